"""Films the studio's page, as README.md shows it: python docs/studio_film.py.

The film is in real time on any machine. Page and simulation are given a clock of ours, which goes on by a picture of
the film once both have done what that takes. It needs the extra ``studio``, Playwright, and Chromium on the path.
"""

import argparse
import io
import shutil
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

from PIL import Image
from playwright.sync_api import Browser, Page, sync_playwright

import drumrs
from drumrs.studio import Session, session
from drumrs.studio.server import Server

PICTURE = 80  # how long a picture of the film lasts [ms]
_DRAWINGS = 5  # of the page within a picture of the film
SIZE = (900, 690)
LEAD = 3.0  # what passes before the film begins, so that the load tumbles and measures are there [s]


class Clock:
    """Time that passes by `advance` alone; stands for the module `time` where a session looks at it."""

    def __init__(self) -> None:
        self._now = 0.0
        self._passed = threading.Condition()

    def perf_counter(self) -> float:
        """Return the time [s]."""
        return self._now

    def sleep(self, seconds: float) -> None:
        """Wait until so much time has passed, but let what is asked of the session come in between."""
        until = self._now + seconds
        with self._passed:
            self._passed.wait_for(lambda: self._now >= until, timeout=0.01)

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        with self._passed:
            self._now += seconds
            self._passed.notify_all()


class Camera:
    """Takes a picture of the page for each so many milliseconds that page and simulation have lived through."""

    def __init__(self, page: Page, shown: Session, clock: Clock) -> None:
        self.page, self.shown, self.clock = page, shown, clock
        self.pictures: list[Image.Image] = []

    def go_on(
        self, seconds: float, act: Callable[[float], None] = lambda _: None, *, film: bool = True
    ) -> None:
        """Let time pass, and do something before each picture, which is told the share of the time that is over."""
        count = round(1000 * seconds / PICTURE)
        for k in range(count):
            act((k + 1) / count)
            self._go_on()
            if film:
                self.pictures.append(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB"))

    def _go_on(self) -> None:
        before = self._moment
        self.clock.advance(PICTURE / 1000)
        wait_until(lambda: self._moment != before)
        for _ in range(_DRAWINGS - 1):
            self._draw()
        wait_until(
            lambda: self.page.evaluate("studio.recording?.end ?? -1") == self._moment[1] or self._draw()
        )
        self._draw()

    def _draw(self) -> None:
        """Let the page's time go on by one drawing; what it is sent it shows with the next one."""
        self.page.clock.run_for(PICTURE // _DRAWINGS)

    @property
    def _moment(self) -> tuple[float, float]:
        """Number of the simulation's start and its time [s], as they stand at the head of its picture."""
        start, at = struct.unpack_from("<2d", self.shown.view.frame)
        return start, at


def wait_until(condition: Callable[[], bool | None]) -> None:
    """Wait, in time that passes by itself."""
    deadline = time.monotonic() + 60.0
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError("the page and its simulation do not go on")
        time.sleep(0.002)


@contextmanager
def serving(server: Server) -> Iterator[None]:
    """Serve a page within a block."""
    ready = threading.Event()
    thread = threading.Thread(target=server.serve, args=(ready.set,))
    thread.start()
    ready.wait()
    try:
        yield
    finally:
        server.stop()
        thread.join()


def film(browser: Browser) -> list[Image.Image]:
    """Return the pictures: the paper's drum, a higher speed, more bundles."""
    clock = Clock()
    config = drumrs.baseline(fill=0.15, baffles=True).softer(100.0)
    with mock.patch.object(session, "time", clock), Session(config) as shown:
        server = Server(shown, "baseline")
        with serving(server):
            page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
            page.clock.install(time=0)
            page.goto(server.address)
            page.clock.pause_at(60.0)
            wait_until(lambda: shown.view.playing)
            camera = Camera(page, shown, clock)
            camera.go_on(LEAD, film=False)
            camera.go_on(2.4)
            camera.go_on(1.2, lambda share: slide(page, "rotation.rpm", round(54 + 26 * share)))
            camera.go_on(2.2)
            camera.go_on(
                0.8, lambda share: slide(page, "load.fill", 0.15 + 0.1 * share, release=share == 1.0)
            )
            camera.go_on(2.4)
            page.close()
    return camera.pictures


def slide(page: Page, key: str, value: float, *, release: bool = True) -> None:
    """Move a slider as a hand does, with the ring around it that keys give."""
    script = """(input, [value, release]) => {
      input.focus({ focusVisible: true });
      input.value = value;
      input.dispatchEvent(new Event("input"));
      if (release) input.dispatchEvent(new Event("change"));
    }"""
    page.locator(f"input[data-key='{key}']").evaluate(script, [value, release])


def write(pictures: list[Image.Image], path: Path, quality: int) -> None:
    """Write the pictures as an animation that begins again at its end."""
    first, *rest = pictures
    # Pictures are what has changed since the one before; a whole one now and then leaves no traces of older ones.
    whole = {"kmin": 6, "kmax": 10}
    first.save(
        path, save_all=True, append_images=rest, duration=PICTURE, loop=0, quality=quality, method=4, **whole
    )


def main() -> None:
    """Write the film."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path(__file__).with_name("studio.webp"))
    parser.add_argument("--quality", type=int, default=25, help="of the pictures, at most 100")
    given = parser.parse_args()
    found = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        write(film(browser), given.out, given.quality)
        browser.close()


if __name__ == "__main__":
    main()
