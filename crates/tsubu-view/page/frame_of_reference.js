// Where things are: a box round all that is seen, the cell of periodic axes, and axes at the box's corner.

import * as three from "./three.min.js";
import { put } from "./walls.js";

const AXES = [0xd92d20, 0x039855, 0x1570ef];

export class FrameOfReference {
  constructor() {
    this.group = new three.Group();
    this.ink = new three.LineBasicMaterial({ transparent: true, opacity: 0.35 });
    this.box = new three.LineSegments(new three.BufferGeometry(), this.ink);
    this.group.add(this.box);
    this.axes = AXES.map((color) => new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial({ color })));
    this.group.add(...this.axes);
    for (const part of this.group.children) part.frustumCulled = false;
  }

  show(box) {
    const { min, max } = box;
    const corner = (i) => [i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z];
    const edges = [];
    for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) if (!(i & bit)) edges.push(...corner(i), ...corner(i | bit));
    put(this.box.geometry, edges);
    const long = 0.15 * max.distanceTo(min);
    this.ends = this.axes.map((axis, k) => {
      const end = min.toArray();
      end[k] += long;
      put(axis.geometry, [...min.toArray(), ...end]);
      end[k] += 0.12 * long;
      return new three.Vector3(...end);
    });
  }
}
