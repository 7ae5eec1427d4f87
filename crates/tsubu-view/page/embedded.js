// What a page in one file is asked for instead of a server: some frames that it carries, their numbers rounded to 8 or 16 bits.

const { about, scales, columns, frames, history } = window.carried.head;
const bytes = window.carried.bytes;

// The frames, each from what it differs by from the one before it.
const [LAST8, LAST16] = [0xff, 0xffff];
const decoded = [];
let offset = 0;
let before = {};
for (const { arrays, ...frame } of frames) {
  const now = {};
  for (const { name, bits, length, same } of arrays) {
    if (same) {
      now[name] = before[name];
      continue;
    }
    const last = before[name]?.length === length ? before[name] : undefined;
    const values = bits === 8 ? new Uint8Array(length) : new Uint16Array(length);
    for (let i = 0; i < length; i++) {
      const difference = bytes[offset + i] + (bits === 8 ? 0 : bytes[offset + length + i] << 8);
      values[i] = difference + (last ? last[i] : 0);
    }
    offset += (bits / 8) * length;
    now[name] = values;
  }
  decoded.push({ ...frame, arrays: now });
  before = now;
}

// Real numbers of an array; of vectors all x stand first, then all y, then all z.
function reals(name, values, width = 1) {
  const [count, most] = [values.length / width, values instanceof Uint8Array ? LAST8 : LAST16];
  const plain = new Float32Array(values.length);
  for (let axis = 0; axis < width; axis++) {
    const [low, high] = scales[name][axis];
    for (let i = 0; i < count; i++) {
      const x = values[axis * count + i];
      // The highest stands for what is no number.
      plain[i * width + axis] = x === most ? NaN : low + (x / (most - 1)) * (high - low);
    }
  }
  return plain;
}

export const runs = async () => [about];
export const news = async () => about;
export const command = async () => about;
export const bye = () => {};
export const range = async (_, colour) => columns.find(({ name }) => name === colour)?.range;

const table = async () => history ?? "";
export { table as history };

const moments = new Map();
function moment(number) {
  if (!moments.has(number)) {
    const { time, step, cell, arrays } = decoded[number];
    const found = { number, time, step, cell, columns: columns.map(({ name, unit }) => ({ name, unit })) };
    const known = (name, width) => (arrays[name] ? reals(name, arrays[name], width) : new Float32Array(0));
    for (const name of ["radius", "forces", "polyhedron", "face of", "rounding"]) found[name] = known(name);
    for (const name of ["position", "lines", "triangles", "bonds", "outlines", "semi-axes"]) found[name] = known(name, 3);
    for (const name of ["turned", "faces"]) found[name] = known(name, 4);
    found.exponents = known("exponents", 2);
    for (const name of ["id", "id high", "group"]) found[name] = Int32Array.from(known(name), Math.round);
    found.id = found.id.map((id, i) => id + 32768 * found["id high"][i]);
    found.grains = found.radius.length;
    moments.set(number, found);
  }
  return moments.get(number);
}

const painted = (number, colour) => {
  const values = decoded[number].arrays[`colour ${colour}`];
  return values ? reals(`colour ${colour}`, values) : new Float32Array(0);
};

export async function frame(_, number, { colour }) {
  return { ...moment(number), colour: painted(number, colour), range: columns.find(({ name }) => name === colour)?.range };
}

export async function grain(_, number, row) {
  const { position } = moment(number);
  const place = { name: "position", unit: "m", value: [...position.subarray(3 * row, 3 * row + 3)] };
  return [place, ...columns.map(({ name, unit }) => ({ name, unit, value: painted(number, name)[row] }))];
}

export async function curve(_, id, colour) {
  const at = (number) => painted(number, colour)[moment(number).id.indexOf(id)] ?? null;
  return [decoded.map(({ time }) => time), decoded.map((_, number) => at(number))];
}
