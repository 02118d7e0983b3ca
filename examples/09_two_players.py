"""
Two players in a page of your own
=================================

Two runs side by side: their players share one clock, and the page needs no server.
"""

# sphinx_gallery_thumbnail_path = "baseline.png"
import argparse
import json
from pathlib import Path

import drumrs
from drumrs import viewer

PAGE = """<!doctype html>
<meta charset="utf-8">
<meta name="color-scheme" content="light dark">
<title>Without and with baffles</title>
<style>body {{ display: grid; grid-template-columns: 1fr 1fr; gap: 12px }}</style>
<div></div><div></div>
<script type="application/json">{recordings}</script>
<script type="module">
{module}
const recordings = JSON.parse(document.querySelector("script").textContent);
const elements = [...document.querySelectorAll("div")];
const [first, second] = recordings.map((data, k) => new Player(elements[k], unpack(data)));
first.addEventListener("time", () => second.seek(first.time));
</script>
"""


def main() -> None:
    """Run both drums, for five seconds of simulated time or, with --small, three."""
    parser = argparse.ArgumentParser()
    parser.add_argument(
        "--small", action="store_true", help="simulate three seconds only, with softer springs"
    )
    parser.add_argument("--out", type=Path, default=Path("out/two_players"), help="folder of the page")
    options = parser.parse_args()

    recordings = []
    for baffles in (False, True):
        config = drumrs.baseline(fill=0.25, baffles=baffles)
        config = config.replace({"run.duration": 5.0})
        if options.small:
            config = config.softer(100.0).replace({"run.duration": 3.0})
        recordings.append(drumrs.player(drumrs.run(config, seed=1)).recording())
    text = json.dumps(recordings).replace("<", "\\u003c")
    module = viewer.module("player.js", "recording.js")
    options.out.mkdir(parents=True, exist_ok=True)
    page = options.out / "two_players.html"
    page.write_text(PAGE.format(recordings=text, module=module), encoding="utf-8")
    print(f"wrote {page}")


if __name__ == "__main__":
    main()
