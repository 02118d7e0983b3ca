// Sliders for what can be changed, as the server describes them: label, meaning, unit, limits, and whether it restarts.

const SPEED_KEY = "rotation.rpm";

export class Sliders {
  // The listeners end with `signal`.
  constructor(container, live, signal) {
    // `asked` is the speed that was asked for and is not told yet.
    Object.assign(this, { container, live, signal, known: [], asked: null });
  }

  show(controls) {
    // Whoever moves a slider by keys keeps the focus on it through the restart.
    const focus = this.container.getRootNode().activeElement?.dataset.key;
    this.known = controls.map((control) => this.make(control));
    this.asked = null;
    this.container.replaceChildren(...this.known.map(({ label }) => label));
    this.known.find(({ control }) => control.key === focus)?.input.focus();
  }

  make(control) {
    const { key, label: words, meaning, unit, value, min, max, step, restarts } = control;
    const make = (tag, more) => Object.assign(document.createElement(tag), more);
    const label = make("label", { className: "slider", title: meaning });
    const output = make("output");
    // "any", so that a value of a case file between two steps stays what it is until it is moved.
    const input = make("input", { type: "range", min, max, step: "any", value });
    input.dataset.key = key;
    const slider = { control, label, input, output };
    const written = unit && unit !== "1" ? ` ${unit}` : "";
    slider.write = () => {
      output.textContent = `${Number(Number(input.value).toPrecision(4))}${written}`.replace("-", "−");
      input.setAttribute("aria-valuetext", output.textContent);
    };
    slider.write();
    label.append(words, output, input, make("small", { textContent: restarts ? "starts anew, from the same seed" : "acts at once" }));
    const settle = () => {
      input.value = Number((Math.round(Number(input.value) / step) * step).toPrecision(9));
      slider.write();
    };
    input.addEventListener("input", () => {
      settle();
      if (restarts) return;
      this.asked = Number(input.value);
      this.live.ask({ do: "speed", value: this.asked });
    }, { signal: this.signal });
    input.addEventListener("change", () => restarts && this.live.ask({ do: "set", key, value: Number(input.value) }), { signal: this.signal });
    // Keys move by a step, ten with shift: browsers have none of their own where any value may be.
    input.addEventListener("keydown", (event) => {
      const way = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[event.key];
      if (!way) return;
      event.preventDefault();
      input.value = Number(input.value) + way * step * (event.shiftKey ? 10 : 1);
      for (const name of ["input", "change"]) input.dispatchEvent(new Event(name));
    }, { signal: this.signal });
    return slider;
  }

  get speed() {
    return this.known.find(({ control }) => control.key === SPEED_KEY);
  }

  setSpeed(rpm) {
    const { speed } = this;
    if (!speed) return;
    speed.control.value = rpm;
    if (this.asked === rpm) this.asked = null;
    // The hand that moves it is ahead of what is told.
    if (this.asked !== null) return;
    speed.input.value = rpm;
    speed.write();
  }

  // Change the speed by a step.
  turn(way) {
    const { input, control } = this.speed;
    input.value = Number(input.value) + way * control.step;
    input.dispatchEvent(new Event("input"));
  }

  // Show what holds, after a change was refused or could not be asked for.
  restore() {
    this.asked = null;
    for (const { control, input, write } of this.known) {
      input.value = control.value;
      write();
    }
  }
}
