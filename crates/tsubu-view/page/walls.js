// Walls: lines, and faces that let the grains be seen.

import * as three from "./three.min.js";

export class Walls {
  constructor() {
    this.group = new three.Group();
    this.line = new three.LineBasicMaterial();
    this.face = new three.MeshBasicMaterial({ side: three.DoubleSide, transparent: true, opacity: 0.14, depthWrite: false });
    this.lines = new three.LineSegments(new three.BufferGeometry(), this.line);
    this.faces = new three.Mesh(new three.BufferGeometry(), this.face);
    this.faces.renderOrder = 2;
    for (const part of [this.lines, this.faces]) {
      part.frustumCulled = false;
      this.group.add(part);
    }
  }

  show({ lines, triangles }) {
    put(this.lines.geometry, lines);
    put(this.faces.geometry, triangles);
  }
}

// Corners of a geometry; those of the same number are overwritten, as walls mostly keep their shape.
export function put(geometry, corners, name = "position", size = 3) {
  const known = geometry.attributes[name];
  if (known?.array.length === corners.length) {
    known.array.set(corners);
    known.needsUpdate = true;
    return;
  }
  geometry.dispose();
  geometry.setAttribute(name, new three.BufferAttribute(new Float32Array(corners), size));
}
