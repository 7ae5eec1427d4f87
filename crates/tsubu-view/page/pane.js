// One run: what of it is drawn, and its frames as they are asked for.

import * as three from "./three.min.js";
import * as server from "./server.js";
import { Grains } from "./grains.js";
import { Walls, put } from "./walls.js";
import { Bonds } from "./bonds.js";
import { Arrows } from "./arrows.js";
import { FrameOfReference } from "./frame_of_reference.js";

// Bytes of frames that are kept for being shown again.
const KEPT = 256 << 20;

export class Pane {
  constructor(run, about, label) {
    this.name = label.appendChild(document.createElement("span"));
    Object.assign(this, { run, about, label, box: new three.Box3(), frames: new Map(), kept: 0 });
    this.grains = new Grains();
    this.walls = new Walls();
    this.bonds = new Bonds();
    this.arrows = new Arrows();
    // Grains that are no spheres and no discs have outlines.
    this.outlines = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial());
    this.outlines.frustumCulled = false;
    this.outlines.renderOrder = 1;
    this.reference = new FrameOfReference();
    this.scene = new three.Scene();
    this.scene.add(this.grains.mesh, this.walls.group, this.bonds.mesh, this.arrows.mesh, this.outlines, this.reference.group);
  }

  // Letters at the ends of the axes, in pixels of the pane.
  letter(camera, width, height) {
    this.letters ??= ["x", "y", "z"].map((textContent) => {
      const letter = Object.assign(document.createElement("span"), { className: "axis", textContent });
      this.label.append(letter);
      return letter;
    });
    this.letters.forEach((letter, k) => {
      const end = this.reference.ends?.[k].clone().project(camera);
      if (!end) return (letter.hidden = true);
      letter.hidden = Math.abs(end.z) > 1 || (camera.isOrthographicCamera && k === 1);
      Object.assign(letter.style, { left: `${((end.x + 1) / 2) * width}px`, top: `${((1 - end.y) / 2) * height}px` });
    });
  }

  // The number of the last frame that is not behind a time.
  at(time) {
    const { times } = this.about;
    let number = 0;
    while (number + 1 < times.length && times[number + 1] <= time * (1 + 1e-9)) number++;
    return number;
  }

  // A frame by its place among those that are there, from the server or from before.
  async fetch(place, { colour, contacts, arrows }) {
    // Frames of a run that goes on have numbers of their own: not all are kept.
    const number = this.about.numbers?.[place] ?? place;
    const key = `${number} ${contacts} ${arrows} ${colour}`;
    if (!this.frames.has(key)) {
      const frame = await server.frame(this.run, number, { colour, contacts, arrows });
      frame.number = number;
      this.frames.set(key, frame);
      this.kept += frame.position.buffer.byteLength;
      for (const [old, { position }] of this.frames) {
        if (this.kept <= KEPT || old === key) break;
        this.frames.delete(old);
        this.kept -= position.buffer.byteLength;
      }
    }
    return this.frames.get(key);
  }

  show(frame, longest) {
    this.frame = frame;
    this.arrows.show(frame, longest);
    put(this.outlines.geometry, frame.outlines ?? []);
    this.grains.show(frame);
    this.walls.show(frame);
    this.bonds.show(frame);
  }

  // The box round walls and all but a hundredth of the grains of some frames: grains that flew away do not make the rest small.
  measure(frames) {
    const before = this.box.clone();
    for (const { position, radius, lines, triangles, cell } of frames) {
      if (!radius.length && !lines.length && !triangles.length) continue;
      for (const points of [lines, triangles]) {
        for (let i = 0; i + 2 < points.length; i += 3) {
          const point = new three.Vector3(points[i], points[i + 1], points[i + 2]);
          if (Number.isFinite(point.lengthSq())) this.box.expandByPoint(point);
        }
      }
      const most = radius.reduce((a, b) => Math.max(a, b), 0);
      const ends = [0, 1, 2].map((k) => middle(position, k));
      if (ends.every((end) => end)) {
        this.box.expandByPoint(new three.Vector3(...ends.map(([low]) => low - most)));
        this.box.expandByPoint(new three.Vector3(...ends.map(([, high]) => high + most)));
      }
      if (cell) {
        const [low, high, repeats] = cell;
        ["x", "y", "z"].forEach((axis, k) => {
          if (repeats[k]) [this.box.min[axis], this.box.max[axis]] = [low[k], high[k]];
        });
      }
    }
    if (!this.box.isEmpty()) this.reference.show(this.box);
    return !before.equals(this.box);
  }
}

// Between which numbers all but a hundredth of a component lie, by some of them.
function middle(vectors, axis) {
  const step = 3 * Math.max(1, Math.floor(vectors.length / 3 / 20000));
  const values = [];
  for (let i = axis; i < vectors.length; i += step) if (Number.isFinite(vectors[i])) values.push(vectors[i]);
  if (!values.length) return undefined;
  values.sort((a, b) => a - b);
  const off = Math.floor(values.length / 200);
  return [values[off], values[values.length - 1 - off]];
}
