// A click on the part shows the node nearest to it and its value.

import vtkCellPicker from '@kitware/vtk.js/Rendering/Core/CellPicker';

const digits = (value) => String(+value.toPrecision(5));

export function probeOn(viewer) {
  const { canvas, probe } = viewer.controls;
  const picker = vtkCellPicker.newInstance();
  picker.setPickFromList(true);
  picker.setTolerance(0);
  picker.initializePickList();
  picker.addPickList(viewer.surface.actor);
  let pressed;
  canvas.addEventListener('pointerdown', (event) => (pressed = [event.clientX, event.clientY]), true);
  canvas.addEventListener('pointerup', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    probe.textContent = described(viewer, picker, canvas, event);
  }, true);
}

function described(viewer, picker, canvas, event) {
  const box = canvas.getBoundingClientRect();
  const [width, height] = viewer.stage.window.getApiSpecificRenderWindow().getSize();
  const x = ((event.clientX - box.left) / box.width) * width;
  const y = (1 - (event.clientY - box.top) / box.height) * height;
  picker.pick([x, y, 0], viewer.stage.renderer);
  const triangle = picker.getCellId();
  if (triangle < 0) return '';
  const at = picker.getPickPosition();
  const { shape } = viewer;
  const corners = Array.from(shape.triangles.subarray(3 * triangle, 3 * triangle + 3));
  const distance = (point) => Math.hypot(...[0, 1, 2].map((d) => shape.points[3 * point + d] - at[d]));
  const nearest = corners.reduce((best, point) => (distance(point) < distance(best) ? point : best));
  const place = [0, 1, 2].map((d) => digits(shape.points[3 * nearest + d]));
  let text = `(${place.join(', ')}) ${viewer.scene.length}`;
  const { shown } = viewer;
  const value = shown?.on === 'nodes' ? shown.values[shape.source[nearest]]
    : shown?.on === 'elements' ? shown.values[shape.face[triangle]] : undefined;
  if (Number.isFinite(value)) text += `\n${shown.quantity.label}: ${digits(value)} ${shown.quantity.unit ?? ''}`;
  return text;
}
