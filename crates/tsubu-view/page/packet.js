// A frame from its bytes: a head in JSON, then plain arrays that lie in the bytes as they came.

const KINDS = { f32: Float32Array, i32: Int32Array };

export function unpack(bytes) {
  const length = new DataView(bytes).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  let offset = 4 + length;
  const arrays = {};
  for (const { name, type, length } of head.arrays) {
    arrays[name] = new KINDS[type](bytes, offset, length);
    offset += 4 * length;
  }
  return { ...head, ...arrays };
}
