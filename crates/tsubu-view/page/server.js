// What the server is asked for.

import { unpack } from "./packet.js";

async function ask(path) {
  let answer;
  try {
    answer = await fetch(path);
  } catch {
    throw new Error("The server does not answer: was tsubu view ended?");
  }
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

export const runs = async () => (await ask("runs")).json();
export const about = async (run) => (await ask(`run/${run}/about`)).json();
export const history = async (run) => (await ask(`run/${run}/history`)).text();
export const range = async (run, colour) => (await ask(`run/${run}/range?colour=${encodeURIComponent(colour)}`)).json();
export const grain = async (run, frame, row) => (await ask(`run/${run}/frame/${frame}/grain/${row}`)).json();

export async function frame(run, number, colour, contacts) {
  const wishes = `colour=${encodeURIComponent(colour)}&contacts=${contacts ? 1 : 0}`;
  return unpack(await (await ask(`run/${run}/frame/${number}?${wishes}`)).arrayBuffer());
}
