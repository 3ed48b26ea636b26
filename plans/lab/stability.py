"""What is lost over the cycle: where lines meet flatly, to errors of the data, by a hand, by a simpler model.

Model depth is what each part of the dynamic model is worth, found by leaving it out. A part is a step that lays down
one force or moment: the inertia force of a link, its moment of inertia forces, its weight, a load. It is left out by a
rewrite of that step alone, whose size becomes zero; all else stays as it is.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ..board import Program
from ..boards.exact import SMALL, STATUSES, run
from ..condition import conditions
from ..hands.shaky import Alike, Hand, Paper, draw
from ..hands.spread import kept
from ..laws import TURN, dot
from ..linkages.cycle import Cycle
from ..linkages.mechanism import ZERO
from ..linkages.solved import signs
from ..names import role
from ..quantities import BALANCES, plans_of

Array = NDArray[Any]
DIGITS = 16.0  # of double precision
NOTHING_LEFT = 1e15  # K at which a quantity and the largest beside it are nothing but rounding
DRAWINGS = 300
AT_ONCE = 200  # positions that are drawn in one go
DEAD, CHANGE, POLE, LIMIT = "dead", "change", "parallel", "limit"
FORCES, MOMENTS, WEIGHTS, INERTIA, ALL = "inertia_forces", "inertia_moments", "weights", "inertia", "all"
KINDS = {"inertia_force": FORCES, "inertia_moment": MOMENTS, "weight": WEIGHTS}


@dataclass(frozen=True, slots=True)
class Spot:
    """A place of the driver that is special: `dead` (of `link`), `change`, `parallel` guides, or a `limit`."""

    kind: str
    place: float
    link: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Stability:
    """What is lost over the cycle; all arrays are float64 of shape (N,), NaN where a position has no plan."""

    places: Array  # of the driver, rad or m
    statuses: tuple[str, ...]
    sines: Array  # of the worst intersection on which the chosen quantities hang
    worst: tuple[str, ...]  # its mark
    conditions: Mapping[str, Array]  # K of every quantity
    # What most drawings of a hand keep, in millimetres where a plan shows the quantity, otherwise in per cent of its
    # largest value over the cycle, where lines do not meet flatly; and which of both.
    misses: Mapping[str, Array]
    in_mm: Mapping[str, bool]
    spots: tuple[Spot, ...]

    @property
    def angles(self) -> Array:
        """Angles of the worst intersection, degrees."""
        return np.asarray(np.degrees(np.arcsin(np.clip(self.sines, 0.0, 1.0))))

    def digits(self, name: str) -> Array:
        """Return how many digits of double precision are left of a quantity, beside the largest vector of its plan."""
        with np.errstate(divide="ignore"):
            lost = np.log10(np.maximum(self.conditions[name], 1.0))
        return np.asarray(DIGITS - lost)


def stability(cycle: Cycle, names: Sequence[str], mus: Mapping[str, float], hand: Hand, seed: int = 0) -> Stability:
    """Look at quantities at all places of a cycle; `mus` are scale factors by plan, SI per mm."""
    lost = cycle.reach.undetermined(cycle.angles)
    sines, worst, found = _conditions(cycle, names, lost)
    plans = plans_of(cycle.program)
    in_mm = {name: plans.get(name, "") in mus for name in names}
    misses = _misses(cycle, names, mus, hand, seed)
    steep = sines >= SMALL if (sines >= SMALL).any() else np.ones(len(sines), bool)
    for name in names:
        sizes = np.abs(np.broadcast_to(cycle.values[name], len(sines)))[steep]
        size = mus[plans[name]] if in_mm[name] else np.nanmax(sizes, initial=0.0) / 100.0
        misses[name] = np.where(lost, np.nan, misses[name]) * (1.0 / size if size else np.nan)
    return Stability(cycle.angles, cycle.statuses, sines, worst, found, misses, in_mm, spots(cycle))


def _conditions(
    cycle: Cycle, names: Sequence[str], lost: NDArray[np.bool_]
) -> tuple[Array, tuple[str, ...], dict[str, Array]]:
    """Return the worst sine of every position, the mark where it is, and K of every quantity."""
    count, fixed = len(cycle.angles), signs(cycle.mechanism)
    sines, worst = np.full(count, np.nan), [""] * count
    found = {name: np.full(count, np.nan) for name in names}
    needed = {step.name for step in cycle.program.needed_for(names)}
    # angles of a crank within a turn: of an angle its radians count as a given
    places = cycle.angles % TURN if cycle.drive.turns else cycle.angles
    for i, values in enumerate(cycle.each(places)):
        board = run(cycle.program, values)
        if board.trouble is not None or lost[i]:
            sines[i] = 0.0 if board.status == "singular" or lost[i] else np.nan
            continue
        varied = [name for name, value in values.items() if name not in fixed and value]
        known = conditions(cycle.program, values, varied, board.values, board.sines, names)
        sines[i] = min((known[name].sine for name in names), default=1.0)
        worst[i] = next((mark for mark, sine in board.sines.items() if mark in needed and abs(sine) == sines[i]), "")
        for name in names:
            value = known[name].value
            found[name][i] = value if value is not None and value < NOTHING_LEFT else np.nan
    return sines, tuple(worst), found


def _misses(cycle: Cycle, names: Sequence[str], mus: Mapping[str, float], hand: Hand, seed: int) -> dict[str, Array]:
    """Return what most drawings keep, SI."""
    program = cycle.program.needed_for(names)
    givens = cycle.drive.givens(cycle.givens, cycle.angles)
    count = len(cycle.angles)
    found = {name: np.full(count, np.nan) for name in names}
    for start in range(0, count, AT_ONCE):
        part = slice(start, min(start + AT_ONCE, count))
        shape = (part.stop - start, DRAWINGS)
        here = {name: value[part, None] if np.ndim(value) else value for name, value in givens.items()}
        board = draw(Paper(program, here, mus), hand, Alike(np.random.default_rng(seed)), shape)
        for name in names:
            exact = np.broadcast_to(cycle.values[name], count)[part, None]
            found[name][part] = kept(np.broadcast_to(board.values[name], shape), exact)
    return found


def spots(cycle: Cycle) -> tuple[Spot, ...]:
    """Return the special places of the driver."""
    found = [Spot(DEAD, dead.angle, motion.output.link) for motion in cycle.motions for dead in motion.dead]
    places = {CHANGE: cycle.reach.changes, POLE: cycle.reach.poles, LIMIT: cycle.reach.limits}
    return (*found, *(Spot(kind, place) for kind, at in places.items() for place in at))


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


def _parts_of(program: Program) -> dict[str, str]:
    """Return the forces and moments of masses that a program lays down, each with its kind."""
    return {step.name: KINDS[step.law] for step in program if step.law in KINDS}


def _without(program: Program, parts: Collection[str]) -> Program:
    """Return a program that lays down these forces and moments with a size of zero; loads may be among them."""
    nothing = {step: step.but(operands=(ZERO, *step.operands[1:])) for step in program if step.name in parts}
    return Program(tuple(nothing.get(step, step) for step in program))


class _Model:
    """A mechanism's forces over its cycle, with all parts of the model or without some.

    Raises InputError: with the key `chart-no-forces`: the task has no plan of forces and no lever.
    """

    def __init__(self, cycle: Cycle) -> None:
        self._cycle = cycle
        self.balance = next((name for name in BALANCES if name in cycle.program.names), "")
        if not self.balance:
            raise InputError("chart-no-forces")
        self.reactions = tuple(
            name for name in cycle.quantities if role(name).kind == "R" and role(name).part not in ("n", "t")
        )
        self._full = self._values(())
        self.largest = _most(self._full[self.balance])
        self.reaction = max(self.reactions, key=lambda name: _most(self._full[name]), default=None)
        self.largest_reaction = _most(self._full[self.reaction]) if self.reaction else None

    def _values(self, parts: Collection[str]) -> dict[str, Array]:
        cycle, wanted = self._cycle, (self.balance, *self.reactions)
        program = _without(cycle.program, parts)
        lost = cycle.codes >= STATUSES.index("singular")  # or apart: no plan to compare
        found = cycle.drive.along(program, cycle.givens, wanted)(cycle.angles)
        return {name: np.where(lost, np.nan, value) for name, value in found.items()}

    def cost(self, key: str, parts: Iterable[str]) -> Cost:
        """Return what leaving out `parts` changes."""
        parts = tuple(parts)
        less = self._values(parts)
        change = _size(less[self.balance] - self._full[self.balance]) * (100.0 / self.largest if self.largest else 0.0)
        reaction = np.full(len(change), np.nan)
        if self.reactions and self.largest_reaction:
            off = [_size(less[name] - self._full[name]) for name in self.reactions]
            reaction = np.max(off, axis=0) * (100.0 / self.largest_reaction)
        worst = np.fmax(change, reaction)
        place = float(self._cycle.angles[np.argmax(np.where(np.isfinite(worst), worst, -1.0))])
        most, rms = (_most(reaction), _rms(reaction)) if self.reaction is not None else (None, None)
        return Cost(key, parts, _most(change), _rms(change), most, rms, place)


def depth(cycle: Cycle, tolerance: float) -> Depth:
    """Find what each simplification costs, and what may be left out together.

    The `tolerance` is per cent of the largest balance and of the largest reaction that may be missed.
    """
    model, kinds = _Model(cycle), _parts_of(cycle.program)
    single = [model.cost(part, (part,)) for part in kinds]
    groups = {kind: tuple(part for part, of in kinds.items() if of == kind) for kind in (FORCES, MOMENTS, WEIGHTS)}
    groups |= {INERTIA: groups[FORCES] + groups[MOMENTS], ALL: tuple(kinds)}
    own = {frozenset(parts): key for key, parts in reversed(groups.items())}  # all masses without weights are inertia
    differ = {key: parts for key, parts in groups.items() if len(parts) > 1 and own[frozenset(parts)] == key}
    several = [model.cost(key, parts) for key, parts in differ.items()]
    together = model.cost("", ())
    for cost in sorted(single, key=lambda cost: cost.worst):
        without_it = model.cost("", (*together.parts, *cost.parts))
        together = without_it if without_it.worst <= tolerance else together
    needed, spare = (tuple(x for x in kinds if (x in together.parts) == left_out) for left_out in (False, True))
    largest = (model.balance, model.largest, model.reaction, model.largest_reaction)
    return Depth(*largest, (*single, *several), tolerance, needed, spare, together)


def _size(values: Array) -> Array:
    return np.sqrt(dot(values, values)) if np.iscomplexobj(values) else np.abs(values)


def _most(values: Array) -> float:
    return float(np.nanmax(_size(values), initial=0.0))


def _rms(values: Array) -> float:
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else 0.0
