"""The inference of the lost baffle: sentences as residuals, emulator, posterior, and all of it on a made-up truth."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import polars as pl
import pytest

from drumrs import ConfigError, baseline, paper
from drumrs.paper.baffle import inference, observations, sentences
from drumrs.paper.baffle.design import Plan
from drumrs.paper.baffle.evidence import Means, Observable
from drumrs.paper.baffle.posterior import measured_corrections, posterior, round_shapes, spread_over
from drumrs.paper.baffle.sentences import (
    ALONG,
    CARRIED,
    CIRCULATION,
    MIXED,
    POWER,
    RATIO,
    SENTENCES,
    UNWEIGHTED,
)
from drumrs.paper.shape import INFERRED, PADDLE, ROOM, TRIANGLE, Shape, shapes_in_region

TRUTH = Shape(0.045, 0.07, 0.04)
BARE_POWER = {
    0.15: 4.9,
    0.25: 4.1,
    0.35: 3.9,
    0.40: 3.65,
    0.45: 3.5,
    0.50: 3.0,
    0.55: 2.3,
    0.65: 1.2,
    0.75: 0.4,
}
BARE_RATIO = {
    0.15: 0.7,
    0.25: 1.0,
    0.35: 1.1,
    0.40: 1.3,
    0.45: 1.6,
    0.50: 1.8,
    0.55: 2.1,
    0.65: 2.0,
    0.75: 1.4,
}
BARE_MOTION = {ALONG: 0.2, CARRIED: 0.1, MIXED: 0.5, CIRCULATION: 0.16}
SMALL = Plan(shapes=30, confirmed=3, seeds=(1, 2), bare_seeds=(1, 2))


def value(one: Observable, lengths: np.ndarray) -> float:
    """Return an observable of a world in which every sentence fits `TRUTH`, and each length spoils some of them."""
    if not one.baffles:
        motion = BARE_MOTION.get(one.quantity)
        return (
            motion if motion is not None else (BARE_POWER if one.quantity == POWER else BARE_RATIO)[one.fill]
        )
    height, base, tip = (np.asarray(lengths) - TRUTH.lengths) / (0.03, 0.03, 0.03)
    if one.quantity == POWER:
        large = one.fill > 0.5
        own = BARE_POWER[one.fill] * ((1.0 if large else 0.88) + 0.006 * (one.size - 20.0))
        return own * (1.0 + (0.8 if large else 0.1) * height)
    if one.quantity == RATIO:
        return (2.2 if one.fill < 0.6 else BARE_RATIO[one.fill]) + 0.6 * base
    if one.fill == 0.25:
        return {ALONG: 0.7, CARRIED: 0.9, MIXED: 0.3}.get(one.quantity, 0.2)
    return BARE_MOTION[one.quantity] * (1.0 if one.quantity == CIRCULATION else 1.0 + 1.5 * tip)


def known_at(shapes: np.ndarray, error: float = 0.01) -> Means:
    shapes = np.atleast_2d(shapes)
    found = {}
    for one in sentences.OBSERVABLES:
        means = np.array([value(one, row) for row in shapes])
        found[one] = (means, error * np.abs(means))
    return found


def made_up(points, _folder) -> pl.DataFrame:
    """Return the table of a made-up world; softer springs have N/T 8 % higher and seeds scatter."""
    rows = []
    for point in points:
        lengths = point.shape.lengths if point.shape else (None, None, None)
        for quantity in observations.QUANTITIES:
            one = point.observable(quantity)
            if quantity not in {POWER, RATIO} and one.fill not in sentences.WATCHED_FILLS:
                continue
            mean = value(one, lengths) * (1.08 if quantity == RATIO and point.softer > 1.0 else 1.0)
            noise = np.random.default_rng(abs(hash((point, quantity))) % 2**32).normal()
            rows.append(
                (
                    *lengths,
                    point.softer,
                    point.seed,
                    *point.place,
                    quantity,
                    mean * (1.0 + 0.01 * noise),
                    0.01 * mean,
                )
            )
    columns = ("height", "base", "tip", "softer", "seed", "fill", "size", "quantity", "value", "error")
    return pl.DataFrame(rows, schema=list(columns), orient="row", infer_schema_length=None)


@pytest.mark.parametrize(
    "part",
    [part for sentence in (*SENTENCES, *UNWEIGHTED) for part in sentence.parts],
    ids=lambda part: part.name,
)
def test_every_residual_changes_its_sign_with_what_it_is_made_of(part):
    known = known_at(np.array(TRUTH.lengths))
    signs = set()
    for way in np.linspace(0.0, 4.0, 81):
        first = part.of[0]
        means = known[first][0] * way
        signs.add(float(np.sign(part.residual({**known, first: (means, means * 0.0)})[0][0])))
    assert signs >= {-1.0, 1.0}


def test_every_sentence_fits_the_truth_and_counts_once():
    known = known_at(np.array(TRUTH.lengths), error=0.0)
    for sentence in SENTENCES:
        part, residual = sentence.worst(known)
        assert residual > -0.01 if part.at_least else abs(residual) < 1.0, sentence.name
        assert sentence.log_likelihood(known) == min(one.log_likelihood(known) for one in sentence.parts)


def test_residuals_know_the_errors_of_what_they_are_made_of():
    ratio = next(one for one in SENTENCES if one.name == "N/T about 2.2 below 60 %").parts[0]
    one = ratio.of[0]
    residual, error = ratio.residual({one: (np.array(2.42), np.array(0.22))})
    assert residual == pytest.approx(2.0)
    assert error == pytest.approx(2.0)
    sure, unsure = (ratio.log_likelihood({one: (np.array(2.42), np.array(x))}) for x in (0.0, 0.22))
    assert sure == pytest.approx(-2.5 * np.log(2.0))
    assert unsure == pytest.approx(-2.5 * np.log(1.2) - 0.5 * np.log(5.0))
    assert ratio.log_likelihood({one: (np.array(2.42), np.array(0.0))}, factor=2.0) == pytest.approx(
        -2.5 * np.log(1.25)
    )


def test_a_limit_is_met_by_more():
    along = next(one for one in SENTENCES if one.name.startswith("against the rim")).parts[0]
    below, at, above = (
        float(along.log_likelihood({along.of[0]: (np.array(x), np.array(0.0))})) for x in (0.3, 0.5, 0.9)
    )
    assert at == pytest.approx(np.log(0.5))
    assert below < at < above < 0.0


def test_shapes_leave_room_and_cover_the_region():
    shapes = shapes_in_region(200)
    assert all(Shape(*row).share_of_drum <= ROOM for row in shapes.tolist())
    assert (shapes[:, 2] <= shapes[:, 1]).all()
    assert np.ptp(shapes, axis=0) == pytest.approx([0.09, 0.1, 0.1], rel=0.25)
    assert all(shape.share_of_drum <= ROOM for shape in round_shapes())
    assert PADDLE in round_shapes()


def test_the_area_of_a_baffle_is_that_of_its_outline():
    from shapely import Point as Disc
    from shapely import Polygon

    radius = 0.5 * baseline().drum.diameter
    foot = np.sqrt(radius**2 - 0.25 * PADDLE.base**2)
    half_base, half_tip, inner = 0.5 * PADDLE.base, 0.5 * PADDLE.tip, radius - PADDLE.height
    outside = 2.0 * radius
    outline = Polygon(
        [
            (outside, half_base),
            (foot, half_base),
            (inner, half_tip),
            (inner, -half_tip),
            (foot, -half_base),
            (outside, -half_base),
        ]
    )
    disc = Disc(0.0, 0.0).buffer(radius, quad_segs=500)
    assert PADDLE.share_of_drum == pytest.approx(3.0 * disc.intersection(outline).area / disc.area, rel=1e-3)


@pytest.mark.parametrize("shape", [TRIANGLE, PADDLE, Shape(0.035, 0.05, 0.05)])
def test_shapes_are_configurations_down_to_their_limits(shape):
    config = baseline(0.75).replace(shape.keys)
    assert config.drum.baffles.count == 3
    assert config.derived.load_mass > 0.0


def test_the_posterior_finds_the_truth():
    dense = shapes_in_region(4000)
    found = posterior(dense, known_at(dense))
    for k, length in enumerate(TRUTH.lengths):
        low, middle, high = found.quantiles(dense[:, k])
        assert low < length < high
        assert found.narrowing(dense[:, k]) < 0.6
        assert middle == pytest.approx(length, abs=0.012)
    wide, narrow = (posterior(dense, known_at(dense), factor) for factor in (2.0, 0.5))
    assert wide.bits < found.bits < narrow.bits


def test_what_full_stiffness_changes_is_measured_with_its_scatter():
    ratio, share = Observable(RATIO, 0.25), Observable(ALONG, 0.25)
    soft = {one: (np.array([2.0, 2.0, 2.0]), np.full(3, 0.001)) for one in (ratio, share)}
    stiff = {one: (np.array([1.8, 1.9, 1.7]), np.full(3, 0.001)) for one in (ratio, share)}
    found = measured_corrections(soft, stiff)
    assert found[ratio][:2] == (pytest.approx(0.9), pytest.approx(0.05, rel=0.01))
    assert found[share][:2] == (pytest.approx(-0.2), pytest.approx(0.1, rel=0.01))
    known = np.array([3.0]), np.array([0.2])
    assert np.ravel(found[ratio].apply(*known)) == pytest.approx([2.7, np.hypot(0.18, 0.15)], rel=0.01)
    assert np.ravel(found[share].apply(*known)) == pytest.approx([2.8, np.hypot(0.2, 0.1)], rel=0.01)
    # Where noise explains it all, the error is that of the mean.
    noisy = {one: (means, np.full(3, 0.2)) for one, (means, _) in stiff.items()}
    assert measured_corrections(soft, noisy)[share].error == pytest.approx(0.2 / np.sqrt(3.0), rel=0.01)


def test_shapes_to_confirm_are_likely_and_apart():
    shapes = round_shapes()
    logs = np.array([-50.0 * (shape.height - 0.05) ** 2 / 0.01**2 for shape in shapes])
    chosen = spread_over(shapes, logs, 6)
    assert all(shape.height == 0.05 for shape in chosen)
    apart = [np.subtract(a.lengths, b.lengths) for a in chosen for b in chosen if a < b]
    assert min(np.linalg.norm(apart, axis=1)) > 0.02
    assert spread_over(shapes, logs, 3) == chosen[:3]


def test_observations_are_means_of_runs(tmp_path):
    plan = Plan(softer=400.0, duration=1.6, window=(0.4, 1.6))
    cases = {point: config for point, config in plan.soft([PADDLE]).items() if point.place == (0.25, 20.0)}
    paper_sweep = inference.Sweep.from_configs(cases.values())
    paper_sweep.run(tmp_path, jobs=1, progress=False)
    table = observations.observe(cases, tmp_path)
    assert set(table["quantity"]) == set(observations.QUANTITIES)
    ((key, known),) = observations.known_by_shape(table).items()
    assert key == (PADDLE, 400.0)
    row = paper_sweep.table().collect().row(0, named=True)
    assert known[Observable(POWER, 0.25)][0] == pytest.approx(row["drum_specific_power"])
    # The error of one seed, doubled.
    assert known[Observable(POWER, 0.25)][1] == pytest.approx(2.0 * row["drum_specific_power_error"])


def test_shapes_that_lack_a_run_are_left_out():
    table = made_up(SMALL.soft([PADDLE, TRIANGLE]), None)
    whole = observations.known_by_shape(table)
    assert set(whole) == {(PADDLE, SMALL.softer), (TRIANGLE, SMALL.softer)}
    lacking = table.filter((pl.col("tip") > 0.0) | (pl.col("fill") < 0.7))
    assert set(observations.known_by_shape(lacking)) == {(PADDLE, SMALL.softer)}


@pytest.fixture
def _nothing_is_simulated(monkeypatch):
    class Done:
        failures = ()

    monkeypatch.setattr(inference.Sweep, "run", lambda *_, **__: Done())
    monkeypatch.setattr(inference, "observe", made_up)


@pytest.mark.usefixtures("_nothing_is_simulated")
def test_the_inference_finds_a_made_up_truth_and_writes_its_page(tmp_path):
    found = paper.infer_baffle(tmp_path, SMALL, jobs=1, progress=False)
    assert set(found.confirmed) >= {TRIANGLE}
    assert np.abs(np.subtract(found.best.lengths, TRUTH.lengths)).max() < 0.02
    factor, error, _ = found.corrections[Observable(RATIO, 0.25)]
    assert factor == pytest.approx(1.0 / 1.08, abs=3.0 * error)
    assert error < 0.03
    for k, length in enumerate(TRUTH.lengths):
        low, _, high = found.posteriors[1.0].quantiles(found.posteriors[1.0].shapes[:, k], (0.01, 0.5, 0.99))
        assert low < length < high
    assert {path.name for path in tmp_path.iterdir()} == {
        "baffle.md",
        "baffle.parquet",
        "figures",
        "drumrs-baffle.json",
    }
    page = (tmp_path / "baffle.md").read_text(encoding="utf-8")
    assert all(f"“{sentence.quote}”" in page for sentence in (*SENTENCES, *UNWEIGHTED))
    best = found.best
    assert (
        f"height {100 * best.height:.3g} cm, base {100 * best.base:.3g} cm, tip {100 * best.tip:.3g} cm"
        in page
    )
    assert (tmp_path / "figures" / "baffle.png").read_bytes()[1:4] == b"PNG"


def test_the_command_says_what_was_inferred(drum, tmp_path, monkeypatch):
    asked, plan = [], Plan()

    def infer(*arguments):
        asked.append(arguments)
        (tmp_path / "baffle.md").touch()
        return SimpleNamespace(best=PADDLE, failures=())

    monkeypatch.setattr("drumrs.paper.infer_baffle", infer)
    status, printed, told = drum("reproduce", "--baffle", "--out", tmp_path, "--jobs", "1")
    assert status == 0
    assert asked == [(tmp_path, plan, 1)]
    assert f"{plan.cost:.2g} particle-steps in all" in told
    assert printed.startswith("inferred baffle: height 3.5 cm, base 8 cm, tip 5 cm\n")
    assert printed.endswith(f"wrote {tmp_path / 'baffle.md'}\n")


@pytest.mark.parametrize("other", ["--quick", "--full", "--retry"])
def test_the_command_has_no_other_scale(other, drum, tmp_path):
    status, _, told = drum("reproduce", "--baffle", other, "--out", tmp_path / "new")
    assert status == 2
    assert told.startswith("drumrs: --baffle is given with --quick, --full or --retry")
    assert not (tmp_path / "new").exists()


def test_the_kept_page_says_what_is_called_inferred():
    page = (Path(__file__).parents[3] / "docs" / "study" / "baffle.md").read_text(encoding="utf-8")
    height, base, tip = (f"{100.0 * length:.3g}" for length in INFERRED.lengths)
    assert f"**Inferred: height {height} cm, base {base} cm, tip {tip} cm.**" in page


def test_a_missing_library_is_named_before_anything_runs(monkeypatch, tmp_path):
    monkeypatch.setattr("drumrs.decide.emulator.find_spec", lambda _: None)
    with pytest.raises(
        ConfigError, match=r"needs the package sklearn, which is not installed.*drumrs\[decide\]"
    ):
        paper.infer_baffle(tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_folder_of_the_study_is_refused(tmp_path):
    (tmp_path / "drumrs-reproduction.json").write_text("{}", encoding="utf-8")
    with pytest.raises(ConfigError, match="that of a reproduction"):
        paper.infer_baffle(tmp_path)
