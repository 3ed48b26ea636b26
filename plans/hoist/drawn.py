"""The graphical solution beside the others: the crossing of parabola and sinusoid, the circle, the diagram of forces.

Curves are joined by chords from section line to section line, which errs as the square of a section; a hand errs
besides, in the lift-off, in ordinates of the diagram and in the radius of the circle.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from ..boards.exact import run
from ..contest import Clock, Entry, timed
from ..hands.hand import Hand
from ..hands.shaky import Paper, draw
from ..hands.spread import kept
from .construction import Roots, construct
from .diagram_plan import FORCES
from .hoist import CIRCLE_PART, FORCES_PART, ROOTS_PART
from .paper import board_givens
from .rivals import COURSE, DRAWN, HAND, LIFT_OFF, PEAK
from .root_plans import drawn
from .solve import SolvedHoist

Array = NDArray[np.float64]
SECTIONS = (10, 20, 40, 80, 160)  # before the lift-off
DRAWINGS, SEED = 400, 1
T_1, TOP = drawn("t_1"), "F_max"
ENDS = {"R": "F_12", "P": "P_12"}  # forces by the letters of the marks at their ends


def sectioned(solved: SolvedHoist, before: int) -> tuple[Program, dict[str, Any]]:
    """Return the construction with so many sections before the lift-off, and what it begins with."""
    assert solved.layout.roots is not None
    begin = solved.layout.roots.begin
    section = (solved.forces.found["t_1"] - begin) / (before + 0.5)
    layout = replace(solved.layout, roots=Roots(begin, section, before, (), (), False))
    program = construct(layout, (ROOTS_PART, CIRCLE_PART, FORCES_PART))
    return program, {**solved.givens, **board_givens(solved.forces, layout)}


def by_board(solved: SolvedHoist, clock: Clock) -> Iterator[Entry]:
    """Go through lift-offs on exact boards with more and more sections: the crossing errs as chords do."""
    t_1 = solved.forces.found["t_1"]
    for before in SECTIONS:
        program, givens = sectioned(solved, before)
        part = program.needed_for((T_1,))
        error = abs(float(run(part, givens).values[T_1]) / t_1 - 1.0)
        spent = timed(partial(run, part, givens), clock)
        yield Entry(DRAWN, before, LIFT_OFF, error, error, T_1, t_1, spent, 1, 0.0)


def by_hand(solved: SolvedHoist, mus: Mapping[str, float], hand: Hand) -> Iterator[Entry]:
    """Go through what 95 % of the drawings of a hand keep, on the sections that the sheet has.

    Parameters
    ----------
    mus : mapping of str to float
        Scale factors by plan, SI per mm.
    """
    assert solved.layout.roots is not None
    found, before = solved.forces.found, solved.layout.roots.lift_off
    program, givens = sectioned(solved, before)
    paper = Paper(program, givens, solved.worth(mus), solved.edges, solved.on_paper)
    values = draw(paper, hand, np.random.default_rng(SEED), DRAWINGS).values
    exact = run(program, givens).values
    setting, t_1 = f"n = {before}", found["t_1"]
    for kind, name, right in ((LIFT_OFF, T_1, t_1), (PEAK, TOP, found["F_max"])):
        errors = np.broadcast_to(np.abs(values[name] - right), DRAWINGS) * (1.0 / right)
        most, middle = float(kept(errors, 0.0)), float(np.median(errors))
        yield Entry(HAND, setting, kind, most, middle, name, t_1, None, 1, 0.0)
    ends = {f"{FORCES}.{letter}{i}": force for letter, force in ENDS.items() for i in range(len(exact))}
    marks = [mark for mark in exact if mark in ends]
    worth = givens["mu_F"] * (1.0 / found["F_max"])
    lines = np.array([float(kept(worth * np.abs(values[m].imag - exact[m].imag), 0.0)) for m in marks])
    at = marks[int(lines.argmax())]
    time = float(exact[at].real) * givens["mu_t"]
    yield Entry(HAND, setting, COURSE, float(lines.max()), float(np.median(lines)), ends[at], time, None, 1, 0.0)
