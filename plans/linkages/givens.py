"""The givens of a construction as its board wants them: what the task says, and what must be found first."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any

from ...scales.kept import Kept
from ..board import Program
from ..names import magnitude
from .chain import constructed
from .loads import BEGIN, END, in_order
from .mechanism import Mechanism, start_names

_STROKES = Kept[Any](64)  # from where to where outputs move


def board_givens(
    mechanism: Mechanism, values: Mapping[str, Any], program: Program | None = None, follow: bool = True
) -> dict[str, Any]:
    """Return `values` as the board wants them.

    The size of a load is `|F_3|` there, for `F_3` is the vector. Groups of class III are followed from their starts,
    unless the `values` say already where they lie. Where `program` needs the ends of the working stroke, these are
    found first.

    Raises
    ------
    InputError
        A load diagram whose places decrease, or an output without a stroke.
    """
    if mechanism.starts and follow:
        from .triads.following import followed  # which needs numpy, and few mechanisms need it

        values = {**values, **followed(mechanism, values)}
    for diagram in mechanism.diagrams:
        in_order(diagram, values)
    sizes: dict[str, Any] = {magnitude(name): values[name] for name in mechanism.sizes}
    if program is None or END not in program.needs or END in values:
        return {**values, **sizes}
    _, motion = constructed(mechanism.without_loads, ("velocity",))
    return {**values, **sizes, **_stroke_ends(mechanism, values, motion.needs)}


def _stroke_ends(mechanism: Mechanism, values: Mapping[str, Any], motion: Iterable[str]) -> dict[str, Any]:
    """Find the ends of the working stroke: once where only the driver moves, else for every mechanism of the arrays.

    `motion` names the values on which its motion depends. The ends are kept, for sweeps, charts and sheets ask for them
    again at each position.
    """
    from .cycles.strokes import stroke_of  # which needs numpy, and givens of its own for the sweep

    assert mechanism.stroke is not None
    sense, driver_at = mechanism.stroke.sense, mechanism.driver.coordinate
    followed = {name for start in mechanism.starts for name in start_names(start.link)}
    stated = {name for start in mechanism.starts for name in (start.x, start.y, start.angle, start.driver)}
    needed = {name: values[name] for name in {*motion, sense, *stated} & values.keys() - {driver_at} - followed}
    size = max((len(value) for value in needed.values() if getattr(value, "ndim", 0)), default=0)
    found = []
    for row in range(size or 1):
        one = {name: float(value[row] if getattr(value, "ndim", 0) else value) for name, value in needed.items()}
        asked = repr(mechanism), repr(sorted(one.items()))
        travel = _STROKES.get(asked, partial(stroke_of, mechanism, {**one, driver_at: 0.0}))
        found.append((travel.low, travel.high) if one.get(sense, 1.0) > 0.0 else (travel.high, travel.low))
    begin, end = zip(*found, strict=True)
    return {BEGIN: [*begin], END: [*end]} if size else {BEGIN: begin[0], END: end[0]}
