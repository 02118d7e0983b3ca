// The curves of a simulation that goes on: panels that are told anew, whole, and keep their place.

import { Panel } from "./panel.js";

const NOTHING = new Float32Array(0);

export class Curves {
  // The listeners end with `signal`.
  constructor(container, theme, signal) {
    Object.assign(this, { container, theme, signal, panels: [] });
    this.axes = { begin: 0, end: 0, window: null, panels: [] };
  }

  // Nothing is known any more, of the same panels.
  blank() {
    Object.assign(this.axes, { end: 0, window: null });
    for (const panel of this.axes.panels) {
      Object.assign(panel, { times: NOTHING, lines: panel.lines.map((line) => ({ ...line, values: NOTHING })) });
    }
    this.spoil();
  }

  // Take what is told; it is drawn by `draw`.
  take(panels, window) {
    Object.assign(this.axes, { end: window[1], window });
    panels.forEach((panel, k) => this.put(panel, k));
    this.spoil();
  }

  put(panel, k) {
    const known = this.axes.panels[k];
    const names = ({ lines }) => lines.map(({ name }) => name).join();
    if (known && names(known) === names(panel)) {
      Object.assign(known, panel);
      return;
    }
    // A loss that has not been before has a line of its own.
    this.axes.panels[k] = panel;
    const made = new Panel(this.container, panel, this.axes, this.theme, { onSeek: () => {}, signal: this.signal, level: 2 });
    this.panels[k]?.box.replaceWith(made.box);
    this.panels[k] = made;
  }

  // They are to be drawn anew.
  spoil() {
    for (const { plot } of this.panels) plot.stale = true;
  }

  // Draw those that are to be drawn anew, or so many of them.
  draw(most = Infinity) {
    const stale = this.panels.filter(({ plot }) => plot.stale);
    for (const panel of stale.slice(0, most)) panel.draw(this.axes.end);
  }
}
