// The page: it asks what runs there are, and ties the parts together.

import * as server from "./server.js";
import { Box3 } from "./three.min.js";
import { Stage } from "./stage.js";
import { Pane } from "./pane.js";
import { View } from "./camera.js";
import { Player, SPEEDS } from "./player.js";
import { Curves, colourOf } from "./curves.js";
import { parse } from "./table.js";
import { legend } from "./legend.js";
import { scaleBar } from "./scale_bar.js";
import { number, withUnit } from "./numbers.js";
import * as live from "./live.js";
import * as status from "./status.js";
import * as cut from "./cut.js";
import * as pick from "./pick.js";
import * as screenshot from "./screenshot.js";
import * as theme from "./theme.js";

const $ = (id) => document.getElementById(id);
const options = (select, names) => select.replaceChildren(...names.map(([value, text]) => new Option(text, value)));

// What went wrong is said where everybody looks; the next thing that goes right takes it away.
function say(error) {
  $("message").hidden = !error;
  if (error) $("message").textContent = error.message ?? error;
}
const tried = (work) => (...args) => Promise.resolve().then(() => work(...args)).then(() => say(), say);

async function begin() {
  const runs = await server.runs();
  await live.begun(runs, say);
  const panes = runs.map((about, run) => {
    const label = Object.assign(document.createElement("div"), { className: "pane" });
    if (runs.length > 1) label.style.color = colourOf(run);
    $("panes").append(label);
    return new Pane(run, about, label);
  });
  document.title = `tsubu view: ${runs.map(({ name }) => name).join(", ")}`;
  const stage = new Stage($("canvas"), panes);
  // The run that goes on longest gives the clock, of those that end together the one with the most frames; the others follow it.
  const end = ({ about }) => about.times.at(-1);
  const clock = () => {
    const last = 0.99 * Math.max(...panes.map(end));
    return panes.filter((pane) => end(pane) >= last).reduce((a, b) => (b.about.times.length > a.about.times.length ? b : a));
  };
  const state = { colour: "velocity", contacts: false, cut: cut.NO_CUT, range: [0, 1], picked: undefined };
  const wanted = (pane, time) => pane.fetch(pane.at(time), state.colour, state.contacts);

  async function show(number) {
    const time = player.times[number];
    const frames = await Promise.all(panes.map((pane) => wanted(pane, time)));
    panes.forEach((pane, i) => pane.show(frames[i]));
    mark();
    stage.draw();
    // The next one comes while this one is seen.
    if (number + 1 < player.times.length) for (const pane of panes) wanted(pane, player.times[number + 1]).catch(() => {});
  }
  const player = new Player(clock().about.times, show);

  const first = await Promise.all(panes.map((pane) => wanted(pane, player.times[0])));
  const last = await Promise.all(panes.map((pane) => wanted(pane, player.times.at(-1))));
  // Where a run begins or ends without a grain, those between tell how much room they take.
  const { times } = player;
  const bare = (frame) => !frame.radius.length;
  const between = first.some(bare) || last.some(bare) ? [0.25, 0.5, 0.75].map((share) => times[Math.floor(share * times.length)]) : [];
  const inner = await Promise.all(panes.map((pane) => Promise.all(between.map((time) => wanted(pane, time)))));
  const flat = first.every((frame, i) => (panes[i].about.dimension ?? (frame.position.every((x, k) => k % 3 !== 1 || x === 0) ? 2 : 3)) === 2);
  panes.forEach((pane, i) => {
    pane.measure([first[i], last[i], ...inner[i]]);
    pane.grains.material.uniforms.flatland.value = flat;
    pane.reference.box.visible = !flat;
    pane.bonds.lieOn(flat);
  });
  const box = new Box3();
  const unite = () => panes.forEach((pane) => box.union(pane.box));
  unite();
  stage.view = new View(stage.canvas, flat, () => stage.draw());
  stage.drawn = () => scaleBar($("scale-bar"), stage.view.metresPerPixel(stage.grid().height));
  stage.resize();
  stage.view.fit(box);
  theme.set(theme.preferred(), stage);

  const { columns } = first[0];
  options($("colour"), columns.map(({ name, unit }) => [name, withUnit(name, unit)]));
  if (!columns.some(({ name }) => name === state.colour)) state.colour = columns.at(0)?.name ?? "";
  $("colour").value = state.colour;

  // Colours mean the same at all times and in all panes.
  async function paint() {
    const ranges = (await Promise.all(panes.map(({ run }) => server.range(run, state.colour)))).filter((range) => range);
    state.range = ranges.length ? [Math.min(...ranges.map(([a]) => a)), Math.max(...ranges.map(([, b]) => b))] : [0, 1];
    for (const pane of panes) pane.grains.material.uniforms.range.value.set(...state.range);
    const { name, unit } = columns.find(({ name }) => name === state.colour) ?? { name: "", unit: "" };
    legend($("legend"), withUnit(name, unit), state.range);
    await player.go(player.wish ?? player.number);
  }

  // The picked grain keeps its mark from frame to frame, by its id.
  function mark() {
    const { picked } = state;
    for (const pane of panes) {
      const row = picked?.pane === pane ? pane.frame.id.indexOf(picked.id) : -1;
      pane.grains.material.uniforms.picked.value = row;
      if (picked?.pane === pane && !player.playing) {
        if (row < 0) $("grain").hidden = true;
        else pick.tell($("grain"), pane, row).catch(say);
      }
    }
  }

  const table = async ({ run }) => parse(await server.history(run).catch(() => ""));
  const tables = await Promise.all(panes.map(table));
  const curves = new Curves($("curves"), tables, (time) => tried(() => player.step(clock().at(time) - player.number))());
  // Which curves there are: a run that goes on may have no row yet.
  function listCurves() {
    const names = [...new Set(curves.tables.flatMap(({ names }) => names.slice(1)))];
    if (names.length === $("curve").options.length) return;
    options($("curve"), names.map((name) => [name, name]));
    $("history").hidden = names.length === 0;
    curves.name ??= names.find((name) => name.startsWith("kinetic")) ?? names[0];
    $("curve").value = curves.name;
  }
  $("history").hidden = true;
  listCurves();

  player.changed = () => {
    const { times, number: now, playing } = player;
    Object.assign($("time"), { max: times.length - 1, value: now });
    $("now").textContent = `${number(times[now])} s, frame ${now + 1} of ${times.length}`;
    $("time").setAttribute("aria-valuetext", $("now").textContent);
    $("play").textContent = playing ? "⏸" : "▶";
    $("play").setAttribute("aria-label", playing ? "pause" : "play");
    curves.time = times[now];
    curves.draw();
  };
  player.speed = player.natural();
  options($("speed"), SPEEDS.map((speed) => [speed, `${speed} × real time`]));
  $("speed").value = player.speed;

  const cutNow = () => {
    const axis = $("cut-axis").value;
    $("cut").hidden = !axis;
    state.cut = cut.plane(axis, Number($("cut").value), box);
    for (const pane of panes) cut.apply(pane, state.cut);
    stage.draw();
  };
  const fit = () => stage.view.fit(box);
  const turnTheme = () => {
    theme.set(theme.other(), stage);
    curves.draw();
  };
  const shoot = async () => {
    const ends = [...$("legend").querySelectorAll("span")].map((span) => span.textContent);
    const title = $("legend").querySelector(".title").textContent;
    screenshot.save(await screenshot.picture(stage, { title, ends, now: $("now").textContent }), "tsubu.png");
  };
  $("colour").onchange = tried(() => ((state.colour = $("colour").value), paint()));
  $("contacts").onchange = tried(() => {
    state.contacts = $("contacts").checked;
    for (const pane of panes) {
      pane.bonds.mesh.visible = state.contacts;
      // Bonds lie on discs, but inside of spheres: these make room.
      pane.grains.material.uniforms.shrink.value = state.contacts && !flat ? 0.35 : 1;
    }
    return player.go(player.number);
  });
  $("walls").onchange = () => {
    for (const pane of panes) pane.walls.group.visible = $("walls").checked;
    stage.draw();
  };
  $("cut-axis").onchange = $("cut").oninput = cutNow;
  $("curve").onchange = () => ((curves.name = $("curve").value), curves.draw());
  let speedTold = false;
  $("speed").onchange = () => ((speedTold = true), (player.speed = Number($("speed").value)));
  $("time").oninput = tried(() => player.step(Number($("time").value) - player.number));
  $("play").onclick = () => player.toggle();
  $("fit").onclick = fit;
  $("theme").onclick = turnTheme;
  $("screenshot").onclick = tried(shoot);

  let pressed;
  stage.canvas.addEventListener("pointerdown", ({ clientX, clientY }) => (pressed = [clientX, clientY]));
  stage.canvas.addEventListener("click", tried(async (event) => {
    if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const aimed = pick.aim(stage, event);
    const row = aimed && pick.row(aimed.pane.frame, aimed.ray, state.cut, aimed.pane.grains.material.uniforms.shrink.value);
    state.picked = aimed && row >= 0 ? { pane: aimed.pane, id: aimed.pane.frame.id[row] } : undefined;
    if (!state.picked) $("grain").hidden = true;
    mark();
    stage.draw();
  }));

  const keys = {
    " ": () => player.toggle(),
    ArrowRight: () => player.step(1),
    ArrowLeft: () => player.step(-1),
    Home: () => player.step(-Infinity),
    End: () => player.step(Infinity),
    f: fit,
    d: turnTheme,
    s: shoot,
  };
  addEventListener("keydown", (event) => {
    if (event.target.matches("select, input, button") || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    tried(act)();
  });

  // Who looks at the last frame of a run that goes on is taken along.
  let [painted, drawn] = [Math.max(...panes.map(live.count)), -Infinity];
  async function grown(pane) {
    const last = player.number + 1 === player.times.length && !player.playing;
    const now = player.times[player.number];
    const grew = pane.measure([await pane.fetch(pane.about.times.length - 1, state.colour, state.contacts)]);
    if (grew) {
      unite();
      if (!stage.view.moved) fit();
    }
    player.times = clock().about.times;
    player.number = clock().at(now);
    if (last) await player.go(Infinity);
    // A history may be long: it is looked up once a second.
    if (performance.now() > drawn + 1000) await curve(pane);
    if (!speedTold) $("speed").value = player.speed = player.natural();
    player.changed();
    // The range of the colours is that of all frames: now and then it is looked up again.
    if (live.count(pane) >= 2 * painted) {
      painted = live.count(pane);
      await paint();
    }
  }
  async function curve(pane) {
    drawn = performance.now();
    curves.tables[pane.run] = await table(pane);
    listCurves();
    curves.draw();
  }
  async function ended() {
    await Promise.all(panes.map(curve));
    await paint();
  }
  const told = (pane) => {
    const { name, status: word } = pane.about;
    pane.name.textContent = name + (word === "finished" ? "" : `: ${word}`);
    status.tell(panes, say);
  };
  await paint();
  if (panes.some(({ about }) => about.live && about.status !== "finished")) await player.go(Infinity);
  // What a page carries itself is played, over and over, unless the reader wants things still.
  if ("embedded" in document.documentElement.dataset) {
    player.loop = true;
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) player.play();
  }
  live.follow(panes, { grown, told, ended, failed: say });
  Object.assign(window, { tsubu: { player, stage, panes, state, ready: true } });
}

begin().catch(say);
