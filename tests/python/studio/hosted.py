"""A page that shows widgets as notebooks do: the module that a widget brings, and a model with its messages."""

import base64
import json
import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

# Style of the notebook's own that a widget is not to get, one who listens for keys, and a model as anywidget hands it
# over. Bytes come as views of something larger, which begin anywhere. While the kernel is `busy` messages wait; when it
# is `dead` its model throws, as Jupyter's does.
HOST = """<!doctype html><meta charset=utf-8><title>A notebook</title>
<style>p { color: rgb(1, 2, 3) } button, canvas, .tiles { display: none }</style>
<p>Text of the notebook</p><div id="one"></div><div id="two"></div>
<script type="text/plain">MODULE</script>
<script type="module">
const text = document.querySelector("script[type='text/plain']").textContent;
const { default: widget } = await import(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
const listeners = new Set();
const viewOf = (code) => {
  const bytes = Uint8Array.from(atob(code), (letter) => letter.charCodeAt(0));
  const larger = new Uint8Array(bytes.length + 10);
  larger.set(bytes, 3);
  return new DataView(larger.buffer, 3, bytes.length);
};
const model = {
  on: (name, listener) => name === "msg:custom" && listeners.add(listener),
  off: (name, listener) => listeners.delete(listener),
  send(content) {
    if (window.dead) throw new Error("Cannot send");
    (window.busy ?? Promise.resolve()).then(async () => {
      for (const [answer, codes] of await tell(JSON.stringify(content))) {
        for (const listener of listeners) listener(answer, codes.map(viewOf));
      }
    });
  },
};
const keys = [];
document.addEventListener("keydown", ({ key }) => keys.push(key));
const show = (name) => widget.render({ model, el: document.getElementById(name) });
Object.assign(window, { keys, listeners, dispose: show("one"), show });
</script>"""


class Line:
    """In place of a kernel's comm: what a widget sends lies here until the page takes it."""

    kernel = SimpleNamespace()
    comm_id = "line"

    def __init__(self) -> None:
        self.sent: list[tuple[dict[str, Any], list[bytes]]] = []

    def on_msg(self, callback) -> None:
        self.deliver = callback

    def send(self, data, metadata=None, buffers=()) -> None:
        assert metadata is None
        self.sent.append((data, buffers or []))

    def close(self, *_, **__) -> None:
        pass

    def ask(self, text: str) -> list[tuple[dict[str, Any], list[str]]]:
        """Hand a message of the page to the widget, as text like on any wire; return its answers."""
        data = {"method": "custom", "content": json.loads(text)}
        self.deliver({"content": {"data": data}, "buffers": []})
        sent, self.sent = self.sent, []
        return [
            (
                json.loads(json.dumps(data["content"], allow_nan=False)),
                [base64.b64encode(one).decode() for one in buffers],
            )
            for data, buffers in sent
        ]


class Notebook:
    """A page with a widget, and what it complained about or asked of others."""

    def __init__(self, context, widget) -> None:
        self.widget, self.session = widget, widget.session
        self.line = Line()
        self.troubles: list[str] = []
        self.page = context.new_page()
        self.page.on("console", lambda message: self.troubles.append(message.text))
        self.page.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.page.on("request", lambda request: self._note(request.url))
        self.page.expose_function("tell", self._tell)
        self.page.set_content(HOST.replace("MODULE", widget.get_state()["_esm"]))
        self.page.wait_for_function("'dispose' in window")

    def _tell(self, text: str) -> list:
        # A kernel has one line to all pages; here each has its own, which takes its answers.
        self.widget.comm = self.line
        return self.line.ask(text)

    def _note(self, url: str) -> None:
        if not url.startswith(("data:", "blob:", "about:")):
            self.troubles.append(f"asked for {url}")

    def part(self, name: str, place: str = "one"):
        return self.page.locator(f"#{place} .{name}")

    def seconds(self, place: str = "one") -> float:
        return float(self.part("time", place).inner_text().split()[0])

    def wait(self, condition: str) -> None:
        """Wait until a condition on the shadow tree of the first widget, `root`, holds."""
        root = "document.querySelector('#one > div')?.shadowRoot"
        self.page.wait_for_function(f"() => {{ const root = {root}; return root && ({condition}) }}")

    def wait_for_time(self, least: float) -> None:
        self.wait(f"parseFloat(root.querySelector('.time').textContent) > {least}")

    def until(self, condition: Callable[[], bool]) -> None:
        """Wait until a condition on the widget holds, while the page goes on."""
        deadline = time.monotonic() + 20.0
        while not condition():
            assert time.monotonic() < deadline
            self.page.wait_for_timeout(20)
