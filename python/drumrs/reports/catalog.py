"""The pages: for each trade the question in words, its sections, and what two dimensions cannot say to it."""

from dataclasses import dataclass

from drumrs.reports import charge, contacts, laundry, power
from drumrs.reports.content import Section

# What holds for every page.
_PLANE = (
    "Bundles are discs in a plane: numbers are per meter of depth, and nothing moves along the axis. End walls, and "
    "what bodies do in a third dimension, are left out; a plane packs denser and locks more easily than space.",
    "Contacts are springs, dashpots and sliders with the numbers of the configuration: where these are assumed, so is "
    "what the page says. Compare runs rather than trust a single one.",
    "Means are over the window of one run, errors are standard errors within it. Whether another start would come to "
    "the same, only other seeds can say.",
)


@dataclass(frozen=True)
class Page:
    """A page.

    Attributes
    ----------
    title, question
        What it is called, and what it answers.
    sections
        Its sections, in their order.
    limits
        What two dimensions cannot say to it, beyond what holds for every page.
    """

    title: str
    question: str
    sections: tuple[Section, ...]
    limits: tuple[str, ...] = ()

    @property
    def all_limits(self) -> tuple[str, ...]:
        """What the page cannot say."""
        return (*self.limits, *_PLANE)


_MOTION = Section("motion", "See it move", charge.motion)
_POWER = Section("power", "Power", power.power)
_MODELS = Section("models", "Beside models of mills", power.beside_models)
_PHASES = Section("phases", "Phase by phase", power.by_phase)
_LEDGER = Section("ledger", "Energy ledger", power.ledger)
_SHAPE = Section("shape", "Toe, shoulder and shape", charge.shape)
_FLOW = Section("flow", "Where the load is", charge.flow)
_LAYER = Section("layer", "The flowing layer", charge.layer)
_REGIME = Section("regime", "Regime", charge.regime)
_FLIGHT = Section("flight", "Flight and fall", charge.flight)
_CIRCULATION = Section("circulation", "Circulation", charge.circulation)
_VISITS = Section("visits", "Visits to the spray", charge.visits)
_COLLISIONS = Section("collisions", "Collisions", contacts.collisions)
_WEAR = Section("wear", "Wear of the drum", contacts.wear)
_SPLIT = Section("split", "Who takes the energy", contacts.split)
_DISCS = Section("discs", "How discs differ", contacts.discs)
_HANDLING = Section("handling", "Knocking and rubbing", contacts.handling)
_GOING = Section("slip", "Slip and riding along", laundry.going_along)
_OPENING = Section("opening", "Openness and curtain", laundry.opening)
_BALANCE = Section("balance", "Unbalance", laundry.balance)
_MIXING = Section("mixing", "Mixing", laundry.mixing)

PAGES = {
    "washer": Page(
        "How the washer handles its load",
        "How often does the load fall, how hard is it knocked and rubbed, does it slip, and how far off balance is "
        "it?",
        (_POWER, _HANDLING, _FLIGHT, _GOING, _BALANCE, _PHASES, _MOTION, _DISCS, _LEDGER),
        (
            "There is no water but what the load holds: no suds, no level, no drag.",
            "Articles do not tear, fold or tangle: a bundle is a round piece of fabric that keeps its size. What is "
            "said here is mechanical action, never cleaning.",
            "A plane knows unbalance of forces only: the couple of two unbalances, front and rear, is beyond it.",
        ),
    ),
    "dryer": Page(
        "How the dryer opens its load",
        "Does the load open to the air, does it fall as a curtain, and how hard is it handled meanwhile?",
        (_POWER, _OPENING, _FLIGHT, _GOING, _HANDLING, _MIXING, _PHASES, _MOTION, _LEDGER),
        (
            "There is no air and no heat: openness and curtain say what air could reach, not how fast it dries.",
            "Bundles do not cling by static, and do not grow lighter as they dry.",
        ),
    ),
    "mill": Page(
        "What the mill does with its power",
        "How much power does the charge draw, where does it lie and land, how hard does it hit, and where does the "
        "liner wear?",
        (_POWER, _MODELS, _SHAPE, _FLOW, _FLIGHT, _COLLISIONS, _WEAR, _SPLIT, _MOTION, _LEDGER),
        (
            "There is no slurry, no breakage and no discharge; the charge stays what it was at the start.",
            "Cylinders hit and pack otherwise than balls: impacts of a plane are between rods a meter long, so that "
            "energies are per meter, and a spectrum’s place on its axis depends on what length stands for a ball.",
        ),
    ),
    "coater": Page(
        "How evenly the coater turns its bed",
        "Does every tablet come to the surface as often as the others, and how fast does the bed mix?",
        (
            _VISITS,
            _CIRCULATION,
            _MIXING,
            _LAYER,
            _SHAPE,
            _FLOW,
            _REGIME,
            _HANDLING,
            _DISCS,
            _POWER,
            _MOTION,
            _LEDGER,
        ),
        (
            "There is no spray and no film: visits to a zone stand for the dose, and discs in it hide each other.",
            "Tablets are round, and a bed that mixes in its plane need not mix along the axis, which is slower.",
        ),
    ),
    "research": Page(
        "All that is measured of a run",
        "What does the load do, where does its energy go, and by which numbers?",
        (
            *(_POWER, _PHASES, _REGIME, _SHAPE, _FLOW, _LAYER, _CIRCULATION, _VISITS, _FLIGHT, _MIXING),
            *(_COLLISIONS, _WEAR, _SPLIT, _DISCS, _HANDLING, _GOING, _OPENING, _BALANCE, _MOTION, _LEDGER),
        ),
    ),
}
