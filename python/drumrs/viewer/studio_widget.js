// The studio as a widget of a notebook, as anywidget loads it. The studio is that of the page; here is its line to a kernel.

import { Studio } from "./studio.js";

// How long an answer may take before that is said, and how long to wait where there was no new picture [ms].
const PATIENCE = 3000;
const WAIT = 100;

// The studio's line to a kernel, with the events and `ask` of live.js.
class KernelLive extends EventTarget {
  constructor(model) {
    super();
    this.model = model;
    // Pages that show one widget share its messages: each asks under a name of its own, and is answered under it.
    this.page = Math.random().toString(36).slice(2);
    this.silence = "The kernel does not answer. If it is not busy, it was restarted or has ended: run this cell again.";
    this.hear = (content, buffers) => content.page === this.page && this.take(content, buffers);
    model.on("msg:custom", this.hear);
    // Once somebody listens.
    queueMicrotask(() => this.dispatchEvent(new Event("open")));
  }

  ask(message) {
    if (message.do === "frame") this.askForPicture();
    else this.send(message);
    // It may have changed the picture that was not to be asked for before long.
    if (this.later) this.askForPicture();
    if (this.isLost) this.lose();
  }

  // One at a time.
  askForPicture() {
    clearTimeout(this.later);
    this.later = null;
    if (this.patience) return;
    this.send({ do: "frame" });
    this.patience = setTimeout(() => this.lose(), PATIENCE);
  }

  send(message) {
    try {
      this.model.send({ ...message, page: this.page });
    } catch {
      // Jupyter's line is gone with the kernel.
      this.lose();
    }
  }

  lose() {
    this.isLost = true;
    this.dispatchEvent(new Event("lost"));
  }

  // Each answer to what was asked for a picture has that or nothing, after what else is new.
  take({ told, isPicture }, buffers) {
    if (isPicture) {
      clearTimeout(this.patience);
      this.patience = null;
    }
    if (this.isLost) {
      this.isLost = false;
      this.dispatchEvent(new Event("open"));
    }
    for (const detail of told) this.dispatchEvent(new CustomEvent("told", { detail }));
    for (const { buffer, byteOffset, byteLength } of buffers) {
      this.dispatchEvent(new CustomEvent("frame", { detail: buffer.slice(byteOffset, byteOffset + byteLength) }));
    }
    if (isPicture && !buffers.length) this.later = setTimeout(() => this.askForPicture(), WAIT);
  }

  close() {
    clearTimeout(this.patience);
    clearTimeout(this.later);
    this.model.off("msg:custom", this.hear);
    this.send({ do: "leave" });
  }
}

function render({ model, el }) {
  const studio = new Studio(el, new KernelLive(model));
  // In JupyterLab letters are commands: "m" would make the cell a text, "dd" delete it, were it not for this attribute.
  // Other notebooks are not to hear of keys that were the studio's.
  studio.host.dataset.lmSuppressShortcuts = "true";
  studio.host.addEventListener("keydown", (event) => event.defaultPrevented && event.stopPropagation());
  return () => studio.destroy();
}

export default { render };
