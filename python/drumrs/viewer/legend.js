// What the colors and the layers of a stage mean, in words.

import { formatNumber } from "./format.js";

// The quantity that colors stand for, and both ends of its scale.
export function legendOf(coloring, scene) {
  const { mode, mark, name, recording } = coloring;
  const text = (value) => (mode.name ? mode.name(recording, value) : formatNumber(value * mode.factor));
  const [lowest, highest] = coloring.range(scene).map(text);
  const moment = mode.marked ? `, t\u00a0=\u00a0${recording.frames[mark].time.toFixed(2)}\u00a0s` : "";
  const quantity = `${mode.label}${moment}${mode.unit && ` [${mode.unit}]`}`;
  // Speeds beyond the end of the scale have its last color.
  return { quantity, lowest, highest: name === "speed" ? `≥ ${highest}` : highest };
}

// What the layers that are shown mean.
export function layersOf(stage) {
  const { recording, corotating } = stage;
  const words = [];
  if (stage.forces && recording.forceScale) {
    const [least, end] = [recording.forceScale.least, recording.forceScale.end].map(formatNumber);
    words.push(`Lines: normal force of the contacts' springs at the nearest frame, from its overlaps, without damping and friction; from ${least}\u00a0N/m, full width from ${end}\u00a0N/m.`);
  }
  if (stage.occupied) {
    const { from, to } = stage.occupancy.map;
    words.push(`Blue: how often bundles cover a place${corotating ? " of the turning drum" : ""}, from never to always, in ${from.toFixed(2)} to ${to.toFixed(2)}\u00a0s.`);
  }
  return words.join(" ");
}
