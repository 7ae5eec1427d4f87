// A plane that cuts away what is in front of it: whole grains and bonds, and walls where it passes.

import * as three from "./three.min.js";

export const NO_CUT = new three.Vector4(0, 0, 0, 1);

// The plane across an axis at a share of a box: what lies beyond it goes.
export function plane(axis, share, box) {
  if (!axis) return NO_CUT;
  const at = box.min[axis] + share * (box.max[axis] - box.min[axis]);
  // The view comes from negative y: there the near side goes.
  const side = axis === "y" ? -1 : 1;
  const cut = new three.Vector4(0, 0, 0, side * at);
  cut[axis] = side;
  return cut;
}

export function apply(pane, cut) {
  for (const { material } of [pane.grains, pane.bonds, pane.arrows]) material.uniforms.cut.value.copy(cut);
  const planes = cut === NO_CUT ? [] : [new three.Plane(new three.Vector3(-cut.x, -cut.y, -cut.z), cut.w)];
  for (const material of [pane.walls.line, pane.walls.face]) material.clippingPlanes = planes;
}
