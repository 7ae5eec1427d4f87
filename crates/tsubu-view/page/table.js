// A history: columns of numbers under names with units.

function cells(line) {
  const found = line.match(/("([^"]|"")*"|[^,]*)(,|$)/g) ?? [];
  return found.slice(0, found.at(-1) === "" ? -1 : undefined).map((cell) => {
    const plain = cell.replace(/,$/, "");
    return plain.startsWith('"') ? plain.slice(1, -1).replaceAll('""', '"') : plain;
  });
}

// From CSV, whose first column is the time.
export function parse(text) {
  const [head, ...rows] = text.split("\n").filter((line) => line);
  const names = cells(head ?? "");
  const columns = names.map(() => new Float64Array(rows.length));
  rows.forEach((row, i) => row.split(",").forEach((cell, k) => columns[k] && (columns[k][i] = cell === "" ? NaN : Number(cell))));
  return { names, columns };
}
