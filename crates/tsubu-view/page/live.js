// A run that is still computed: its new frames are shown as they come, as long as the last one is looked at.

import * as server from "./server.js";

// Milliseconds between questions for news: of a run in the same program, of a folder that is written to, of a run at its end.
const [SOON, EVERY, SELDOM] = [250, 1000, 20000];

const goesOn = ({ about }) => about.status === "running" || about.status === "paused";
export const count = ({ about: { times, numbers } }) => (numbers ? (numbers.at(-1) ?? -1) + 1 : times.length);

// The first frames may take a while: grains are placed and settled before.
export async function begun(runs, say) {
  const waits = ({ times, status, live }) => live && !times.length && (status === "running" || status === "paused");
  for (let i = 0; i < runs.length; i++) {
    while (waits(runs[i])) {
      say("The run is being prepared: grains are placed, and settled where the scene asks for it.");
      await new Promise((done) => setTimeout(done, SOON));
      runs[i] = await server.news(i);
    }
    if (!runs[i].times.length) throw new Error(runs[i].told || "The run has no frame.");
  }
  say();
}

// Asks for news of the panes; `grown(pane)` hears of new frames, `told(pane)` of anything, `ended()` that all are at their end, and
// `failed(error)` of a server that does not answer.
export function follow(panes, { grown, told, ended, failed }) {
  const soon = panes.some(({ about }) => about.live) ? SOON : EVERY;
  let running = true;
  panes.forEach(told);
  async function ask() {
    for (const pane of running ? panes.filter(goesOn) : panes.filter(({ about }) => about.live)) {
      const before = count(pane);
      pane.about = await server.news(pane.run);
      told(pane);
      if (count(pane) !== before) await grown(pane);
    }
    if (running && !panes.some(goesOn)) {
      running = false;
      await ended();
      // The server of a run that was stopped goes once its pages have all that they want.
      panes.filter(({ about }) => about.live && about.status !== "finished").forEach(({ run }) => server.bye(run));
    }
  }
  const again = () => {
    if (running) setTimeout(() => ask().catch(failed).then(again), soon);
    // A run at its end is shown as long as a page asks.
    else if (panes.some(({ about }) => about.live)) setTimeout(() => ask().catch(() => {}).then(again), SELDOM);
  };
  running = panes.some(goesOn);
  again();
  addEventListener("pagehide", () => panes.filter(({ about }) => about.live).forEach(({ run }) => server.bye(run)));
}
