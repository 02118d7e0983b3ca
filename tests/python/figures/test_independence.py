"""Figures depend on nothing of the user's: neither on the backend that the environment names, nor on a matplotlibrc."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from drumrs import figures
from synthetic import made_up, series_of

NOWHERE = "no_such_backend"

DRAW = """
import sys
sys.path.insert(0, {tests!r})
from drumrs import figures
from synthetic import made_up, series_of
figures.write(figures.snapshot(made_up(drum_radius=1.0)), "snapshot.png")
figures.write(figures.time_series(series_of(7.0)), "series.png")
"""

HOSTILE = """
backend: pdf
axes.facecolor: black
axes.grid: True
axes.labelsize: 30
font.family: serif
font.size: 20
image.cmap: gray
lines.linewidth: 9
savefig.bbox: tight
savefig.dpi: 20
text.usetex: True
"""


def python(code, folder, **environment):
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("module", ["drumrs.paper.plots", "drumrs.verification.picture"])
def test_a_backend_that_is_not_there_does_not_matter(module, tmp_path):
    code = f"import {module}, os; print(os.environ['MPLBACKEND'])"
    assert python(code, tmp_path, MPLBACKEND=NOWHERE).split() == [NOWHERE]


def test_whatever_else_is_drawn_has_the_backend_asked_for(tmp_path):
    code = "import drumrs.figures, matplotlib; print(matplotlib.get_backend())"
    assert python(code, tmp_path, MPLBACKEND="svg").split() == ["svg"]


def test_a_matplotlibrc_leaves_the_bytes_alone(tmp_path):
    (tmp_path / "matplotlibrc").write_text(HOSTILE)
    python(DRAW.format(tests=str(Path(__file__).parents[1])), tmp_path)
    figures.write(figures.snapshot(made_up(drum_radius=1.0)), tmp_path / "own_snapshot.png")
    figures.write(figures.time_series(series_of(7.0)), tmp_path / "own_series.png")
    for name in ("snapshot.png", "series.png"):
        assert (tmp_path / name).read_bytes() == (tmp_path / f"own_{name}").read_bytes()


def test_style_and_settings_end_with_the_figure():
    import matplotlib as mpl

    with mpl.rc_context({"lines.linewidth": 9.0}):
        figures.render(figures.time_series(series_of(7.0)), "png")
        assert mpl.rcParams["lines.linewidth"] == 9.0
