// The drum and its load on a canvas of its own; several may show one recording.
//
//   const stage = new Stage(canvas, recording, readTheme(element));
//   stage.draw(recording.scene(time), coloring.shades(scene));
//
// Set `marks` (a radius on each bundle), `forces` (lines at contacts), `occupied` (where bundles are how often, behind
// them), `corotating` (seen from the drum, which stands still), `chosen` (numbers of bundles) and `path` (how long their
// paths are [s]) at will; the next drawing follows them. A `map` is an Occupancy to show in place of that of the
// recording's frames.

import { prepare } from "./canvas.js";
import { PixelDiscs } from "./discs.js";
import { roundSteps } from "./format.js";
import { occupancy, picture } from "./occupancy.js";
import { DIRECTIONS } from "./recording.js";

// Half the picture's width over the drum's radius: there is room for the arrow outside of the rim.
const MARGIN = 1.13;
const ARROW = 1.075;
const TICKS = 24;
// Width of the line of a force at the end of the scale, over the greatest radius.
const THICKEST = 0.55;
// Radius [pixels] up to which a mark could not be told from its bundle.
const LEAST_MARKED = 3;
// How much of a bundle's color stays where forces or occupancy are to be seen.
const FADED = 0.35;
// Bundles from which on a canvas takes longer for their arcs than we for their pixels.
const MANY = 1000;
// Widths that lines of forces are drawn in, at most.
const WIDTHS = 12;
// Width of the widest line [pixels] from which on lines of forces have a rim, so that they are seen over bundles.
const LEAST_RIMMED = 2;
// How often a map that goes on growing is painted anew, at most [ms].
const MAP_EVERY = 100;
// Line round a bundle, and by how much it lies within the bundle's radius [pixels].
const LINE = 0.75;
const INSET = 0.4;

export class Stage {
  constructor(canvas, recording, theme) {
    this.canvas = canvas;
    this.recording = recording;
    this.theme = theme;
    this.marks = true;
    this.forces = false;
    this.occupied = false;
    this.corotating = false;
    this.chosen = [];
    this.path = 1;
    this.map = null;
    this.pixels = new PixelDiscs();
  }

  // From meters to pixels: y points up, and a picture seen from the drum is turned back by its angle.
  frame(scene) {
    const { width, height } = this;
    const unit = Math.min(width, height) / (2 * MARGIN * this.recording.reach);
    return { unit, x: width / 2, y: height / 2, turn: this.corotating ? -scene.drumAngle : 0 };
  }

  draw(scene, shades) {
    const { context, width, height } = prepare(this.canvas);
    const { theme } = this;
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
    const areSeen = this.recording.greatestRadius > LEAST_MARKED * this.pixel;
    if (this.marks && areSeen && !this.faded) this.drawMarks(scene, shades);
    if (this.forces) this.drawForces(scene);
    this.chosen.forEach((bundle, place) => this.drawChosen(scene, bundle, [theme.accent, ...theme.lines][place % 5]));
    context.restore();
    this.drawArrow(scene);
    this.drawScale(unit);
  }

  drawDrum(scene) {
    const { context, recording, pixel, theme } = this;
    context.save();
    context.rotate(scene.drumAngle);
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
    if (this.occupied) this.drawOccupancy(scene);
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

  get faded() {
    return this.forces || this.occupied;
  }

  // The map and its picture, made anew when the recording or the map has grown, or it is seen or colored in another way.
  get occupancy() {
    const { recording, corotating, known } = this;
    const [length, color, now] = [this.map ? this.map.to : recording.frames.length, this.theme.lines[0], performance.now()];
    const isOther = known?.corotating !== corotating || known.color !== color || (this.map && known.map !== this.map);
    // A map that grows with each picture changes little from one to the next.
    if (isOther || (known.length !== length && !(this.map && now - known.made < MAP_EVERY))) {
      const map = this.map ?? occupancy(recording, corotating);
      this.known = { length, corotating, color, map, made: now, image: picture(map, color, known?.image) };
    }
    return this.known;
  }

  // Within the turned drum; the map of the laboratory does not turn.
  drawOccupancy({ drumAngle }) {
    const { context, recording, corotating } = this;
    const { reach } = recording;
    context.save();
    if (!corotating) context.rotate(-drumAngle);
    context.drawImage(this.occupancy.image, -reach, -reach, 2 * reach, 2 * reach);
    context.restore();
  }

  drawBundles(scene, shades) {
    const { context } = this;
    context.save();
    if (this.faded) context.globalAlpha = FADED;
    if (this.recording.count >= MANY) this.paintBundles(scene, shades);
    else this.traceBundles(scene, shades);
    context.restore();
  }

  paintBundles(scene, shades) {
    const { canvas, context, recording, theme } = this;
    const { unit, x, y, turn } = this.frame(scene);
    const { width, height } = canvas;
    const dots = width / this.width;
    const view = { width, height, unit: unit * dots, x: x * dots, y: y * dots, turn };
    const style = { outline: theme.outline, line: LINE * dots, inset: INSET * dots, least: dots };
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.pixels.paint(view, scene.positions, recording.radii, shades, style), 0, 0);
  }

  // Those of one color at once: it takes half the time.
  traceBundles({ positions }, shades) {
    const { context, recording, pixel, theme } = this;
    context.lineWidth = LINE * pixel;
    context.strokeStyle = theme.outline;
    const byFill = new Map();
    shades.forEach(({ fill }, k) => byFill.get(fill)?.push(k) ?? byFill.set(fill, [k]));
    for (const [fill, members] of byFill) {
      context.beginPath();
      for (const k of members) {
        const [x, y] = [positions[2 * k], positions[2 * k + 1]];
        const radius = Math.max(recording.radii[k] - INSET * pixel, pixel);
        context.moveTo(x + radius, y);
        context.arc(x, y, radius, 0, 2 * Math.PI);
      }
      context.fillStyle = fill;
      context.fill();
      context.stroke();
    }
  }

  // Forces of the nearest frame: from center to center, or to the drum, as wide as they are strong.
  drawForces(scene) {
    const { context, recording, pixel, theme } = this;
    const { forces } = recording.frames[recording.nearest(scene.time)];
    if (!forces) return;
    const widest = THICKEST * recording.greatestRadius;
    // Widths that a screen tells apart, of which there are none thinner than half a pixel: those of one width at once.
    const widths = Math.min(Math.max(Math.ceil((2 * widest) / pixel), 1), WIDTHS);
    const paths = Array.from({ length: widths }, () => new Path2D());
    for (let k = 0; k < forces.one.length; k++) {
      this.traceForce(paths[Math.max(Math.ceil(widths * forces.shares[k]) - 1, 0)], scene.positions, forces.one[k], forces.other[k]);
    }
    // Lines about as thin as a pixel are told apart without a rim and without caps, which would take most of the time.
    const isThin = widest < LEAST_RIMMED * pixel;
    context.lineCap = isThin ? "butt" : "round";
    for (const [color, more] of isThin ? [[theme.ink, 0]] : [[theme.inside, Math.min(1.5 * pixel, widest)], [theme.ink, 0]]) {
      context.strokeStyle = color;
      paths.forEach((path, k) => {
        context.lineWidth = Math.max((widest * (k + 1)) / widths, 0.5 * pixel) + more;
        context.stroke(path);
      });
    }
    context.lineCap = "butt";
  }

  traceForce(path, positions, one, other) {
    const { count, radii } = this.recording;
    const [x, y] = [positions[2 * one], positions[2 * one + 1]];
    path.moveTo(x, y);
    if (other < count) {
      path.lineTo(positions[2 * other], positions[2 * other + 1]);
      return;
    }
    const toDrum = (2 * Math.PI * (other - count)) / DIRECTIONS;
    path.lineTo(x + radii[one] * Math.cos(toDrum), y + radii[one] * Math.sin(toDrum));
  }

  // A radius on each bundle shows how it spins: black on light colors, white on dark ones.
  drawMarks({ positions, angles }, shades) {
    const { context, recording, pixel } = this;
    context.lineWidth = Math.min(1.5 * pixel, 0.25 * recording.greatestRadius);
    for (const light of [true, false]) {
      context.beginPath();
      for (let k = 0; k < angles.length; k++) {
        if (shades[k].light !== light) continue;
        const [x, y] = [positions[2 * k], positions[2 * k + 1]];
        const length = 0.85 * recording.radii[k];
        context.moveTo(x, y);
        context.lineTo(x + length * Math.cos(angles[k]), y + length * Math.sin(angles[k]));
      }
      context.strokeStyle = light ? "#000" : "#fff";
      context.stroke();
    }
  }

  // A chosen bundle's ring, and its path up to now, as it is seen.
  drawChosen(scene, bundle, color) {
    const { context, recording, pixel, theme } = this;
    const [x, y] = [scene.positions[2 * bundle], scene.positions[2 * bundle + 1]];
    context.beginPath();
    context.moveTo(x, y);
    for (let frame = recording.frameAt(scene.time); frame >= 0; frame--) {
      const { time, drumAngle } = recording.frames[frame];
      if (time < scene.time - this.path) break;
      const point = recording.position(frame, bundle);
      const back = this.corotating ? scene.drumAngle - drumAngle : 0;
      const [sine, cosine] = [Math.sin(back), Math.cos(back)];
      context.lineTo(cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1]);
    }
    context.lineJoin = "round";
    for (const [paint, width] of [[theme.inside, 5], [color, 2.5]]) {
      context.strokeStyle = paint;
      context.lineWidth = width * pixel;
      context.stroke();
    }
    context.beginPath();
    context.arc(x, y, recording.radii[bundle] + pixel, 0, 2 * Math.PI);
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
    const { positions } = scene;
    const hit = this.recording.radii.findIndex((radius, k) => Math.hypot(positions[2 * k] - px, positions[2 * k + 1] - py) <= radius);
    return hit < 0 ? null : hit;
  }
}
