// A page with a studio whose core runs in the page: no server is asked.
//
// What it needs is JSON in a script of the page, as docs/live_drum.py writes it: the worker's text, the core, the machines.

import { Studio } from "./studio.js";

// The studio's line to a worker: events and `ask` are those of live.js.
class WorkerLive extends EventTarget {
  constructor({ worker, core, machines }) {
    super();
    const address = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.hear(data);
    this.worker.onerror = () => this.hear({ kind: "error", text: "The drum stands still: this browser does not run its core." });
    this.worker.postMessage({ core: Uint8Array.from(atob(core), (character) => character.charCodeAt(0)), machines });
  }

  hear(told) {
    if (told.kind === "open") this.dispatchEvent(new Event("open"));
    else this.dispatchEvent(new CustomEvent(told instanceof ArrayBuffer ? "frame" : "told", { detail: told }));
  }

  ask(message) {
    this.worker.postMessage(message);
  }

  close() {
    this.worker.terminate();
  }
}

const live = new WorkerLive(JSON.parse(document.querySelector("#drum").textContent));
// Cases, measures and forces take the package.
const studio = new Studio(document.querySelector("main"), live, ["toml", "python", "trade", "forces"]);
Object.assign(window, { studio });
