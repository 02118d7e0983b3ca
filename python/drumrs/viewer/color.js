// Colors of the bundles: what they stand for, and viridis, even to the eye and safe for every kind of color vision.

const VIRIDIS = [
  "440154", "48186a", "472d7b", "424086", "3b528b", "33638d", "2c728e", "26818e", "21908c",
  "1f9f88", "28ae80", "3ebc74", "5dc963", "82d34c", "abdc32", "d5e21a", "fde725",
].map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

const LEVELS = 256;

// Relative luminance above which black shows better than white.
const LIGHT = 0.45;

function viridis(share) {
  const place = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const below = Math.min(Math.floor(place), VIRIDIS.length - 2);
  return VIRIDIS[below].map((from, k) => Math.round(from + (place - below) * (VIRIDIS[below + 1][k] - from)));
}

// One entry for each level: what a disc is filled with, as a style and as numbers from 0 to 255, and whether its marks are
// to be black.
const PALETTE = Array.from({ length: LEVELS }, (_, level) => {
  const [red, green, blue] = viridis(level / (LEVELS - 1));
  const luminance = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
  return { fill: `rgb(${red} ${green} ${blue})`, red, green, blue, light: luminance > LIGHT };
});

// The scale as a CSS background.
export const GRADIENT = `linear-gradient(to right, ${Array.from({ length: 17 }, (_, k) => PALETTE[Math.round((k * 255) / 16)].fill)})`;

function shade(value, lowest, highest) {
  const share = highest > lowest ? (value - lowest) / (highest - lowest) : 0.5;
  return PALETTE[Math.round(Math.min(Math.max(share, 0), 1) * (LEVELS - 1))];
}

// Each mode gives every bundle a number, shown times `factor` in a unit. The ends of the scale are the least and the
// greatest number unless the mode has a range. A mode with `marked` shows where bundles were at a time of the reader's
// choice, so that mixing shows; `name` writes a number that is no plain quantity; `lacks` says what a recording lacks for
// the mode, or is false.
export const MODES = {
  speed: {
    label: "Speed",
    unit: "m/s",
    factor: 1,
    range: (recording) => [0, recording.speedScale],
    value: (recording, k, scene) => scene.speeds[k],
  },
  height: {
    label: "Height at marked time",
    unit: "mm",
    factor: 1000,
    marked: true,
    value: (recording, k, scene, mark) => recording.position(mark, k)[1],
  },
  distance: {
    label: "Distance from axis at marked time",
    unit: "mm",
    factor: 1000,
    marked: true,
    value: (recording, k, scene, mark) => Math.hypot(...recording.position(mark, k)),
  },
  size: {
    label: "Diameter",
    unit: "mm",
    factor: 1000,
    value: (recording, k) => 2 * recording.radii[k],
  },
  received: {
    label: "Energy received in the run",
    unit: "J/m",
    factor: 1,
    lacks: (recording) => !recording.discs && 'add "discs" to run.record and run again',
    value: (recording, k) => recording.discs.received[k],
  },
  landings: {
    label: "Landings in the run",
    unit: "",
    factor: 1,
    lacks: (recording) => !recording.discs && 'add "discs" to run.record and run again',
    value: (recording, k) => recording.discs.landings[k],
    name: (recording, value) => String(value),
  },
  species: {
    label: "Species",
    unit: "",
    factor: 1,
    lacks: (recording) => !recording.species && "the load has no species",
    range: (recording) => [0, recording.species.names.length - 1],
    value: (recording, k) => recording.species.of[k],
    name: (recording, value) => recording.species.names[value],
  },
};

// The modes of a recording: those that it lacks nothing for.
export function modesOf(recording) {
  return Object.keys(MODES).filter((name) => !MODES[name].lacks?.(recording));
}

// How a recording is colored: by a mode, with the frame `mark` for the modes that have a marked time.
export class Coloring {
  constructor(recording) {
    this.recording = recording;
    this.name = "speed";
    this.mark = 0;
    this.found = new Array(recording.count);
  }

  get mode() {
    return MODES[this.name];
  }

  value(k, scene) {
    return this.mode.value(this.recording, k, scene, this.mark);
  }

  // Where the two ends of the scale lie.
  range(scene) {
    if (this.mode.range) return this.mode.range(this.recording);
    let [lowest, highest] = [Infinity, -Infinity];
    for (let k = 0; k < this.recording.count; k++) {
      const value = this.value(k, scene);
      lowest = Math.min(lowest, value);
      highest = Math.max(highest, value);
    }
    return [lowest, highest];
  }

  // What each bundle is filled with, and whether it is light: { fill, red, green, blue, light }. The next call fills the array
  // again.
  shades(scene) {
    const [lowest, highest] = this.range(scene);
    for (let k = 0; k < this.recording.count; k++) this.found[k] = shade(this.value(k, scene), lowest, highest);
    return this.found;
  }
}
