"""What the accuracy of a quantity is measured by: the largest vector beside it, and the intersections behind it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from .board import POSITION, Program, Step
from .boards.exact import ILL
from .names import is_shown
from .quantities import POINTS, RESULTS, shown_on, unit_of

MEETING = ("meet", "arc", "arcs", "tangent")
PER_CENT = 100.0


def results(program: Program) -> tuple[Step, ...]:
    """Return the steps that make quantities that a user sees, points among them."""
    return tuple(step for step in program if is_shown(step.name) and step.verb in (*RESULTS, *POINTS))


def references(program: Program, values: Mapping[str, Any]) -> dict[str, float]:
    """Return for each quantity the size beside which its error counts, in its unit.

    That is the largest vector of the plan that shows it, the size of the mechanism on its own plan, for points too; for
    a number that no plan shows the largest one of its unit, and for per cents a hundred.
    """
    plans, found = plans_of(program), {}
    largest: dict[str, float] = {POSITION: extent(program, values)}
    for step in results(program):
        found[step.name] = key = plans.get(step.name) or unit_of(step.name)
        if step.verb not in POINTS:
            size = abs(values[step.name])
            if math.isfinite(size):
                largest[key] = max(largest.get(key, 0.0), float(size))
    return {name: PER_CENT if key == "%" else largest.get(key, 0.0) for name, key in found.items()}


def plans_of(program: Program) -> dict[str, str]:
    """Return for each quantity the plan that shows it, points and measured lengths among them."""
    here = (*POINTS, "distance", "measure")
    return {**shown_on(program), **{step.name: POSITION for step in results(program) if step.verb in here}}


def extent(program: Program, values: Mapping[str, Any]) -> float:
    """Return the longest distance between lettered points of the mechanism, m."""
    places = [values[step.name] for step in results(program) if step.verb in POINTS]
    return max((size for a in places for b in places if (size := abs(a - b)) == size), default=0.0)


def intersections(program: Program, sines: Mapping[str, float]) -> dict[str, float]:
    """Return the sine of the lines, or of line and arc, at each step that makes them meet; zero where they do not.

    A board looks at two directions once: lines along the same two meet at the same angle on every plan.
    """
    by_lines = {step.operands[1::2]: sines[step.name] for step in program if step.verb == "meet" and step.name in sines}
    found: dict[str, float] = {}
    for step in program:
        sine = by_lines.get(step.operands[1::2]) if step.verb == "meet" else sines.get(step.name)
        if sine is not None or step.verb in MEETING:
            found[step.name] = float(sine) if sine == sine and sine is not None else 0.0
    return found


def point_of(program: Program, mark: str) -> str:
    """Return the mark at which a meeting is seen: a tangent finds the direction of a line through its second point."""
    step = next(step for step in program if step.name == mark)
    return step.operands[1] if step.verb == "tangent" else mark


def pins_together(program: Program, values: Mapping[str, Any], mark: str) -> tuple[str, str] | None:
    """Return the two joints that settle a direction badly because they nearly coincide, None for lines that do."""
    step = next(step for step in program if step.name == mark)
    if step.verb != "tangent":
        return None
    first, second, *_, size = step.operands
    return (first, second) if abs(values[second] - values[first]) < ILL * values[size] else None


def worst_behind(
    program: Program, sines: Mapping[str, float], counts: Callable[[Step, str], bool] = lambda step, operand: True
) -> dict[str, float]:
    """Return for every name the least sine of all intersections that it hangs on, one where there are none.

    `sines` are as an exact board gives them; `counts` tells whether a step inherits from an operand.
    """
    own = intersections(program, sines)
    worst: dict[str, float] = {}
    for name, operands in program.counting(counts):
        least = own.get(name, 1.0)
        for operand in operands:
            if (sine := worst.get(operand, 1.0)) < least:
                least = sine
        worst[name] = least if least < 1.0 else 1.0
    return worst
