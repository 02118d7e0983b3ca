// What everything that draws shares: a sharp canvas, and the colors and font of the page's style.

const COLORS = ["paper", "inside", "ink", "muted", "grid", "shade", "steel", "outline", "accent"];

// Match a canvas to its size on the screen, in the screen's own dots, and return a context in CSS pixels.
export function prepare(canvas) {
  const dots = window.devicePixelRatio || 1;
  const width = Math.max(1, canvas.clientWidth);
  const height = Math.max(1, canvas.clientHeight);
  const [across, down] = [Math.round(width * dots), Math.round(height * dots)];
  if (canvas.width !== across || canvas.height !== down) [canvas.width, canvas.height] = [across, down];
  const context = canvas.getContext("2d");
  context.setTransform(across / width, 0, 0, down / height, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

// Read colors, line colors and font from an element's style: the CSS variables that player.css sets in a player, and
// that a page sets for a stage or plot of its own.
export function readTheme(element) {
  const style = getComputedStyle(element);
  const named = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    ...Object.fromEntries(COLORS.map((name) => [name, named(name)])),
    lines: [1, 2, 3, 4].map((k) => named(`line-${k}`)),
    font: `12px ${style.fontFamily}`,
  };
}
