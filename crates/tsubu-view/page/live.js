// A run that is still computed: its new frames are shown as they come, as long as the last one is looked at.

import * as server from "./server.js";

const EVERY = 1000;

// Asks for news of the panes whose runs are not at their end; `grown(pane)` hears of new frames, `ended()` that all are at their end, and
// `failed(error)` of a server that does not answer.
export function follow(panes, { grown, ended, failed }) {
  const running = () => panes.filter(({ about }) => about.status === "running");
  const say = (pane) => (pane.name.textContent = pane.about.name + (pane.about.status === "running" ? ": running" : ""));
  panes.forEach(say);
  async function ask() {
    for (const pane of running()) {
      const news = await server.about(pane.run);
      const more = news.times.length !== pane.about.times.length;
      pane.about = news;
      say(pane);
      if (more) await grown(pane);
    }
    if (!running().length) await ended();
  }
  const again = () => running().length && setTimeout(() => ask().catch(failed).then(again), EVERY);
  again();
}
