// <drumrs-player>: a player in a page that was written as one file; its recording is JSON in a script inside.
//
// Attributes: `autoplay`, and `start`, a time [s]. The player itself is its property `player`.

import { Player } from "./player.js";
import { unpack } from "./recording.js";

const NAME = "drumrs-player";

class PlayerElement extends HTMLElement {
  connectedCallback() {
    const start = Number(this.getAttribute("start") ?? -Infinity);
    this.style.display = "block";
    this.player = new Player(this, unpack(JSON.parse(this.querySelector("script").textContent)), { start });
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.hasAttribute("autoplay") && !still) this.player.play();
    // A player alone on its page takes all keys.
    this.onKey = (event) => {
      const alone = document.querySelectorAll(NAME).length === 1;
      if (alone && event.target === document.body) this.player.controls.press(event);
    };
    document.addEventListener("keydown", this.onKey);
  }

  disconnectedCallback() {
    document.removeEventListener("keydown", this.onKey);
    this.player.destroy();
  }
}

// A page may hold this script more than once.
if (!customElements.get(NAME)) customElements.define(NAME, PlayerElement);
