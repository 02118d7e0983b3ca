// Where bundles are how often: the share of the time in which one covers a place, as a picture of one color.
//
//   const map = occupancy(recording, corotating);      // of the frames of a recording, or
//   const map = new Occupancy(recording, corotating);  // of frames that come and go:
//   map.add(frame, weight);
//   context.drawImage(picture(map, "#0072b2"), …);

const SIZE = 240;
// Frames that are plenty for a mean.
const PLENTY = 400;

// Squares over the recording's reach, rows upwards: `sums` of the weights of the frames in which they are covered, `sum`
// that of all. `from` and `to` are the times of the first and the last frame. Seen from the drum where it is `corotating`.
export class Occupancy {
  constructor({ radii, reach }, corotating) {
    Object.assign(this, { radii, reach, corotating, size: SIZE, sums: new Float32Array(SIZE * SIZE), sum: 0 });
  }

  add({ time, positions, drumAngle }, weight = 1) {
    const { radii, reach, sums } = this;
    const unit = SIZE / (2 * reach);
    const cell = (place) => Math.min(Math.max(Math.round((place + reach) * unit), 0), SIZE);
    const back = this.corotating ? -drumAngle : 0;
    const [sine, cosine] = [Math.sin(back), Math.cos(back)];
    for (let k = 0; k < radii.length; k++) {
      const radius = radii[k];
      const across = cosine * positions[2 * k] - sine * positions[2 * k + 1];
      const up = sine * positions[2 * k] + cosine * positions[2 * k + 1];
      const last = cell(up + radius);
      for (let row = cell(up - radius); row < last; row++) {
        const height = (row + 0.5) / unit - reach - up;
        const half = Math.sqrt(Math.max(radius * radius - height * height, 0));
        const end = row * SIZE + cell(across + half);
        for (let place = row * SIZE + cell(across - half); place < end; place++) sums[place] += weight;
      }
    }
    this.sum += weight;
    this.from ??= time;
    this.to = time;
  }

  share(place) {
    return this.sum ? this.sums[place] / this.sum : 0;
  }
}

// Of the frames of the averages' window, or of all without one.
export function occupancy(recording, corotating) {
  const { frames, window } = recording;
  const inside = frames.filter(({ time }) => !window || (time >= window[0] && time <= window[1]));
  const chosen = inside.length ? inside : frames;
  const every = Math.ceil(chosen.length / PLENTY);
  const map = new Occupancy(recording, corotating);
  chosen.forEach((frame, k) => k % every === 0 && map.add(frame));
  return Object.assign(map, { to: chosen.at(-1).time });
}

// Paint a map onto a canvas of its size: the color, the denser the more often a place is covered. Its first row is the lowest.
export function picture(map, color, canvas = document.createElement("canvas")) {
  const { size } = map;
  Object.assign(canvas, { width: size, height: size });
  const context = canvas.getContext("2d");
  const image = context.createImageData(size, size);
  for (let k = 0; k < size * size; k++) image.data[4 * k + 3] = 230 * Math.min(map.share(k), 1);
  context.putImageData(image, 0, 0);
  context.globalCompositeOperation = "source-in";
  context.fillStyle = color;
  context.fillRect(0, 0, size, size);
  return canvas;
}
