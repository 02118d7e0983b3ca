// Measures as tiles. Each keeps its place: where there is no value, as after a change, a dash stands for it.

const NONE = "–";

export class Tiles {
  constructor(container) {
    this.container = container;
    this.clear();
  }

  // Forget them all: others are to come.
  clear() {
    this.known = new Map();
    this.container.replaceChildren();
  }

  // Measures are { name, text, unit, meaning }. Those that come for the first time find their place behind the one before them.
  write(measures) {
    const found = new Map(measures.map((measure) => [measure.name, measure]));
    let before = null;
    for (const measure of measures) {
      if (!this.known.has(measure.name)) this.add(measure, before);
      before = this.known.get(measure.name).tile;
    }
    for (const [name, { value }] of this.known) {
      const text = (found.get(name)?.text ?? NONE).replace("-", "−");
      if (value.textContent !== text) value.textContent = text;
    }
  }

  add({ name, unit, meaning }, before) {
    const make = (tag, more) => Object.assign(document.createElement(tag), more);
    const tile = make("div", { className: "tile", title: meaning });
    tile.dataset.name = name;
    const words = name.replaceAll("_", " ");
    const value = make("span");
    const definition = make("dd");
    definition.append(value, " ", make("small", { textContent: unit }));
    tile.append(make("dt", { textContent: words[0].toUpperCase() + words.slice(1) }), definition);
    if (before) before.after(tile);
    else this.container.prepend(tile);
    this.known.set(name, { tile, value });
  }
}
