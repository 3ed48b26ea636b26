"""The whole chain for a mechanism: which constructions, on which plans, in order of attachment and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import ModuleType
from typing import Any

from ...scales.errors import InputError
from ..board import Program, RecordingBoard
from . import driver, rrp
from .lever import lever
from .mechanism import FRAME, Link, Mechanism, Prismatic
from .structure import Group, Structure, analyse

Forces = dict[int, list[tuple[str, str]]]
Couples = dict[int, list[str]]

PLANS = ("structure", "position", "velocity", "acceleration", "forces", "lever")
NEEDS = {
    "structure": (),
    "position": (),
    "velocity": ("position",),
    "acceleration": ("velocity",),
    "forces": ("acceleration",),
    "lever": ("acceleration",),
}
CONSTRUCTIONS: dict[str, ModuleType] = {"RRP": rrp}


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
        When the mechanism has no structure of known groups.
    """
    structure = analyse(mechanism)
    board = RecordingBoard()
    plans = with_needs(plans)
    dyads = [_named(mechanism, group) for group in structure.groups]
    for plan in ("position", "velocity", "acceleration"):
        if plan in plans:
            getattr(driver, plan)(board, mechanism)
            for module, dyad in dyads:
                getattr(module, plan)(board, dyad)
    if "acceleration" in plans and {"forces", "lever"} & set(plans):
        _loads(board, mechanism)
    if "forces" in plans:
        _forces(board, mechanism, dyads)
    if "lever" in plans:
        _lever(board, mechanism, dyads)
    if {"forces", "lever"} <= set(plans):
        board.calc("delta_M_bal", "difference", "M_bal_lever", "M_bal")
    return structure, Program(tuple(board.steps))


def _named(mechanism: Mechanism, group: Group) -> tuple[ModuleType, rrp.Dyad]:
    if group.kind not in CONSTRUCTIONS:
        raise InputError("no-construction", kind=group.kind, links=", ".join(map(str, group.links)))
    module = CONSTRUCTIONS[group.kind]
    return module, module.dyad(mechanism, group)


def board_givens(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return `values` as the board wants them: the size of a load as `|F_3|`, for `F_3` is the vector."""
    return {**values, **{f"|{load.magnitude}|": values[load.magnitude] for load in mechanism.loads}}


def _loads(board: RecordingBoard, mechanism: Mechanism) -> None:
    """Lay down the outer loads, the inertia force and moment of every link that has a mass."""
    for load in mechanism.loads:
        board.turn(f"e_{load.name}", load.direction)
        board.calc(load.name, "along", f"|{load.magnitude}|", f"e_{load.name}")
    for link in mechanism.links:
        if _has_inertia_force(mechanism, link):
            board.calc(f"F_i{link.number}", "inertia_force", str(link.mass), f"a_{link.centre}")
        if link.inertia and _has_inertia_moment(mechanism, link):
            board.calc(f"M_i{link.number}", "inertia_moment", link.inertia, f"epsilon_{link.number}")


def _has_inertia_force(mechanism: Mechanism, link: Link) -> bool:
    return bool(link.mass) and link.centre != mechanism.driver.pivot


def _has_inertia_moment(mechanism: Mechanism, link: Link) -> bool:
    """Return whether the link turns unsteadily: not the crank, which turns steadily, nor a slider on the frame."""
    guides = [pair.links for pair in mechanism.pairs if isinstance(pair, Prismatic)]
    return link.number != mechanism.driver.link and (link.number, FRAME) not in guides


def _hung(mechanism: Mechanism) -> tuple[Forces, Couples]:
    """Forces (name, point) and couples by link: inertia first, then the outer loads."""
    forces: Forces = {link.number: [] for link in mechanism.links}
    couples: Couples = {link.number: [] for link in mechanism.links}
    for link in mechanism.links:
        if _has_inertia_force(mechanism, link):
            forces[link.number].append((f"F_i{link.number}", str(link.centre)))
        forces[link.number] += [(load.name, load.point) for load in mechanism.loads_on(link.number)]
        if link.inertia and _has_inertia_moment(mechanism, link):
            couples[link.number].append(f"M_i{link.number}")
    return forces, couples


def _forces(board: RecordingBoard, mechanism: Mechanism, dyads: list[tuple[ModuleType, rrp.Dyad]]) -> None:
    """Solve the groups from the last to the first, pass each reaction on to the link it acts on, balance the driver."""
    forces, couples = _hung(mechanism)
    reactions: list[tuple[str, str]] = []
    for module, dyad in reversed(dyads):
        module.forces(board, dyad, forces, couples)
        passed = (f"R_{dyad.rod.number}{dyad.before}", dyad.A)
        if dyad.before == mechanism.driver.link:
            reactions.append(passed)
        elif dyad.before in forces:
            forces[dyad.before].append(passed)
    driver.forces(board, mechanism, (*reactions, *forces[mechanism.driver.link]))


def _lever(board: RecordingBoard, mechanism: Mechanism, dyads: list[tuple[ModuleType, rrp.Dyad]]) -> None:
    forces, couples = _hung(mechanism)
    pairs = [(couple, d.A, d.B, d.length) for _, d in dyads for couple in couples[d.rod.number]]
    lever(board, mechanism, [force for link in forces.values() for force in link], pairs)
