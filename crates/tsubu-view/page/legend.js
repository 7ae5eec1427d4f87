// What the colours mean: name, unit and numbers beside the palette.

import { at } from "./palette.js";
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
