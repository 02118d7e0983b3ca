// Buttons, keys and text of a player: what the reader does becomes a call of the player, what changes is written.
//
// The markup is player.html; its parts are found by their classes, so nothing needs an id.

import { GRADIENT, MODES } from "./color.js";
import { canRecord, Film } from "./film.js";
import { counted, formatNumber } from "./format.js";
import { layersOf, legendOf } from "./legend.js";

const KEYS = {
  " ": (player) => player.toggle(),
  ArrowLeft: (player, event) => player.step(event.shiftKey ? -10 : -1),
  ArrowRight: (player, event) => player.step(event.shiftKey ? 10 : 1),
  Home: (player) => player.seekFrame(0),
  End: (player) => player.seekFrame(player.recording.frames.length - 1),
  "+": (player, event, controls) => controls.changeRate(1),
  "=": (player, event, controls) => controls.changeRate(1),
  "-": (player, event, controls) => controls.changeRate(-1),
  c: (player) => player.nextMode(),
  m: (player) => player.markTime(),
  f: (player) => player.recording.forceScale && player.show({ forces: !player.stage.forces }),
  o: (player) => player.show({ occupied: !player.stage.occupied }),
  n: (player) => player.select(((player.selected ?? -1) + 1) % player.recording.count),
  N: (player) => player.select(((player.selected ?? -1) + 1) % player.recording.count, true),
  Escape: (player) => player.select(null),
};

export class Controls {
  // The listeners end with `signal`.
  constructor(root, player, signal) {
    Object.assign(this, { root, player });
    this.part = (name) => root.querySelector(`.${name}`);
    const on = (name, event, act) => this.part(name).addEventListener(event, act, { signal });
    on("play", "click", () => player.toggle());
    on("back", "click", () => player.step(-1));
    on("forward", "click", () => player.step(1));
    on("scrub", "input", ({ target }) => player.seekFrame(Number(target.value)));
    on("rate", "change", ({ target }) => (player.rate = Number(target.value)));
    on("mode", "change", ({ target }) => player.setMode(target.value));
    on("mark", "click", () => player.markTime());
    on("marks", "change", ({ target }) => player.show({ marks: target.checked }));
    on("corotating", "change", ({ target }) => player.show({ corotating: target.checked }));
    on("forces", "change", ({ target }) => player.show({ forces: target.checked }));
    on("occupied", "change", ({ target }) => player.show({ occupied: target.checked }));
    on("film", "click", () => this.toggleFilm());
    this.part("film").hidden = !canRecord();
    on("path", "change", ({ target }) => player.show({ path: Number(target.value) }));
    root.addEventListener("keydown", (event) => this.press(event), { signal });
    this.part("bar").style.background = GRADIENT;
    for (const [name, mode] of Object.entries(MODES)) this.part("mode").add(this.option(name, mode));
    if (!player.recording.forceScale) {
      this.part("forces").disabled = true;
      this.part("forces").parentElement.title = "Forces follow from the run's configuration, which was not beside its frames";
    }
    this.describe();
  }

  // A choice of a color mode; what a recording lacks for it is said in place of an offer.
  option(name, { label, lacks }) {
    const lacking = lacks?.(this.player.recording);
    const option = new Option(label, name);
    if (lacking) Object.assign(option, { disabled: true, title: `${label}: ${lacking}` });
    return option;
  }

  // Begin to record what is shown as a film, or end that.
  toggleFilm() {
    const button = this.part("film");
    if (this.film) this.film.stop("drum");
    else this.player.play();
    this.film = this.film ? null : new Film(this.part("stage"), getComputedStyle(this.part("player")).backgroundColor);
    button.textContent = this.film ? "Stop recording" : "Record";
    button.setAttribute("aria-pressed", Boolean(this.film));
  }

  // Write what depends on the recording and not on the time.
  describe() {
    const { recording } = this.player;
    const title = recording.title || "Simulation";
    this.part("title").textContent = title;
    this.part("facts").textContent = recording.facts;
    this.part("player").setAttribute("aria-label", `Player: ${title}`);
    this.part("stage").setAttribute("aria-label", `${counted(recording.count, "bundle")} in the drum: ${title}`);
    this.part("scrub").max = recording.frames.length - 1;
  }

  // Do what a key stands for, unless the control that has the focus needs the key itself.
  press(event) {
    const act = KEYS[event.key];
    const inside = this.root.activeElement;
    const own = inside?.matches("select") || (inside?.matches("button, input, summary") && event.key === " ");
    if (!act || own || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(this.player, event, this);
  }

  changeRate(by) {
    const choice = this.part("rate");
    choice.selectedIndex = Math.min(Math.max(choice.selectedIndex + by, 0), choice.length - 1);
    this.player.rate = Number(choice.value);
  }

  // Write everything that follows the time, the colors and the selection.
  write() {
    const { recording, time, scene, playing, coloring } = this.player;
    const rpm = (scene.spin * 30) / Math.PI;
    this.part("time").textContent = `${time.toFixed(2)} s`;
    this.part("turning").textContent = `${rpm.toFixed(1).replace("-", "−")} rpm, ${Math.abs(scene.drumAngle / 2 / Math.PI).toFixed(2)} turns`;
    const frame = recording.nearest(time);
    this.part("scrub").value = frame;
    const words = `${time.toFixed(2)} of ${recording.end.toFixed(2)} seconds, frame ${frame + 1} of ${recording.frames.length}`;
    this.part("scrub").setAttribute("aria-valuetext", words);
    this.part("player").classList.toggle("playing", playing);
    this.part("play").setAttribute("aria-label", playing ? "Pause" : "Play");
    this.part("mode").value = coloring.name;
    for (const name of ["marks", "forces", "occupied", "corotating"]) this.part(name).checked = this.player.stage[name];
    const meanings = { ...legendOf(this.player.coloring, scene), layers: layersOf(this.player.stage) };
    for (const [name, text] of Object.entries(meanings)) this.part(name).textContent = text;
    this.writeSelected();
  }

  writeSelected() {
    const { selected, scene, recording } = this.player;
    let words = "Click a bundle to follow its path; more of them with shift.";
    if (selected !== null) {
      const { positions, speeds } = scene;
      const distance = formatNumber(1000 * Math.hypot(positions[2 * selected], positions[2 * selected + 1]));
      const kind = recording.species ? `, ${MODES.species.name(recording, recording.species.of[selected])}` : "";
      words = `Bundle ${selected}${kind}: ${formatNumber(speeds[selected])} m/s, ${distance} mm from the axis`;
    }
    this.part("bundle").textContent = words;
  }
}
