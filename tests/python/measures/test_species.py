"""Who has how much: species add up to the load, in mass and in energy."""

import pytest

import drumrs
from drumrs import measures
from drumrs.errors import ConfigError

CONFIG = drumrs.baseline().replace(
    {
        "load.species": [
            {"name": "balls", "preset": "steel-ball", "share": 0.25, "diameter": 0.03},
            {"name": "ore", "preset": "ore", "share": 0.75},
        ],
        "load.share_by": "mass",
        "load.start_speed": 1.0,
        "run.time_step": "auto",
        "run.duration": 0.3,
        "run.sample_every": 0.01,
        "run.frame_every": 0.01,
    }
)


def test_species_add_up_to_the_load():
    result = drumrs.run(CONFIG.softer(100.0), progress=False)
    found = measures.by_species(result.config, result.frames, (0.1, 0.3))
    assert found["species"].to_list() == ["balls", "ore"]
    assert dict(found.select("species", "bundle_count").iter_rows()) == CONFIG.species_counts
    assert found["load_mass"].sum() == pytest.approx(CONFIG.derived.load_mass)
    assert found["load_mass"][0] == pytest.approx(CONFIG.derived.species["balls"].mass)
    late = result.series.filter(result.series["time"] >= 0.0999)
    # Frames hold velocities in single precision.
    assert found["kinetic_translation"].sum() == pytest.approx(late["kinetic_translation"].mean(), rel=1e-5)
    assert (found["kinetic_translation_error"] > 0.0).all()


def test_a_load_without_species_has_no_rows_and_a_window_without_frames_is_refused():
    plain = drumrs.baseline().replace({"run.duration": 0.1})
    frames = drumrs.run(plain, progress=False).frames
    assert measures.by_species(plain, frames, (0.0, 0.1)).is_empty()
    with pytest.raises(ConfigError, match="at least two frames"):
        measures.by_species(plain, frames, (0.5, 0.6))


@pytest.mark.parametrize("kept", [True, False])
def test_a_run_prints_them(drum, tmp_path, kept):
    case = tmp_path / "case.toml"
    case.write_text(CONFIG.to_toml(comments=False))
    printed = drum("run", case, "--softer", "100", *(["--out", tmp_path / "out"] if kept else []))[1]
    rows = [line.split() for line in printed.splitlines()]
    balls = next(row for row in rows if row[:1] == ["balls"])
    assert int(balls[1]) == CONFIG.species_counts["balls"]
    assert float(balls[3]) == pytest.approx(25.0, abs=2.0)
    assert drum("run", case, "--softer", "100", "--set", "run.frame_every=1.0")[1].count("balls") == 0
