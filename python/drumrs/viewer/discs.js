// Discs painted pixel by pixel, for loads so large that a canvas would spend its time on their arcs: what that takes grows
// with the area that they cover, not with their number.
//
//   const discs = new PixelDiscs();
//   context.drawImage(discs.paint({ width, height, unit, x, y, turn }, positions, radii, shades, style), 0, 0, width, height);

export class PixelDiscs {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
  }

  // Paint the discs and return the canvas that they are on. Lengths are in pixels of that canvas: `width` and `height`;
  // `unit` of them are a meter, the axis is at (x, y), and the scene is turned by `turn`. `style` has the `outline`'s color
  // and `line`, its width; `inset`, by how much radii are smaller for its sake; and the `least` radius that is drawn.
  paint(view, positions, radii, shades, style) {
    const { width, height, unit, x, y, turn } = view;
    const { context } = this;
    Object.assign(this, this.blank(width, height));
    const ink = this.inkOf(style.outline);
    const [sine, cosine] = [unit * Math.sin(turn), unit * Math.cos(turn)];
    for (let k = 0; k < radii.length; k++) {
      const [px, py] = [positions[2 * k], positions[2 * k + 1]];
      const across = x + cosine * px - sine * py;
      const down = y - sine * px - cosine * py;
      const radius = Math.max(unit * radii[k] - style.inset, style.least);
      // Of a small disc the line would leave no color.
      this.disc(across, down, radius, shades[k], Math.min(style.line, radius / 3) / 2, ink);
    }
    context.putImageData(this.image, 0, 0);
    return this.canvas;
  }

  // An empty image of a size; the memory of the last one is used again.
  blank(width, height) {
    const { canvas, context, image } = this;
    if (image?.width === width && image.height === height) {
      this.words.fill(0);
      return { image };
    }
    Object.assign(canvas, { width, height });
    const fresh = context.createImageData(width, height);
    // Typed arrays follow the machine's byte order, which is little-endian wherever a browser runs.
    return { image: fresh, words: new Uint32Array(fresh.data.buffer) };
  }

  // A color as numbers, its opacity from 0 to 1.
  inkOf(color) {
    if (this.ink?.color !== color) {
      const pen = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d");
      pen.fillStyle = color;
      pen.fillRect(0, 0, 1, 1);
      const [red, green, blue, alpha] = pen.getImageData(0, 0, 1, 1).data;
      this.ink = { color, red, green, blue, opacity: alpha / 255 };
    }
    return this.ink;
  }

  // One disc about a place, and over it the line round it. What part of a pixel is within a circle is told by the distance
  // of its middle. Pixels that are wholly within, which are most of a large disc's, are set a row at once.
  disc(across, down, radius, { red, green, blue }, half, ink) {
    const { width, height, data } = this.image;
    const outer = radius + half + 0.5;
    const inner = radius - half - 0.5;
    const color = (255 << 24) | (blue << 16) | (green << 8) | red;
    const [top, bottom] = [Math.max(Math.floor(down - outer), 0), Math.min(Math.ceil(down + outer), height)];
    for (let row = top; row < bottom; row++) {
      const dy = row + 0.5 - down;
      const reach = Math.sqrt(Math.max(outer * outer - dy * dy, 0));
      const [left, right] = [Math.max(Math.floor(across - reach), 0), Math.min(Math.ceil(across + reach), width)];
      const whole = Math.abs(dy) < inner ? Math.sqrt(inner * inner - dy * dy) : -1;
      const from = Math.max(Math.ceil(across - whole - 0.5), left);
      const to = Math.min(Math.floor(across + whole + 0.5), right);
      const first = row * width;
      if (from < to) this.words.fill(color, first + from, first + to);
      for (let column = left; column < right; column++) {
        if (column === from && from < to) column = to;
        const dx = column + 0.5 - across;
        const within = outer - Math.sqrt(dx * dx + dy * dy);
        if (within <= 0 || column >= right) continue;
        const filled = clamped(within - half);
        const lined = ink.opacity * (clamped(within) - clamped(within - 2 * half));
        const at = 4 * (first + column);
        // What is there already shows through as far as neither covers it.
        const below = (data[at + 3] / 255) * (1 - filled) * (1 - lined);
        const all = below + filled * (1 - lined) + lined;
        const over = below / all;
        const line = lined / all;
        const own = 1 - over - line;
        data[at] = over * data[at] + own * red + line * ink.red;
        data[at + 1] = over * data[at + 1] + own * green + line * ink.green;
        data[at + 2] = over * data[at + 2] + own * blue + line * ink.blue;
        data[at + 3] = 255 * all;
      }
    }
  }
}

function clamped(value) {
  return Math.min(Math.max(value, 0), 1);
}
