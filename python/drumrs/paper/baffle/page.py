"""The page of the inference, Markdown, with its table and figure: what is known of the baffle, and how."""

import io
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from drumrs.files import write_whole
from drumrs.pages import provenance
from drumrs.paper.baffle.evidence import Means, Observable, Part, Sentence
from drumrs.paper.baffle.posterior import Array, Posterior, weigh
from drumrs.paper.baffle.sentences import (
    ALONG,
    POWER,
    RATIO,
    SENTENCES,
    UNWEIGHTED,
    log_likelihood,
)
from drumrs.paper.shape import BASES, HEIGHTS, MARKED, ROOM, TRIANGLE, Shape, shares_of_drum
from drumrs.pictures import attempt

if TYPE_CHECKING:
    from drumrs.paper.baffle.findings import Inference

_CM = 100.0
# Confirmed shapes whose residuals are shown sentence by sentence.
_SHOWN = 6
# Lengths differ by this [m] for the slope of a residual.
_STEP = 0.005
# A base so near the least that was searched [m] is said to be.
_EDGE = 0.005
# A posterior this much narrower than the prior is worth the word "known"; one above is "hardly known".
_KNOWN, _HARDLY = 0.5, 0.8


def write(inference: "Inference", folder: Path) -> None:
    """Write baffle.md, baffle.parquet and figures/baffle.png.

    Raises
    ------
    OSError
        Where one cannot be written; there is never half a file.
    """
    buffer = io.BytesIO()
    inference.table.write_parquet(buffer)
    write_whole(folder / "baffle.parquet", buffer.getvalue())
    with attempt(folder / "figures" / "baffle.png"):
        from drumrs.figures import write as write_figure
        from drumrs.paper.baffle.figure import draw

        (folder / "figures").mkdir(exist_ok=True)
        write_figure(draw(inference), folder / "figures" / "baffle.png")
    write_whole(folder / "baffle.md", ("\n".join(text(inference)) + "\n").encode())


def text(inference: "Inference") -> Iterator[str]:
    """Give the lines of the page."""
    yield from _opening(inference)
    yield from _what_is_left(inference)
    yield from _confirmed(inference)
    yield from _sentences(inference)
    yield from _sensitivity(inference)
    yield from _method(inference)
    yield from _checks(inference)


def _opening(inference: "Inference") -> Iterator[str]:
    best = inference.best
    yield "# The lost baffle"
    yield ""
    yield (
        "The drawing of the paper's baffles is lost; what its text says of them is not. Written by `drumrs reproduce "
        f"--baffle`. drumrs {provenance.versions()['drumrs']}."
    )
    yield ""
    yield (
        f"**Inferred: height {_CM * best.height:.3g} cm, base {_CM * best.base:.3g} cm, tip {_CM * best.tip:.3g} cm.** "
        f"Of {len(inference.confirmed)} shapes run at full stiffness it fits the paper's sentences best. It is not the "
        "only one that does: below is what the sentences leave open. Of the triangle that was assumed before (height "
        f"5, base 6 cm) the likelihood is e^{_against_best(inference, TRIANGLE):.1f} of the inferred one's."
    )
    yield ""
    if best.base < BASES[0] + _EDGE:
        yield (
            f"Its base is near the least that was searched, {_CM * BASES[0]:g} cm, less than the radius of a bundle: "
            "to the load it is a blade."
        )
        yield ""
    yield "![What the sentences leave, and the baffles](figures/baffle.png)"
    yield ""
    yield (
        "**Posterior of height, base and tip** (gray) given all sentences, with the shapes that were run, and the "
        "cross-sections of those run at full stiffness."
    )
    yield ""


def _against_best(inference: "Inference", shape: Shape) -> float:
    best, own = (float(log_likelihood(inference.confirmed[one])) for one in (inference.best, shape))
    return own - best


def _lengths(shapes: Array) -> dict[str, tuple[Array, float, str]]:
    """Return what may be known of a shape: values, factor and unit by name."""
    height, base, tip = shapes.T
    return {
        "height": (height, _CM, "cm"),
        "base": (base, _CM, "cm"),
        "tip": (tip, _CM, "cm"),
        "mean width": (0.5 * (base + tip), _CM, "cm"),
        "tip over base": (tip / base, 1.0, ""),
        "share of the drum, all three": (shares_of_drum(shapes), 100.0, "%"),
        "height over mean width": (2.0 * height / (base + tip), 1.0, ""),
    }


def _what_is_left(inference: "Inference") -> Iterator[str]:
    yield "## What the sentences leave"
    yield ""
    yield (
        "Medians and intervals that hold 68 %, with all tolerances halved, as stated, and doubled. *Narrowed to* is "
        "the scatter over that of all shapes searched."
    )
    yield ""
    header = [f"tolerances × {factor:g}" for factor in inference.posteriors]
    yield from _table(["", *header, "narrowed to"], _rows_of_lengths(inference))
    one = inference.posteriors[1.0]
    yield f"{_degeneracy(one)}"
    yield ""


def _rows_of_lengths(inference: "Inference") -> Iterator[list[str]]:
    one = inference.posteriors[1.0]
    for name, (values, scale, unit) in _lengths(one.shapes).items():
        cells = []
        for posterior_ in inference.posteriors.values():
            low, middle, high = (scale * x for x in posterior_.quantiles(values))
            cells.append(f"{middle:.3g} ({low:.3g} to {high:.3g}) {unit}".strip())
        yield [name, *cells, f"{100.0 * one.narrowing(values):.0f} %"]


def _degeneracy(one: Posterior) -> str:
    lengths = _lengths(one.shapes)
    narrowed = {name: one.narrowing(values) for name, (values, *_) in lengths.items()}
    best, least = min(narrowed, key=narrowed.__getitem__), max(narrowed, key=narrowed.__getitem__)
    pairs = [("height", "base"), ("height", "tip"), ("base", "tip"), ("height", "mean width")]
    together = {pair: one.correlation(lengths[pair[0]][0], lengths[pair[1]][0]) for pair in pairs}
    strongest = max(together, key=lambda pair: abs(together[pair]))
    rho = together[strongest]
    trade = (
        f"a larger {strongest[0]} makes up for a smaller {strongest[1]}"
        if rho < 0.0
        else f"a larger {strongest[0]} goes with a larger {strongest[1]}"
    )
    known = "is known" if narrowed[best] < _KNOWN else "is known a little"
    unknown = "is hardly known at all" if narrowed[least] > _HARDLY else "is known least"
    return (
        f"Several shapes fit. What {known} best is {best} (narrowed to {100.0 * narrowed[best]:.0f} % of the scatter "
        f"before); {least} {unknown} ({100.0 * narrowed[least]:.0f} %). Lengths trade: {trade} (correlation "
        f"{rho:+.2f}). Altogether the sentences give {one.bits:.1f} bits of information, as if one in "
        f"{2.0**one.bits:.0f} of the shapes searched were left."
    )


def _confirmed(inference: "Inference") -> Iterator[str]:
    yield "## Shapes at full stiffness"
    yield ""
    yield (
        f"{_seeds(inference.plan.seeds)} each. *Log likelihood* is that of all sentences, less that of the best; "
        "shapes whose values are within 1 of each other fit equally well."
    )
    yield ""
    names = {shape: name for name, shape in MARKED.items()}
    rows = [
        [
            str(shape) + (f" ({names[shape]})" if shape in names else ""),
            f"{_against_best(inference, shape):+.1f}",
            *(f"{known[Observable(POWER, fill)][0]:.2f}" for fill in (0.25, 0.50, 0.75)),
            *(f"{known[Observable(RATIO, fill)][0]:.2f}" for fill in (0.15, 0.25, 0.55, 0.75)),
            f"{known[Observable(ALONG, 0.25)][0]:.2f}",
        ]
        for shape, known in inference.confirmed.items()
    ]
    header = ["height / base / tip", "log likelihood", "W/kg at 25 %", "50 %", "75 %"]
    yield from _table([*header, "N/T at 15 %", "25 %", "55 %", "75 %", "along the rim, 25 %"], rows)
    yield "Residuals sentence by sentence, each of the part that fits worst, in tolerances: "
    yield (
        "for what should equal a number, how far above (+) or below (−) it is, ideally 0; for what should be at least "
        "a limit, above 0 meets it."
    )
    yield ""
    shown = list(inference.confirmed)[:_SHOWN]
    shown += [TRIANGLE] if TRIANGLE not in shown and TRIANGLE in inference.confirmed else []
    cells = [
        [sentence.name, *(f"{sentence.worst(inference.confirmed[shape])[1]:+.1f}" for shape in shown)]
        for sentence in SENTENCES
    ]
    yield from _table(["sentence", *(str(shape) for shape in shown)], cells)


def _sentences(inference: "Inference") -> Iterator[str]:
    known = inference.confirmed[inference.best]
    triangle = inference.confirmed.get(TRIANGLE)
    yield "## The sentences"
    yield ""
    yield (
        "Each counts once, by the part that fits it worst. Numbers are those of the inferred baffle"
        + (", and of the assumed triangle in brackets." if triangle else ".")
    )
    yield ""
    for title, sentences in (("", SENTENCES), ("Quoted, not weighed", UNWEIGHTED)):
        if title:
            yield f"### {title}"
            yield ""
            yield "These contradict the other sentences, or themselves."
            yield ""
        for sentence in sentences:
            yield f"**{sentence.name}.** “{sentence.quote}”"
            yield ""
            yield from (f"- {_described(part, known, triangle)}" for part in sentence.parts)
            yield ""


def _described(part: Part, known: Means, other: Means | None) -> str:
    value, error = part.estimate(known)
    expected = f"{'at least ' if part.at_least else ''}{part.expected:.3g} ± {part.tolerance:.2g} expected"
    beside = f" [{part.estimate(other)[0]:.3g}]" if other else ""
    return f"{part.name}: {value:.3g} ± {error:.1g}{beside}, {expected}"


def _sensitivity(inference: "Inference") -> Iterator[str]:
    yield "## Information in each sentence"
    yield ""
    yield (
        "*Alone* is the information of a sentence by itself, *without it* that of the others, in bits about the shapes "
        "searched; a sentence without information fits all shapes alike, or none. The rest is how its worst "
        "part's residual at the inferred shape changes with each length, in tolerances per cm, as emulated."
    )
    yield ""
    one = inference.posteriors[1.0]
    best = inference.best
    rows = []
    likelihoods = {
        s.name: np.broadcast_to(s.log_likelihood(inference.known), one.weights.shape) for s in SENTENCES
    }
    together = np.sum(list(likelihoods.values()), axis=0)
    for sentence in SENTENCES:
        own = likelihoods[sentence.name]
        alone, others = weigh(one.shapes, own).bits, weigh(one.shapes, together - own).bits
        slopes = _slopes(inference, sentence, best)
        rows.append([sentence.name, f"{alone:.2f}", f"{others:.2f}", *(f"{x:+.2f}" for x in slopes)])
    rows.sort(key=lambda row: -float(row[1]))
    yield from _table(["sentence", "alone", "without it", "height", "base", "tip"], rows)


def _slopes(inference: "Inference", sentence: Sentence, shape: Shape) -> list[float]:
    """Return the slope of the worst part's residual with each length [1/cm]; forwards, or backwards for the tip."""
    part, _ = sentence.worst(inference.confirmed[shape])
    here = np.array(shape.lengths)
    steps = np.diag([_STEP, _STEP, -_STEP if shape.tip >= _STEP else _STEP])
    known = inference.predicted_at(np.vstack([here, here + steps]))
    residuals = part.residual(known)[0]
    return [float(x) for x in (residuals[1:] - residuals[0]) / (_CM * steps.sum(axis=1))]


def _method(inference: "Inference") -> Iterator[str]:
    plan = inference.plan
    yield "## How"
    yield ""
    yield (
        f"**Shapes.** Three equal baffles, symmetric about their axes: heights of {_CM * HEIGHTS[0]:g} to "
        f"{_CM * HEIGHTS[1]:g} cm; bases of {_CM * BASES[0]:g} cm, less than a bundle's radius, to "
        f"{_CM * BASES[1]:g} cm, a quarter of the drum's diameter; tips from 0, a triangle, to the base, an upright "
        f"block. Figure 3(c) shows a load of 75 % fill among them, which fits where the three take at most "
        f"{100.0 * ROOM:g} % of the drum: larger ones are not searched. Before anything is known, all of these are "
        "equally likely."
    )
    yield ""
    scanned = len(inference.scanned)
    yield (
        f"**Runs.** {scanned} shapes with springs softer by {plan.softer:g}, one seed: those of a Sobol sequence, "
        f"three that have names, and those that were confirmed. {len(inference.confirmed)} at full stiffness, "
        f"{_seeds(plan.seeds)}. The bare drum at full stiffness, {_seeds(plan.bare_seeds)}. All over "
        f"{plan.duration:g} s, averaged over {plan.window[0]:g}–{plan.window[1]:g} s, with a time step of a twentieth "
        "of a collision instead of Table 1's 51st."
    )
    yield ""
    yield (
        "**Emulator.** A Gaussian process for each observable with softer springs, whose noise is the error of each "
        "run; its lengths are fitted. What full stiffness changes is measured at the confirmed shapes, observable by "
        "observable, and applied, the scatter between shapes being a further error. N/T is that of the gross work."
    )
    yield ""
    yield (
        "**Likelihood.** A number that should equal a target is likely as in Student's distribution with 4 degrees of "
        "freedom, its width from tolerance, emulator and noise in squares: tolerances are guesses themselves, and a "
        "sentence that no shape fits should not decide among shapes. One that should be at least a limit: the "
        "probability that it is, by the same distribution. The worst part of a sentence counts; sentences are "
        "independent."
    )
    yield ""
    if inference.failures:
        yield f"{len(inference.failures)} cases failed; their shapes are left out:"
        yield ""
        yield from (f"- {failure.case.config.title}: {failure.message}" for failure in inference.failures)
        yield ""


def _seeds(seeds: tuple[int, ...]) -> str:
    return f"{len(seeds)} seed{'s' if len(seeds) > 1 else ''}"


def _checks(inference: "Inference") -> Iterator[str]:
    yield "## Checks"
    yield ""
    loo_residuals = np.concatenate([emulator.loo_residuals for emulator in inference.emulators.values()])
    within = [100.0 * float(np.mean(np.abs(loo_residuals) < k)) for k in (1.0, 2.0)]
    yield (
        "**Emulator, leaving one shape out.** What the others predict differs from what was run by "
        f"{np.sqrt(np.mean(loo_residuals**2)):.2f} stated errors (root mean square over all observables; 1 is right): "
        f"{within[0]:.0f} % of the differences are within one error (68 % expected), {within[1]:.0f} % within two (95 "
        "%). The errors of an observable are multiplied by its own."
    )
    yield ""
    rows = [
        [
            one.quantity.replace("_", " "),
            f"{100.0 * one.fill:g} %",
            f"{one.size:g}",
            f"{np.sqrt(np.mean(emulator.loo_residuals**2)):.2f}",
            f"{emulator.scale:.3g}",
            f"{emulator.typical_error:.2g}",
        ]
        for one, emulator in sorted(inference.emulators.items())
    ]
    header = ["observable", "fill", "D/d", "difference over error", "scatter over shapes", "typical error"]
    yield from _table(header, rows)
    yield (
        "**Softer springs.** What full stiffness changes, as mean over the confirmed shapes, and its error with the "
        "scatter between shapes: a factor of powers, N/T and angular momentum; so much added to shares and "
        "indices of motion."
    )
    yield ""
    changes = [
        [
            one.quantity.replace("_", " "),
            f"{100.0 * one.fill:g} %",
            f"× {change.value:.3f} ± {change.error:.3f}"
            if change.in_proportion
            else f"{change.value:+.3f} ± {change.error:.3f}",
        ]
        for one, change in sorted(inference.corrections.items())
    ]
    yield from _table(["observable", "fill", "full stiffness"], changes)


def _table(header: list[str], rows: Iterable[list[str]]) -> Iterator[str]:
    yield f"| {' | '.join(header)} |"
    yield f"|{'---|' * len(header)}"
    yield from (f"| {' | '.join(row)} |" for row in rows)
    yield ""
