// A drum that turns while it is changed: what python/drumrs/studio has on a server, in the page itself.
//
//   const session = new Session(Simulation, machines, post);
//   session.hear({ do: "play" });
//
// `machines` are { label, facts, config, scene, controls } by name: the core's configuration, drum and load as `unpack` of
// recording.js reads them, and sliders. What is heard, and told by `post`, is that of studio/responder.py, without
// measures, forces and cases, which take the package. Nothing is done while nobody asks for pictures.

// Length of the ramp to another speed [s].
const RAMP = 0.1;
// Time that steps take at once, after which others have their turn [ms].
const SLICE = 12;
// How long nobody must have asked for a picture for the drum to stand still [ms].
const PATIENCE = 1000;
// A simulation that is behind its time by more than this [s] does not try to catch up.
const LATE = 0.1;
// Over how long the simulated seconds in a second are counted [ms].
const COUNTED = 500;
const SEED = 1;
const SPEED = "rotation.rpm";
const FULL = 65535;
const TURN = 65536;

export class Session {
  constructor(Simulation, machines, post) {
    Object.assign(this, { Simulation, machines, post, playing: true, rate: 1, starts: 0, factor: 0, asked: -Infinity, said: "" });
    // Steps in a millisecond, learnt while running.
    this.pace = 1;
    this.load(Object.keys(machines)[0]);
  }

  // Do what is asked for, and say so where that cannot be: the simulation then stays as it was.
  hear({ do: what, key, value }) {
    try {
      if (what === "frame") this.wanted = true;
      else if (what === "play" || what === "pause") this.playing = what === "play";
      else if (what === "step") this.step();
      else if (what === "reset") this.start(this.name, this.steady, `Started anew from seed ${SEED}.`);
      else if (what === "rate") this.rate = value ?? Infinity;
      else if (what === "speed") this.setSpeed(value);
      else if (what === "set") this.set(key, value);
      else if (what === "preset") this.load(value);
    } catch (error) {
      this.post({ kind: "error", text: error.message });
    }
    if (what !== "frame") {
      this.due = null;
      this.changed = true;
    }
    this.asked = performance.now();
    this.tell();
    this.wake();
  }

  load(name) {
    const { config, controls } = this.machines[name];
    this.start(name, config, "");
    this.controls = controls;
    this.rpm = controls.find((one) => one.key === SPEED).value;
  }

  start(name, config, said) {
    const simulation = new this.Simulation(JSON.stringify(config), SEED);
    this.simulation?.free();
    Object.assign(this, { simulation, name, config, said, fastest: 1, started: true, changed: true, due: null });
    this.starts += 1;
  }

  // The configuration at the present speed from its start on.
  get steady() {
    return { ...this.config, rotation: { knots: [[0, radians(this.rpm)]] } };
  }

  // Do one step and stand still.
  step() {
    this.playing = false;
    this.advance(1);
  }

  // Change to another speed now and stay there.
  setSpeed(rpm) {
    const { simulation } = this;
    // The step after the next one is the first of which nothing is known yet.
    const earliest = Math.ceil(1e3 * (simulation.time + 3 * simulation.time_step)) / 1e3;
    const knots = withSpeed(this.config.rotation.knots, radians(rpm), earliest);
    const config = { ...this.config, rotation: { knots } };
    simulation.change(JSON.stringify(config));
    Object.assign(this, { config, rpm });
  }

  // Start anew with another value of a key, at the present speed.
  set(key, value) {
    const config = structuredClone(this.steady);
    const names = key.split(".");
    const last = names.pop();
    names.reduce((table, name) => table[name], config)[last] = value;
    const control = this.controls.find((one) => one.key === key);
    this.start(this.name, config, `Started anew with ${control.label.toLowerCase()} ${value}.`);
    this.controls = this.controls.map((one) => (one === control ? { ...one, value } : one));
  }

  advance(steps) {
    const before = performance.now();
    this.simulation.run(steps);
    const passed = performance.now() - before;
    if (passed > 1) this.pace = steps / passed;
    else this.pace = Math.max(this.pace, 2 * steps);
    this.changed = true;
  }

  // Do what is due, tell it, and come back soon.
  tick() {
    const now = performance.now();
    this.next = null;
    if (!this.playing || now - this.asked > PATIENCE) {
      this.due = null;
      return;
    }
    this.due ??= { from: now, time: this.simulation.time };
    this.count(now);
    const { time, time_step: step } = this.simulation;
    const behind = this.due.time + (this.rate * (now - this.due.from)) / 1000 - time;
    const steps = Math.min(behind / step, Math.max(SLICE * this.pace, 1));
    try {
      if (steps >= 1) this.advance(Math.floor(steps));
    } catch (error) {
      Object.assign(this, { playing: false, said: error.message, changed: true });
    }
    if (behind - Math.floor(steps) * step > LATE) this.due = null;
    this.tell();
    this.wake();
  }

  wake() {
    if (this.playing) this.next ??= setTimeout(() => this.tick(), 0);
  }

  // Simulated seconds in a second.
  count(now) {
    const { time } = this.simulation;
    const since = this.counted;
    if (since && since.start === this.starts && now - since.from < COUNTED) return;
    if (since?.start === this.starts && now - since.from < 2 * COUNTED) this.factor = (1000 * (time - since.time)) / (now - since.from);
    this.counted = { from: now, time, start: this.starts };
  }

  // The newest picture, where one is wanted, and what has changed beside it.
  tell() {
    if (!this.wanted || !this.changed) return;
    const { simulation, machines, name, playing, rate, rpm } = this;
    const seen = this.see();
    if (this.started) {
      const presets = Object.fromEntries(Object.entries(machines).map(([key, { label }]) => [key, label]));
      this.post({ kind: "start", scene: this.scene(seen), controls: this.controls, presets, preset: name, trades: [] });
    }
    const { label, facts } = machines[name];
    const title = `${simulation.radii().length} bundles: ${label}`;
    this.post({ kind: "state", title, facts, playing, rate: rate === Infinity ? null : rate, speed: rpm, trade: "", said: [this.said] });
    // Bundles fall faster at first than ever after: the scale follows slowly.
    this.fastest = Math.max(seen.fastest, 0.995 * this.fastest);
    this.post({ kind: "measures", window: [0, simulation.time], tiles: [], panels: [], speedScale: this.fastest });
    this.post(this.picture(seen));
    Object.assign(this, { wanted: false, changed: false, started: false });
  }

  // The load in whole numbers of 16 bits, as recording.py makes them.
  see() {
    const { reach } = this.machines[this.name].scene;
    const velocities = this.simulation.velocities();
    const speeds = Float64Array.from({ length: velocities.length / 2 }, (_, k) => Math.hypot(velocities[2 * k], velocities[2 * k + 1]));
    const fastest = speeds.reduce((most, speed) => Math.max(most, speed), 0) || 1;
    return {
      fastest,
      places: Uint16Array.from(this.simulation.positions(), (x) => Math.round(((x / reach + 1) / 2) * FULL)),
      turns: Uint16Array.from(this.simulation.angles(), (angle) => Math.round((angle / 2 / Math.PI) * TURN)),
      shares: Uint16Array.from(speeds, (speed) => Math.round((speed / fastest) * FULL)),
    };
  }

  scene({ fastest, places, turns, shares }) {
    const load = { radii: base64(Float32Array.from(this.simulation.radii())), positions: base64(places), angles: base64(turns), speeds: base64(shares) };
    return { ...this.machines[this.name].scene, ...load, fastest };
  }

  // As scene.py packs it.
  picture({ fastest, places, turns, shares }) {
    const { simulation, starts, factor } = this;
    const head = Float64Array.of(starts, simulation.time, simulation.drum_angle, simulation.drum_angular_velocity, fastest, factor);
    const parts = [head, places, turns, shares].map(({ buffer }) => new Uint8Array(buffer));
    const bytes = new Uint8Array(parts.reduce((size, part) => size + part.length, 0));
    let end = 0;
    for (const part of parts) {
      bytes.set(part, end);
      end += part.length;
    }
    return bytes.buffer;
  }
}

// The knots of a program that changes to another speed and stays there, as config/program.py makes them.
export function withSpeed(knots, speed, earliest) {
  const before = knots.filter(([time]) => time <= earliest);
  const after = knots.filter(([time]) => time > earliest);
  if (before.length && after.length && before.at(-1)[1] !== after[0][1]) before.push(after[0]);
  else if (!before.length || before.at(-1)[0] < earliest) before.push([earliest, (before.at(-1) ?? after[0])[1]]);
  return [...before, [before.at(-1)[0] + RAMP, speed]];
}

// Radians in a second of turns in a minute, with the bits of config/to_core.py.
function radians(rpm) {
  return (rpm * 2 * Math.PI) / 60;
}

function base64(array) {
  return btoa(Array.from(new Uint8Array(array.buffer), (byte) => String.fromCharCode(byte)).join(""));
}
