"""The whole chain for a mechanism: which constructions, on which plans, in order of attachment and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from importlib import import_module
from types import ModuleType

from ...scales.errors import InputError
from ...scales.kept import Kept
from ..board import Program, RecordingBoard, with_needs
from ..names import by_lever, spelled, vector
from . import compound
from .lever import Joined, lever, points_of
from .loads import hung, lay_loads
from .mechanism import FRAME, ZERO, Driver, Mechanism, SlidingDriver
from .parts import AssurGroup, Bodies, Forces, Span
from .structure import Structure, analyse
from .working_stroke import Moving, needs_stroke

NEEDS: dict[str, tuple[str, ...]] = {  # all plans in order of construction, with those they are built on
    "structure": (),
    "position": (),
    "velocity": ("position",),
    "acceleration": ("velocity",),
    "compound": ("acceleration",),
    "forces": ("acceleration",),
    "lever": ("acceleration",),
    "cycle": ("acceleration",),
}
PLANS = tuple(NEEDS)
USUAL = tuple(plan for plan in PLANS if plan not in ("compound", "cycle"))  # without a word on which are wanted
Attached = list[tuple[ModuleType, AssurGroup]]
_CONSTRUCTED = Kept[tuple[Structure, Program]](16)
# modules with the constructions of each kind, which a mechanism without such a group does without
CONSTRUCTIONS = {
    "RRR": "dyads.rrr",
    "RRP": "dyads.rrp",
    "RPR": "dyads.rpr",
    "PRP": "dyads.prp",
    "RPP": "dyads.rpp",
    "III": "triads.triad",
}
DRIVERS: dict[type, str] = {Driver: "driver", SlidingDriver: "sliding_driver"}


def driver_of(mechanism: Mechanism) -> ModuleType:
    """Return the constructions of the mechanism's driver."""
    return _module(DRIVERS[type(mechanism.driver)])


@cache
def _module(name: str) -> ModuleType:
    return import_module(f".{name}", __package__)


def construct(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Find the structure and record the construction of `plans` (and of the plans they need).

    Raises
    ------
    InputError
        When the mechanism has no structure of known groups, or a name stands for two things.
    """
    structure = analyse(mechanism)
    board = RecordingBoard()
    for opposite, length in mechanism.opposites.items():
        board.calc(opposite, "opposite", length)
    plans = with_needs(plans, NEEDS)
    dyads, bodies = _named(mechanism, structure)
    for plan in ("position", "velocity", "acceleration"):
        if plan in plans:
            getattr(driver_of(mechanism), plan)(board, mechanism)
            if plan == "position":
                _place_frame(board, mechanism)
            for module, dyad in dyads:
                getattr(module, plan)(board, dyad)
    if "compound" in plans:
        compound.compound(board, compound.couplers(mechanism, (dyad for _, dyad in dyads), bodies))
    _statics(board, mechanism, set(plans), dyads, bodies)
    program = Program(board.steps)
    for name in sorted(mechanism.givens.intersection(program.names)):
        raise InputError("name-twice", name=name)
    return structure, program


def constructed(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Return what `construct` finds; kept, for a class has one mechanism with many values."""
    wanted = tuple(plans)
    return _CONSTRUCTED.get((repr(mechanism), wanted), lambda: construct(mechanism, wanted))


def _statics(board: RecordingBoard, mechanism: Mechanism, plans: set[str], dyads: Attached, bodies: Bodies) -> None:
    """Lay down the loads; plans of forces, the lever, and their difference, as far as they are wanted."""
    if not plans & {"forces", "lever"}:
        return
    module = driver_of(mechanism)
    spans = {span.link.number: span for span in _spans(mechanism, dyads)}
    resisting = any(couple.sense is None for couple in mechanism.couples) or needs_stroke(mechanism)
    turning = module.turning_rate(board, mechanism) if resisting else ZERO
    lay_loads(board, Moving(mechanism, bodies, spans, vector("V", mechanism.driver.point).size, turning))
    if "forces" in plans:
        _forces(board, mechanism, dyads, bodies)
    if "lever" in plans:
        _lever(board, mechanism, spans, bodies)
    if {"forces", "lever"} <= plans:
        name = module.balance(mechanism)
        board.calc(spelled("delta", name), "difference", by_lever(name), name)


def _spans(mechanism: Mechanism, dyads: Attached) -> tuple[Span, ...]:
    """Return all links with two joints, the driver first."""
    return (*driver_of(mechanism).spans(mechanism), *(span for _, dyad in dyads for span in dyad.spans))


def hinged(mechanism: Mechanism, structure: Structure) -> tuple[compound.Coupler, ...]:
    """Return the couplers whose motion the plan `compound` splits."""
    dyads, bodies = _named(mechanism, structure)
    return compound.couplers(mechanism, (dyad for _, dyad in dyads), bodies)


def named_groups(mechanism: Mechanism) -> tuple[AssurGroup, ...]:
    """Return the groups with the names that their constructions use, in order of attachment."""
    return tuple(group for _, group in _named(mechanism, analyse(mechanism))[0])


def moving_bodies(mechanism: Mechanism, structure: Structure) -> Bodies:
    """Return how every moving link is known: a direction that turns with it, its angular velocity, by number."""
    return _named(mechanism, structure)[1]


def require_couplers(mechanism: Mechanism, structure: Structure) -> None:
    """Refuse to split motions where no link with two joints hangs on one that turns.

    Raises
    ------
    InputError
        With the key `no-coupler`.
    """
    if not hinged(mechanism, structure):
        raise InputError("no-coupler")


def _named(mechanism: Mechanism, structure: Structure) -> tuple[Attached, Bodies]:
    """Name the parts of all groups, each for those attached to it."""
    for group in structure.groups:
        if group.kind not in CONSTRUCTIONS:
            raise InputError("no-construction", kind=group.kind, links=", ".join(map(str, group.links)))
    first = driver_of(mechanism)
    for span in first.spans(mechanism):
        _has_length(span)
    bodies = {mechanism.driver.link: first.body(mechanism)}
    dyads = []
    for group in structure.groups:
        module = _module(CONSTRUCTIONS[group.kind])
        dyad: AssurGroup = module.dyad(mechanism, group, bodies)
        for span in dyad.spans:
            _has_length(span)
        bodies |= {body.link.number: body for body in dyad.bodies}
        dyads.append((module, dyad))
    return dyads, bodies


def _has_length(span: Span) -> None:
    """Refuse a link whose joints coincide by form."""
    points = span.link.points
    if points[span.start] == points[span.end]:
        raise InputError("joints-coincide", link=span.link.number, first=span.start, second=span.end)


def _place_frame(board: RecordingBoard, mechanism: Mechanism) -> None:
    """Mark the pivots on the frame."""
    for point, place in mechanism.frame_points.items():
        board.place(point, *place)


def _forces(board: RecordingBoard, mechanism: Mechanism, dyads: Attached, bodies: Bodies) -> None:
    """Solve the groups from the last to the first, pass each reaction on to the link it acts on, balance the driver."""
    forces, couples = hung(mechanism, bodies)
    reactions: Forces = {link: [] for link in forces}
    for module, dyad in reversed(dyads):
        for link in (body.link.number for body in dyad.bodies):
            forces[link] += reactions[link]
        module.forces(board, dyad, forces, couples)
        for passed in dyad.passed():
            if passed.link != FRAME:
                reactions[passed.link].append((passed.force, passed.point))
                couples[passed.link] += [passed.couple] if passed.couple else []
    first = mechanism.driver.link
    forces[first] = reactions[first] + forces[first]
    driver_of(mechanism).forces(board, mechanism, forces, couples)


def _lever(board: RecordingBoard, mechanism: Mechanism, spans: Mapping[int, Span], bodies: Bodies) -> None:
    """Hang all forces on the lever, and the couples: as pairs of forces where two points are known, else as powers."""
    forces, couples = hung(mechanism, bodies)
    rates = {omega: span for number, span in spans.items() if (omega := bodies[number].omega)}
    pairs: list[tuple[str, Joined]] = [(couple, span) for number, span in spans.items() for couple in couples[number]]
    turning = []
    for number, omega in ((n, bodies[n].omega) for n in couples if n not in spans):
        points = points_of(omega, board.steps, rates) if omega else None
        pairs += [(couple, points) for couple in couples[number] if points]
        turning += [(couple, omega) for couple in couples[number] if omega and not points]
    moments = lever(board, mechanism, [force for link in forces.values() for force in link], pairs, turning)
    driver_of(mechanism).on_lever(board, mechanism, moments)
