// From a number to a colour: viridis, as in the report (crates/tsubu-report/src/colour.rs).

import { DataTexture, LinearFilter, RGBAFormat } from "./three.min.js";

const VIRIDIS = [
  [68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
  [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37],
];

export function at(t) {
  const place = Math.min(Math.max(t, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(place), VIRIDIS.length - 2);
  return VIRIDIS[low].map((c, k) => Math.round(c + (place - low) * (VIRIDIS[low + 1][k] - c)));
}

// The colours as a texture of one row.
export function texture(width = 256) {
  const data = new Uint8Array(4 * width);
  for (let i = 0; i < width; i++) data.set([...at(i / (width - 1)), 255], 4 * i);
  const map = new DataTexture(data, width, 1, RGBAFormat);
  map.minFilter = map.magFilter = LinearFilter;
  map.needsUpdate = true;
  return map;
}
