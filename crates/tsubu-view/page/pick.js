// The grain under a point of the canvas, and its numbers.

import * as three from "./three.min.js";
import * as server from "./server.js";
import { number, withUnit } from "./numbers.js";

// The row of the nearest grain that a ray meets, grains being drawn smaller by `shrink`; -1 for none.
export function row({ position, radius }, { origin, direction }, cut, shrink) {
  let [best, nearest] = [-1, Infinity];
  for (let i = 0; i < radius.length; i++) {
    const [x, y, z] = position.subarray(3 * i, 3 * i + 3);
    if (cut && cut.x * x + cut.y * y + cut.z * z > cut.w) continue;
    const off = [origin.x - x, origin.y - y, origin.z - z];
    const b = off[0] * direction.x + off[1] * direction.y + off[2] * direction.z;
    const c = off[0] ** 2 + off[1] ** 2 + off[2] ** 2 - (shrink * radius[i]) ** 2;
    const far = -b - Math.sqrt(b * b - c);
    if (far < nearest) [best, nearest] = [i, far];
  }
  return best;
}

// The pane and the ray behind a point of the page.
export function aim(stage, event) {
  const { left, top } = stage.canvas.getBoundingClientRect();
  const [x, y] = [event.clientX - left, event.clientY - top];
  const number = stage.panes.findIndex((_, n) => {
    const [l, t, w, h] = stage.place(n);
    return x >= l && x < l + w && y >= t && y < t + h;
  });
  if (number < 0) return undefined;
  const [l, t, w, h] = stage.place(number);
  const ray = new three.Raycaster();
  ray.setFromCamera(new three.Vector2((2 * (x - l)) / w - 1, 1 - (2 * (y - t)) / h), stage.view.camera);
  return { pane: stage.panes[number], ray: ray.ray };
}

// Fills a table with all that is known of a grain.
export async function tell(table, pane, row) {
  const { run, frame } = pane;
  const columns = await server.grain(run, frame.number, row);
  table.replaceChildren();
  table.createCaption().textContent = `grain ${frame.id[row] ?? row}`;
  for (const { name, unit, value } of columns) {
    const line = table.insertRow();
    const head = document.createElement("th");
    head.textContent = withUnit(name, unit);
    line.append(head);
    line.insertCell().textContent = [value].flat().map(number).join("  ");
  }
  table.hidden = false;
}
