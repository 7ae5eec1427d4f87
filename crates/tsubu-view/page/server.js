// What the server is asked for.

import { unpack } from "./packet.js";

async function ask(path, options) {
  let answer;
  try {
    answer = await fetch(path, options);
  } catch {
    throw new Error("The server does not answer: was tsubu view ended?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

export const runs = async () => (await ask("runs")).json();
// By this name the server knows whether this page is still open.
const PAGE = crypto.getRandomValues(new Uint32Array(2)).join("-");

// What there is by now of a run that may go on.
export const news = async (run) => (await ask(`run/${run}/news?${PAGE}`)).json();
// Asks a run to `pause`, `go-on` or `stop`.
export const command = async (run, word) => (await ask(`run/${run}/${word}`, { method: "POST" })).json();
// Says that this page wants nothing more.
export const bye = (run) => navigator.sendBeacon(`run/${run}/bye?${PAGE}`);
// Times, and what a grain has in a column at them.
export const curve = async (run, id, colour) => (await ask(`run/${run}/grain/${id}?colour=${encodeURIComponent(colour)}`)).json();
export const history = async (run) => (await ask(`run/${run}/history`)).text();
export const range = async (run, colour) => (await ask(`run/${run}/range?colour=${encodeURIComponent(colour)}`)).json();
export const grain = async (run, frame, row) => (await ask(`run/${run}/frame/${frame}/grain/${row}`)).json();

export async function frame(run, number, { colour, contacts, arrows }) {
  const wishes = `colour=${encodeURIComponent(colour)}&contacts=${contacts ? 1 : 0}&arrows=${encodeURIComponent(arrows)}`;
  return unpack(await (await ask(`run/${run}/frame/${number}?${wishes}`)).arrayBuffer());
}
