// Where bundles are how often: the share of the frames in which one covers a place, as a picture of one color.
//
//   const map = occupancy(recording, corotating);      // { size, shares }: squares over the recording's reach
//   context.drawImage(picture(map, "#0072b2"), …);

const SIZE = 240;
// Frames that are plenty for a mean.
const PLENTY = 400;

// Count over the frames of the averages' window, or over all without one; seen from the drum where it is `corotating`.
// Rows go upwards; `from` and `to` are the times of the first and last frame.
export function occupancy(recording, corotating) {
  const { frames, radii, reach, window } = recording;
  const inside = frames.filter(({ time }) => !window || (time >= window[0] && time <= window[1]));
  const chosen = inside.length ? inside : frames;
  const every = Math.ceil(chosen.length / PLENTY);
  const few = chosen.filter((_, k) => k % every === 0);
  const shares = new Float32Array(SIZE * SIZE);
  const unit = SIZE / (2 * reach);
  const cell = (place) => Math.min(Math.max(Math.round((place + reach) * unit), 0), SIZE);
  for (const { positions, drumAngle } of few) {
    const back = corotating ? -drumAngle : 0;
    const [sine, cosine] = [Math.sin(back), Math.cos(back)];
    radii.forEach((radius, k) => {
      const [x, y] = [positions[2 * k], positions[2 * k + 1]];
      const [across, up] = [cosine * x - sine * y, sine * x + cosine * y];
      for (let row = cell(up - radius); row < cell(up + radius); row++) {
        const height = (row + 0.5) / unit - reach - up;
        const half = Math.sqrt(Math.max(radius * radius - height * height, 0));
        for (let column = cell(across - half); column < cell(across + half); column++) shares[row * SIZE + column] += 1 / few.length;
      }
    });
  }
  return { size: SIZE, shares, from: chosen[0].time, to: chosen.at(-1).time };
}

// A canvas of a map's size: the color, the denser the more often a place is covered. Its first row is the lowest.
export function picture({ size, shares }, color) {
  const canvas = Object.assign(document.createElement("canvas"), { width: size, height: size });
  const context = canvas.getContext("2d");
  const image = context.createImageData(size, size);
  shares.forEach((share, k) => (image.data[4 * k + 3] = 230 * Math.min(share, 1)));
  context.putImageData(image, 0, 0);
  context.globalCompositeOperation = "source-in";
  context.fillStyle = color;
  context.fillRect(0, 0, size, size);
  return canvas;
}
