// What the colors stand for. Each mode gives every bundle a number, and the scale its two ends.

const MODES = {
  speed: {
    label: "Speed",
    unit: "m/s",
    scale: 1,
    range: (recording) => [0, recording.speedScale],
    value: (recording, k, scene) => scene.bundles[k].speed,
  },
  height: {
    label: "Height at the mark",
    unit: "mm",
    scale: 1000,
    marked: true,
    value: (recording, k, scene, mark) => recording.coordinate(mark, k, 1),
  },
  distance: {
    label: "Distance from the axis at the mark",
    unit: "mm",
    scale: 1000,
    marked: true,
    value: (recording, k, scene, mark) =>
      Math.hypot(recording.coordinate(mark, k, 0), recording.coordinate(mark, k, 1)),
  },
  size: {
    label: "Diameter",
    unit: "mm",
    scale: 1000,
    value: (recording, k) => 2 * recording.radii[k],
  },
};

class Coloring {
  constructor(recording) {
    this.recording = recording;
    this.mode = "speed";
    this.mark = 0;
  }

  get kind() {
    return MODES[this.mode];
  }

  value(k, scene) {
    return this.kind.value(this.recording, k, scene, this.mark);
  }

  // Where the two ends of the scale lie; only speeds change while the load turns, and theirs are fixed.
  range(scene) {
    if (this.kind.range) return this.kind.range(this.recording);
    const values = scene.bundles.map((_, k) => this.value(k, scene));
    return [Math.min(...values), Math.max(...values)];
  }

  shades(scene) {
    const range = this.range(scene);
    return scene.bundles.map((_, k) => shade(this.value(k, scene), range));
  }
}
