// How a run is: its stage, how much is done, what `check` said of it; and the buttons that pause and stop it.

import * as server from "./server.js";
import { number } from "./numbers.js";

const $ = (id) => document.getElementById(id);
const node = (name, properties, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};

// What is known of a run, put where the page has room for it; `failed(error)` hears of a command that did not come through.
export function tell(panes, failed) {
  const live = panes.find(({ about }) => about.live);
  $("run").hidden = !live && panes.every(({ about }) => !about.verdict);
  if (live) control(live, failed);
  const parts = panes.map((pane) => verdict(pane, panes.length > 1));
  const told = JSON.stringify(panes.map(({ about }) => [about.verdict, about.stages, about.status]));
  if ($("verdict").dataset.told === told) return;
  $("verdict").dataset.told = told;
  $("verdict").replaceChildren(...parts.filter((part) => part));
}

function control({ run, about }, failed) {
  const { status, now, steps, share, told } = about;
  const goesOn = status === "running" || status === "paused";
  const text = `${status}: t = ${number(now)} s, ${steps.toLocaleString("en")} steps${told ? `; ${told}` : ""}`;
  if ($("status").textContent !== text) $("status").textContent = text;
  $("share").hidden = false;
  $("share").value = status === "finished" ? 1 : share;
  $("control").hidden = !goesOn;
  const ask = (word) => server.command(run, word).then((news) => control({ run, about: news }, failed), failed);
  $("pause").textContent = status === "paused" ? "go on" : "pause";
  $("pause").onclick = () => ask(status === "paused" ? "go-on" : "pause");
  $("stop").onclick = () => ask("stop");
}

// Stages with the present one marked, and the verdict behind a line that says whether it warns.
function verdict({ name, about }, several) {
  const warnings = about.verdict.split("\n").filter((line) => line.startsWith("warn")).length;
  const word = warnings ? `check: ${warnings} warning${warnings > 1 ? "s" : ""}` : "check: no warning";
  if (!about.verdict) return undefined;
  const stages = about.stages.map((stage, i) => {
    const here = i + 1 === about.stages.length && about.live && about.status !== "finished";
    return node("li", here ? { ariaCurrent: "step" } : {}, `${stage}${here ? " (now)" : ""}`);
  });
  const whole = node("details", {}, node("summary", {}, several ? `${name.textContent}: ${word}` : word), node("pre", {}, about.verdict));
  return node("div", {}, ...(stages.length ? [node("ol", { ariaLabel: "stages" }, ...stages)] : []), whole);
}
