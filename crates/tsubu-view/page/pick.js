// The grain under a point of the canvas, and its numbers.

import * as three from "./three.min.js";
import * as server from "./server.js";
import { number, withUnit } from "./numbers.js";

// Where the grain is drawn by its number, a single pixel.
const target = new three.WebGLRenderTarget(1, 1);

// The pane behind a point of the page and the row of the grain that is seen there, -1 for none.
export function seen(stage, event) {
  const { left, top } = stage.canvas.getBoundingClientRect();
  const [x, y] = [event.clientX - left, event.clientY - top];
  const number = stage.panes.findIndex((_, n) => {
    const [l, t, w, h] = stage.place(n);
    return x >= l && x < l + w && y >= t && y < t + h;
  });
  if (number < 0) return undefined;
  const [l, t, w, h] = stage.place(number);
  return { pane: stage.panes[number], row: row(stage, stage.panes[number], [x - l, y - t, w, h]) };
}

function row({ renderer, view: { camera } }, { grains }, [x, y, width, height]) {
  const [colour, alpha] = [renderer.getClearColor(new three.Color()), renderer.getClearAlpha()];
  camera.setViewOffset(width, height, x, y, 1, 1);
  grains.mesh.material = grains.asked;
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(grains.mesh, camera);
  const bytes = new Uint8Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, bytes);
  renderer.setRenderTarget(null);
  renderer.setClearColor(colour, alpha);
  grains.mesh.material = grains.material;
  camera.clearViewOffset();
  return new DataView(bytes.buffer).getInt32(0, true) - 1;
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
