"""The whole chain for a mechanism: which constructions, on which plans, in order of attachment and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import ModuleType
from typing import Any

from ...scales.errors import InputError
from ..board import Program, RecordingBoard
from . import compound, driver, prp, rpp, rpr, rrp, rrr
from .lever import lever
from .mechanism import FRAME, Link, Mechanism
from .parts import AssurGroup, Bodies, Couples, Forces, Span
from .structure import Structure, analyse

PLANS = ("structure", "position", "velocity", "acceleration", "compound", "forces", "lever")
NEEDS = {
    "structure": (),
    "position": (),
    "velocity": ("position",),
    "acceleration": ("velocity",),
    "compound": ("acceleration",),
    "forces": ("acceleration",),
    "lever": ("acceleration",),
}
Attached = list[tuple[ModuleType, AssurGroup]]
CONSTRUCTIONS: dict[str, ModuleType] = {"RRR": rrr, "RRP": rrp, "RPR": rpr, "PRP": prp, "RPP": rpp}


def with_needs(plans: Iterable[str]) -> tuple[str, ...]:
    """Return `plans` and all that they need, in order of construction."""
    wanted = set(plans)
    for plan in reversed(PLANS):
        if plan in wanted:
            wanted.update(NEEDS[plan])
    return tuple(plan for plan in PLANS if plan in wanted)


def construct(mechanism: Mechanism, plans: Iterable[str] = PLANS) -> tuple[Structure, Program]:
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
    plans = with_needs(plans)
    dyads, bodies = _named(mechanism, structure)
    for plan in ("position", "velocity", "acceleration"):
        if plan in plans:
            getattr(driver, plan)(board, mechanism)
            if plan == "position":
                _place_frame(board, mechanism)
            for module, dyad in dyads:
                getattr(module, plan)(board, dyad)
    if "compound" in plans:
        compound.compound(board, compound.couplers(mechanism, (dyad for _, dyad in dyads), bodies))
    if "acceleration" in plans and {"forces", "lever"} & set(plans):
        _loads(board, mechanism, bodies)
    if "forces" in plans:
        _forces(board, mechanism, dyads, bodies)
    if "lever" in plans:
        _lever(board, mechanism, dyads, bodies)
    if {"forces", "lever"} <= set(plans):
        board.calc("delta_M_bal", "difference", "M_bal_lever", "M_bal")
    program = Program(board.steps)
    for name in sorted(mechanism.givens.intersection(program.names)):
        raise InputError("name-twice", name=name)
    return structure, program


def hinged(mechanism: Mechanism, structure: Structure) -> tuple[compound.Coupler, ...]:
    """Return the couplers whose motion the plan `compound` splits."""
    dyads, bodies = _named(mechanism, structure)
    return compound.couplers(mechanism, (dyad for _, dyad in dyads), bodies)


def moving_bodies(mechanism: Mechanism, structure: Structure) -> Bodies:
    """Return how every moving link is known: a direction that turns with it, its angular velocity, by number."""
    return _named(mechanism, structure)[1]


def _named(mechanism: Mechanism, structure: Structure) -> tuple[Attached, Bodies]:
    """Name the parts of all groups, each for those attached to it."""
    for group in structure.groups:
        if group.kind not in CONSTRUCTIONS:
            raise InputError("no-construction", kind=group.kind, links=", ".join(map(str, group.links)))
    _has_length(driver.span(mechanism))
    bodies = {mechanism.driver.link: driver.body(mechanism)}
    dyads = []
    for group in structure.groups:
        module = CONSTRUCTIONS[group.kind]
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


def board_givens(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return `values` as the board wants them: the size of a load as `|F_3|`, for `F_3` is the vector."""
    given = [load.magnitude for load in mechanism.loads] + [couple.magnitude for couple in mechanism.couples]
    return {**values, **{f"|{name}|": values[name] for name in given}}


def _loads(board: RecordingBoard, mechanism: Mechanism, bodies: Bodies) -> None:
    """Lay down the outer loads, the inertia force and moment of every link that has a mass."""
    for load in mechanism.loads:
        board.turn(f"e_{load.name}", load.direction)
        board.calc(load.name, "along", f"|{load.magnitude}|", f"e_{load.name}")
    for couple in mechanism.couples:
        board.calc(couple.name, "signed", f"|{couple.magnitude}|", couple.sense)
    for link in mechanism.links:
        if _has_inertia_force(mechanism, link):
            board.calc(f"F_i{link.number}", "inertia_force", str(link.mass), f"a_{link.centre}")
        if link.inertia and bodies[link.number].epsilon:
            board.calc(f"M_i{link.number}", "inertia_moment", link.inertia, str(bodies[link.number].epsilon))


def _has_inertia_force(mechanism: Mechanism, link: Link) -> bool:
    return bool(link.mass) and link.centre not in mechanism.frame_points


def _hung(mechanism: Mechanism, bodies: Bodies) -> tuple[Forces, Couples]:
    """Forces (name, point) and couples by link: inertia first, then the outer loads."""
    forces: Forces = {link.number: [] for link in mechanism.links}
    couples: Couples = {link.number: [] for link in mechanism.links}
    for link in mechanism.links:
        if _has_inertia_force(mechanism, link):
            forces[link.number].append((f"F_i{link.number}", str(link.centre)))
        forces[link.number] += [(load.name, load.point) for load in mechanism.loads_on(link.number)]
        if link.inertia and bodies[link.number].epsilon:
            couples[link.number].append(f"M_i{link.number}")
    for couple in mechanism.couples:
        couples[couple.link].append(couple.name)
    return forces, couples


def _forces(board: RecordingBoard, mechanism: Mechanism, dyads: Attached, bodies: Bodies) -> None:
    """Solve the groups from the last to the first, pass each reaction on to the link it acts on, balance the driver."""
    forces, couples = _hung(mechanism, bodies)
    reactions: Forces = {link: [] for link in forces}
    for module, dyad in reversed(dyads):
        for link in (body.link.number for body in dyad.bodies):
            forces[link] += reactions[link]
        module.forces(board, dyad, forces, couples)
        for passed in dyad.passed():
            if passed.link != FRAME:
                reactions[passed.link].append((passed.force, passed.point))
                couples[passed.link] += [passed.couple] if passed.couple else []
    crank = mechanism.driver.link
    forces[crank] = reactions[crank] + forces[crank]
    driver.forces(board, mechanism, forces, couples)


def _lever(board: RecordingBoard, mechanism: Mechanism, dyads: Attached, bodies: Bodies) -> None:
    """Hang all forces on the lever, and the couples: as pairs of forces on links with two joints, else as powers."""
    forces, couples = _hung(mechanism, bodies)
    spans = [span for _, dyad in dyads for span in dyad.spans]
    pairs = [(couple, span) for span in spans for couple in couples[span.link.number]]
    alone = set(couples) - {span.link.number for span in spans}
    turning = [(c, omega) for n in couples if n in alone for c in couples[n] if (omega := bodies[n].omega)]
    lever(board, mechanism, [force for link in forces.values() for force in link], pairs, turning)
