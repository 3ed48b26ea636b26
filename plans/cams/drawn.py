"""A cam as a student draws it: what is read off the drawing stands where the construction has what a formula gives.

A cam's construction finds most sizes twice: by the closed forms of its law, and by chords and tangents as they are
drawn. Who draws has one of each, and goes on with it: the scale factors follow from the highest ordinate of the curve
of chords, r_0 from where the tangents meet. Here what is drawn takes the name of what it stands for, `mu_s_chord` that
of `mu_s`, `r_0_tangents` that of `r_0`, and all that hangs on these hangs on the drawing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from ..board import Program, Step
from ..boards.exact import run
from .formulas import SHARPEST
from .solve import EXACT_OF, SolvedCam

HEIGHTS = {"_S_max": "S_max_chord", "_V_max": "V_max_chord"}  # ordinates that only a drawing shows keep its name
TANGENTS = {"r_0": "r_0_tangents", "e": "e_tangents", "r_0_flat_min": "r_0_flat_tangent"}
GIVEN = ("r_0", "e")  # of a cam whose sizes are given none are drawn


def stands_for(solved: SolvedCam) -> dict[str, str]:
    """Return for every size that is drawn, and found by a formula, too, what it is called there."""
    names = {*solved.program.names}
    chords = {name: EXACT_OF[name] for name in solved.program.names if name in EXACT_OF}
    found = {drawn: exact for drawn, exact in chords.items() if exact in names}
    sized = any(name in solved.givens for name in GIVEN)
    for exact, drawn in TANGENTS.items():
        if {exact, drawn} <= names and not (sized and exact in GIVEN):
            found[drawn] = exact
    return found


def as_drawn(solved: SolvedCam) -> SolvedCam:
    """Return the cam as a student draws it: of values that are drawn those have the plain names."""
    named = stands_for(solved)
    made = {*solved.program.names}
    instead = {exact: drawn for exact, drawn in HEIGHTS.items() if {exact, drawn} <= made}
    left_out = {*named.values(), *instead}
    steps = [step for step in solved.program if step.name not in left_out]
    renamed = [_renamed(step, {**named, **instead}) for step in steps]
    bends = solved.roller is not None and not solved.motion.velocity_jumps  # else the pitch curve has corners
    numbers = _curved(solved) if bends else {}
    at_centre = ("h", "e", "s_0", *numbers) if numbers else ()
    by_tangents = "e_tangents" in named
    program = Program(tuple(_in_order(one for step in renamed for one in _measured(step, at_centre, by_tangents))))
    numbers |= solved.givens
    board = run(program, numbers)
    return replace(solved, program=program, givens=numbers, values=board.values, sines=board.sines)


def _renamed(step: Step, names: Mapping[str, str]) -> Step:
    operands = tuple(names.get(name, name) for name in step.operands)
    return replace(step, name=names.get(step.name, step.name), operands=operands)


def _measured(step: Step, at_centre: tuple[str, ...], by_tangents: bool) -> tuple[Step, ...]:
    """Return a step as it is done on a drawing: s_0 goes with r_0 and e, the curvature is that of the drawn cam."""
    if by_tangents and step.name == "s_0":
        return (replace(step, law="other_leg", operands=("r_0", "e")),)
    if step.name == "rho_min" and at_centre:
        return (replace(step, law=SHARPEST, operands=at_centre),)
    return (step,)


def _curved(solved: SolvedCam) -> dict[str, float]:
    """Return s, s', s'' in parts of the stroke on every section line, both limits where they jump, in this order.

    The pitch curve of a roller is curved after these, and after where its centre is.
    """
    limits = [solved.motion.at(solved.angles, side) for side in (-1, 1)]
    found = {}
    for order, word in enumerate(("s", "ds", "d2s")):
        turned = solved.cam.sense if order == 1 else 1.0
        for side, values in zip(("before", "after"), limits, strict=True):
            for i, value in enumerate(values[order].tolist()):
                found[f"_{word}{i}_{side}_curved"] = turned * value / solved.motion.h
    return found


def _in_order(steps: Iterable[Step]) -> Iterator[Step]:
    """Go through steps, each as soon as all that it needs is there."""
    wanted = [*steps]
    missing, held = {step.name for step in wanted}, list[Step]()
    for step in wanted:
        held.append(step)
        while ready := next((one for one in held if missing.isdisjoint(one.operands)), None):
            held.remove(ready)
            missing.discard(ready.name)
            yield ready
