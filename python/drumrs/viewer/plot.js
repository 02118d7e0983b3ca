// Curves over time on a canvas of its own, with a cursor; the panel of a recording says what they are.
//
//   const plot = new Plot(canvas, panel, recording, readTheme(element));
//   plot.draw(time);
//
// Set `stale` when the theme or the panel's data have changed; a new size is seen at the next drawing.

import { prepare } from "./canvas.js";
import { decades, formatTick, powerOfTen, roundSteps } from "./format.js";
import { mix } from "./recording.js";

const LEFT = 52;
const RIGHT = 10;
const TOP = 8;
const BOTTOM = 22;

export class Plot {
  constructor(canvas, panel, recording, theme) {
    Object.assign(this, { canvas, panel, recording, theme });
    this.first = panel === recording.panels[0];
    this.still = document.createElement("canvas");
    this.stale = true;
  }

  x(time) {
    const { begin, end } = this.recording;
    return LEFT + ((time - begin) / (end - begin || 1)) * (this.width - LEFT - RIGHT);
  }

  y(value) {
    const [lowest, highest] = this.panel.range;
    const share = this.panel.logarithmic
      ? Math.log(value / lowest) / Math.log(highest / lowest)
      : (value - lowest) / (highest - lowest);
    return this.height - BOTTOM - share * (this.height - TOP - BOTTOM);
  }

  timeAt(left) {
    const { begin, end } = this.recording;
    const share = (left - LEFT) / (this.width - LEFT - RIGHT);
    return begin + Math.min(Math.max(share, 0), 1) * (end - begin);
  }

  valueAt(line, time) {
    const { times } = this.panel;
    let index = 0;
    while (index < times.length - 2 && times[index + 1] <= time) index++;
    const span = times[index + 1] - times[index];
    const share = span > 0 ? Math.min(Math.max((time - times[index]) / span, 0), 1) : 0;
    return mix(line.values[index], line.values[Math.min(index + 1, times.length - 1)], share);
  }

  // The curves stand still, so they are drawn once for each size and theme; only the cursor moves.
  draw(time) {
    const { context, width, height } = prepare(this.canvas);
    if (this.stale || this.width !== width || this.height !== height) {
      [this.width, this.height] = [width, height];
      this.drawStill();
      this.stale = false;
    }
    context.drawImage(this.still, 0, 0, width, height);
    const x = this.x(time);
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.25;
    context.beginPath();
    context.moveTo(x, TOP);
    context.lineTo(x, height - BOTTOM);
    context.stroke();
    for (const line of this.panel.lines) this.drawDot(context, x, line, time);
  }

  drawDot(context, x, line, time) {
    const y = this.y(this.valueAt(line, time));
    if (!(y >= TOP - 1 && y <= this.height - BOTTOM + 1)) return;
    context.fillStyle = this.theme.lines[line.color];
    context.strokeStyle = this.theme.paper;
    context.beginPath();
    context.arc(x, y, 4, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }

  drawStill() {
    const context = this.still.getContext("2d");
    [this.still.width, this.still.height] = [this.canvas.width, this.canvas.height];
    context.setTransform(this.canvas.width / this.width, 0, 0, this.canvas.height / this.height, 0, 0);
    context.font = this.theme.font;
    if (this.recording.window) this.drawWindow(context, this.recording.window);
    this.drawAxes(context);
    context.beginPath();
    context.rect(LEFT, TOP - 2, this.width - LEFT - RIGHT, this.height - TOP - BOTTOM + 4);
    context.clip();
    context.lineJoin = "round";
    for (const line of this.panel.lines) this.drawLine(context, line);
  }

  // The interval of the averages is shaded, and named once.
  drawWindow(context, interval) {
    const { begin, end } = this.recording;
    const [from, to] = interval.map((time) => this.x(Math.min(Math.max(time, begin), end)));
    context.fillStyle = this.theme.shade;
    context.fillRect(from, TOP, to - from, this.height - TOP - BOTTOM);
    const label = "averages";
    if (!this.first || to - from < context.measureText(label).width + 8) return;
    context.fillStyle = this.theme.muted;
    context.textAlign = "right";
    // Powers are drawn from 0 on, so there is room at the foot.
    context.textBaseline = "bottom";
    context.fillText(label, to - 4, this.height - BOTTOM - 2);
  }

  drawAxes(context) {
    const { theme, width, height, recording, panel } = this;
    const [lowest, highest] = panel.range;
    const rows = panel.logarithmic ? decades(lowest, highest) : roundSteps(lowest, highest, 4).values;
    context.lineWidth = 1;
    context.fillStyle = theme.muted;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of rows) {
      const y = Math.round(this.y(value)) + 0.5;
      this.rule(context, theme.grid, [LEFT, y], [width - RIGHT, y]);
      context.fillText(panel.logarithmic ? powerOfTen(value) : formatTick(value), LEFT - 6, y);
    }
    context.textAlign = "center";
    context.textBaseline = "top";
    const times = roundSteps(recording.begin, recording.end, Math.min(6, width / 70)).values;
    const last = times.at(-1);
    for (const time of times) {
      const x = Math.round(this.x(time)) + 0.5;
      this.rule(context, theme.muted, [x, height - BOTTOM], [x, height - BOTTOM + 4]);
      context.fillText(`${time}${time === last ? " s" : ""}`, x, height - BOTTOM + 6);
    }
    this.rule(context, theme.muted, [LEFT, height - BOTTOM + 0.5], [width - RIGHT, height - BOTTOM + 0.5]);
  }

  rule(context, color, from, to) {
    context.strokeStyle = color;
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
  }

  drawLine(context, line) {
    const { times } = this.panel;
    context.strokeStyle = this.theme.lines[line.color];
    context.lineWidth = 1.6;
    context.beginPath();
    let down = false;
    for (let k = 0; k < times.length; k++) {
      const y = this.y(line.values[k]);
      if (!Number.isFinite(y)) {
        down = false;
        continue;
      }
      if (down) context.lineTo(this.x(times[k]), y);
      else context.moveTo(this.x(times[k]), y);
      down = true;
    }
    context.stroke();
  }
}
