// A picture of what is seen, with legend and time, as a PNG file.

// Paints what is seen now onto a sheet.
export function paint(sheet, stage, { title, ends, now }) {
  stage.drawNow();
  const { canvas } = stage;
  if (sheet.width !== canvas.width || sheet.height !== canvas.height) Object.assign(sheet, { width: canvas.width, height: canvas.height });
  const pen = sheet.getContext("2d");
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.drawImage(canvas, 0, 0);
  const ratio = canvas.width / canvas.clientWidth;
  pen.scale(ratio, ratio);
  pen.fillStyle = getComputedStyle(canvas).color;
  pen.font = "14px system-ui, sans-serif";
  const right = canvas.clientWidth - 12;
  pen.textAlign = "right";
  pen.fillText(title, right, 26);
  const colours = document.querySelector("#legend canvas");
  if (colours) pen.drawImage(colours, right - 14, 34, 14, 150);
  // Beside colours stand three numbers, beside groups their names, each with its own colour.
  ends.forEach(({ text, colour }, i) => {
    const at = colours ? 45 + 69 * i : 46 + 20 * i;
    pen.fillText(text, right - 20, at);
    if (!colour) return;
    pen.save();
    pen.fillStyle = colour;
    pen.fillRect(right - 14, at - 11, 14, 14);
    pen.restore();
  });
  pen.textAlign = "left";
  pen.fillText(now, 12, canvas.clientHeight - 44);
}

export function picture(stage, told) {
  const sheet = document.createElement("canvas");
  paint(sheet, stage, told);
  return new Promise((done) => sheet.toBlob(done, "image/png"));
}

export function save(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
