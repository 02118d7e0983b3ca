// The studio's line to its server: a WebSocket that comes back when it is lost.
//
//   const live = new Live(url);
//   live.addEventListener("told", ({ detail }) => …);     // JSON
//   live.addEventListener("frame", ({ detail }) => …);    // an ArrayBuffer
//   live.addEventListener("open" and "lost", …);
//   live.ask({ do: "play" });
//
// `silence` is what is said while it is lost. A widget of a notebook has the same in studio_widget.js.

const FIRST_PAUSE = 250;
const LONGEST_PAUSE = 4000;

export class Live extends EventTarget {
  constructor(url) {
    super();
    this.url = url;
    this.silence = "The simulation does not answer. Is drumrs studio still running? This page tries again.";
    this.pause = FIRST_PAUSE;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.pause = FIRST_PAUSE;
      this.dispatchEvent(new Event("open"));
    };
    socket.onmessage = ({ data }) => {
      const detail = typeof data === "string" ? JSON.parse(data) : data;
      this.dispatchEvent(new CustomEvent(typeof data === "string" ? "told" : "frame", { detail }));
    };
    socket.onclose = () => {
      if (this.closed) return;
      this.dispatchEvent(new Event("lost"));
      this.again = setTimeout(() => this.connect(), this.pause);
      this.pause = Math.min(2 * this.pause, LONGEST_PAUSE);
    };
    this.socket = socket;
  }

  // What is asked for while there is no line is lost, as the page says.
  ask(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  close() {
    this.closed = true;
    clearTimeout(this.again);
    this.socket.close();
  }
}
