// A plot with its heading and a legend that shows the values at the time of the cursor.

import { formatNumber } from "./format.js";
import { Plot } from "./plot.js";

export class Panel {
  // `onSeek` is called with a time where the reader points at one; the listeners end with `signal`; `level` is that of the
  // heading among those of the page.
  constructor(container, panel, recording, theme, { onSeek, signal, level = 4 }) {
    const canvas = create("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${panel.title} over time: ${panel.lines.map((line) => line.name).join(", ")}`);
    const heading = create(`h${level}`, "heading");
    this.title = create("span");
    heading.append(this.title, " ", create("span", "unit", `[${panel.unit}]`));
    const legend = create("ul", "readings");
    this.readings = panel.lines.map((line) => {
      const item = create("li", "reading", `${line.name} `);
      item.style.setProperty("--line", `var(--line-${line.color + 1})`);
      item.append(create("b"));
      legend.append(item);
      return item.lastChild;
    });
    this.box = create("div", "panel");
    this.box.append(heading, legend, canvas);
    container.append(this.box);
    this.plot = new Plot(canvas, panel, recording, theme);
    const seek = (event) => onSeek(this.plot.timeAt(event.offsetX));
    const begin = (event) => {
      canvas.setPointerCapture(event.pointerId);
      seek(event);
    };
    canvas.addEventListener("pointerdown", begin, { signal });
    canvas.addEventListener("pointermove", (event) => event.buttons && seek(event), { signal });
  }

  draw(time) {
    const { plot, readings } = this;
    plot.draw(time);
    // It says over how long means are, which grows with a run that goes on.
    if (this.title.textContent !== plot.panel.title) this.title.textContent = plot.panel.title;
    plot.panel.lines.forEach((line, k) => {
      const text = formatNumber(plot.valueAt(line, time));
      if (readings[k].textContent !== text) readings[k].textContent = text;
    });
  }
}

function create(tag, name = "", text = "") {
  const element = document.createElement(tag);
  if (name) element.className = name;
  element.textContent = text;
  return element;
}
