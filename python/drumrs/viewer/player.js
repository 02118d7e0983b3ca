// <drumrs-player>: one recorded run, played on a canvas, with its power and energies beside it.
//
// The element holds its data as JSON in a script of its own; markup and style come from the template of the page.
// Everything lives in the element's shadow tree and nothing in global names, so a page may hold many.

const KEYS = {
  " ": (player) => player.toggle(),
  ArrowLeft: (player, event) => player.step(event.shiftKey ? -10 : -1),
  ArrowRight: (player, event) => player.step(event.shiftKey ? 10 : 1),
  Home: (player) => player.seekFrame(0),
  End: (player) => player.seekFrame(player.recording.frames - 1),
  "+": (player) => player.changePace(1),
  "=": (player) => player.changePace(1),
  "-": (player) => player.changePace(-1),
  c: (player) => player.nextMode(),
  m: (player) => player.markNow(),
  n: (player) => player.select(((player.stage.selected ?? -1) + 1) % player.recording.count),
  Escape: (player) => player.select(null),
};

// Longest time [s] that one picture may jump ahead: a hidden tab gets none, and is to go on where it was.
const LONGEST_JUMP = 0.1;

class DrumPlayer extends HTMLElement {
  connectedCallback() {
    if (this.recording) return;
    const root = this.attachShadow({ mode: "open" });
    root.append(document.getElementById("drumrs-player").content.cloneNode(true));
    this.part_ = (name) => root.querySelector(`.${name}`);
    this.recording = new Recording(JSON.parse(this.querySelector("script").textContent));
    this.coloring = new Coloring(this.recording);
    this.theme = {};
    this.stage = new Stage(this.part_("stage"), this.recording, this.theme);
    this.time = this.recording.times[this.recording.nearest(Number(this.getAttribute("start") ?? -Infinity))];
    this.playing = false;
    this.fill();
    this.listen();
    this.watch();
    this.refresh();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.hasAttribute("autoplay") && !still) this.play();
  }

  // Put in what depends on the run.
  fill() {
    const { recording } = this;
    const title = recording.title || "Simulation";
    this.part_("title").textContent = title;
    this.part_("player").setAttribute("aria-label", `Player: ${title}`);
    this.part_("stage").setAttribute("aria-label", `${recording.count} bundles in the drum: ${title}`);
    this.part_("scrub").max = recording.frames - 1;
    this.part_("bar").style.background = GRADIENT;
    for (const [name, { label }] of Object.entries(MODES)) this.part_("mode").add(new Option(label, name));
    this.part_("player").classList.toggle("charted", recording.panels.length > 0);
    this.plots = recording.panels.map((panel) => this.addPanel(panel));
  }

  addPanel(panel) {
    const box = make("div", "panel");
    const heading = make("h4", "", panel.title);
    heading.append(" ", make("span", "unit", `[${panel.unit}]`));
    const list = make("ul", "readings");
    const readings = panel.lines.map((line) => {
      const item = make("li", "reading", `${line.name} `);
      item.style.setProperty("--line", `var(--line-${line.color + 1})`);
      item.append(make("b"));
      list.append(item);
      return item.lastChild;
    });
    const canvas = make("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${panel.title} over time: ${panel.lines.map((line) => line.name).join(", ")}`);
    box.append(heading, list, canvas);
    this.part_("panels").append(box);
    const plot = new Plot(canvas, panel, this.recording, this.theme);
    return Object.assign(plot, { readings });
  }

  listen() {
    const on = (name, event, act) => this.part_(name).addEventListener(event, act);
    on("play", "click", () => this.toggle());
    on("back", "click", () => this.step(-1));
    on("on", "click", () => this.step(1));
    on("scrub", "input", ({ target }) => this.seekFrame(Number(target.value)));
    on("mode", "change", ({ target }) => this.setMode(target.value));
    on("mark", "click", () => this.markNow());
    on("marks", "change", ({ target }) => this.look({ marks: target.checked }));
    on("ride", "change", ({ target }) => this.look({ riding: target.checked }));
    on("stage", "click", (event) => this.select(this.stage.bundleAt(event.offsetX, event.offsetY, this.scene)));
    for (const plot of this.plots) {
      const seek = (event) => this.seek(plot.timeAt(event.offsetX));
      plot.canvas.addEventListener("pointerdown", (event) => {
        plot.canvas.setPointerCapture(event.pointerId);
        seek(event);
      });
      plot.canvas.addEventListener("pointermove", (event) => event.buttons && seek(event));
    }
    this.addEventListener("keydown", (event) => this.press(event));
  }

  // Follow the size of the element and the scheme of colors; a player alone on its page takes all keys.
  watch() {
    const sizes = new ResizeObserver(() => this.refresh());
    for (const canvas of this.shadowRoot.querySelectorAll("canvas")) sizes.observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh());
    document.addEventListener("keydown", (event) => {
      const alone = document.querySelectorAll("drumrs-player").length === 1;
      if (alone && event.target === document.body) this.press(event);
    });
  }

  press(event) {
    const act = KEYS[event.key];
    const inside = this.shadowRoot.activeElement;
    const own = inside?.matches("select") || (inside?.matches("button, input, summary") && event.key === " ");
    if (!act || own || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(this, event);
  }

  // Read colors and font anew, and draw everything.
  refresh() {
    const style = getComputedStyle(this);
    const named = (name) => style.getPropertyValue(`--${name}`).trim();
    for (const name of ["paper", "inside", "ink", "muted", "grid", "shade", "steel", "outline", "accent"]) {
      this.theme[name] = named(name);
    }
    this.theme.lines = [1, 2, 3, 4].map((k) => named(`line-${k}`));
    this.theme.font = `12px ${style.fontFamily}`;
    for (const plot of this.plots) plot.stale = true;
    this.draw();
  }

  draw() {
    const { recording, time } = this;
    this.scene = recording.scene(time);
    this.stage.draw(this.scene, this.coloring.shades(this.scene));
    for (const plot of this.plots) {
      plot.draw(time);
      plot.panel.lines.forEach((line, k) => (plot.readings[k].textContent = show(plot.valueAt(line, time))));
    }
    this.write();
  }

  // Everything that is text and follows the time.
  write() {
    const { recording, time, scene } = this;
    const rpm = (scene.spin * 30) / Math.PI;
    this.part_("time").textContent = `${time.toFixed(2)} s`;
    this.part_("turning").textContent = `${rpm.toFixed(1).replace("-", "−")} rpm, ${Math.abs(scene.drumAngle / 2 / Math.PI).toFixed(2)} turns`;
    const frame = recording.nearest(time);
    this.part_("scrub").value = frame;
    const words = `${time.toFixed(2)} of ${recording.end.toFixed(2)} seconds, frame ${frame + 1} of ${recording.frames}`;
    this.part_("scrub").setAttribute("aria-valuetext", words);
    this.writeLegend();
    this.writeSelected();
  }

  writeLegend() {
    const { kind, mark } = this.coloring;
    const [lowest, highest] = this.coloring.range(this.scene).map((value) => show(value * kind.scale));
    const moment = kind.marked ? `, t = ${this.recording.times[mark].toFixed(2)} s` : "";
    this.part_("what").textContent = `${kind.label}${moment} [${kind.unit}]`;
    this.part_("lowest").textContent = lowest;
    this.part_("highest").textContent = this.coloring.mode === "speed" ? `≥ ${highest}` : highest;
  }

  writeSelected() {
    const chosen = this.stage.selected;
    if (chosen === null) return;
    const { x, y, speed } = this.scene.bundles[chosen];
    const radius = show(1000 * Math.hypot(x, y));
    this.part_("bundle").textContent = `Bundle ${chosen}: ${show(speed)} m/s, ${radius} mm from the axis`;
  }

  play() {
    this.pause();
    if (this.time >= this.recording.end) this.time = this.recording.begin;
    this.setPlaying(true);
    let last = null;
    const advance = (now) => {
      const passed = last === null ? 0 : Math.min((now - last) / 1000, LONGEST_JUMP);
      last = now;
      this.time = Math.min(this.time + passed * Number(this.part_("pace").value), this.recording.end);
      this.draw();
      if (this.time >= this.recording.end || !this.isConnected) this.pause();
      else this.next = requestAnimationFrame(advance);
    };
    this.next = requestAnimationFrame(advance);
  }

  pause() {
    cancelAnimationFrame(this.next);
    this.setPlaying(false);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  setPlaying(playing) {
    this.playing = playing;
    this.part_("player").classList.toggle("playing", playing);
    this.part_("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  }

  seek(time) {
    this.time = time;
    this.draw();
  }

  seekFrame(frame) {
    const last = this.recording.frames - 1;
    this.seek(this.recording.times[Math.min(Math.max(frame, 0), last)]);
  }

  // Stepping stops the clock and lands on a frame, that is, on what was computed.
  step(frames) {
    this.pause();
    const here = this.recording.frameAt(this.time);
    const between = this.recording.times[here] !== this.time;
    this.seekFrame(here + frames + (between && frames < 0 ? 1 : 0));
  }

  changePace(by) {
    const choice = this.part_("pace");
    choice.selectedIndex = Math.min(Math.max(choice.selectedIndex + by, 0), choice.length - 1);
  }

  setMode(name) {
    this.coloring.mode = this.part_("mode").value = name;
    this.draw();
  }

  nextMode() {
    const names = Object.keys(MODES);
    this.setMode(names[(names.indexOf(this.coloring.mode) + 1) % names.length]);
  }

  // From now on the colors say where each bundle is at this moment, so that mixing shows.
  markNow() {
    this.coloring.mark = this.recording.nearest(this.time);
    this.setMode(this.coloring.kind.marked ? this.coloring.mode : "height");
  }

  look(changes) {
    Object.assign(this.stage, changes);
    this.draw();
  }

  select(bundle) {
    this.stage.selected = bundle;
    if (bundle === null) this.part_("bundle").textContent = "Choose a bundle to follow its path.";
    this.draw();
  }
}

function make(tag, name = "", text = "") {
  const element = document.createElement(tag);
  if (name) element.className = name;
  element.textContent = text;
  return element;
}

if (!customElements.get("drumrs-player")) customElements.define("drumrs-player", DrumPlayer);
