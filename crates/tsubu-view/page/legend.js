// What the colours mean: name, unit and numbers beside the palette.

import { apart, at } from "./palette.js";
import { number } from "./numbers.js";

export function legend(element, title, [low, high]) {
  element.innerHTML = '<div class="title"></div><div class="scale"><div class="ends"><span></span><span></span><span></span></div><canvas width="1" height="256"></canvas></div>';
  element.querySelector(".title").textContent = title;
  const pen = element.querySelector("canvas").getContext("2d");
  for (let y = 0; y < 256; y++) {
    pen.fillStyle = `rgb(${at(high > low ? 1 - y / 255 : 0.35)})`;
    pen.fillRect(0, y, 1, 1);
  }
  const spans = element.querySelectorAll("span");
  const told = high > low ? [high, (low + high) / 2, low].map(number) : ["", number(low), ""];
  told.forEach((text, i) => (spans[i].textContent = text));
  element.setAttribute("aria-label", `colour: ${title}, from ${number(low)} to ${number(high)}`);
}

// What the colours of groups mean: their names.
export function names(element, title, groups) {
  const lines = groups.map((name, i) => {
    const line = Object.assign(document.createElement("div"), { className: "name" });
    const swatch = Object.assign(document.createElement("i"), { className: "swatch" });
    swatch.style.background = `rgb(${apart(i)})`;
    line.append(Object.assign(document.createElement("span"), { textContent: name }), swatch);
    return line;
  });
  element.replaceChildren(Object.assign(document.createElement("div"), { className: "title", textContent: title }), ...lines);
  element.setAttribute("aria-label", `colour: ${title}: ${groups.join(", ")}`);
}

// What stands beside the colours, and the colour of each that has its own.
export function told(element) {
  return [...element.querySelectorAll("span")].map((span) => ({ text: span.textContent, colour: span.nextElementSibling?.style?.background }));
}
