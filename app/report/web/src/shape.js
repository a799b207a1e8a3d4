// Triangles and edges of what is shown, from the faces of the mesh: as it is, mirrored, revolved.
//
// A shape is {points, source, triangles, face, lines}: of every point the node whose values it
// shows, of every triangle the face it is part of.

/** Triangles of a ring of nodes; mid-sides stand between corners. */
const cuts = {
  3: [[0, 1, 2]],
  4: [[0, 1, 2], [0, 2, 3]],
  6: [[0, 1, 5], [1, 2, 3], [3, 4, 5], [1, 3, 5]],
  8: [[0, 1, 7], [1, 2, 3], [3, 4, 5], [5, 6, 7], [1, 3, 5], [1, 5, 7]],
};

export function trianglesOf(faces, ring) {
  const cut = cuts[ring];
  const n = faces.length / ring;
  const triangles = new Int32Array(3 * cut.length * n);
  const face = new Int32Array(cut.length * n);
  let at = 0;
  for (let f = 0; f < n; ++f)
    for (const corners of cut) {
      face[at / 3] = f;
      for (const corner of corners) triangles[at++] = faces[f * ring + corner];
    }
  return { triangles, face };
}

/** Pieces of the faces' edges, and those that belong to one face only. */
export function edgesOf(faces, ring, nodes) {
  const count = new Map();
  for (let f = 0; f < faces.length; f += ring)
    for (let i = 0; i < ring; ++i) {
      const [a, b] = [faces[f + i], faces[f + ((i + 1) % ring)]];
      const key = Math.min(a, b) * nodes + Math.max(a, b);
      count.set(key, (count.get(key) ?? 0) + 1);
    }
  const all = new Int32Array(2 * count.size);
  const border = [];
  let at = 0;
  for (const [key, times] of count) {
    const [a, b] = [Math.floor(key / nodes), key % nodes];
    all[at++] = a;
    all[at++] = b;
    if (times === 1) border.push(a, b);
  }
  return { all, border: Int32Array.from(border) };
}

/** Joins shapes into one. */
function joined(parts) {
  const total = (name) => parts.reduce((sum, part) => sum + part[name].length, 0);
  const shape = {
    points: new Float32Array(total('points')),
    source: new Int32Array(total('source')),
    triangles: new Int32Array(total('triangles')),
    face: new Int32Array(total('face')),
    lines: new Int32Array(total('lines')),
  };
  const at = { points: 0, source: 0, triangles: 0, face: 0, lines: 0 };
  for (const part of parts) {
    const first = at.source;
    for (const name of ['points', 'source', 'face']) {
      shape[name].set(part[name], at[name]);
      at[name] += part[name].length;
    }
    for (const name of ['triangles', 'lines'])
      for (const node of part[name]) shape[name][at[name]++] = node + first;
  }
  return shape;
}

/** Every combination of the planes: [] for the part itself, [p] for its image in p, and so on. */
export function images(planes) {
  return planes.reduce((all, plane) => [...all, ...all.map((image) => [...image, plane])], [[]]);
}

export function reflected(points, image) {
  const result = points.slice();
  for (const { axis, value } of image)
    for (let i = axis; i < result.length; i += 3) result[i] = 2 * value - result[i];
  return result;
}

export function flat(mesh, points, planes) {
  const source = Int32Array.from({ length: mesh.nodes }, (_, i) => i);
  return joined(
    images(planes).map((image) => ({
      points: reflected(points, image),
      source,
      triangles: mesh.triangles,
      face: mesh.face,
      lines: mesh.edges.all,
    })),
  );
}

const turned = (points, angle) => {
  const result = points.slice();
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  for (let i = 0; i < points.length; i += 3) {
    result[i] = c * points[i];
    result[i + 2] = -s * points[i];
  }
  return result;
};

/** Lines of the plane, turned about the y axis. */
function surfaceOfRevolution(points, segments, angle, steps) {
  const n = points.length / 3;
  const parts = { points: [], source: [], triangles: [], face: [], lines: [] };
  for (let k = 0; k <= steps; ++k) {
    parts.points.push(...turned(points, (angle * k) / steps));
    for (let i = 0; i < n; ++i) parts.source.push(i);
  }
  for (let k = 0; k < steps; ++k)
    for (let i = 0; i < segments.length; i += 2) {
      const [a, b] = [segments[i] + k * n, segments[i + 1] + k * n];
      parts.triangles.push(a, b, b + n, a, b + n, a + n);
      parts.face.push(-1, -1);
    }
  return parts;
}

const degrees = Math.PI / 180;
export const opening = 270 * degrees;

/** An axisymmetric part over three quarters of a turn, its section at both ends. */
export function revolved(mesh, points, steps = 48) {
  const border = mesh.edges.border;
  const used = [...new Set(border)].sort((a, b) => a - b);
  const number = new Map(used.map((node, i) => [node, i]));
  const outline = new Float32Array(3 * used.length);
  used.forEach((node, i) => outline.set(points.subarray(3 * node, 3 * node + 3), 3 * i));
  const skin = surfaceOfRevolution(outline, border.map((node) => number.get(node)), opening, steps);
  skin.source = skin.source.map((i) => used[i]);
  const source = Int32Array.from({ length: mesh.nodes }, (_, i) => i);
  const end = (angle) => ({
    points: turned(points, angle),
    source,
    triangles: mesh.triangles,
    face: mesh.face,
    lines: mesh.edges.all,
  });
  return joined([skin, end(0), end(opening)]);
}

/** Lines as far as they lie at positive radii. */
function atPositiveRadii(points, lines) {
  const kept = [];
  for (let i = 0; i < lines.length; i += 2) {
    let ends = [lines[i], lines[i + 1]].map((node) => points.slice(3 * node, 3 * node + 3));
    if (ends.every(([x]) => x < 0)) continue;
    const t = ends[0][0] / (ends[0][0] - ends[1][0]);
    const foot = [0, ends[0][1] + t * (ends[1][1] - ends[0][1]), 0];
    ends = ends.map((end) => (end[0] < 0 ? foot : end));
    kept.push(...ends[0], ...ends[1]);
  }
  return Float32Array.from(kept);
}

/** A tool of the plane, revolved in the same way; a plane extends beyond the axis and would appear twice. */
export function revolvedTool(points, lines, steps = 48) {
  const outline = atPositiveRadii(points, lines);
  const segments = Int32Array.from({ length: outline.length / 3 }, (_, i) => i);
  return surfaceOfRevolution(outline, segments, opening, steps);
}
