// The view of the frames: what of a frame is drawn, by the settings of the controls.

import vtkPlane from '@kitware/vtk.js/Common/DataModel/Plane';

import { colourTable } from './colours.js';
import { makeControls, makePlay, showLegend } from './controls.js';
import { interpolated, section } from './cut.js';
import { quantities, spread } from './fields.js';
import { Model } from './model.js';
import { probeOn } from './probe.js';
import { flat, images, reflected, revolved, revolvedTool } from './shape.js';
import { Body, Stage } from './stage.js';

const part = [0.62, 0.66, 0.72];
const tool = [0.45, 0.55, 0.68];
const ink = [0.33, 0.35, 0.39]; // seen on dark and on bright colours

function defaults(about) {
  const first = ['von_mises', 'plastic_strain'].find((key) => about.quantities.some((q) => q.key === key));
  return {
    field: first ?? about.quantities[0]?.key ?? '',
    range: 'frame', low: 0, high: 1,
    edges: true, mirror: false, revolve: false, ghost: true,
    section: false, normal: 'x', nx: 1, ny: 0, nz: 0, position: 50, flip: false, cutTools: true,
    frame: about.frames - 1, last: true, look: undefined,
    tools: Object.fromEntries(about.tools.map((name) => [name, true])),
  };
}

/** What was chosen before, where this page has it too. */
function restored(about, saved) {
  const settings = { ...defaults(about), ...(saved?.settings ?? {}) };
  settings.tools = { ...defaults(about).tools, ...(saved?.settings?.tools ?? {}) };
  if (settings.last || settings.frame >= about.frames) settings.frame = about.frames - 1;
  if (settings.field && !about.quantities.some((q) => q.key === settings.field))
    settings.field = defaults(about).field;
  return settings;
}

class Viewer {
  constructor(container, scene, saved, showTime) {
    this.model = new Model(scene);
    this.scene = scene;
    this.showTime = showTime;
    this.quantities = quantities(scene.fields);
    const tools = [...new Set(scene.frames.flatMap((frame) => (frame.tools ?? []).map((t) => t.tool)))];
    this.about = {
      quantities: this.quantities,
      tools,
      planes: this.planesOfSymmetry(),
      frames: scene.frames.length,
      solid: scene.dimension === 3,
      axisymmetric: scene.axisymmetric,
    };
    this.settings = restored(this.about, saved);
    this.controls = makeControls(container, this.about, this.settings, {
      changed: (key) => this.changed(key),
      look: (name) => this.look(name),
      save: () => this.save(),
    });
    makePlay(this.controls.play, this.controls.slider);
    this.stage = new Stage(this.controls.canvas);
    this.plane = vtkPlane.newInstance();
    this.makeBodies(tools);
    this.container = container;
    this.queue = Promise.resolve();
    probeOn(this);
  }

  /** In an axisymmetric scene the axis, too, is one. */
  planesOfSymmetry() {
    const planes = [...this.scene.symmetry];
    if (this.scene.axisymmetric && !planes.some(({ axis, value }) => axis === 0 && value === 0))
      planes.push({ axis: 0, value: 0 });
    return planes;
  }

  makeBodies(tools) {
    const lighting = this.about.solid;
    const body = (options) => new Body(this.stage, options);
    this.surface = body({ colour: part, lighting });
    this.edges = body({ colour: ink, lighting: false });
    this.cap = body({ colour: part, lighting: false });
    this.capEdges = body({ colour: ink, lighting: false });
    this.contact = body({ colour: part, lighting: false, width: 5 });
    [this.edges, this.capEdges, this.contact].forEach((each) => each.inFront());
    this.tools = new Map(tools.map((name) => [name, body({ colour: tool, width: 2, lighting: true })]));
    for (const each of this.tools.values()) each.behind();
  }

  changed(key) {
    if (key === 'frame') this.settings.last = this.settings.frame === this.about.frames - 1;
    const whole = ['mirror', 'revolve'].includes(key);
    return whole ? this.lookAtAll() : this.redraw();
  }

  /** One drawing at a time; of several that wait only the last one is made. */
  redraw() {
    this.wanted = (this.wanted ?? 0) + 1;
    const mine = this.wanted;
    this.queue = this.queue.then(async () => {
      if (mine === this.wanted) await this.draw();
    });
    return this.queue;
  }

  async draw() {
    const { settings } = this;
    const index = settings.frame;
    const frame = await this.model.frame(index);
    this.frame = frame;
    const quantity = this.quantities.find(({ key }) => key === settings.field);
    const shown = quantity && (await this.model.values(index, quantity));
    this.shown = shown && { ...shown, quantity };
    this.setSurface(frame);
    await this.setTools(index);
    this.box = this.boundsOfPart();
    this.setSection(frame);
    const range = await this.rangeOf(index, quantity, shown);
    if (range) this.colour(shown, range, quantity);
    await this.colourTools(index, quantity, range);
    showLegend(this.controls.legend, range && quantity, range ?? {});
    this.describe(index);
    this.stage.renderer.resetCameraClippingRange();
    this.stage.render();
  }

  setSurface({ mesh, points }) {
    const { settings } = this;
    this.isRevolved = settings.revolve && this.about.axisymmetric;
    this.planes = settings.mirror && !this.isRevolved ? this.about.planes : [];
    this.shape = this.isRevolved ? revolved(mesh, points) : flat(mesh, points, this.planes);
    this.surface.actor.getProperty().setLighting(this.about.solid || this.isRevolved);
    this.surface.set({ points: this.shape.points, triangles: this.shape.triangles });
    this.surface.show(true);
    this.edges.set({ points: this.shape.points, lines: this.shape.lines });
    this.edges.show(settings.edges);
    this.setContact(mesh, points);
  }

  /** Contact faces, where their own field is asked for. */
  setContact(mesh, points) {
    const on = this.shown?.on === 'contact' && mesh.contactFaces;
    this.contact.show(Boolean(on));
    if (!on) return;
    const { width } = mesh.contact;
    const cells = { lines: [], triangles: [] };
    this.contactOf = [];
    for (let f = 0; f < mesh.contactFaces.length; f += width) {
      const nodes = Array.from(mesh.contactFaces.subarray(f, f + width)).filter((node) => node >= 0);
      for (let i = 1; i < nodes.length - (this.about.solid ? 1 : 0); ++i) {
        if (this.about.solid) cells.triangles.push(nodes[0], nodes[i], nodes[i + 1]);
        else cells.lines.push(nodes[i - 1], nodes[i]);
        this.contactOf.push(f / width);
      }
    }
    this.contact.set({ points, ...cells });
  }

  async setTools(index) {
    const present = new Map((this.model.frames[index].tools ?? []).map((each) => [each.tool, each]));
    for (const [name, body] of this.tools) {
      const about = present.get(name);
      body.show(Boolean(about) && this.settings.tools[name]);
      if (!about) continue;
      const shape = await this.model.shape(about.shape);
      const points = about.pose ? moved(shape.points, about.pose) : shape.points;
      const flatLines = !shape.triangles.length;
      const solid = this.isRevolved && flatLines ? revolvedTool(points, shape.lines) : undefined;
      body.set(solid ? { points: solid.points, triangles: solid.triangles } : mirroredTool(points, shape, this.planes));
      body.copies = solid ? 0 : images(this.planes).length;
      const property = body.actor.getProperty();
      property.setOpacity(this.settings.ghost && (solid || !flatLines) ? 0.3 : 1);
    }
  }

  boundsOfPart() {
    const bounds = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity];
    this.shape.points.forEach((value, i) => {
      const d = i % 3;
      bounds[2 * d] = Math.min(bounds[2 * d], value);
      bounds[2 * d + 1] = Math.max(bounds[2 * d + 1], value);
    });
    return bounds;
  }

  /** Origin and normal of the section; the half that the normal points to is shown. */
  sectionPlane() {
    const { normal, nx, ny, nz, position, flip } = this.settings;
    let n = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] }[normal] ?? [nx, ny, nz];
    const length = Math.hypot(...n);
    n = length > 0 ? n.map((value) => value / length) : [1, 0, 0];
    const ends = [Infinity, -Infinity];
    for (let corner = 0; corner < 8; ++corner) {
      const h = n.reduce((sum, value, d) => sum + value * this.box[2 * d + ((corner >> d) & 1)], 0);
      ends[0] = Math.min(ends[0], h);
      ends[1] = Math.max(ends[1], h);
    }
    const height = ends[0] + (position / 100) * (ends[1] - ends[0]);
    const kept = flip ? n : n.map((value) => -value);
    // A little into the half that stays: faces in the plane itself would show through its filling.
    const inside = 1e-4 * (ends[1] - ends[0]);
    return { origin: n.map((value, d) => value * height + kept[d] * inside), normal: kept, height };
  }

  setSection({ mesh, points }) {
    const { section: on, cutTools } = this.settings;
    const { origin, normal, height } = this.sectionPlane();
    this.plane.setOrigin(...origin);
    this.plane.setNormal(...normal);
    [this.surface, this.edges, this.contact].forEach((body) => body.clip(on && this.plane));
    for (const body of this.tools.values()) body.clip(on && cutTools && this.plane);
    this.controls.where.textContent = on ? `${+height.toPrecision(4)} ${this.scene.length}` : '';
    const filled = on && mesh.corners > 0;
    this.cap.show(filled);
    this.capEdges.show(filled && this.settings.edges);
    this.cuts = [];
    if (!filled) return;
    // The image of a cut is the cut of the part by the image of the plane.
    const pieces = images(this.planes).map((image) => {
      const at = reflected(Float32Array.from(origin), image);
      const across = reflected(Float32Array.from(normal), image.map(({ axis }) => ({ axis, value: 0 })));
      const cut = section(mesh, points, at, across);
      this.cuts.push(cut);
      return { ...cut, points: reflected(cut.points, image) };
    });
    const body = joinedCuts(pieces);
    this.cap.set({ points: body.points, triangles: body.triangles });
    this.capEdges.set({ points: body.points, lines: body.lines });
  }

  async rangeOf(index, quantity, shown) {
    const { settings } = this;
    if (!quantity) return undefined;
    const all = shown ? shown.values : await this.valuesOfTools(index, quantity);
    if (!all) return undefined;
    const range = spread(all);
    if (settings.range === 'fixed') Object.assign(range, { low: settings.low, high: settings.high });
    if (settings.range === 'whole') Object.assign(range, { low: range.least, high: range.largest });
    if (settings.range === 'run') Object.assign(range, await this.rangeOfRun(quantity));
    if (!(range.high > range.low)) range.high = range.low + (Math.abs(range.low) || 1) * 1e-3;
    return range;
  }

  async rangeOfRun(quantity) {
    this.runRanges ??= new Map();
    if (!this.runRanges.has(quantity.key)) {
      let [low, high] = [Infinity, -Infinity];
      for (let i = 0; i < this.about.frames; ++i) {
        const values = (await this.model.values(i, quantity))?.values ?? (await this.valuesOfTools(i, quantity)) ?? [];
        for (const value of values) {
          if (value < low) low = value;
          if (value > high) high = value;
        }
      }
      this.runRanges.set(quantity.key, low <= high ? { low, high } : {});
    }
    return this.runRanges.get(quantity.key);
  }

  colour({ on, values, inside }, { low, high }, quantity) {
    const table = colourTable(low, high);
    if (on === 'nodes') {
      this.surface.colour(pick(values, this.shape.source), 'points', table);
      if (this.cuts.length) this.cap.colour(this.cuts.flatMap((cut) => [...interpolated(cut, values)]), 'points', table);
    } else if (on === 'elements') {
      this.surface.colour(pick(values, this.shape.face), 'cells', table);
      if (this.cuts.length && inside)
        this.cap.colour(this.cuts.flatMap((cut) => cut.cell.map((c) => inside[c])), 'cells', table);
    } else if (on === 'contact' && this.frame.mesh.contactFaces) {
      this.contact.colour(this.contactOf.map((face) => values[face]), 'cells', table);
    }
    this.table = { low, high, quantity };
  }

  async valuesOfTools(index, quantity) {
    if (quantity.on !== 'tools') return undefined;
    const name = quantity.name.replace(' (tools)', '');
    const all = [];
    for (const each of this.tools.keys()) {
      const values = await this.model.toolValues(index, each, name);
      if (values) all.push(...values);
    }
    return all.length ? all : undefined;
  }

  async colourTools(index, quantity, range) {
    if (quantity?.on !== 'tools' || !range) return;
    const table = colourTable(range.low, range.high);
    for (const [each, body] of this.tools) {
      const values = await this.model.toolValues(index, each, quantity.name.replace(' (tools)', ''));
      if (!values || !body.copies) continue;
      body.colour(Array.from({ length: body.copies }, () => [...values]).flat(), 'cells', table);
      body.actor.getProperty().setOpacity(1);
    }
  }

  describe(index) {
    const { time } = this.model.frames[index];
    const mesh = this.frame.mesh;
    this.controls.time.textContent =
      `t = ${+time.toPrecision(5)} ${this.scene.time}, frame ${index + 1} of ${this.about.frames}` +
      (this.model.isNewMesh(index) ? `, new mesh (${mesh.elements} ${mesh.element})` : '');
    Object.assign(this.container.dataset, { frame: index, time, field: this.settings.field, mesh: this.frame.about.mesh });
    this.showTime(time);
  }

  /** A view that holds the part as it is in this frame and as it was in the first one. */
  async lookAtAll() {
    const { frame } = this.settings;
    this.settings.frame = 0;
    await this.redraw();
    this.first = this.box;
    this.settings.frame = frame;
    await this.redraw();
    this.look('reset');
  }

  /** Box of the part now and at first; now alone where it goes far, as through a roll gap. */
  boxToLookAt() {
    const both = this.box.map((value, i) => (i % 2 ? Math.max : Math.min)(value, this.first?.[i] ?? value));
    const size = (box) => Math.hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
    return size(both) < 1.5 * size(this.box) ? both : this.box;
  }

  look(name) {
    if (name !== 'reset') this.settings.look = name;
    const planar = !this.about.solid && !this.isRevolved;
    const usual = this.about.solid ? 'iso' : this.isRevolved ? 'iso, y up' : 'z';
    const chosen = name === 'reset' ? usual : name;
    this.stage.look(chosen, this.boxToLookAt(), planar || ['x', 'y', 'z'].includes(chosen));
  }

  async save() {
    const link = document.createElement('a');
    link.href = await this.stage.picture();
    link.download = `${document.title.replace(/[^\w-]+/g, '-')}-${this.settings.frame + 1}.png`;
    link.click();
  }

  state() {
    return { settings: this.settings, camera: this.stage.cameraState() };
  }
}

const pick = (values, source) => Float32Array.from(source, (i) => (i < 0 ? NaN : values[i]));

/** Points under a rigid motion, the first three rows of its matrix. */
function moved(points, m) {
  const result = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3)
    for (let r = 0; r < 3; ++r)
      result[i + r] =
        m[4 * r] * points[i] + m[4 * r + 1] * points[i + 1] + m[4 * r + 2] * points[i + 2] + m[4 * r + 3];
  return result;
}

function mirroredTool(points, { lines, triangles }, planes) {
  const n = points.length / 3;
  const all = { points: [], lines: [], triangles: [] };
  images(planes).forEach((image, k) => {
    all.points.push(...reflected(points, image));
    for (const node of lines) all.lines.push(node + k * n);
    for (const node of triangles) all.triangles.push(node + k * n);
  });
  return all;
}

function joinedCuts(cuts) {
  const all = { points: [], triangles: [], lines: [] };
  for (const cut of cuts) {
    const first = all.points.length / 3;
    for (const value of cut.points) all.points.push(value);
    for (const node of cut.triangles) all.triangles.push(node + first);
    for (const node of cut.lines) all.lines.push(node + first);
  }
  return all;
}

export async function showFrames(container, scene, saved, showTime) {
  const viewer = new Viewer(container, scene, saved, showTime);
  await viewer.lookAtAll();
  if (saved?.camera) viewer.stage.restoreCamera(saved.camera);
  container.dataset.state = 'ready';
  return viewer;
}
