// A studio in an element of a page: a drum that turns while it is changed. Stage, colors, curves and films are those of
// the player; what happens is asked of `live` and told by it, as live.js has it.
//
//   const studio = new Studio(element, live);
//   studio.destroy();
//
// `lacks` names the parts of studio.html that this one is to do without: there the simulation cannot do what they ask for.

import { STYLE } from "./assets.js";
import { readTheme } from "./canvas.js";
import { Coloring, GRADIENT, MODES, modesOf } from "./color.js";
import { Curves } from "./curves.js";
import { canRecord, Film } from "./film.js";
import { counted, formatNumber } from "./format.js";
import { layersOf, legendOf } from "./legend.js";
import { Occupancy } from "./occupancy.js";
import { unpack, unpackFrame, unpackPanel } from "./recording.js";
import { Sliders } from "./sliders.js";
import { Stage } from "./stage.js";
import { STUDIO_MARKUP, STUDIO_STYLE } from "./studio_assets.js";
import { Tiles } from "./tiles.js";

// Bundles times pictures that are kept for paths.
const MOST_KEPT = 500000;
// How often texts that follow the pictures are written, at most [ms]: each has the page laid out anew.
const WRITE_EVERY = 200;
// Weight of a lone picture in the map of occupancy [s]: what comes after it soon outweighs it.
const MOMENT = 1e-6;

// What of a stage has a box, and stays as it is where another drum comes.
const LAYERS = ["forces", "occupied", "corotating"];

// What keys do: `name` is how they are written, `words` what they do, of several in a row the last one's; `part` what does the
// same, without which there is no such key.
const STUDIO_KEYS = {
  " ": { name: "space", words: "play or pause", act: (studio) => studio.toggle() },
  ArrowRight: { name: "→", words: "one step", act: (studio) => studio.ask("step") },
  r: { words: "reset", act: (studio) => studio.ask("reset") },
  ArrowUp: { name: "↑", act: (studio) => studio.sliders.turn(1) },
  ArrowDown: { name: "↓", words: "speed of the drum", act: (studio) => studio.sliders.turn(-1) },
  c: { words: "color", act: (studio) => studio.nextMode() },
  m: { words: "mark this time", act: (studio) => studio.mark() },
  f: { words: "forces", part: "forces", act: (studio) => studio.show({ forces: !studio.stage.forces }) },
  o: { words: "occupancy", act: (studio) => studio.show({ occupied: !studio.stage.occupied }) },
  n: { words: "next bundle and its path", act: (studio) => studio.choose([((studio.stage?.chosen.at(-1) ?? -1) + 1) % studio.recording.count]) },
  Escape: { name: "Esc", words: "no bundle", act: (studio) => studio.choose([]) },
  s: { words: "screenshot", act: (studio) => studio.saveScreenshot() },
};

export class Studio {
  constructor(element, live, lacks = []) {
    this.live = live;
    this.host = document.createElement("div");
    const root = this.host.attachShadow({ mode: "open" });
    root.innerHTML = `<style>${STYLE}${STUDIO_STYLE}</style>${STUDIO_MARKUP}`;
    element.append(this.host);
    this.root = root;
    this.part = (name) => root.querySelector(`.${name}`);
    this.theme = {};
    for (const name of lacks) (this.part(name).closest("label") ?? this.part(name)).hidden = true;
    this.keys = Object.fromEntries(Object.entries(STUDIO_KEYS).filter(([, { part }]) => !lacks.includes(part)));
    this.listKeys();
    this.pictures = { count: 0, since: performance.now(), rate: 0 };
    this.written = 0;
    // As the system asks for: with less motion the drum stands until the reader lets it turn.
    this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.ended = new AbortController();
    this.listen(this.ended.signal);
  }

  listen(signal) {
    const { live, root } = this;
    const on = (name, event, act) => this.part(name).addEventListener(event, act, { signal });
    on("play", "click", () => this.toggle());
    on("reset", "click", () => this.ask("reset"));
    on("one", "click", () => this.ask("step"));
    on("rate", "change", ({ target }) => this.ask("rate", target.value ? Number(target.value) : null));
    for (const name of ["preset", "trade"]) on(name, "change", ({ target }) => this.ask(name, target.value));
    on("mode", "change", ({ target }) => this.setMode(target.value));
    on("mark", "click", () => this.mark());
    for (const name of LAYERS) on(name, "change", ({ target }) => this.show({ [name]: target.checked }));
    on("toml", "click", () => this.ask("case", "toml"));
    on("python", "click", () => this.ask("case", "python"));
    on("picture", "click", () => this.saveScreenshot());
    on("film", "click", () => this.toggleFilm());
    on("stage", "click", (event) => this.select(event));
    this.part("film").hidden = !canRecord();
    this.part("bar").style.background = GRADIENT;
    this.sliders = new Sliders(this.part("sliders"), live, signal);
    this.tiles = new Tiles(this.part("tiles"));
    this.curves = new Curves(this.part("panels"), this.theme, signal);
    root.addEventListener("keydown", (event) => this.press(event), { signal });
    live.addEventListener("open", () => this.connected(true), { signal });
    live.addEventListener("lost", () => this.connected(false), { signal });
    live.addEventListener("told", ({ detail }) => this.hear(detail), { signal });
    live.addEventListener("frame", ({ detail }) => this.receive(detail), { signal });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh(), { signal });
    this.sizes = new ResizeObserver(() => this.refresh());
    this.sizes.observe(this.part("stage"));
  }

  listKeys() {
    const list = this.part("keys").lastElementChild;
    const all = Object.entries(this.keys);
    all.forEach(([key, { name = key, words }], k) => {
      list.append(Object.assign(document.createElement("kbd"), { textContent: name }), words ? ` ${words}` : " ");
      if (words) list.append(k < all.length - 1 ? ", " : ".");
    });
  }

  destroy() {
    this.ended.abort();
    this.sizes.disconnect();
    cancelAnimationFrame(this.next);
    this.live.close();
    this.host.remove();
  }

  ask(what, value) {
    this.complain("");
    this.live.ask({ do: what, value });
  }

  connected(isConnected) {
    this.complain(isConnected ? "" : this.live.silence);
    if (!isConnected) {
      this.sliders.restore();
      return;
    }
    this.reserve = null;
    this.live.ask({ do: "forces", value: this.stage?.forces ?? false });
    this.live.ask({ do: "frame" });
  }

  complain(text) {
    const trouble = this.part("trouble");
    // A text that stays is not to be read out again.
    if (trouble.textContent !== text) trouble.textContent = text;
    trouble.hidden = !text;
  }

  hear(told) {
    if (told.kind === "start") this.begin(told);
    else if (told.kind === "state") this.describe(told);
    else if (told.kind === "measures") this.measure(told);
    else if (told.kind === "case") this.copy(told);
    else if (told.kind === "error") this.refuse(told.text);
  }

  refuse(text) {
    this.complain(text);
    this.sliders.restore();
  }

  // Another drum, or the same one from its start.
  begin({ scene, controls, presets, preset, trades }) {
    const before = this.stage;
    this.recording = unpack(scene);
    this.stage = new Stage(this.part("stage"), this.recording, this.theme);
    for (const name of LAYERS) this.stage[name] = before?.[name] ?? false;
    this.since = 0;
    this.cover();
    const { name } = this.coloring ?? {};
    this.coloring = new Coloring(this.recording);
    if (modesOf(this.recording).includes(name)) this.coloring.name = name;
    this.part("mode").replaceChildren(...modesOf(this.recording).map((mode) => new Option(MODES[mode].label, mode)));
    this.part("preset").replaceChildren(...Object.entries(presets).map(([value, words]) => new Option(words, value)));
    this.part("preset").value = preset;
    // Another machine may be measured in other ways.
    if (preset !== this.preset) this.tiles.clear();
    this.preset = preset;
    this.part("trade").replaceChildren(...trades.map((trade) => new Option(trade, trade)));
    this.sliders.show(controls);
    this.measure({ window: [0, 0], tiles: [], panels: [], speedScale: this.recording.speedScale });
    this.curves.blank();
    this.refresh();
  }

  describe({ title, facts, playing, rate, speed, trade, said }) {
    this.part("title").textContent = title;
    this.part("facts").textContent = facts;
    this.part("stage").setAttribute("aria-label", `The drum: ${title}`);
    if (this.still) {
      this.still = false;
      if (playing) this.ask("pause");
    }
    this.playing = playing;
    this.part("player").classList.toggle("playing", playing);
    this.part("play").setAttribute("aria-label", playing ? "Pause" : "Play");
    this.part("rate").value = rate ?? "";
    if (trade !== this.trade) this.tiles.clear();
    this.trade = trade;
    this.part("trade").value = trade;
    this.sliders.setSpeed(speed);
    if (speed !== this.speed) {
      Object.assign(this, { speed, since: this.recording.end });
      this.cover();
    }
    const last = said.at(-1) ?? "";
    if (this.part("said").textContent !== last) this.part("said").textContent = last;
  }

  measure({ window, tiles, panels, speedScale }) {
    this.tiles.write(tiles);
    const [from, to] = window.map((time) => time.toFixed(2));
    this.part("since").textContent = tiles.length ? `Means over ${from} to ${to}\u00a0s, since the last change, ± standard error.` : "";
    this.recording.speedScale = speedScale;
    this.curves.take(panels.map(unpackPanel), window);
  }

  // Keep a picture, and draw it with the screen's next one; a second one waits in reserve, so that a picture of the screen does not
  // go without where the next one comes late. Each is asked for as soon as there is room for it, before anything is drawn, so that
  // it is made meanwhile.
  receive(buffer) {
    if (this.next) {
      this.reserve = buffer;
      return;
    }
    this.live.ask({ do: "frame" });
    this.present(buffer);
  }

  present(buffer) {
    this.keep(buffer);
    this.next = requestAnimationFrame(() => {
      const { reserve } = this;
      this.next = this.reserve = null;
      if (reserve) this.live.ask({ do: "frame" });
      this.goOn();
      if (reserve) this.present(reserve);
    });
  }

  keep(buffer) {
    const { recording, stage } = this;
    const { frame, spin, factor, forceScale } = unpackFrame(recording, buffer);
    const passed = frame.time - recording.end;
    if (passed <= 0) recording.frames.pop();
    recording.frames.push(frame);
    if (passed > 0) stage.map?.add(frame, passed);
    this.forget(Math.max(Math.floor(MOST_KEPT / recording.count), 2));
    recording.forceScale = forceScale ?? recording.forceScale;
    Object.assign(this, { spin, factor });
  }

  // Begin the map of occupancy with the pictures that are kept since the last change. The first two may lie apart.
  cover() {
    const { recording, stage, since } = this;
    stage.map = stage.occupied ? new Occupancy(recording, stage.corotating) : null;
    recording.frames.forEach((frame, k, frames) => {
      if (k >= 2 && frame.time > since) stage.map?.add(frame, frame.time - frames[k - 1].time);
    });
    if (!stage.map?.sum) stage.map?.add(recording.frames.at(-1), MOMENT);
  }

  // Leave out the oldest pictures, but the one that colors refer to.
  forget(most) {
    const { coloring, recording } = this;
    const { frames } = recording;
    if (frames.length <= most) return;
    // Many at once, so that it is seldom done.
    const excess = Math.ceil(frames.length / 4);
    const [marked] = coloring.mark < excess ? [frames[coloring.mark]] : [];
    frames.splice(0, excess);
    if (marked) frames.unshift(marked);
    coloring.mark = marked ? 0 : coloring.mark - excess;
  }

  // Read colors and font anew, and draw everything.
  refresh() {
    Object.assign(this.theme, readTheme(this.host));
    this.curves.spoil();
    this.curves.draw();
    this.draw();
  }

  draw() {
    if (!this.recording) return;
    this.drawScene();
    this.write();
  }

  // Draw a picture of many, and what else is due.
  goOn() {
    this.drawScene();
    this.count();
    if (!this.playing || performance.now() - this.written > WRITE_EVERY) this.write();
    // While it plays, one of the curves with a picture, so that none comes late.
    this.curves.draw(this.playing ? 1 : Infinity);
  }

  drawScene() {
    const { recording, stage, coloring } = this;
    const scene = recording.scene(recording.end);
    scene.spin = this.spin ?? 0;
    stage.draw(scene, coloring.shades(scene));
    this.scene = scene;
  }

  count() {
    const { pictures } = this;
    pictures.count += 1;
    const passed = (performance.now() - pictures.since) / 1000;
    if (passed < 1) return;
    Object.assign(pictures, { rate: pictures.count / passed, count: 0, since: performance.now() });
  }

  write() {
    const { scene, stage, coloring, pictures, playing, factor } = this;
    this.written = performance.now();
    const rpm = (scene.spin * 30) / Math.PI;
    const texts = {
      time: `${scene.time.toFixed(2)} s`,
      turning: `${rpm.toFixed(1).replace("-", "−")} rpm, ${Math.abs(scene.drumAngle / 2 / Math.PI).toFixed(2)} turns`,
      pace: playing ? `${formatNumber(factor)} simulated seconds in a second, ${counted(Math.round(pictures.rate), "picture")}.` : "Paused.",
      ...legendOf(coloring, scene),
      layers: layersOf(stage),
    };
    // What stays is not written again: that alone would have the page laid out anew.
    for (const [name, text] of Object.entries(texts)) if (this.part(name).textContent !== text) this.part(name).textContent = text;
    for (const name of LAYERS) this.part(name).checked = stage[name];
    if (this.part("mode").value !== coloring.name) this.part("mode").value = coloring.name;
  }

  toggle() {
    this.ask(this.playing ? "pause" : "play");
  }

  // Change how the drum is shown, as stage.js has it. Forces come with the pictures, to who asks for them.
  show(changes) {
    Object.assign(this.stage, changes);
    if ("forces" in changes) this.ask("forces", changes.forces);
    if ("occupied" in changes || "corotating" in changes) this.cover();
    this.draw();
  }

  choose(bundles) {
    this.show({ chosen: bundles });
  }

  select(event) {
    const bundle = this.stage.bundleAt(event.offsetX, event.offsetY, this.scene);
    this.choose(bundle === null ? [] : [bundle]);
  }

  setMode(name) {
    this.coloring.name = name;
    this.draw();
  }

  nextMode() {
    const names = modesOf(this.recording);
    this.setMode(names[(names.indexOf(this.coloring.name) + 1) % names.length]);
  }

  // From now on the colors say where each bundle is at this moment, so that mixing shows.
  mark() {
    this.coloring.mark = this.recording.frames.length - 1;
    this.setMode(this.coloring.mode.marked ? this.coloring.name : "height");
  }

  async copy({ as, text }) {
    const area = this.part("case");
    Object.assign(area, { value: text, hidden: false });
    const name = as === "toml" ? "case.toml" : "a script";
    try {
      await navigator.clipboard.writeText(text);
      this.part("said").textContent = `Copied as ${name}.`;
    } catch {
      area.focus();
      area.select();
      this.part("said").textContent = `The browser does not let this page copy: ${name} is selected below.`;
    }
  }

  get background() {
    return getComputedStyle(this.part("player")).backgroundColor;
  }

  saveScreenshot() {
    const canvas = this.part("stage");
    const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
    const pen = copy.getContext("2d");
    pen.fillStyle = this.background;
    pen.fillRect(0, 0, copy.width, copy.height);
    pen.drawImage(canvas, 0, 0);
    Object.assign(document.createElement("a"), { href: copy.toDataURL(), download: "drum.png" }).click();
  }

  toggleFilm() {
    const button = this.part("film");
    if (this.film) this.film.stop("drum");
    this.film = this.film ? null : new Film(this.part("stage"), this.background);
    button.textContent = this.film ? "Stop recording" : "Record";
    button.setAttribute("aria-pressed", Boolean(this.film));
  }

  // Do what a key stands for, unless the control that has the focus needs the key itself.
  press(event) {
    const key = this.keys[event.key];
    const inside = this.root.activeElement;
    const own = inside?.matches("select, input[type=range], textarea") || (inside?.matches("button, input, summary") && event.key === " ");
    if (!key || own || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    key.act(this);
  }
}
