// What was recorded: frames as typed arrays, and the state of the scene at any time between them.

// Typed arrays follow the machine's byte order, which is little-endian wherever a browser runs.
function decode(base64, Kind) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  return new Kind(bytes.buffer);
}

const FULL = 65535;
const TURN = 65536;

class Recording {
  constructor(data) {
    this.title = data.title;
    this.times = decode(data.times, Float64Array);
    this.drumAngles = decode(data.drum_angles, Float64Array);
    this.radii = decode(data.radii, Float32Array);
    this.positions = decode(data.positions, Uint16Array);
    this.angles = decode(data.angles, Uint16Array);
    this.speeds = decode(data.speeds, Uint16Array);
    this.reach = data.reach;
    this.fastest = data.fastest;
    this.speedScale = data.speed_scale;
    this.drumRadius = data.drum_radius;
    this.baffles = data.baffles;
    this.walls = data.walls;
    this.window = data.window;
    this.panels = data.panels.map((panel) => ({
      ...panel,
      times: decode(panel.times, Float32Array),
      lines: panel.lines.map((line) => ({ ...line, values: decode(line.values, Float32Array) })),
    }));
    this.frames = this.times.length;
    this.count = this.radii.length;
    this.begin = this.times[0];
    this.end = this.times[this.frames - 1];
  }

  // The last frame that is not later than a time.
  frameAt(time) {
    let low = 0;
    let high = this.frames - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  nearest(time) {
    const frame = this.frameAt(time);
    const later = Math.min(frame + 1, this.frames - 1);
    return time - this.times[frame] <= this.times[later] - time ? frame : later;
  }

  // Two frames and how far a time lies from the first towards the second.
  between(time) {
    const frame = this.frameAt(time);
    const next = Math.min(frame + 1, this.frames - 1);
    const span = this.times[next] - this.times[frame];
    return { frame, next, share: span > 0 ? Math.min(Math.max((time - this.times[frame]) / span, 0), 1) : 0 };
  }

  drumAngle({ frame, next, share }) {
    return mix(this.drumAngles[frame], this.drumAngles[next], share);
  }

  // Angular velocity of the drum about a time [rad/s].
  spin({ frame }) {
    const first = Math.max(Math.min(frame, this.frames - 2), 0);
    const last = Math.min(first + 1, this.frames - 1);
    const span = this.times[last] - this.times[first];
    return span > 0 ? (this.drumAngles[last] - this.drumAngles[first]) / span : 0;
  }

  coordinate(frame, bundle, axis) {
    return ((2 * this.positions[2 * (frame * this.count + bundle) + axis]) / FULL - 1) * this.reach;
  }

  // Between two frames a bundle is drawn on the straight line from one recorded place to the next, and turned the
  // shorter way round. On a frame the picture is what was computed; between two it is off by at most a (Δt)²/8 for
  // an acceleration a: a millimeter or two at 25 frames a second.
  bundle({ frame, next, share }, bundle) {
    const here = frame * this.count + bundle;
    const there = next * this.count + bundle;
    const turned = ((this.angles[there] - this.angles[here] + 1.5 * TURN) % TURN) - 0.5 * TURN;
    return {
      x: mix(this.coordinate(frame, bundle, 0), this.coordinate(next, bundle, 0), share),
      y: mix(this.coordinate(frame, bundle, 1), this.coordinate(next, bundle, 1), share),
      angle: ((this.angles[here] + share * turned) / TURN) * 2 * Math.PI,
      speed: (mix(this.speeds[here], this.speeds[there], share) / FULL) * this.fastest,
    };
  }

  scene(time) {
    const moment = this.between(time);
    const bundles = Array.from({ length: this.count }, (_, k) => this.bundle(moment, k));
    return { time, bundles, drumAngle: this.drumAngle(moment), spin: this.spin(moment) };
  }
}

function mix(from, to, share) {
  return from + share * (to - from);
}
