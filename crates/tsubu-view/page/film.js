// A film of the run from its first frame to its last, as a WebM file.

import { paint } from "./screenshot.js";

// Pictures a second.
const RATE = 25;

export const possible = () => typeof MediaRecorder === "function" && MediaRecorder.isTypeSupported("video/webm");

// Shows all frames, each as long as the speed says, and gives the film of them. `told()` gives what stands around the grains.
export async function film(stage, player, told) {
  const sheet = document.createElement("canvas");
  await player.go(0);
  paint(sheet, stage, told());
  const stream = sheet.captureStream(RATE);
  const recorder = new MediaRecorder(stream, { mimeType: "video/webm", videoBitsPerSecond: 8e6 });
  const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const done = new Promise((end) => (recorder.onstop = end));
  recorder.start();
  const times = [...player.times];
  let number = 0;
  const begun = performance.now();
  const whole = Math.min(Math.max((times.at(-1) - times[0]) / player.speed, 0.2), 120);
  for (let passed = 0; passed < whole; passed = (performance.now() - begun) / 1000) {
    const time = times[0] + (passed / whole) * (times.at(-1) - times[0]);
    while (number + 1 < times.length && times[number + 1] <= time) number++;
    if (number !== player.number) await player.go(number);
    paint(sheet, stage, told());
    await new Promise((next) => setTimeout(next, 1000 / RATE));
  }
  await player.go(times.length - 1);
  paint(sheet, stage, told());
  await new Promise((next) => setTimeout(next, 2000 / RATE));
  recorder.stop();
  await done;
  return new Blob(parts, { type: "video/webm" });
}
