// Records what the drum's canvas shows as a film, with the browser's own recorder, and hands it over as a download.

// What browsers can write: mp4 where they can, for everybody can play it.
const KINDS = { "video/mp4": "mp4", "video/webm": "webm" };

export const canRecord = () => Boolean(window.MediaRecorder && Object.keys(KINDS).some((kind) => MediaRecorder.isTypeSupported(kind)));

export class Film {
  // Begin. The canvas is clear where nothing is drawn, and a film is not: it is copied onto the page's color.
  constructor(canvas, background) {
    const copy = document.createElement("canvas");
    // Films have an even number of pixels.
    Object.assign(copy, { width: canvas.width & ~1, height: canvas.height & ~1 });
    const pen = copy.getContext("2d");
    const draw = () => {
      pen.fillStyle = background;
      pen.fillRect(0, 0, copy.width, copy.height);
      pen.drawImage(canvas, 0, 0);
      this.request = requestAnimationFrame(draw);
    };
    draw();
    this.kind = Object.keys(KINDS).find((kind) => MediaRecorder.isTypeSupported(kind));
    this.recorder = new MediaRecorder(copy.captureStream(), { mimeType: this.kind, videoBitsPerSecond: 8e6 });
    this.pieces = [];
    this.recorder.addEventListener("dataavailable", ({ data }) => this.pieces.push(data));
    this.recorder.start();
  }

  // End, and offer the file.
  stop(name) {
    this.recorder.addEventListener("stop", () => {
      cancelAnimationFrame(this.request);
      const url = URL.createObjectURL(new Blob(this.pieces, { type: this.kind }));
      Object.assign(document.createElement("a"), { href: url, download: `${name}.${KINDS[this.kind]}` }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60000);
    });
    this.recorder.stop();
  }
}
