// A bar of a round length, for what is in the middle of the view.

import { metres } from "./numbers.js";

export function scaleBar(element, metresPerPixel) {
  const most = 120 * metresPerPixel;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].find((digit) => digit * power <= most) * power;
  element.style.width = `${length / metresPerPixel}px`;
  element.textContent = metres(Number(length.toPrecision(1)));
  element.setAttribute("aria-label", `scale bar of ${element.textContent}`);
}
