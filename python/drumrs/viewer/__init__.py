"""The player: a run as one HTML page that needs nothing else, for a browser, a notebook or a report.

`recording` turns frames and series into what the page reads, with the forces at contacts of `forces`; `page` puts
pages together, `folder` finds a run, and `source` reads it.
In the browser, player.js is a player in any element of a page. Of its parts, stage.js draws the drum over the map
of occupancy.js, discs.js many bundles at once, plot.js curves, panel.js has their legend, film.js records, controls.js
buttons and keys, color.js what colors stand for, legend.js says it; recording.js holds the frames and takes more of
them while a run goes on. element.js is the element of the pages written here; studio.js is the page of a simulation
that runs, with its sliders.js, tiles.js and curves.js. `module` joins files into one module for other pages and
widgets. Nothing here sees a simulation.
"""

from drumrs.viewer.bundle import module
from drumrs.viewer.folder import find
from drumrs.viewer.page import Player, script
from drumrs.viewer.source import default_page, read

__all__ = ["Player", "default_page", "find", "module", "read", "script"]
