"""The page with a drum that runs in the browser, from the core in WebAssembly that `make wasm` builds."""

import base64
import json
import re
from pathlib import Path
from typing import Any

import drumrs
from drumrs.simulation import Simulation
from drumrs.studio.controls import SPEED, controls
from drumrs.studio.scene import frame_now, pack_start
from drumrs.viewer import module

ROOT = Path(__file__).parents[1]
# Where `make wasm` writes to.
BUILT = ROOT / "target" / "wasm" / "page"
# Springs softer by this factor than the paper's let a phone keep up with real time.
_SOFTER = 100.0
# Keys that the core's configuration has under the same name, so that a page can set them by itself.
_KEYS = (SPEED, "load.count", "contact.bundle.friction")
# Joined as one script: browsers refuse modules to the workers of a page that was opened from disk.
_BETWEEN_MODULES = re.compile(r"^(import .*;\n|export (\{.*\};\n?)?)", re.MULTILINE)

_FACTS = (
    "Computed in this page, with the bits that every other machine gets. Springs are a hundred times softer than "
    "the paper's, so that this keeps up with time."
)

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>A drum that runs in this page</title>
<link rel="icon" href="data:,">
<style>
body {{ max-width: 1240px; margin: 0 auto; padding: 12px; background: Canvas; }}
@media (max-width: 500px) {{ body {{ padding: 0; }} }}
</style>
</head>
<body>
<main></main>
<script type="application/json" id="drum">{data}</script>
<script type="module">
{module}</script>
</body>
</html>
"""


def is_built() -> bool:
    """Return whether the core in WebAssembly is there."""
    return (BUILT / "drumrs_bg.wasm").is_file() and (BUILT / "drumrs.js").is_file()


def page() -> str:
    """Return the page, which needs nothing else."""
    scripts = ROOT / "wasm" / "page"
    worker = (BUILT / "drumrs.js", scripts / "session.js", scripts / "worker.js")
    data = {
        "worker": "".join(map(_joined, worker)),
        "core": base64.b64encode((BUILT / "drumrs_bg.wasm").read_bytes()).decode(),
        "machines": machines(),
    }
    # A script within a page's script must not end it.
    safe = json.dumps(data, allow_nan=False).replace("<", "\\u003c")
    return _PAGE.format(data=safe, module=f"{module('studio.js')}\n{_joined(scripts / 'page.js')}")


def machines() -> dict[str, Any]:
    """Return what can be chosen on the page, as session.js reads it."""
    found = {}
    for count in (3, 6, 0):
        config = machine(count)
        simulation = Simulation(config)
        core = json.loads(config.to_core_json())
        core["run"]["time_step"] = simulation.time_step
        sliders = [one for one in controls(config, config.rotation.rpm or 0.0) if one["key"] in _KEYS]
        label = f"the paper's drum, {f'{count} baffles' if count else 'no baffles'}"
        found[f"{count} baffles"] = {
            "label": label,
            "facts": _FACTS,
            "config": core,
            "scene": pack_start(frame_now(simulation, simulation.records.none())),
            "controls": sliders,
        }
    return found


def machine(baffles: int) -> drumrs.Config:
    """Return the drum of the page with so many baffles."""
    changes = {"load.fill": None, "load.count": 100, "drum.baffles.count": baffles}
    # What is recorded and never read would fill the memory of a page that runs for hours.
    sparing = {"run.sample_every": 1.0, "run.frame_every": 1.0}
    return drumrs.baseline(baffles=True).softer(_SOFTER).replace(changes | sparing)


def _joined(path: Path) -> str:
    """Return a module without what makes it one, behind those that it imports."""
    return _BETWEEN_MODULES.sub("", path.read_text(encoding="utf-8"))
