"""Three bundles in a player, and the page that shows them."""

import math

import numpy as np

from drumrs.frames import Frames

RADIUS = 0.2


def scene() -> Frames:
    """Two bundles at rest and one that circles, in a drum with a baffle: three seconds in 76 frames."""
    times = np.linspace(0.0, 3.0, 76)
    turned = 2.0 * times
    circle = 0.1 * np.column_stack([np.cos(turned), np.sin(turned)])
    still = [np.broadcast_to(place, circle.shape) for place in ((0.0, -0.15), (-0.15, 0.0))]
    shape = (len(times), 3)
    return Frames(
        times=times,
        drum_angles=turned,
        positions=np.stack([*still, circle], axis=1).astype(np.float32),
        angles=np.broadcast_to(turned[:, None] % math.tau - math.pi, shape).astype(np.float32),
        velocities=np.broadcast_to([[0.0, 0.0], [0.0, 0.0], [0.0, 0.2]], (*shape, 2)).astype(np.float32),
        contacts=np.zeros(shape, np.uint16),
        radii=np.array([0.02, 0.03, 0.04]),
        drum_radius=RADIUS,
        baffles=(np.array([[0.19, -0.03], [0.15, 0.0], [0.19, 0.03]]),),
    )


class Shown:
    """A page with one or more players, and what it complained about or asked for."""

    def __init__(self, page, file):
        self.page = page
        self.troubles: list[str] = []
        page.on("console", lambda message: self.troubles.append(message.text))
        page.on("pageerror", lambda error: self.troubles.append(str(error)))
        page.on("request", lambda request: self._ask(request.url, file))
        page.goto(file.as_uri())

    def _ask(self, url, file):
        # Widgets import their text as a blob, which leaves the page as little as the page itself.
        if url != file.as_uri() and not url.startswith("blob:"):
            self.troubles.append(f"asked for {url}")

    def part(self, name, player=0):
        return self.page.locator("drumrs-player").nth(player).locator(f".{name}")

    @property
    def time(self) -> float:
        return self.page.evaluate("document.querySelector('drumrs-player').player.time")

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)

    def wait(self, condition):
        self.page.wait_for_function(
            f"(player => {condition})(document.querySelector('drumrs-player').player)"
        )

    def color(self, x, y) -> tuple[int, int, int]:
        """Return the color of the drum's picture at a place in meters."""
        script = """(canvas, [x, y]) => {
          const unit = canvas.width / 2 / (1.13 * 0.2);
          const at = [canvas.width / 2 + unit * x, canvas.height / 2 - unit * y].map(Math.round);
          const copy = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
          const context = copy.getContext("2d", { willReadFrequently: true });
          context.drawImage(canvas, -at[0], -at[1]);
          return [...context.getImageData(0, 0, 1, 1).data];
        }"""
        red, green, blue, _ = self.part("stage").evaluate(script, [x, y])
        return red, green, blue

    def pixels(self, name="stage") -> bytes:
        script = "canvas => canvas.toDataURL()"
        return self.part(name).first.evaluate(script)
