"""Students for tests of marking: bundled tasks on paper, and answers read off drawings of a shaky hand."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from kulman.plans.hands.shaky import Paper, paper_of, preset
from kulman.plans.hands.spread import drawn
from kulman.plans.marking.answers import Answer, Said, miss
from kulman.plans.marking.key import Key, answer_key
from kulman.plans.mistakes.book import Book, Signature, book
from kulman.variants.shelf import bundled
from kulman.variants.solution import solve

HAND = "normal"
LINKAGES = bundled("mechanism")
# scale factors of students of whom many are counted: they draw so whatever the sheet takes
DRAWN: dict[str, dict[str, str | float]] = {
    "nau-slider-crank": {"mu_F_23": 15.0, "mu_F_1": 25.0},
    "scheme-08-planer": {"mu_l": 0.005, "mu_F_1": 100.0, "mu_F_23": 100.0, "mu_F_45": 50.0},
}


@cache
def paper(task: str, variant: str | None = None) -> Paper:
    """Return the sheet of a task, velocities and accelerations drawn to the customary pa of the preset."""
    solution = solve(task, variant, scales=DRAWN.get(task))
    solved, mus = solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()}
    pa, point = preset(HAND).pa or 0.0, solved.mechanism.driver.point
    for symbol, name in (("mu_V", f"V_{point}"), ("mu_a", f"a_{point}")):
        if symbol in mus and solved.size(name) > 0.0:
            mus[symbol] = solved.size(name) / pa
    return paper_of(solved, mus)


@cache
def key(task: str, variant: str | None = None, wanted: frozenset[str] | None = None) -> Key:
    """Return the answer key of a task with the tolerances of the preset."""
    return answer_key(paper(task, variant), preset(HAND).tolerance, wanted=wanted)


@cache
def mistakes(task: str) -> Book:
    """Return the mistakes that concern a task."""
    return book(key(task))


def answer(name: str, value: Any, directions: bool = True) -> Answer:
    """Return what a student writes: three digits, and the direction or sense where these are asked."""
    size = float(f"{abs(value):.3g}")
    if isinstance(value, complex):
        return Answer(name, value=size, direction=cmath.phase(value) if directions else None)
    return Answer(name, value=size, sense=int(math.copysign(1.0, value)) if directions and value else None)


def right_answers(of: Key, directions: bool = True) -> list[Answer]:
    """Return the answers of somebody who makes no error."""
    return [answer(name, of[name], directions) for name in of.questions]


def students(of: Key, drawing: Paper, count: int, seed: int, directions: bool = True) -> Iterator[list[Answer]]:
    """Go through the answers of students who have drawn a sheet; what cannot be drawn is left out."""
    plans = {plan: drawing.mus.get(plan, 0.0) for plan in drawing.program.plans}
    board = drawn(replace(drawing, mus={**drawing.mus, **plans}), preset(HAND).hand, np.random.default_rng(seed), count)
    read = {name: board[name].tolist() for name in of.questions}
    for i in range(count):
        yield [answer(name, row[i], directions) for name, row in read.items() if row[i] == row[i]]


def in_millimetres(of: Key, answers: Iterable[Answer], everything: bool) -> list[Answer]:
    """Return answers that say of vectors and arms their segments alone, no scale factor and no value.

    Where not `everything` is measured, vectors that are calculated and laid off keep their values.
    """
    found = []
    for one in answers:
        question = of.questions[one.name]
        mu, measured = of.paper.mus.get(question.plan), question.step.verb in ("read", "arm")
        if mu and (measured or (everything and question.vector)):
            one = replace(one, mm=round((one.value or 0.0) / mu, 1), value=None)
        found.append(one)
    return found


def moves(of: Key, found: Signature, directions: bool = True) -> dict[str, float]:
    """Return by how many tolerances a broken rule moves each line."""
    moved = {}
    for name in of.questions:
        value = found.values[name]
        if value == value:
            said = answer(name, value, directions)
            unit = None if said.direction is None else cmath.rect(1.0, said.direction)
            way = Said(abs(value), said.sense, unit)
            moved[name] = miss(way, of[name], of.allowed[name], of.angles.get(name, math.pi)).off
    return moved


def planted(of: Book, found: Signature, seed: int, directions: bool = True) -> list[Answer]:
    """Return the answers of a student who has broken one rule, and draws with a shaky hand."""
    drawing = Paper(found.broken.program, found.broken.givens, of.key.paper.mus)
    return next(students(of.key, drawing, 1, seed, directions))
