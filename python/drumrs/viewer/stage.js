// The drum and its load on a canvas of its own; several may show one recording.
//
//   const stage = new Stage(canvas, recording, readTheme(element));
//   stage.draw(recording.scene(time), coloring.shades(scene));
//
// Set `marks` (a radius on each bundle), `corotating` (seen from the drum, which stands still) and `selected` (number of
// a bundle, or null) at will; the next drawing follows them.

import { prepare } from "./canvas.js";
import { roundSteps } from "./format.js";

// Half the picture's width over the drum's radius: there is room for the arrow outside of the rim.
const MARGIN = 1.13;
const ARROW = 1.075;
const TICKS = 24;
const TRAIL = 1; // seconds

export class Stage {
  constructor(canvas, recording, theme) {
    this.canvas = canvas;
    this.recording = recording;
    this.theme = theme;
    this.marks = true;
    this.corotating = false;
    this.selected = null;
  }

  // From meters to pixels: y points up, and a picture seen from the drum is turned back by its angle.
  frame(scene) {
    const { width, height } = this;
    const unit = Math.min(width, height) / (2 * MARGIN * this.recording.reach);
    return { unit, x: width / 2, y: height / 2, turn: this.corotating ? -scene.drumAngle : 0 };
  }

  draw(scene, shades) {
    const { context, width, height } = prepare(this.canvas);
    [this.width, this.height] = [width, height];
    const { unit, x, y, turn } = this.frame(scene);
    this.context = context;
    this.pixel = 1 / unit;
    context.save();
    context.translate(x, y);
    context.scale(unit, -unit);
    context.rotate(turn);
    this.drawDrum(scene);
    this.drawBundles(scene, shades);
    if (this.marks) this.drawMarks(scene, shades);
    if (this.selected !== null) this.drawSelected(scene);
    context.restore();
    this.drawArrow(scene);
    this.drawScale(unit);
  }

  drawDrum({ drumAngle }) {
    const { context, recording, pixel, theme } = this;
    context.save();
    context.rotate(drumAngle);
    context.lineWidth = 2 * pixel;
    context.strokeStyle = context.fillStyle = theme.steel;
    if (recording.drumRadius) {
      context.beginPath();
      context.arc(0, 0, recording.drumRadius + pixel, 0, 2 * Math.PI);
      context.fillStyle = theme.inside;
      context.fill();
      context.stroke();
      this.drawTicks(recording.drumRadius + 2 * pixel);
      context.fillStyle = theme.steel;
    }
    if (recording.shell) {
      this.trace(recording.shell);
      context.closePath();
      context.fillStyle = theme.inside;
      context.fill();
      context.stroke();
      context.fillStyle = theme.steel;
    }
    for (const line of recording.baffles) {
      this.trace(line);
      context.closePath();
      context.fill();
    }
    for (const line of recording.walls) {
      this.trace(line);
      context.stroke();
    }
    context.restore();
  }

  // Ticks round the rim let a bare drum be seen to turn; one of them is longer.
  drawTicks(radius) {
    const { context, pixel } = this;
    context.beginPath();
    for (let k = 0; k < TICKS; k++) {
      const [x, y] = [Math.cos((2 * Math.PI * k) / TICKS), Math.sin((2 * Math.PI * k) / TICKS)];
      const tip = radius + (k === 0 ? 9 : 4) * pixel;
      context.moveTo(radius * x, radius * y);
      context.lineTo(tip * x, tip * y);
    }
    context.lineWidth = 1.25 * pixel;
    context.stroke();
  }

  trace(points) {
    this.context.beginPath();
    points.forEach(([x, y], k) => (k ? this.context.lineTo(x, y) : this.context.moveTo(x, y)));
  }

  drawBundles({ bundles }, shades) {
    const { context, recording, pixel, theme } = this;
    context.lineWidth = 0.75 * pixel;
    context.strokeStyle = theme.outline;
    bundles.forEach(({ x, y }, k) => {
      context.beginPath();
      context.arc(x, y, Math.max(recording.radii[k] - 0.4 * pixel, pixel), 0, 2 * Math.PI);
      context.fillStyle = shades[k].fill;
      context.fill();
      context.stroke();
    });
  }

  // A radius on each bundle shows how it spins: black on light colors, white on dark ones.
  drawMarks({ bundles }, shades) {
    const { context, recording, pixel } = this;
    context.lineWidth = Math.min(1.5 * pixel, 0.25 * recording.greatestRadius);
    for (const light of [true, false]) {
      context.beginPath();
      bundles.forEach(({ x, y, angle }, k) => {
        if (shades[k].light !== light) return;
        const length = 0.85 * recording.radii[k];
        context.moveTo(x, y);
        context.lineTo(x + length * Math.cos(angle), y + length * Math.sin(angle));
      });
      context.strokeStyle = light ? "#000" : "#fff";
      context.stroke();
    }
  }

  // The chosen bundle's ring, and its path over the last second in the frame that is shown.
  drawSelected(scene) {
    const { context, recording, pixel, theme, selected } = this;
    const here = scene.bundles[selected];
    context.beginPath();
    context.moveTo(here.x, here.y);
    for (let frame = recording.frameAt(scene.time); frame >= 0; frame--) {
      const { time, drumAngle } = recording.frames[frame];
      if (time < scene.time - TRAIL) break;
      const point = recording.position(frame, selected);
      const back = this.corotating ? scene.drumAngle - drumAngle : 0;
      const [sine, cosine] = [Math.sin(back), Math.cos(back)];
      context.lineTo(cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1]);
    }
    context.lineJoin = "round";
    for (const [color, width] of [[theme.inside, 5], [theme.accent, 2.5]]) {
      context.strokeStyle = color;
      context.lineWidth = width * pixel;
      context.stroke();
    }
    context.beginPath();
    context.arc(here.x, here.y, recording.radii[selected] + pixel, 0, 2 * Math.PI);
    context.lineWidth = 3 * pixel;
    context.stroke();
  }

  // An arc over the top of the drum with a head: which way the drum turns.
  drawArrow({ spin }) {
    const { context, recording, theme, width, height } = this;
    const outer = recording.outerRadius;
    if (!outer || spin === 0) return;
    const radius = ARROW * outer * (1 / this.pixel);
    const sense = Math.sign(spin);
    const point = (degrees, r) => {
      const angle = ((90 + sense * degrees) * Math.PI) / 180;
      return [width / 2 + r * Math.cos(angle), height / 2 - r * Math.sin(angle)];
    };
    context.strokeStyle = context.fillStyle = theme.ink;
    context.lineWidth = 1.75;
    context.beginPath();
    for (let degrees = -20; degrees <= 18; degrees += 2) context.lineTo(...point(degrees, radius));
    context.stroke();
    context.beginPath();
    for (const [degrees, r] of [[21, radius], [17.5, radius - 5], [17.5, radius + 5]]) context.lineTo(...point(degrees, r));
    context.fill();
  }

  // A bar of a round length, so that sizes can be read off.
  drawScale(unit) {
    const { context, theme, height } = this;
    const length = roundSteps(0, 0.5 * this.recording.reach, 1).step;
    const label = length < 1 ? `${Number((1000 * length).toPrecision(3))} mm` : `${length} m`;
    context.strokeStyle = context.fillStyle = theme.muted;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(8, height - 12);
    context.lineTo(8, height - 8);
    context.lineTo(8 + unit * length, height - 8);
    context.lineTo(8 + unit * length, height - 12);
    context.stroke();
    context.font = theme.font;
    context.textBaseline = "bottom";
    context.textAlign = "left";
    context.fillText(label, 8, height - 14);
  }

  // The bundle under a point of the canvas, or null.
  bundleAt(left, top, scene) {
    const { unit, x, y, turn } = this.frame(scene);
    const [across, up] = [(left - x) / unit, (y - top) / unit];
    const [sine, cosine] = [Math.sin(-turn), Math.cos(-turn)];
    const [px, py] = [cosine * across - sine * up, sine * across + cosine * up];
    const hit = scene.bundles.findIndex((bundle, k) => Math.hypot(bundle.x - px, bundle.y - py) <= this.recording.radii[k]);
    return hit < 0 ? null : hit;
  }
}
