"""The paper's Table 1, repaired: what the scan prints, what it must have been, and how that is known."""

from dataclasses import dataclass

from drumrs.config import Config, baseline
from drumrs.paper.drums import BAFFLED

# Scanned off the paper, units as here: stiffness [N/m] and damping [N s/m] between bundles and with the drum, and the
# time step [s].
SCANNED_STIFFNESS = {"bundle": 9.25e9, "drum": 9.70e9}
SCANNED_DAMPING = {"bundle": 5.35e3, "drum": 7.74e3}
SCANNED_STEP = 3.70e-6

_AUTHORS = "as scanned"
_LOST = "the figure that gave it is lost"


@dataclass(frozen=True)
class Row:
    """A line of Table 1."""

    quantity: str
    scanned: str
    used: str
    source: str = _AUTHORS


@dataclass(frozen=True)
class Contact:
    """One kind of contact in the baseline: what is given, what follows, and what the scan would mean.

    Attributes
    ----------
    name
        ``"bundle"`` or ``"drum"``: what the bundle touches.
    stiffness, damping
        k_N [N/m] and ν_N [N s/m] of the baseline; the latter follows from the restitution.
    collision_time
        Duration of a collision [s].
    scanned_restitution
        Restitution that the scanned stiffness and damping would give.
    repaired_restitution
        Restitution that the repaired stiffness and the scanned damping give.
    scanned_steps
        Time steps that a collision would last by the scan.
    """

    name: str
    stiffness: float
    damping: float
    collision_time: float
    scanned_restitution: float
    repaired_restitution: float
    scanned_steps: float


def contacts(config: Config) -> tuple[Contact, Contact]:
    """Return the contacts of a bundle with another one, and with the drum."""
    names = ("bundle", "drum")
    # The scanned springs are too stiff for the paper's time step.
    damped = {f"contact.{name}.normal_damping": SCANNED_DAMPING[name] for name in names}
    stiff = {f"contact.{name}.normal_stiffness": SCANNED_STIFFNESS[name] for name in names}
    used, repaired, scanned = (
        config.replace({"run.time_step": "auto", **changes}).derived
        for changes in ({}, damped, {**damped, **stiff})
    )
    found = [
        Contact(
            name=name,
            stiffness=getattr(config.contact, name).normal_stiffness,
            damping=getattr(used, name).normal_damping,
            collision_time=getattr(used, name).collision_time,
            scanned_restitution=getattr(scanned, name).restitution,
            repaired_restitution=getattr(repaired, name).restitution,
            scanned_steps=getattr(scanned, name).collision_time / SCANNED_STEP,
        )
        for name in names
    ]
    return found[0], found[1]


def rows() -> list[Row]:
    """Return Table 1 line by line, with the numbers of the baseline."""
    config = baseline()
    bundle, drum = contacts(config)
    load, run = config.load, config.run
    law = config.contact.bundle
    step = float(run.time_step)
    ratio = config.drum.diameter / load.diameter
    return [
        Row("drum diameter D", "47.5 cm", f"{config.drum.diameter:g} m"),
        Row("drum speed", "54 rpm", f"{config.rotation.rpm:g} rpm, {_speed(config)}"),
        Row("bundle diameter d", "2.375 cm", f"{load.diameter:g} m (D/d = {ratio:g})"),
        Row(
            "bundle density ρ",
            "1000 kg/m³",
            f"{load.density:g} kg/m³, {config.derived.bundle_mass:.4f} kg per m",
        ),
        Row(
            "number of bundles N",
            "100 (25 %)",
            f"{config.bundle_count} at fill N d²/D² = {load.fill:.0%}, {config.derived.load_mass:.1f} kg per m",
        ),
        Row("friction μ, both", "0.5 (symbol lost)", f"{law.friction:g}", "the other of the two rows"),
        Row(
            "restitution e, both", "0.1 (symbol lost)", f"{law.restitution:g}", "fits the damping, see below"
        ),
        *_stiffness_rows(bundle, "bundle–bundle"),
        *_stiffness_rows(drum, "bundle–drum"),
        Row("k_S / k_N, both", "1", f"{law.stiffness_ratio:g}"),
        Row(
            "time step",
            f"{scientific(SCANNED_STEP)} s",
            f"{scientific(step)} s, 1/{bundle.collision_time / step:.1f} of a collision",
        ),
        _baffles(),
    ]


def _stiffness_rows(contact: Contact, name: str) -> tuple[Row, Row]:
    scanned = scientific(SCANNED_STIFFNESS[contact.name]), scientific(SCANNED_DAMPING[contact.name])
    return (
        Row(
            f"{name} k_N",
            f"{scanned[0]} N/m",
            f"{scientific(contact.stiffness)} N/m",
            "exponent repaired, see below",
        ),
        Row(f"{name} ν_N", f"{scanned[1]} N s/m", f"{scientific(contact.damping)} N s/m", "follows from e"),
    )


def _speed(config: Config) -> str:
    derived = config.derived
    critical = f"{derived.critical_share:.1%} of the critical speed"
    return f"Ω = {derived.angular_velocity:.4f} rad/s (Ω²R/g = {derived.froude_number:.3f}, {critical})"


def _baffles() -> Row:
    one = BAFFLED.config().drum.baffles
    tip = f", {1e3 * one.tip:g} mm wide at the tip" if one.shape == "trapezoid" else ""
    used = f"3 {one.shape}s, {1e3 * one.height:g} mm high on a base of {1e3 * one.base:g} mm{tip}, every 120°"
    return Row("baffles", "–", used, f"inferred from the text: {_LOST}")


def scientific(value: float) -> str:
    """Write a number with a power of ten, as the paper does.

    Examples
    --------
    >>> scientific(9.25e7), scientific(3.7e-6)
    ('9.25·10⁷', '3.70·10⁻⁶')
    """
    digits, exponent = f"{value:.2e}".split("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{digits}·10{raised}"
