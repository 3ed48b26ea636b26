"""What a cam is judged by: rules of good design, usual numbers, and the cam as a student draws it.

Cams with other numbers are solved, too, but are more often a wrong unit than a cam.

Of a cam as a student draws it, what is read off the drawing stands where the construction has what a formula gives.
A cam's construction finds most sizes twice: by the closed forms of its law, and by chords and tangents as they are
drawn. Who draws has one of each, and goes on with it: the scale factors follow from the highest ordinate of the curve
of chords, r_0 from where the tangents meet. Here what is drawn takes the name of what it stands for, `mu_s_chord` that
of `mu_s`, `r_0_tangents` that of `r_0`, and all that hangs on these hangs on the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ..board import Program, Step
from ..boards.exact import run
from ..solved import AT_LEAST, AT_MOST, Check
from .cam import GIVENS
from .construction import CHORD_OF, EXACT, EXACT_OF, SHARPEST
from .followers import OF_R_0, OF_RHO_MIN
from .solve import SolvedCam

ROUNDING = 1e-9  # part of a limit by which rounding may pass it


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule(Check):
    """A rule; its limit may be a `part` of the `size` of the quantity `of`, m."""

    part: float = 1.0
    size: float = 0.0


def rules_of(solved: SolvedCam) -> tuple[Rule, ...]:
    """Return the rules for a cam with a roller, none for one with a plate alone.

    `roller_of_radius` and `roller_of_curvature` hold the roller against 0.4 r_0 and 0.7 rho_min, the latter where the
    pitch curve is convex anywhere; `gamma_rise` and `gamma_fall` the least transmission angles against those permitted.
    """
    found = solved.rolling
    if found is None:
        return ()
    rules, R = [], found.profile.R
    sizes = {"radius": (OF_R_0, "r_0", found.sizes.r_0), "curvature": (OF_RHO_MIN, "rho_min", found.profile.rho_min)}
    for name, (part, of, size) in sizes.items():
        limit = part * size
        if math.isfinite(size):
            rules.append(Rule(
                name=f"roller_of_{name}", ok=limit * (1.0 + ROUNDING) >= R, value=R, unit="m", limit=limit,
                relation=AT_MOST, quantity="R_roller", of=of, part=part, size=size,
            ))  # fmt: skip
    for phase in ("gamma_rise", "gamma_fall"):
        least, permitted = float(solved.values[f"{phase}_min"]), float(solved.givens[phase])
        rules.append(Rule(
            name=phase, ok=least >= permitted * (1.0 - ROUNDING), value=least, unit="rad", limit=permitted,
            relation=AT_LEAST, quantity=f"{phase}_min",
        ))  # fmt: skip
    return tuple(rules)


# what follows is looked at where all that is given is usual
USUAL_FOUND = {"r_0": (2e-3, 1.0), "r_0_flat": (2e-3, 1.0), "a_max": (0.0, 1e5)}


_Unusual = tuple[str, float, float, float]  # the name of a number, the number, and between what the usual ones lie


def unusual(solved: SolvedCam) -> Iterator[_Unusual]:
    """Go through the numbers that hardly any cam has, SI: the given ones, else those that follow from them."""
    given = {name: of.usual for name, of in GIVENS.items() if of.usual is not None}
    yield from [*_beyond(solved.givens, given)] or _beyond(solved.values, USUAL_FOUND)


def _beyond(values: Mapping[str, Any], usual: Mapping[str, tuple[float, float]]) -> Iterator[_Unusual]:
    for name, (least, most) in usual.items():
        value = values.get(name)
        if value is not None and not least * (1.0 - ROUNDING) <= value <= most * (1.0 + ROUNDING):
            yield name, float(value), least, most


HEIGHTS = {EXACT[name]: CHORD_OF[name] for name in EXACT}  # ordinates that only a drawing shows keep its name
TANGENTS = {"r_0": "r_0_tangents", "e": "e_tangents", "r_0_flat_min": "r_0_flat_tangent"}
GIVEN = ("r_0", "e")  # of a cam whose sizes are given none are drawn


def stands_for(solved: SolvedCam) -> dict[str, str]:
    """Return for every size that is drawn, and found by a formula, too, what it is called there."""
    names = {*solved.program.names}
    found = {drawn: exact for drawn, exact in EXACT_OF.items() if {drawn, exact} <= names}
    sized = any(name in solved.givens for name in GIVEN)
    for exact, drawn in TANGENTS.items():
        if {exact, drawn} <= names and not (sized and exact in GIVEN):
            found[drawn] = exact
    return found


def as_drawn(solved: SolvedCam) -> SolvedCam:
    """Return the cam as a student draws it: of values that are drawn those have the plain names."""
    named, made = stands_for(solved), {*solved.program.names}
    instead = {exact: drawn for exact, drawn in HEIGHTS.items() if {exact, drawn} <= made}
    left_out, names = {*named.values(), *instead}, named | instead
    bends = solved.roller is not None and not solved.motion.velocity_jumps  # else the pitch curve has corners
    numbers = _curved(solved) if bends else {}
    steps = []
    for step in (step for step in solved.program if step.name not in left_out):
        operands = tuple(names.get(name, name) for name in step.operands)
        drawn = step.but(name=names.get(step.name, step.name), operands=operands)
        if drawn.name == "s_0" and "e_tangents" in named:  # it goes with r_0 and e
            drawn = drawn.but(law="other_leg", operands=("r_0", "e"))
        elif drawn.name == "rho_min" and numbers:  # the curvature is that of the drawn cam
            drawn = drawn.but(law=SHARPEST, operands=("h", "e", "s_0", *numbers))
        steps.append(drawn)
    program, numbers = Program(tuple(_in_order(steps))), {**numbers, **solved.givens}
    board = run(program, numbers)
    return replace(solved, program=program, givens=numbers, values=board.values, sines=board.sines)


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
