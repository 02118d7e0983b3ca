"""The registry of quantities: every name that drumrs gives is in it, and what is read from it."""

import json
from dataclasses import fields
from pathlib import Path

import polars as pl
import pytest

import drumrs
from drumrs import glossary, registry, viewer
from drumrs.analysis import STATISTICS
from drumrs.errors import CheckpointError, ConfigError
from drumrs.figures.history import mean_rate
from drumrs.paper import measure, plots
from drumrs.parts import Parts
from drumrs.run_folder import RunFolder
from drumrs.sweep import Sweep, columns
from drumrs.sweep.columns import parameters, schema
from drumrs.sweep.sealed import FORMAT, write_sealed
from drumrs.viewer.curves import panels_of_series

DOCS = Path(__file__).parents[2] / "docs"
CONFIG = drumrs.baseline(0.1, baffles=True).replace(
    {
        "run.duration": 0.2,
        "run.window": [0.05, 0.2],
        "run.sample_every": 0.002,
        "run.frame_every": 0.02,
        "run.record": registry.RECORDINGS,
    }
)


@pytest.fixture(scope="module")
def sweep(tmp_path_factory) -> Sweep:
    sweep = Sweep.from_configs([CONFIG])
    sweep.run(tmp_path_factory.mktemp("sweep"), jobs=1, progress=False)
    return sweep


def test_every_column_and_field_is_a_quantity(sweep):
    table = measure(sweep)
    facts = {"case", "seed", *parameters(CONFIG)}
    names = {*table.columns, *STATISTICS, *(field.name for field in fields(drumrs.Summary))} - facts
    names |= set(sweep.series(sweep.cases[0]).columns)
    assert len(names) > 90
    for name in names:
        one = drumrs.quantity(name)
        assert one.name == name
        assert one.unit
        assert one.meaning
        assert one.reading in registry.READINGS
    # And the other way round: what is listed is somewhere, but for the frames' columns and other drums' parts.
    # The tables of the published drums and of phases, measures, and what places a case, have tests of their own.
    listed = {name for name in drumrs.quantities()["name"] if not name.startswith("wall_")}
    listed -= {*registry.PUBLISHED_DRUMS, *registry.MEASURES, *registry.FACTS, *registry.PHASES}
    assert listed - names == {
        "frame",
        "bundle",
        "x",
        "y",
        "angle",
        "velocity_x",
        "velocity_y",
        "contacts",
        "radius",
        "species",
    }


def test_no_quantity_has_two_names_in_a_row_of_results(sweep):
    row = sweep.table().collect().select(pl.col(pl.Float64)).row(0, named=True)
    # Two other ways to the drum's power, which agree with it to round-off: that is what they are for.
    others = {*parameters(CONFIG), "energy_balance_power", "moment_balance_power"}
    by_value: dict[float, list[str]] = {}
    for name, value in row.items():
        if value and name not in others:
            by_value.setdefault(float(f"{value:.13g}"), []).append(name)
    assert len(by_value) > 20
    assert [names for names in by_value.values() if len(names) > 1] == []


def test_names_that_follow_from_rules():
    power = drumrs.quantity("dissipated_sliding_power")
    assert (power.unit, power.reading, power.formula) == ("W/m", "mean", "ΔD_sliding/Δt")
    assert power.meaning == "energy taken by sliding, per time"
    assert drumrs.quantity("normal_power").formula == "ΔN/Δt"
    assert drumrs.quantity("dissipated_normal_specific_power").unit == "W/kg"
    assert drumrs.quantity("work_ratio_error").meaning == "standard error of work_ratio"
    assert drumrs.quantity("baffle_12_force_x").meaning == "horizontal force of the load on baffle 12"


def test_what_is_no_quantity_is_refused():
    bare = ("color", "power", "error", "run.duration", "baffle_0_work")
    older = ("specific_power", "work_drum")
    by_no_rule = ("elastic_normal_power", "drum_power_error_error", "time_error", "steps_error")
    for name in bare + older + by_no_rule:
        with pytest.raises(KeyError, match=f"'{name}' is not the name of a quantity"):
            drumrs.quantity(name)


def test_the_list_is_printed_whole():
    shown = str(drumrs.quantities())
    assert "…" not in shown.replace("…_error", "")
    assert all(name in shown for name in ("drum_work", "mixed_in_a_turn", "radius"))
    assert "N/T by dissipation" in drumrs.quantities()._repr_html_()


def test_the_page_of_the_documentation_is_current():
    assert (DOCS / "quantities.md").read_text(encoding="utf-8") == glossary.page(), (
        "write it again: drumrs quantities --markdown > docs/quantities.md"
    )


def test_a_summary_says_what_its_numbers_are():
    assert (
        "drum_torque\n        Torque of the drum on the load about the axis [N m/m]."
        in drumrs.Summary.__doc__
    )


def test_the_kept_study_has_the_names_of_today():
    kept = pl.read_parquet_schema(DOCS / "study" / "table.parquet")
    results = list(kept)[list(kept).index("seed") + 1 :]
    assert set(results) == {one.name for one in registry.known(results)}
    assert set(schema()) - set(kept) <= {
        *parameters(CONFIG),
        "dissipated_tangential_power",
        "dissipated_rolling_power",
    }


def test_one_quantity_goes_from_the_core_to_a_figure_under_one_name(sweep):
    """The stops of `dissipated_sliding` are those that ARCHITECTURE.md lists."""
    name, case = "dissipated_sliding", sweep.cases[0]
    assert name in {column.name for column in registry.recorded(["rim"])}
    simulation = drumrs.Simulation(case.config)
    simulation.run()
    recorded = simulation.series[name]
    assert recorded[-1] > 0.0

    path = Path(sweep._folder) / f"{case.id}.series.parquet"
    series = sweep.series(case)
    assert series[name].equals(recorded)
    assert json.loads(pl.read_parquet_metadata(path)["units"])[name] == drumrs.quantity(name).unit == "J/m"

    row = measure(sweep).row(0, named=True)
    inside = series.filter(pl.col("time").is_between(row["window_start"], row["window_end"]))
    power = (inside[name][-1] - inside[name][0]) / (inside["time"][-1] - inside["time"][0])
    assert row[f"{name}_power"] == pytest.approx(power)
    assert row[f"{name}_specific_power"] == pytest.approx(power / case.load_mass)
    assert row["dissipation_ratio"] == pytest.approx(row["dissipated_normal_power"] / power)

    figure = plots.drift_over_time({"drum": [series]}, {"drum": case.load_mass}, (0.02, 0.06))
    (line,) = figure.axes[1].get_lines()
    time, sliding = series["time"].to_numpy(), series[name].to_numpy()
    _, rate = mean_rate(time, sliding, time[-1] / 3.0)
    _, damping = mean_rate(time, series["dissipated_normal"].to_numpy(), time[-1] / 3.0)
    moving = rate > 0.0
    assert moving.sum() > 10
    assert line.get_ydata()[moving] == pytest.approx(damping[moving] / rate[moving])
    assert figure.axes[1].get_ylabel() == f"{drumrs.quantity('dissipation_ratio').label} N/T"

    (powers, _) = panels_of_series(series)
    assert drumrs.quantity(name).title in {one.name for one in powers.lines}


def renamed(path: Path) -> None:
    """Give a table the names that an older version would have."""
    pl.read_parquet(path).rename({"drum_work": "work_drum"}).write_parquet(path)


def test_a_folder_of_older_names_is_refused_with_the_way_out(tmp_path):
    drumrs.save(drumrs.run(CONFIG, progress=False), tmp_path, pictures=False)
    summary = json.loads((tmp_path / "summary.json").read_text())
    told = "another version of drumrs wrote it, with other names; run its configuration again"
    summary["specific_power"] = summary.pop("drum_specific_power")
    (tmp_path / "summary.json").write_text(json.dumps(summary))
    with pytest.raises(ConfigError, match=f"summary.json' has no 'drum_specific_power'.*{told}"):
        drumrs.load(tmp_path)
    renamed(tmp_path / "series.parquet")
    with pytest.raises(ConfigError, match=f"series.parquet' has no 'drum_work'.*{told}"):
        viewer.read(tmp_path)


def test_frames_of_older_columns_are_refused_with_the_way_out(tmp_path):
    drumrs.save(drumrs.run(CONFIG, progress=False), tmp_path, pictures=False)
    frames = tmp_path / "frames.parquet"
    words = {"scene": pl.read_parquet_metadata(frames)["scene"]}
    pl.read_parquet(frames).drop("velocity_x").write_parquet(frames, metadata=words)
    for read in (drumrs.load, viewer.read):
        with pytest.raises(ConfigError, match=r"frames.parquet' has no 'velocity_x'.*another version"):
            read(tmp_path)


def test_a_sweep_of_older_names_is_named_and_computed_again(tmp_path):
    sweep = Sweep.from_configs([CONFIG])
    sweep.run(tmp_path, progress=False)
    case = sweep.cases[0]
    for content, path in {"series": f"{case.id}.series.parquet", "summary": f"{case.id}.parquet"}.items():
        table = pl.read_parquet(tmp_path / path)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("drumrs.sweep.sealed.FORMAT", FORMAT - 1)
            write_sealed(
                tmp_path / path, case.id, content, table.rename({"drum_work": "work_drum"}, strict=False)
            )
    with pytest.raises(ConfigError, match=f"has format {FORMAT - 1}.*another version of drumrs wrote it"):
        sweep.series(case)
    assert sweep.run(tmp_path, progress=False).computed == 1
    assert "drum_work" in sweep.series(case).columns


def test_a_run_does_not_go_on_from_records_of_older_names(tmp_path):
    simulation = drumrs.Simulation(CONFIG)
    folder = RunFolder(tmp_path)
    simulation.run(steps=100)
    folder.save(simulation)
    for path in (tmp_path / "records").glob("series-*.parquet"):
        renamed(path)
    with pytest.raises(
        CheckpointError, match=r"columns of other names.*begin the run anew, without --resume"
    ):
        Parts(tmp_path).restore(
            drumrs.Simulation.load(tmp_path / "checkpoint.bin", with_records=False).records
        )


def test_numbers_of_a_configuration_have_units():
    kinds = columns._leaves(drumrs.Config)
    plain = {
        "drum.rim drum.baffles.count drum.baffles.shape load.count load.spin_locked run.seed run.record contact.base",
        "drum.liner.file drum.liner.repeat drum.liner.mirror drum.liner.units drum.liner.rail.count",
        "rotation.phase load.species load.share_by contact.pair contact.bundle.tension contact.drum.tension run.zone",
    }
    without = set(" ".join(plain).split())
    for key, field in kinds:
        if key in without:
            assert field.json_schema_extra is None, key
            continue
        unit = field.json_schema_extra["unit"]
        assert unit == "1" or field.description.endswith(f" [{unit}]."), key
        assert field.description.count("[") <= 2, key


def test_a_sweeps_table_tells_the_units_of_parameters_and_results(sweep):
    units = json.loads(pl.read_parquet_metadata(sweep.write_table())["units"])
    assert units["drum.diameter"] == "m"
    assert units["contact.bundle.normal_damping"] == "N s/m"
    assert units["drum_specific_power_error"] == "W/kg"
