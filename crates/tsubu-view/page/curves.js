// The curve of the history beside the grains, with a cursor at the moment that is shown.

import { number } from "./numbers.js";

const COLOURS = ["#1570ef", "#d92d20", "#039855", "#9e77ed", "#dc6803", "#0e9384"];
const EDGE = { left: 62, right: 10, top: 10, bottom: 34 };

export class Curves {
  constructor(canvas, tables, go) {
    Object.assign(this, { canvas, tables, time: 0, name: undefined });
    canvas.addEventListener("click", (event) => this.scale && go(this.scale.time(event.offsetX)));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  draw() {
    const { canvas, tables, name, time } = this;
    const [width, height, ratio] = [canvas.clientWidth, canvas.clientHeight, devicePixelRatio];
    Object.assign(canvas, { width: width * ratio, height: height * ratio });
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const style = getComputedStyle(canvas);
    const ink = (variable) => style.getPropertyValue(variable);
    const { grain } = this;
    const curves =
      grain && grain.name === name
        ? tables.map((_, run) => (run === grain.run ? [grain.x, grain.y] : [[], []]))
        : tables.map(({ names, columns }) => [columns[0], columns[names.indexOf(name)]]).map(([x, y]) => (y ? [x, y] : [[], []]));
    const [x0, x1] = ends(curves.map(([x]) => x));
    const [y0, y1] = ends(curves.map(([, y]) => y));
    this.scale = undefined;
    if (!(x1 >= x0 && y1 >= y0)) return;
    const across = (x) => EDGE.left + ((x - x0) / (x1 - x0 || 1)) * (width - EDGE.left - EDGE.right);
    const up = (y) => height - EDGE.bottom - ((y - y0) / (y1 - y0 || 1)) * (height - EDGE.top - EDGE.bottom);
    this.scale = { time: (pixel) => x0 + ((pixel - EDGE.left) / (width - EDGE.left - EDGE.right)) * (x1 - x0) };
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = ink("--faint");
    pen.strokeStyle = ink("--line");
    pen.strokeRect(EDGE.left, EDGE.top, width - EDGE.left - EDGE.right, height - EDGE.top - EDGE.bottom);
    pen.textAlign = "right";
    for (const y of [y0, (y0 + y1) / 2, y1]) pen.fillText(number(y), EDGE.left - 5, up(y) + 4);
    [[x0, "left"], [x1, "right"]].forEach(([x, align]) => {
      pen.textAlign = align;
      pen.fillText(number(x), across(x), height - EDGE.bottom + 14);
    });
    pen.textAlign = "center";
    pen.fillText("time [s]", across((x0 + x1) / 2), height - 6);
    curves.forEach(([x, y], run) => {
      pen.strokeStyle = COLOURS[run % COLOURS.length];
      pen.lineWidth = 1.5;
      pen.beginPath();
      // More points than pixels look the same.
      let apart = true;
      const step = Math.max(1, Math.floor(x.length / (4 * width)));
      for (let i = 0; i < x.length; i += step) {
        // Where a grain is not there its curve has a gap.
        if (!Number.isFinite(y[i])) apart = true;
        else if (apart) (pen.moveTo(across(x[i]), up(y[i])), (apart = false));
        else pen.lineTo(across(x[i]), up(y[i]));
      }
      pen.stroke();
    });
    pen.strokeStyle = ink("--mark");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(across(time), EDGE.top);
    pen.lineTo(across(time), height - EDGE.bottom);
    pen.stroke();
    canvas.setAttribute("aria-label", `${name} against time, from ${number(y0)} to ${number(y1)}; a click goes to a time`);
  }
}

// Of several columns the lowest and the highest number.
function ends(columns) {
  let [low, high] = [Infinity, -Infinity];
  for (const column of columns) {
    for (const x of column) {
      if (!Number.isFinite(x)) continue;
      if (x < low) low = x;
      if (x > high) high = x;
    }
  }
  return [low, high];
}

export const colourOf = (run) => COLOURS[run % COLOURS.length];
