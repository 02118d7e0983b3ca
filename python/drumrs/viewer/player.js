// A player of one recording in an element of a page: stage, plots and controls.
//
//   const player = new Player(element, unpack(data));
//   player.addEventListener("time", () => console.log(player.time));
//   player.seek(2.5);
//   player.recording.extend({ frames });     // while a run goes on; a player at the end stays at the end
//   player.destroy();
//
// To read: time [s], playing, selected (number of the bundle chosen last, or null), recording. To call: play, pause, toggle, seek,
// seekFrame, step, select, setMode, markTime, show, destroy. Events: "time", "select", "play", "pause".
// Markup, style and listeners stay in a shadow tree of the player's own: a page may hold any number of them, of one
// recording or of several.

import { MARKUP, STYLE } from "./assets.js";
import { readTheme } from "./canvas.js";
import { Coloring, modesOf } from "./color.js";
import { Controls } from "./controls.js";
import { Panel } from "./panel.js";
import { Stage } from "./stage.js";

// Longest time [s] that one picture may jump ahead: a hidden tab gets none, and is to go on where it was.
const LONGEST_JUMP = 0.1;

export class Player extends EventTarget {
  // `start` is the time [s] to show first; the first frame unless given.
  constructor(element, recording, { start = -Infinity } = {}) {
    super();
    this.recording = recording;
    this.coloring = new Coloring(recording);
    this.rate = 1;
    this.playing = false;
    this.time = recording.frames[recording.nearest(start)].time;
    this.last = recording.end;
    this.host = document.createElement("div");
    const root = this.host.attachShadow({ mode: "open" });
    root.innerHTML = `<style>${STYLE}</style>${MARKUP}`;
    element.append(this.host);
    this.theme = {};
    this.ended = new AbortController();
    this.build(root, this.ended.signal);
    this.watch(root, this.ended.signal);
    this.refresh();
  }

  build(root, signal) {
    const { recording, theme } = this;
    const canvas = root.querySelector(".stage");
    const onSeek = (time) => this.seek(time);
    this.stage = new Stage(canvas, recording, theme);
    this.controls = new Controls(root, this, signal);
    this.panels = recording.panels.map((panel) => new Panel(root.querySelector(".panels"), panel, recording, theme, { onSeek, signal }));
    root.querySelector(".player").classList.toggle("charted", this.panels.length > 0);
    const select = (event) => this.select(this.stage.bundleAt(event.offsetX, event.offsetY, this.scene), event.shiftKey);
    canvas.addEventListener("click", select, { signal });
  }

  // Follow the size of the element, the scheme of colors and a recording that grows.
  watch(root, signal) {
    this.sizes = new ResizeObserver(() => this.refresh());
    for (const canvas of root.querySelectorAll("canvas")) this.sizes.observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh(), { signal });
    this.recording.addEventListener("change", () => this.follow(), { signal });
  }

  // Remove the player from the page, with all that it listens to.
  destroy() {
    this.pause();
    this.sizes.disconnect();
    this.ended.abort();
    this.host.remove();
  }

  get selected() {
    return this.stage.chosen.at(-1) ?? null;
  }

  // Show what was added to the recording.
  follow() {
    if (this.time === this.last && !this.playing) this.time = this.recording.end;
    this.last = this.recording.end;
    this.controls.describe();
    this.refresh();
  }

  // Read colors and font anew, and draw everything.
  refresh() {
    Object.assign(this.theme, readTheme(this.host));
    for (const { plot } of this.panels) plot.stale = true;
    this.draw();
  }

  draw() {
    this.scene = this.recording.scene(this.time);
    this.stage.draw(this.scene, this.coloring.shades(this.scene));
    for (const panel of this.panels) panel.draw(this.time);
    this.controls.write();
  }

  play() {
    this.pause();
    if (this.time >= this.recording.end) this.seek(this.recording.begin);
    this.setPlaying(true);
    let last = null;
    const advance = (now) => {
      const passed = last === null ? 0 : Math.min((now - last) / 1000, LONGEST_JUMP);
      last = now;
      this.seek(Math.min(this.time + passed * this.rate, this.recording.end));
      if (this.time >= this.recording.end || !this.host.isConnected) this.pause();
      else if (this.playing) this.next = requestAnimationFrame(advance);
    };
    this.next = requestAnimationFrame(advance);
  }

  pause() {
    cancelAnimationFrame(this.next);
    if (this.playing) this.setPlaying(false);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  setPlaying(playing) {
    this.playing = playing;
    this.controls.write();
    this.dispatchEvent(new Event(playing ? "play" : "pause"));
  }

  seek(time) {
    this.time = time;
    this.draw();
    this.dispatchEvent(new Event("time"));
  }

  seekFrame(frame) {
    const last = this.recording.frames.length - 1;
    this.seek(this.recording.frames[Math.min(Math.max(frame, 0), last)].time);
  }

  // Stepping stops the clock and lands on a frame, that is, on what was computed.
  step(frames) {
    this.pause();
    const here = this.recording.frameAt(this.time);
    const between = this.recording.frames[here].time !== this.time;
    this.seekFrame(here + frames + (between && frames < 0 ? 1 : 0));
  }

  // Choose what colors stand for: a name of MODES.
  setMode(name) {
    this.coloring.name = name;
    this.draw();
  }

  nextMode() {
    const names = modesOf(this.recording);
    this.setMode(names[(names.indexOf(this.coloring.name) + 1) % names.length]);
  }

  // From now on the colors say where each bundle is at this time, so that mixing shows.
  markTime() {
    this.coloring.mark = this.recording.nearest(this.time);
    this.setMode(this.coloring.mode.marked ? this.coloring.name : "height");
  }

  // Change how the drum is shown: { marks, forces, occupied, corotating, path }, as stage.js has them.
  show(changes) {
    Object.assign(this.stage, changes);
    this.draw();
  }

  // Choose a bundle, or none by null; with `more`, beside those chosen before.
  select(bundle, more = false) {
    const before = more ? this.stage.chosen.filter((other) => other !== bundle) : [];
    this.stage.chosen = bundle === null ? before : [...before, bundle];
    this.draw();
    this.dispatchEvent(new Event("select"));
  }
}
