// Numbers and units for people.

export function number(x) {
  if (x === null || x === undefined || !Number.isFinite(x)) return "-";
  if (Number.isInteger(x) && Math.abs(x) < 1e7) return String(x);
  const size = Math.abs(x);
  return size >= 1e-3 && size < 1e5 ? String(Number(x.toPrecision(4))) : x.toExponential(3).replace("e+", "e");
}

export const withUnit = (name, unit) => (unit && unit !== "-" ? `${name} [${unit}]` : name);

// A length in metres with the prefix that reads best.
export function metres(x) {
  const [factor, unit] = x >= 1 ? [1, "m"] : x >= 1e-3 ? [1e3, "mm"] : [1e6, "µm"];
  return `${number(x * factor)} ${unit}`;
}
