// The scene of vtk.js: renderer, camera, actors. Knows nothing of frames.

import '@kitware/vtk.js/Rendering/Profiles/Geometry';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkAxesActor from '@kitware/vtk.js/Rendering/Core/AxesActor';
import vtkCellArray from '@kitware/vtk.js/Common/Core/CellArray';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkGenericRenderWindow from '@kitware/vtk.js/Rendering/Misc/GenericRenderWindow';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkOrientationMarkerWidget from '@kitware/vtk.js/Interaction/Widgets/OrientationMarkerWidget';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';

/** Numbers of points as vtk.js wants them: each cell begins with how many it has. */
function cellArray(numbers, width) {
  const n = numbers.length / width;
  const cells = new Uint32Array(n * (width + 1));
  for (let i = 0; i < n; ++i) {
    cells[i * (width + 1)] = width;
    for (let k = 0; k < width; ++k) cells[i * (width + 1) + 1 + k] = numbers[i * width + k];
  }
  return vtkCellArray.newInstance({ values: cells });
}

/** A surface, or lines, that can change from frame to frame. */
export class Body {
  constructor(stage, { colour, width = 1, lighting = true, opacity = 1 }) {
    this.data = vtkPolyData.newInstance();
    this.mapper = vtkMapper.newInstance();
    this.mapper.setInputData(this.data);
    this.mapper.setScalarVisibility(false);
    this.actor = vtkActor.newInstance();
    this.actor.setMapper(this.mapper);
    const property = this.actor.getProperty();
    property.setColor(...colour);
    property.setLineWidth(width);
    property.setLighting(lighting);
    property.setAmbient(0.5);
    property.setDiffuse(0.55);
    property.setSpecular(0);
    property.setOpacity(opacity);
    stage.renderer.addActor(this.actor);
    this.show(false);
  }

  show(on) {
    this.actor.setVisibility(on);
  }

  /** Lines a little in front of the surface they lie on. */
  inFront() {
    this.mapper.setResolveCoincidentTopologyToPolygonOffset();
    this.mapper.setRelativeCoincidentTopologyLineOffsetParameters(-1, -2);
  }

  /** A surface behind those that it coincides with: a tool where the part lies on it. */
  behind() {
    this.mapper.setResolveCoincidentTopologyToPolygonOffset();
    this.mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(2, 6);
  }

  set({ points, triangles = [], lines = [] }) {
    this.data = vtkPolyData.newInstance();
    this.data.getPoints().setData(Float32Array.from(points), 3);
    this.data.setPolys(cellArray(triangles, 3));
    this.data.setLines(cellArray(lines, 2));
    this.mapper.setInputData(this.data);
    this.mapper.setScalarVisibility(false);
  }

  /** @param at  'points' or 'cells' */
  colour(values, at, table) {
    const array = vtkDataArray.newInstance({ name: 'shown', values: Float32Array.from(values) });
    (at === 'points' ? this.data.getPointData() : this.data.getCellData()).setScalars(array);
    if (at === 'points') this.mapper.setScalarModeToUsePointData();
    else this.mapper.setScalarModeToUseCellData();
    this.mapper.setInterpolateScalarsBeforeMapping(at === 'points');
    this.mapper.setLookupTable(table);
    this.mapper.setUseLookupTableScalarRange(true);
    this.mapper.setScalarVisibility(true);
    this.data.modified();
  }

  clip(plane) {
    this.mapper.removeAllClippingPlanes();
    if (plane) this.mapper.addClippingPlane(plane);
  }
}

const widthOfLegend = 190; // with its distance from the edge [CSS px]

const directions = {
  x: { from: [1, 0, 0], up: [0, 0, 1] },
  y: { from: [0, 1, 0], up: [0, 0, 1] },
  z: { from: [0, 0, 1], up: [0, 1, 0] },
  iso: { from: [1, -1.2, 0.8], up: [0, 0, 1] },
  'iso, y up': { from: [1, 0.7, 1.2], up: [0, 1, 0] },
};

export class Stage {
  constructor(container) {
    this.window = vtkGenericRenderWindow.newInstance();
    this.window.setContainer(container);
    this.renderer = this.window.getRenderer();
    this.renderWindow = this.window.getRenderWindow();
    this.interactor = this.window.getInteractor();
    this.camera = this.renderer.getActiveCamera();
    this.addAxes();
    this.setTheme();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.setTheme();
      this.render();
    });
    new ResizeObserver(() => {
      this.window.resize();
      this.render();
    }).observe(container);
    this.window.resize();
  }

  addAxes() {
    const axes = vtkAxesActor.newInstance();
    const widget = vtkOrientationMarkerWidget.newInstance({ actor: axes, interactor: this.interactor });
    widget.setEnabled(true);
    widget.setViewportCorner(vtkOrientationMarkerWidget.Corners.BOTTOM_LEFT);
    widget.setViewportSize(0.14);
    widget.setMinPixelSize(60);
    widget.setMaxPixelSize(120);
  }

  setTheme() {
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    this.renderer.setBackground(...(dark ? [0.114, 0.137, 0.169] : [0.96, 0.965, 0.972]));
  }

  render() {
    this.renderWindow.render();
  }

  look(name, bounds, parallel) {
    const { from, up } = directions[name];
    const middle = [0, 1, 2].map((d) => (bounds[2 * d] + bounds[2 * d + 1]) / 2);
    this.camera.setParallelProjection(parallel);
    this.camera.setFocalPoint(...middle);
    this.camera.setPosition(...middle.map((m, d) => m + from[d]));
    this.camera.setViewUp(...up);
    this.renderer.resetCamera(bounds);
    if (parallel) this.fit(bounds);
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  /** Of a parallel view as large as the picture allows, to the left of the legend. */
  fit(bounds) {
    const [width, height] = this.window.getApiSpecificRenderWindow().getSize();
    const up = this.camera.getViewUp();
    const along = this.camera.getDirectionOfProjection();
    const right = [
      along[1] * up[2] - along[2] * up[1],
      along[2] * up[0] - along[0] * up[2],
      along[0] * up[1] - along[1] * up[0],
    ];
    const extent = (axis) =>
      [0, 1, 2].reduce((sum, d) => sum + Math.abs(axis[d]) * (bounds[2 * d + 1] - bounds[2 * d]), 0);
    const legend = Math.min(widthOfLegend * devicePixelRatio, 0.3 * width);
    const scale = Math.max(extent(up), (extent(right) * height) / Math.max(width - legend, 1));
    this.camera.setParallelScale(0.54 * scale || 1);
    // By half of the legend to the right.
    const aside = (legend * this.camera.getParallelScale()) / Math.max(height, 1);
    const moved = (place) => place.map((value, d) => value + aside * right[d]);
    this.camera.setPosition(...moved(this.camera.getPosition()));
    this.camera.setFocalPoint(...moved(this.camera.getFocalPoint()));
  }

  cameraState() {
    const c = this.camera;
    return {
      position: c.getPosition(),
      focus: c.getFocalPoint(),
      up: c.getViewUp(),
      scale: c.getParallelScale(),
      parallel: c.getParallelProjection(),
    };
  }

  restoreCamera(state) {
    this.camera.setParallelProjection(state.parallel);
    this.camera.setPosition(...state.position);
    this.camera.setFocalPoint(...state.focus);
    this.camera.setViewUp(...state.up);
    this.camera.setParallelScale(state.scale);
    this.renderer.resetCameraClippingRange();
    this.render();
  }

  async picture() {
    const [image] = this.renderWindow.captureImages();
    return image;
  }
}
