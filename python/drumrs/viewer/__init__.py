"""The player: a run as one HTML page that needs nothing else, for a browser, a notebook or a report.

`recording` turns frames and series into what the page reads, `page` puts pages together, `source` finds a run's files;
the page itself is `player.html`, `player.css` and the scripts beside them. Sees frames and tables, never a simulation.
"""

from drumrs.viewer.page import Player, assets
from drumrs.viewer.source import default_page, read

__all__ = ["Player", "assets", "default_page", "read"]
