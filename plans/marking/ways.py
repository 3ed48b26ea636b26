"""How plans may be drawn: the right one, and those of constructions with one rule broken, as points and vectors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from ..mistakes.book import Book, Signature
from ..mistakes.rules import BY_SCALE
from ..names import POINT, role
from .key import Key
from .lines import Complex, Floats, Indices

FLAT = 0.03  # part of the longest vector that points of a plan miss where it is but one line
FULL = 0.15  # part of the longest vector of its plan from which a vector counts whole
SIZE = 0.005  # part by which sizes of shapes may differ that count as one
RIGHT = -1  # the number of the right construction among those with mistakes


@dataclass(frozen=True, eq=False)
class Shape:
    """How a plan may be drawn: places of its marks from the pole, SI; vectors by name, and the marks of their ends.

    Vectors between the same two marks are one line; `lines` are the first ones of these. `broken` are the numbers of
    the signatures in the book that draw it so.
    """

    plan: str
    marks: tuple[str, ...]
    places: Complex
    names: tuple[str, ...]
    tails: Indices
    tips: Indices
    lines: Indices
    broken: tuple[int, ...] = ()
    right: bool = True

    def explained(self, number: int) -> bool:
        """Whether it is drawn so with a mistake, by its number; or without any."""
        return self.right if number == RIGHT else number in self.broken

    @cached_property
    def spans(self) -> Complex:
        """The vectors of the lines, SI."""
        return np.asarray(self.places[self.tips[self.lines]] - self.places[self.tails[self.lines]])

    @cached_property
    def letters(self) -> tuple[str, ...]:
        """What stands at its marks on plans of velocities and accelerations: a at that of A; nothing on others."""
        points = role(self.plan).kind in ("velocity", "acceleration")
        return tuple(role(m).of.lower() if points and role(m).kind == POINT else "" for m in self.marks)

    @cached_property
    def both(self) -> NDArray[np.bool_]:
        """Which lines are vectors both ways, a force and its opposite."""
        ways = set(zip(self.tails.tolist(), self.tips.tolist(), strict=True))
        ends = zip(self.tips[self.lines].tolist(), self.tails[self.lines].tolist(), strict=True)
        return np.array([way in ways for way in ends], bool)

    @cached_property
    def weights(self) -> Floats:
        """What each line counts at the most: short ones less, and those that are nearly one line together as one."""
        return np.asarray(np.clip(np.abs(self.spans) / (FULL * self.longest), 0.2, 1.0) / self.like)

    @cached_property
    def like(self) -> Indices:
        """How many lines are nearly the same as each, with it."""
        ends = np.sort_complex(np.stack((self.places[self.tails], self.places[self.tips]), -1)[self.lines])
        return np.asarray((np.abs(ends[:, None] - ends[None, :]) < FLAT * self.longest).all(axis=-1).sum(axis=1))

    @cached_property
    def flat(self) -> bool:
        """Whether all its lines are but one on paper."""
        ends = np.concatenate((self.places[self.tails], self.places[self.tips]))
        way = self.spans[np.abs(self.spans).argmax()] / self.longest
        off = (ends - ends[0]) / way / self.longest
        ends_of = np.minimum(np.abs(off.real - off.real.min()), np.abs(off.real - off.real.max()))
        return float(max(np.abs(off.imag).max(), ends_of.max())) < FLAT

    @cached_property
    def longest(self) -> float:
        """The size of the longest vector, SI."""
        return float(np.abs(self.spans).max(initial=0.0))


Edges = tuple[tuple[str, str, str], ...]


def edges_of(program: Program, plan: str) -> Edges:
    """Return the vectors of a plan: name, tail and tip."""
    found: list[tuple[str, str, str]] = []
    for step in program.on(plan):
        if step.verb == "read":
            tail, tip = step.operands
            found.append((_quantity_shown(step.name), tail, tip))
        elif step.verb == "chain":
            found.append((_quantity_shown(step.operands[1]), step.operands[0], step.name))
    return tuple(found)


def _changed_edges(right: Edges, program: Program, plan: str) -> Edges:
    """Return the vectors of a plan that is drawn with a mistake; one that is only misread is drawn all the same.

    So are those of which one is read for another: each goes between its own marks.
    """
    own = edges_of(program, plan)
    names, made = {name for name, *_ in own}, set(program.names)
    found = (*own, *(edge for edge in right if edge[0] not in names and made.issuperset(edge[1:])))
    return right if sorted(edge[1:] for edge in found) == sorted(edge[1:] for edge in right) else found


def _quantity_shown(name: str) -> str:
    """Return the quantity that a vector shows, which a mistake may have put aside before it is misread."""
    return role(name).shown.shown


def shape_of(plan: str, edges: Edges, values: Mapping[str, Any], *broken: int) -> Shape | None:
    """Return how a plan is drawn with some values; None where these are none."""
    marks = tuple(dict.fromkeys(mark for _, *ends in edges for mark in ends))
    places = np.array([values.get(mark, math.nan) for mark in marks], complex)
    number = {mark: place for place, mark in enumerate(marks)}
    if not len(marks) or not np.isfinite(places).all():
        return None
    tails, tips = (np.array([number[edge[side]] for edge in edges], np.intp) for side in (1, 2))
    lines = {
        frozenset(pair): at for at, pair in reversed([*enumerate(zip(tails.tolist(), tips.tolist(), strict=True))])
    }
    of_lines = np.array(sorted(lines.values()), np.intp)
    return Shape(plan, marks, places, tuple(edge[0] for edge in edges), tails, tips, of_lines, broken, not broken)


def shapes_of(key: Key, book: Book | None, plan: str) -> tuple[Shape, ...]:
    """Return all ways in which a plan may be drawn, the right one first; those that look alike are one."""
    program = key.paper.program
    right_edges = edges_of(program, plan)
    right = shape_of(plan, right_edges, key.values)
    if right is None or not right.longest:
        return ()
    found, looks = {_look_of(right): right}, dict[tuple[Any, ...], tuple[Any, ...]]()
    for number, one in enumerate(book.signatures if book else ()):
        if one.broken.mistake in BY_SCALE:
            continue
        changed = any(step.plan == plan for steps in one.broken.change.steps.values() for step in steps)
        edges = _changed_edges(right_edges, one.broken.program, plan) if changed else right_edges
        drawn = edges, *(one.values.get(mark) for _, *ends in edges for mark in ends)
        if drawn in looks:  # most mistakes leave most plans as they are
            look = looks[drawn]
            found[look] = replace(found[look], broken=(*found[look].broken, number))
            continue
        shape = shape_of(plan, edges, one.values, number)
        if shape is not None and shape.longest:
            looks[drawn] = look = _look_of(shape)
            before = found.get(look)
            found[look] = shape if before is None else replace(before, broken=(*before.broken, number))
    return tuple(found.values())


def _look_of(shape: Shape) -> tuple[Any, ...]:
    """Return what shapes have in common that look alike on paper, and are of about the same size."""
    ends = np.round(np.stack((shape.places[shape.tails], shape.places[shape.tips])) / shape.longest, 3) + 0.0
    return (round(math.log(shape.longest) / SIZE), *sorted(zip(shape.names, *ends.tolist(), strict=True), key=repr))


def as_drawn(book: Book) -> Book:
    """Return the book as drawings show mistakes: a vector that was read for another has its own size there."""
    key, found = book.key, list[Signature]()
    for one in book.signatures:
        changed = {step.plan for steps in one.broken.change.steps.values() for step in steps if step.verb == "read"}
        rights = {plan: edges_of(key.paper.program, plan) for plan in changed}
        drawn = {
            name: one.values[tip] - one.values[tail]
            for plan, right in rights.items()
            if _changed_edges(right, one.broken.program, plan) is right
            for name, tail, tip in right
            if name in key.questions
        }
        if drawn:
            row = np.array([drawn.get(name, at) for name, at in zip(key.questions, one.row, strict=True)], complex)
            one = replace(one, values={**one.values, **drawn}, row=row)
        found.append(one)
    return replace(book, signatures=tuple(found))
