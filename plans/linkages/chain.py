"""The whole chain for a mechanism: which constructions, on which plans, in order of attachment and back."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import partial
from importlib import import_module

from ...scales.errors import InputError
from ...scales.kept import Kept
from ..board import Board, Program, RecordingBoard, Step, with_needs
from ..names import Name, by_lever, couple, lever_arm, moment, role, spelled, vector
from . import compound
from .driver import Crank, SlidingBlock, driver_of
from .legs import AssurGroup
from .loads import Moving, hung, lay_loads, needs_stroke
from .mechanism import FRAME, ZERO, Mechanism
from .parts import SYMBOLS, Bodies, Body, Forces, Plan, Span
from .structure import KINDS, TRIAD, Structure, analyse

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
_CONSTRUCTED = Kept[tuple[Structure, Program]](16)
_BODIES = Kept[Bodies](16)
Ends = tuple[str, str, str, str]  # two points that turn together, the normal to their line, their distance
# modules with the groups of each kind, and their classes, which a mechanism without such a group does without
CONSTRUCTIONS = {kind: ("dyads", kind) for kind in KINDS} | {TRIAD: ("triads.triad", "Triad")}


def construct(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Find the structure and record the construction of `plans` (and of the plans they need).

    Raises
    ------
    InputError
        When the mechanism has no structure of known groups, or a name stands for two things.
    """
    structure, board, plans = analyse(mechanism), RecordingBoard(), with_needs(plans, NEEDS)
    for opposite, length in mechanism.opposites.items():
        board.calc(opposite, "opposite", length)
    driver, groups, bodies = named(mechanism, structure)
    if "position" in plans:
        driver.position(board)
        for point, place in mechanism.frame_points.items():
            board.place(point, *place)
        for group in groups:
            group.position(board)
    for name in (name for name in SYMBOLS if name in plans):
        plan = Plan(board, mechanism, name)
        driver.move(plan)
        for group in groups:
            group.move(plan)
    if "compound" in plans:
        compound.compound(board, compound.couplers(mechanism, groups, bodies))
    if "forces" in plans or "lever" in plans:
        _statics(board, plans, driver, groups, bodies)
    program = Program(board.steps)
    for name in sorted(mechanism.givens.intersection(program.names)):
        raise InputError("name-twice", name=name)
    return structure, program


def constructed(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Return what `construct` finds; kept, for a class has one mechanism with many values."""
    wanted = tuple(plans)
    return _CONSTRUCTED.get((mechanism.written, wanted), lambda: construct(mechanism, wanted))


def _statics(
    board: RecordingBoard,
    plans: Collection[str],
    driver: Crank | SlidingBlock,
    groups: Sequence[AssurGroup],
    bodies: Bodies,
) -> None:
    """Lay down the loads; plans of forces, the lever, and their difference, as far as they are wanted."""
    mechanism = driver.mechanism
    spans = {span.number: span for part in (driver, *groups) for span in part.spans}
    resisting = any(couple.sense is None for couple in mechanism.couples) or needs_stroke(mechanism)
    turning = driver.turning_rate(board) if resisting else ZERO
    lay_loads(board, Moving(mechanism, bodies, spans, vector("V", mechanism.driver.point).size, turning))
    if "forces" in plans:
        _forces(board, driver, groups, bodies)
    if "lever" in plans:
        driver.on_lever(board, _lever(board, mechanism, spans, bodies))
    if "forces" in plans and "lever" in plans:
        board.calc(spelled("delta", driver.balance), "difference", by_lever(driver.balance), driver.balance)


def hinged(mechanism: Mechanism, structure: Structure) -> tuple[compound.Coupler, ...]:
    """Return the couplers whose motion the plan `compound` splits."""
    return compound.couplers(mechanism, *named(mechanism, structure)[1:])


def moving_bodies(mechanism: Mechanism, structure: Structure) -> Bodies:
    """Return how every moving link is known: a direction that turns with it, its angular velocity, by number."""
    return _BODIES.get(mechanism.written, lambda: named(mechanism, structure)[2])


def named(
    mechanism: Mechanism, structure: Structure
) -> tuple[Crank | SlidingBlock, tuple[AssurGroup, ...], dict[int, Body]]:
    """Name the parts of the driver and of all groups, each for those attached to it."""
    for group in structure.groups:
        if group.kind not in CONSTRUCTIONS:
            raise InputError("no-construction", kind=group.kind, links=", ".join(map(str, group.links)))
    driver = driver_of(mechanism)
    bodies = {mechanism.driver.link: driver.body}
    groups: list[AssurGroup] = []
    for group in structure.groups:
        module, kind = CONSTRUCTIONS[group.kind]
        groups.append(getattr(import_module(f".{module}", __package__), kind)(mechanism, group, bodies))
        bodies |= {body.link.number: body for body in groups[-1].bodies}
    for span in (span for part in (driver, *groups) for span in part.spans):
        if span.link.points[span.start] == span.link.points[span.end]:  # by the form of the mechanism
            raise InputError("joints-coincide", link=span.number, first=span.start, second=span.end)
    return driver, tuple(groups), bodies


def _forces(board: RecordingBoard, driver: Crank | SlidingBlock, groups: Sequence[AssurGroup], bodies: Bodies) -> None:
    """Solve the groups from the last to the first, pass each reaction on to the link it acts on, balance the driver."""
    forces, couples = hung(driver.mechanism, bodies)
    reactions: Forces = {link: {} for link in forces}
    for group in reversed(groups):
        for body in group.bodies:
            forces[body.link.number] |= reactions[body.link.number]
        group.forces(board, forces, couples)
        for force, link, point, moment_beside in group.passed:
            if link != FRAME:
                reactions[link][force] = point
                couples[link] += [moment_beside] if moment_beside else []
    first = driver.body.link.number
    forces[first] = reactions[first] | forces[first]
    driver.forces(board, forces, couples)


def _lever(board: RecordingBoard, mechanism: Mechanism, spans: Mapping[int, Span], bodies: Bodies) -> list[Name]:
    """Hang all forces on the lever, and the couples: as pairs of forces where two points are known, else as powers.

    Returns their moments.
    """
    forces, couples = hung(mechanism, bodies)
    ends: dict[int, Ends] = {number: (span.start, span.end, span.n, span.length) for number, span in spans.items()}
    by_rate = {omega: both for number, both in ends.items() if (omega := bodies[number].omega)}
    pairs = [(couple, both) for number, both in ends.items() for couple in couples[number]]
    turning = []
    for number, omega in ((n, bodies[n].omega) for n in couples if n not in spans):
        points = _points_of(omega, board.steps, by_rate) if omega else None
        pairs += [(couple, points) for couple in couples[number] if points]
        turning += [(couple, omega) for couple in couples[number] if omega and not points]
    moving = [(force, at) for link in forces.values() for force, at in link.items() if at not in mechanism.frame_points]
    moments = _on_lever(board, mechanism, moving, pairs)
    for turns, omega in turning:
        moments.append(Name(f"_{turns}_p", "M", role(turns).of, "p"))
        board.calc(moments[-1], "couple_on_lever", turns, omega)
    return moments


def _on_lever(
    board: Board, mechanism: Mechanism, forces: list[tuple[str, str]], couples: list[tuple[str, Ends]]
) -> list[Name]:
    """Hang `forces` (name, point) and `couples` (moment, points A, B) on the turned plan; return their moments.

    A couple hangs as two equal opposite forces M / l_AB at B and A, normal to AB.
    """
    still = mechanism.frame_points
    board.pole("lever.p")
    points = [mechanism.driver.point, *(at for _, at in forces), *(p for _, both in couples for p in both[:2])]
    for point in dict.fromkeys(point for point in points if point not in still):
        board.normal(f"lever.{point}", f"velocity.{point}")
    moments: list[Name] = []
    for force, at in forces:
        moments.append(moment(force, "p"))
        board.moment(moments[-1], lever_arm(force), force, f"lever.{at}", "lever.p")
    for turns, (A, B, n, length) in couples:
        half = partial(couple, turns)
        board.calc(half(), "couple", turns, length)
        board.calc(half(B), "along", half(), n)
        board.calc(half(A), "opposite", half(B))
        for point in (p for p in (B, A) if p not in still):
            moments.append(moment(half(point), "p"))
            board.moment(moments[-1], lever_arm(turns, point), half(point), f"lever.{point}", "lever.p")
    return moments


def _points_of(omega: str, steps: Iterable[Step], known: Mapping[str, Ends]) -> Ends | None:
    """Return two points with images on the plan that turn with the angular velocity `omega`, if any are known.

    They are the joints of a link that turns so, or those from whose relative velocity it was read: a sliding block
    turns with its guide, and the guide by the velocity of its point under the block's pin.
    """
    made = {step.name: step for step in steps}
    while omega not in known and omega in made and made[omega].law == "same_turning":
        omega = made[omega].operands[0]
    if omega in known or omega not in made or made[omega].law != "turning":
        return known.get(omega)
    vector, normal, length = made[omega].operands
    start, end = made[made[normal].operands[0]].operands[:2]
    point = role(made[vector].operands[1]).of  # the pin itself, or the point of the link under it
    return start, point if end in (point, role(point).of) else end, normal, length
