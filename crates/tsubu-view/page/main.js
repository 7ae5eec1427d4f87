// The page: it asks what runs there are, and ties the parts together.

import * as server from "./server.js";
import { Box3 } from "./three.min.js";
import { Stage } from "./stage.js";
import { Pane } from "./pane.js";
import { View } from "./camera.js";
import { Player, SPEEDS } from "./player.js";
import { Curves, colourOf } from "./curves.js";
import { parse } from "./table.js";
import * as legend from "./legend.js";
import { longest } from "./arrows.js";
import * as film from "./film.js";
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
  const state = { colour: "velocity", contacts: false, arrows: "", cut: cut.NO_CUT, range: [0, 1], picked: undefined, cost: 0 };
  const wanted = (pane, time) => pane.fetch(pane.at(time), state);

  async function show(number) {
    const time = player.times[number];
    const frames = await Promise.all(panes.map((pane) => wanted(pane, time)));
    const begun = performance.now();
    const most = Math.max(...frames.map(longest));
    panes.forEach((pane, i) => pane.show(frames[i], most));
    tellScales(frames, most);
    mark();
    // Milliseconds that this moment took outside of the graphics card, but for the drawing itself.
    state.cost = performance.now() - begun;
    stage.draw();
    // The next one comes while this one is seen.
    if (number + 1 < player.times.length) for (const pane of panes) wanted(pane, player.times[number + 1]).catch(() => {});
  }
  // What arrows and bonds stand for at this moment.
  function tellScales(frames, most) {
    const told = [];
    if (state.arrows && most > 0) told.push(`longest arrow: ${number(most)} ${unitOf(state.arrows)}`);
    const force = Math.max(0, ...frames.map(({ forces }) => forces?.reduce((a, b) => Math.max(a, b), 0) ?? 0));
    if (state.contacts && force > 0) told.push(`thickest bond: ${number(force)} N`);
    $("scales").textContent = told.join("; ");
  }
  const unitOf = (name) => first[0].columns.find((column) => column.name === name)?.unit;
  const player = new Player(clock().about.times, show);
  window.tsubu = { player, stage, panes, state };

  const first = await Promise.all(panes.map((pane) => wanted(pane, player.times[0])));
  const flat = first.every((frame, i) => (panes[i].about.dimension ?? (frame.position.every((x, k) => k % 3 !== 1 || x === 0) ? 2 : 3)) === 2);
  panes.forEach((pane, i) => {
    pane.measure([first[i]]);
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
  // Of a vector there are components; frames that a page carries have no arrows.
  const vectors = columns.filter(({ name }) => columns.some((other) => other.name === `${name} x`) && name !== "position");
  options($("arrows"), [["", "none"], ...vectors.map(({ name, unit }) => [name, withUnit(name, unit)])]);
  $("arrows").parentElement.hidden = !vectors.length;

  // Colours mean the same at all times and in all panes.
  async function paint() {
    scale(await Promise.all(panes.map(({ run }) => server.range(run, state.colour))));
    await player.go(player.wish ?? player.number);
  }
  function scale(found) {
    const ranges = found.filter((range) => range);
    state.range = ranges.length ? [Math.min(...ranges.map(([a]) => a)), Math.max(...ranges.map(([, b]) => b))] : [0, 1];
    const groups = state.colour === "group" ? groupNames() : undefined;
    for (const pane of panes) pane.grains.paint(state.range, groups?.length);
    const { name, unit } = columns.find(({ name }) => name === state.colour) ?? { name: "", unit: "" };
    if (groups) legend.names($("legend"), "group", groups);
    else legend.legend($("legend"), withUnit(name, unit), state.range);
  }
  // Names of the groups; their numbers where nobody has told names.
  function groupNames() {
    const named = panes.map(({ about }) => about.groups ?? []).reduce((a, b) => (b.length > a.length ? b : a));
    const count = Math.max(named.length, Math.round(state.range[1]) + 1);
    return Array.from({ length: count }, (_, i) => named[i] ?? String(i));
  }
  // The first picture does not wait for what the colours of the whole run are.
  scale(first.map(({ range }) => range));
  panes.forEach((pane, i) => pane.show(first[i]));
  stage.drawNow();
  // Nor for where the grains go.
  const last = await Promise.all(panes.map((pane) => wanted(pane, player.times.at(-1))));
  // Where a run begins or ends without a grain, those between tell how much room they take.
  const { times } = player;
  const bare = (frame) => !frame.radius.length;
  const between = first.some(bare) || last.some(bare) ? [0.25, 0.5, 0.75].map((share) => times[Math.floor(share * times.length)]) : [];
  const inner = await Promise.all(panes.map((pane) => Promise.all(between.map((time) => wanted(pane, time)))));
  panes.forEach((pane, i) => pane.measure([last[i], ...inner[i]]));
  unite();
  if (!stage.view.moved) stage.view.fit(box);

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
    if (curves.grain) names.push(curves.grain.name);
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
    $("play").textContent = playing ? "‖" : "▶";
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
  const around = () => ({ title: $("legend").querySelector(".title").textContent, ends: legend.told($("legend")), now: $("now").textContent });
  const shoot = async () => screenshot.save(await screenshot.picture(stage, around()), "tsubu.png");
  const record = async () => {
    player.pause();
    $("film").disabled = true;
    try {
      screenshot.save(await film.film(stage, player, around), "tsubu.webm");
    } finally {
      $("film").disabled = false;
    }
  };
  $("film").hidden = !film.possible();
  $("film").onclick = tried(record);
  $("colour").onchange = tried(async () => {
    state.colour = $("colour").value;
    await paint();
    await grainCurve();
  });
  $("contacts").onchange = tried(() => {
    state.contacts = $("contacts").checked;
    for (const pane of panes) {
      pane.bonds.mesh.visible = state.contacts;
      // Bonds lie on discs, but inside of spheres: these make room.
      pane.grains.material.uniforms.shrink.value = state.contacts && !flat ? 0.35 : 1;
    }
    return player.go(player.number);
  });
  $("arrows").onchange = tried(() => ((state.arrows = $("arrows").value), player.go(player.number)));
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
    const { pane, row } = pick.seen(stage, event) ?? {};
    state.picked = row >= 0 ? { pane, id: pane.frame.id[row] } : undefined;
    if (!state.picked) $("grain").hidden = true;
    mark();
    stage.draw();
    await grainCurve();
  }));

  // The picked grain has a curve beside those of the history: of what it is coloured by.
  async function grainCurve() {
    const { picked } = state;
    const shown = curves.grain && curves.grain.name === curves.name;
    curves.grain = undefined;
    if (picked) {
      const [x, y] = await server.curve(picked.pane.run, picked.id, state.colour);
      const { unit } = columns.find(({ name }) => name === state.colour) ?? {};
      const name = withUnit(`grain ${picked.id}: ${state.colour}`, unit);
      curves.grain = { name, run: picked.pane.run, x, y: y.map((value) => value ?? NaN) };
      curves.name = name;
    } else if (shown) {
      curves.name = undefined;
    }
    listCurves();
    curves.draw();
  }

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
    const grew = pane.measure([await pane.fetch(pane.about.times.length - 1, state)]);
    if (grew) {
      unite();
      if (!stage.view.moved) fit();
    }
    // Who has gone elsewhere while the frame was on its way stays there.
    const last = player.number + 1 === player.times.length && !player.playing && !player.busy;
    const now = player.times[player.number];
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
  window.tsubu.ready = true;
}

begin().catch(say);
