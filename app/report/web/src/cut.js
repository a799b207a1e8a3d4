// The section of a plane through cells of a part in space: triangles with interpolated values.

const tetrahedra = {
  4: [[0, 1, 2, 3]],
  8: [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]],
};
const sides = {
  4: [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 3]],
  8: [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
};

/** Heights of the nodes above a plane; none is on it. */
function heights(points, origin, normal) {
  const above = new Float64Array(points.length / 3);
  for (let i = 0; i < above.length; ++i) {
    let h = 0;
    for (let d = 0; d < 3; ++d) h += (points[3 * i + d] - origin[d]) * normal[d];
    above[i] = h === 0 ? 1e-30 : h;
  }
  return above;
}

/**
 * @returns {points, between, share, cell, triangles, lines}: of every point the two nodes that it
 *          lies between and how far towards the second; of every triangle its cell
 */
export function section(mesh, points, origin, normal) {
  const { cells, corners } = mesh;
  const above = heights(points, origin, normal);
  const at = [], between = [], share = [], triangles = [], cell = [], lines = [];
  const known = new Map();
  const cross = (a, b) => {
    const [low, high] = a < b ? [a, b] : [b, a];
    const key = low * mesh.nodes + high;
    if (known.has(key)) return known.get(key);
    const t = above[low] / (above[low] - above[high]);
    for (let d = 0; d < 3; ++d)
      at.push(points[3 * low + d] + t * (points[3 * high + d] - points[3 * low + d]));
    between.push(low, high);
    share.push(t);
    known.set(key, share.length - 1);
    return share.length - 1;
  };
  for (let c = 0; c < cells.length; c += corners) {
    let positive = 0;
    for (let i = 0; i < corners; ++i) positive += above[cells[c + i]] > 0 ? 1 : 0;
    if (positive === 0 || positive === corners) continue;
    for (const tetrahedron of tetrahedra[corners]) {
      const nodes = tetrahedron.map((i) => cells[c + i]);
      const up = nodes.filter((node) => above[node] > 0);
      const down = nodes.filter((node) => above[node] < 0);
      const add = (...three) => (triangles.push(...three), cell.push(c / corners));
      if (up.length === 1) add(...down.map((node) => cross(up[0], node)));
      else if (down.length === 1) add(...up.map((node) => cross(node, down[0])));
      else if (up.length === 2) {
        const [p, q] = [cross(up[0], down[0]), cross(up[0], down[1])];
        const [r, s] = [cross(up[1], down[1]), cross(up[1], down[0])];
        add(p, q, r);
        add(p, r, s);
      }
    }
    for (const side of sides[corners]) {
      const ends = [];
      side.forEach((i, k) => {
        const [a, b] = [cells[c + i], cells[c + side[(k + 1) % side.length]]];
        if (above[a] > 0 !== above[b] > 0) ends.push(cross(a, b));
      });
      if (ends.length === 2) lines.push(...ends);
    }
  }
  return {
    points: Float32Array.from(at),
    between,
    share,
    cell,
    triangles: Int32Array.from(triangles),
    lines: Int32Array.from(lines),
  };
}

/** Values at the points of a section. */
export function interpolated(cut, values) {
  return Float32Array.from(cut.share, (t, i) => {
    const [a, b] = [values[cut.between[2 * i]], values[cut.between[2 * i + 1]]];
    return a + t * (b - a);
  });
}
