"""Model depth: what each part of the dynamic model is worth, found by leaving it out.

A part is a step that lays down one force or moment: the inertia force of a link, its moment of inertia forces, its
weight, a load. It is left out by a rewrite of that step alone, whose size becomes zero; all else stays as it is.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....scales.errors import InputError
from ...board import Program
from ...boards.exact import STATUSES
from ...laws import dot
from ...names import role
from ...quantities import BALANCES
from ..cycles.cycle import Cycle
from ..mechanism import ZERO

Array = NDArray[Any]
FORCES, MOMENTS, WEIGHTS, INERTIA, ALL = "inertia_forces", "inertia_moments", "weights", "inertia", "all"
KINDS = {"inertia_force": FORCES, "inertia_moment": MOMENTS, "weight": WEIGHTS}


@dataclass(frozen=True, slots=True)
class Cost:
    """What leaving out `parts` changes, in per cent of the largest value over the cycle."""

    key: str  # the part alone, or `inertia_forces`, `inertia_moments`, `weights`, `inertia`, `all` of a kind
    parts: tuple[str, ...]
    balance: float  # the largest change of what balances the driver
    balance_rms: float  # and its root of the mean square
    reaction: float | None  # of the reaction that changes most, beside the largest one; None where none is wanted
    reaction_rms: float | None
    place: float  # of the driver at the largest of these changes

    @property
    def worst(self) -> float:
        """The larger of both largest changes."""
        return max(self.balance, self.reaction or 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Depth:
    """Costs of all simplifications; `needed` are the parts that a tolerance asks for, `spare` the others together."""

    balance: str
    largest_balance: float
    reaction: str | None
    largest_reaction: float | None
    costs: tuple[Cost, ...]
    tolerance: float
    needed: tuple[str, ...]
    spare: tuple[str, ...]
    together: Cost


def parts_of(program: Program) -> dict[str, str]:
    """Return the forces and moments of masses that a program lays down, each with its kind."""
    return {step.name: KINDS[step.law] for step in program if step.law in KINDS}


def without(program: Program, parts: Collection[str]) -> Program:
    """Return a program that lays down these forces and moments with a size of zero; loads may be among them."""
    nothing = {step: step.but(operands=(ZERO, *step.operands[1:])) for step in program if step.name in parts}
    return Program(tuple(nothing.get(step, step) for step in program))


class Model:
    """A mechanism's forces over its cycle, with all parts of the model or without some.

    Raises
    ------
    InputError
        With the key `chart-no-forces`: the task has no plan of forces and no lever.
    """

    def __init__(self, cycle: Cycle) -> None:
        self._cycle = cycle
        found = [name for name in BALANCES if name in cycle.program.names]
        if not found:
            raise InputError("chart-no-forces")
        self.balance = found[0]
        self.reactions = tuple(
            name for name in cycle.quantities if role(name).kind == "R" and role(name).part not in ("n", "t")
        )
        self._full = self._values(())
        self.largest = _most(self._full[self.balance])
        self.reaction = max(self.reactions, key=lambda name: _most(self._full[name]), default=None)
        self.largest_reaction = _most(self._full[self.reaction]) if self.reaction else None

    def _values(self, parts: Collection[str]) -> dict[str, Array]:
        cycle, wanted = self._cycle, (self.balance, *self.reactions)
        program = without(cycle.program, parts)
        lost = cycle.codes >= STATUSES.index("singular")  # or apart: no plan to compare
        found = cycle.drive.along(program, cycle.givens, wanted)(cycle.angles)
        return {name: np.where(lost, np.nan, value) for name, value in found.items()}

    def cost(self, key: str, parts: Iterable[str]) -> Cost:
        """Return what leaving out `parts` changes."""
        parts = tuple(parts)
        less = self._values(parts)
        change = _size(less[self.balance] - self._full[self.balance]) * _per_cent(self.largest)
        reaction = np.full(len(change), np.nan)
        if self.reactions and self.largest_reaction:
            off = [_size(less[name] - self._full[name]) for name in self.reactions]
            reaction = np.max(off, axis=0) * _per_cent(self.largest_reaction)
        worst = np.fmax(change, reaction)
        known = np.isfinite(worst)
        place = float(self._cycle.angles[np.argmax(np.where(known, worst, -1.0))])
        most, rms = (_most(reaction), _rms(reaction)) if self.reaction is not None else (None, None)
        return Cost(key, parts, _most(change), _rms(change), most, rms, place)


def depth(cycle: Cycle, tolerance: float) -> Depth:
    """Find what each simplification costs, and what may be left out together.

    The `tolerance` is per cent of the largest balance and of the largest reaction that may be missed.
    """
    model, kinds = Model(cycle), parts_of(cycle.program)
    single = [model.cost(part, (part,)) for part in kinds]
    groups = {kind: tuple(part for part, of in kinds.items() if of == kind) for kind in (FORCES, MOMENTS, WEIGHTS)}
    groups[INERTIA] = groups[FORCES] + groups[MOMENTS]
    groups[ALL] = tuple(kinds)
    known = {frozenset((part,)) for part in kinds} | {frozenset[str]()}
    several = []
    for key, parts in groups.items():
        if frozenset(parts) not in known:  # all masses without weights are all inertia
            several.append(model.cost(key, parts))
            known.add(frozenset(parts))
    spare: tuple[str, ...] = ()
    together = model.cost("", ())
    for cost in sorted(single, key=lambda cost: cost.worst):
        without_it = model.cost("", (*spare, *cost.parts))
        if without_it.worst <= tolerance:
            spare, together = without_it.parts, without_it
    needed = tuple(part for part in kinds if part not in spare)
    spare = tuple(part for part in kinds if part in spare)
    largest = (model.balance, model.largest, model.reaction, model.largest_reaction)
    return Depth(*largest, (*single, *several), tolerance, needed, spare, together)


def _size(values: Array) -> Array:
    return np.sqrt(dot(values, values)) if np.iscomplexobj(values) else np.abs(values)


def _most(values: Array) -> float:
    return float(np.nanmax(_size(values), initial=0.0))


def _rms(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else 0.0


def _per_cent(size: float) -> float:
    return 100.0 / size if size else 0.0
