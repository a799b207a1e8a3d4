// Meshes, frames and tools of the page as arrays, unpacked when they are asked for.

import { blob, integers, numbers, vectors } from './blob.js';
import { edgesOf, trianglesOf } from './shape.js';

export class Model {
  constructor(scene) {
    this.scene = scene;
    this.meshes = new Map();
    this.shapes = new Map();
  }

  get frames() {
    return this.scene.frames;
  }

  /** Whether a frame has another mesh than the one before. */
  isNewMesh(index) {
    return index > 0 && this.frames[index].mesh !== this.frames[index - 1].mesh;
  }

  async mesh(number) {
    if (!this.meshes.has(number)) {
      const about = this.scene.meshes[number];
      const bytes = await blob(about.blob);
      const faces = integers(bytes, about.faces);
      const mesh = {
        ...about,
        faces,
        cells: integers(bytes, about.cells),
        edges: edgesOf(faces, about.ring, about.nodes),
        ...trianglesOf(faces, about.ring),
      };
      if (about.contact)
        mesh.contactFaces = integers(await blob(about.contact_blob), about.contact.faces);
      this.meshes.set(number, mesh);
    }
    return this.meshes.get(number);
  }

  async shape(number) {
    if (!this.shapes.has(number)) {
      const about = this.scene.shapes[number];
      const bytes = await blob(about.blob);
      this.shapes.set(number, {
        points: vectors(bytes, about.points),
        lines: integers(bytes, about.lines),
        triangles: integers(bytes, about.triangles),
      });
    }
    return this.shapes.get(number);
  }

  async frame(index) {
    const about = this.frames[index];
    const bytes = await blob(about.blob);
    return { about, bytes, mesh: await this.mesh(about.mesh), points: vectors(bytes, about.points) };
  }

  /** Values of a quantity in a frame: at its nodes or faces, and of whole cells where it has them. */
  async values(index, quantity) {
    const about = this.frames[index];
    if (quantity.on === 'tools' || !about.fields[quantity.name]) return undefined;
    const bytes = await blob(about.blob);
    const read = (parts) => quantity.of(parts.map((part) => numbers(bytes, part)));
    return {
      on: quantity.on,
      values: read(about.fields[quantity.name]),
      inside: about.inside?.[quantity.name] && read(about.inside[quantity.name]),
    };
  }

  /** Values of a field at the pieces of a tool. */
  async toolValues(index, tool, name) {
    const about = this.frames[index].tools?.find((each) => each.tool === tool);
    const field = about?.fields?.[name];
    return field && numbers(await blob(this.frames[index].blob), field);
  }
}
