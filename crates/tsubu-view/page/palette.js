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

// What has no order has colours that are told apart, by people who see fewer of them too (Okabe and Ito).
const APART = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66], [120, 120, 120]];
export const apart = (number) => APART[number % APART.length];

// Colours as a texture of one row: those of numbers from 0 to 1, or of so many things.
export function texture(things, width = 256) {
  const data = new Uint8Array(4 * width);
  const of = (i) => (things ? apart(Math.min(Math.floor((i / width) * things), things - 1)) : at(i / (width - 1)));
  for (let i = 0; i < width; i++) data.set([...of(i), 255], 4 * i);
  const map = new DataTexture(data, width, 1, RGBAFormat);
  map.minFilter = map.magFilter = LinearFilter;
  map.needsUpdate = true;
  return map;
}
