// A picture of what is seen, with legend and time, as a PNG file.

export function picture(stage, { title, ends, now }) {
  stage.drawNow();
  const { canvas } = stage;
  const sheet = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const pen = sheet.getContext("2d");
  pen.drawImage(canvas, 0, 0);
  const ratio = canvas.width / canvas.clientWidth;
  pen.scale(ratio, ratio);
  pen.fillStyle = getComputedStyle(canvas).color;
  pen.font = "14px system-ui, sans-serif";
  const right = canvas.clientWidth - 12;
  pen.drawImage(document.querySelector("#legend canvas"), right - 14, 34, 14, 150);
  pen.textAlign = "right";
  pen.fillText(title, right, 26);
  ends.forEach((text, i) => pen.fillText(text, right - 20, 45 + 69 * i));
  pen.textAlign = "left";
  pen.fillText(now, 12, canvas.clientHeight - 44);
  return new Promise((done) => sheet.toBlob(done, "image/png"));
}

export function save(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
