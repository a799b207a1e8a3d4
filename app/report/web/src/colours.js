// The colour map (viridis, by its control points) and what has no value.

import vtkColorTransferFunction from '@kitware/vtk.js/Rendering/Core/ColorTransferFunction';

const map = [
  [0.267, 0.005, 0.329], [0.283, 0.141, 0.458], [0.254, 0.265, 0.530], [0.207, 0.372, 0.553],
  [0.164, 0.471, 0.558], [0.128, 0.567, 0.551], [0.135, 0.659, 0.518], [0.267, 0.749, 0.441],
  [0.478, 0.821, 0.318], [0.741, 0.873, 0.150], [0.993, 0.906, 0.144],
];
export const noValue = [0.72, 0.74, 0.77];

export function colourTable(low, high) {
  const table = vtkColorTransferFunction.newInstance();
  map.forEach(([r, g, b], i) => table.addRGBPoint(low + (i / (map.length - 1)) * (high - low), r, g, b));
  table.setNanColor([...noValue, 1]);
  table.setMappingRange(low, high);
  return table;
}

export const gradient = `linear-gradient(to top, ${map
  .map((rgb) => `rgb(${rgb.map((x) => Math.round(255 * x)).join(',')})`)
  .join(', ')})`;
