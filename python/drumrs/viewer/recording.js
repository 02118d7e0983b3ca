// A recording: frames in the order of their times, and the scene at any time between them.
//
// A frame is { time, drumAngle, positions, angles, speeds }: seconds, radians, and arrays with an entry for each bundle
// (two for positions: x and y [m]; angles [rad]; speeds [m/s]). It may have `forces`: { one, other, shares }, arrays with
// an entry for each contact: the numbers of its bundles and its force as a share of the recording's `forceScale.end`.
// From `count` on, `other` is a direction to the drum instead: (other − count) of DIRECTIONS in a turn.
// A panel is what plot.js draws: { title, unit, range, logarithmic, times, lines: [{ name, color, values }] }.

export class Recording extends EventTarget {
  // `facts` is a line below the title; `reach` is half the width [m] of a square about the axis that holds everything;
  // `shell` is the outline of a drum that is not round, or null; `window` is the interval of the averages [s] or null;
  // `speedScale` is the speed [m/s] at the end of the color scale; there is at least one frame;
  // `species` is null or { names, of }, of[k] being the place of bundle k's name; `forceScale` is null where frames have
  // no forces, else { end, least } [N/m]: the end of the scale, and what is left out below; `discs` is null or
  // { received, landings }: the energy that each bundle received in the run [J/m], and how often it landed.
  constructor({ title = "", facts = "", radii, drumRadius, shell = null, reach, baffles = [], walls = [], window = null, speedScale = 1, panels = [], species = null, forceScale = null, discs = null, frames }) {
    super();
    Object.assign(this, { title, facts, radii, drumRadius, shell, reach, baffles, walls, window, speedScale, panels, species, forceScale, discs, frames });
    // Radius of the rim, or of the farthest corner of a shell [m]; null without either.
    this.outerRadius = shell ? Math.max(...shell.map(([x, y]) => Math.hypot(x, y))) : drumRadius;
    this.greatestRadius = radii.reduce((greatest, radius) => Math.max(greatest, radius), 0);
  }

  get count() {
    return this.radii.length;
  }

  get begin() {
    return this.frames[0].time;
  }

  get end() {
    return this.frames.at(-1).time;
  }

  // Add later frames while a run goes on; panels and scale, where given, take the place of the present ones. A panel
  // keeps its lines, with more points. Whoever shows this recording hears of it by the event "change".
  extend({ frames = [], panels = [], speedScale = this.speedScale }) {
    for (const frame of frames) this.frames.push(frame);
    panels.forEach((panel, k) => Object.assign(this.panels[k], panel));
    this.speedScale = speedScale;
    this.dispatchEvent(new Event("change"));
  }

  // The index of the last frame that is not later than a time.
  frameAt(time) {
    let low = 0;
    let high = this.frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.frames[middle].time <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  nearest(time) {
    const frame = this.frameAt(time);
    const later = Math.min(frame + 1, this.frames.length - 1);
    return time - this.frames[frame].time <= this.frames[later].time - time ? frame : later;
  }

  position(frame, bundle) {
    const { positions } = this.frames[frame];
    return [positions[2 * bundle], positions[2 * bundle + 1]];
  }

  // The scene at a time: { time, drumAngle, spin, positions, angles, speeds }, spin being that of the drum and the rest as in
  // a frame. The arrays are those of a frame, or those that the next call fills again.
  //
  // Between two frames a bundle is on the straight line from one recorded place to the next, and turns the shorter way
  // round. On a frame the picture is what was computed; between two it is off by at most a (Δt)²/8 for an acceleration
  // a: a millimeter or two at 25 frames a second.
  scene(time) {
    const index = this.frameAt(time);
    const from = this.frames[index];
    const to = this.frames[Math.min(index + 1, this.frames.length - 1)];
    const span = to.time - from.time;
    const share = span > 0 ? Math.min(Math.max((time - from.time) / span, 0), 1) : 0;
    const { positions, angles, speeds } = share > 0 ? this.between(from, to, share) : from;
    return { time, positions, angles, speeds, drumAngle: mix(from.drumAngle, to.drumAngle, share), spin: this.spin(index) };
  }

  between(from, to, share) {
    const { count } = this;
    this.mixed ??= { positions: new Float32Array(2 * count), angles: new Float32Array(count), speeds: new Float32Array(count) };
    const { positions, angles, speeds } = this.mixed;
    for (let k = 0; k < 2 * count; k++) positions[k] = mix(from.positions[k], to.positions[k], share);
    for (let k = 0; k < count; k++) {
      angles[k] = from.angles[k] + share * shorterWay(to.angles[k] - from.angles[k]);
      speeds[k] = mix(from.speeds[k], to.speeds[k], share);
    }
    return this.mixed;
  }

  // Angular velocity of the drum [rad/s] after a frame, or before the last one.
  spin(index) {
    const first = Math.max(Math.min(index, this.frames.length - 2), 0);
    const [from, to] = [this.frames[first], this.frames[Math.min(first + 1, this.frames.length - 1)]];
    return to.time > from.time ? (to.drumAngle - from.drumAngle) / (to.time - from.time) : 0;
  }
}

// How many directions the drum may lie in from a bundle that touches it.
export const DIRECTIONS = 256;

const FULL = 65535;
// Numbers at the head of a picture of the studio, 8 bytes each.
const HEAD_NUMBERS = 6;

// Return the recording that recording.py has packed: base64 of little-endian arrays, those of frames one after another.
export function unpack(data) {
  const radii = decode(data.radii, Float32Array);
  const count = radii.length;
  const drumAngles = decode(data.drum_angles, Float64Array);
  const places = decode(data.positions, Uint16Array);
  const [turns, shares] = [data.angles, data.speeds].map((packed) => decode(packed, Uint8Array));
  const { positions, angles, speeds } = inUnits(places, turns, shares, data);
  const frames = Array.from(decode(data.times, Float64Array), (time, k) => ({
    time,
    drumAngle: drumAngles[k],
    positions: positions.subarray(2 * k * count, 2 * (k + 1) * count),
    angles: angles.subarray(k * count, (k + 1) * count),
    speeds: speeds.subarray(k * count, (k + 1) * count),
  }));
  if (data.forces) giveForces(frames, count, data.forces);
  const panels = data.panels.map(unpackPanel);
  const species = data.species && { ...data.species, of: decode(data.species.of, Uint16Array) };
  const discs = data.discs && { received: decode(data.discs.received, Float32Array), landings: decode(data.discs.landings, Float32Array) };
  const forceScale = data.forces && { end: data.forces.scale, least: data.forces.least };
  const { title, facts, shell, reach, baffles, walls, window, drum_radius: drumRadius, speed_scale: speedScale } = data;
  return new Recording({ title, facts, radii, drumRadius, shell, reach, baffles, walls, window, speedScale, panels, species, forceScale, discs, frames });
}

// Meters, radians and meters in a second of the whole numbers that recording.py makes of them: 16 bits for places, for the
// others 8 in a page, 16 in a picture of the studio.
function inUnits(places, turns, shares, { reach, fastest }) {
  const [turn, full] = [2 ** (8 * turns.BYTES_PER_ELEMENT), 2 ** (8 * shares.BYTES_PER_ELEMENT) - 1];
  return {
    positions: scaled(places, (2 * reach) / FULL, -reach),
    angles: scaled(turns, (2 * Math.PI) / turn, 0),
    speeds: scaled(shares, fastest / full, 0),
  };
}

// A plain loop: of ten thousand bundles a function for each number takes milliseconds.
function scaled(numbers, unit, least) {
  const values = new Float32Array(numbers.length);
  for (let k = 0; k < values.length; k++) values[k] = numbers[k] * unit + least;
  return values;
}

// Return what scene.py of the studio has packed, for a recording: { start, spin, factor, frame, forceScale }, with the
// number of the start, the drum's angular velocity [rad/s] and the simulated seconds in a second. The forces and their
// scale are there where they were asked for.
export function unpackFrame({ count, reach }, buffer) {
  const [start, time, drumAngle, spin, fastest, factor] = new Float64Array(buffer, 0, HEAD_NUMBERS);
  const numbers = new Uint16Array(buffer, 8 * HEAD_NUMBERS, 4 * count);
  const parts = [numbers.subarray(0, 2 * count), numbers.subarray(2 * count, 3 * count), numbers.subarray(3 * count)];
  const frame = { time, drumAngle, ...inUnits(...parts, { reach, fastest }) };
  const found = { start, spin, factor, frame };
  const behind = 8 * (HEAD_NUMBERS + count);
  if (buffer.byteLength === behind) return found;
  const [end, least] = new Float64Array(buffer, behind, 2);
  const Numbers = numbersFor(count);
  const size = Numbers.BYTES_PER_ELEMENT;
  const length = (buffer.byteLength - behind - 16) / (2 * size + 1);
  const at = (k) => behind + 16 + k * size * length;
  frame.forces = { one: new Numbers(buffer, at(0), length), other: new Numbers(buffer, at(1), length), shares: scaled(new Uint8Array(buffer, at(2)), 1 / 255, 0) };
  return { ...found, forceScale: { end, least } };
}

// What holds the numbers of bundles and of directions to the drum.
function numbersFor(count) {
  return count + DIRECTIONS <= FULL + 1 ? Uint16Array : Uint32Array;
}

// Return the panel that recording.py has packed.
export function unpackPanel(panel) {
  const lines = panel.lines.map((line) => ({ ...line, values: decode(line.values, Float32Array) }));
  return { ...panel, times: decode(panel.times, Float32Array), lines };
}

function giveForces(frames, bundles, forces) {
  const Numbers = numbersFor(bundles);
  const [one, other] = [decode(forces.one, Numbers), decode(forces.other, Numbers)];
  const shares = scaled(decode(forces.shares, Uint8Array), 1 / 255, 0);
  let first = 0;
  for (const [k, count] of decode(forces.counts, Uint32Array).entries()) {
    const [from, to] = [first, first + count];
    frames[k].forces = { one: one.subarray(from, to), other: other.subarray(from, to), shares: shares.subarray(from, to) };
    first = to;
  }
}

// Typed arrays follow the machine's byte order, which is little-endian wherever a browser runs.
function decode(base64, Kind) {
  const letters = atob(base64);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < bytes.length; k++) bytes[k] = letters.charCodeAt(k);
  return new Kind(bytes.buffer);
}

export function mix(from, to, share) {
  return from + share * (to - from);
}

// An angle's equal between −π and π.
function shorterWay(angle) {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
