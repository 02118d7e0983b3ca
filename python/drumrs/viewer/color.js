// Colors of the bundles: viridis, even to the eye and safe for every kind of color vision.

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

// One entry for each level: what a disc is filled with, and whether its marks are to be black.
const PALETTE = Array.from({ length: LEVELS }, (_, level) => {
  const [red, green, blue] = viridis(level / (LEVELS - 1));
  const luminance = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
  return { fill: `rgb(${red} ${green} ${blue})`, light: luminance > LIGHT };
});

const GRADIENT = `linear-gradient(to right, ${Array.from({ length: 17 }, (_, k) => PALETTE[Math.round((k * 255) / 16)].fill)})`;

function shade(value, [lowest, highest]) {
  const share = highest > lowest ? (value - lowest) / (highest - lowest) : 0.5;
  return PALETTE[Math.round(Math.min(Math.max(share, 0), 1) * (LEVELS - 1))];
}
