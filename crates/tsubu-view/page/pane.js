// One run: what of it is drawn, and its frames as they are asked for.

import * as three from "./three.min.js";
import * as server from "./server.js";
import { Grains } from "./grains.js";
import { Walls } from "./walls.js";
import { Bonds } from "./bonds.js";
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
    this.reference = new FrameOfReference();
    this.scene = new three.Scene();
    this.scene.add(this.grains.mesh, this.walls.group, this.bonds.mesh, this.reference.group);
  }

  // Letters at the ends of the axes, in pixels of the pane.
  letter(camera, width, height) {
    this.letters ??= ["x", "y", "z"].map((textContent) => {
      const letter = Object.assign(document.createElement("span"), { className: "axis", textContent });
      this.label.append(letter);
      return letter;
    });
    this.letters.forEach((letter, k) => {
      const end = this.reference.ends[k].clone().project(camera);
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

  // A frame, from the server or from before.
  async fetch(number, colour, contacts) {
    const key = `${number} ${contacts} ${colour}`;
    if (!this.frames.has(key)) {
      const frame = await server.frame(this.run, number, colour, contacts);
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

  show(frame) {
    this.frame = frame;
    this.grains.show(frame);
    this.walls.show(frame);
    this.bonds.show(frame);
  }

  // The box round all that a frame shows.
  measure(frame) {
    this.box.makeEmpty();
    for (const points of [frame.position, frame.lines, frame.triangles]) {
      for (let i = 0; i + 2 < points.length; i += 3) {
        const point = new three.Vector3(points[i], points[i + 1], points[i + 2]);
        if (Number.isFinite(point.lengthSq())) this.box.expandByPoint(point);
      }
    }
    this.box.expandByScalar(frame.radius.reduce((a, b) => Math.max(a, b), 0));
    if (frame.cell) {
      const [low, high, repeats] = frame.cell;
      ["x", "y", "z"].forEach((axis, k) => {
        if (repeats[k]) [this.box.min[axis], this.box.max[axis]] = [low[k], high[k]];
      });
    }
    this.reference.show(this.box);
  }
}
