"""The givens of a construction as its board wants them: what the task says, and what must be found first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..board import Program
from .bare import without_loads
from .chain import construct
from .loads import in_order
from .mechanism import Mechanism
from .working_stroke import END, stroke_ends


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
    sizes = {f"|{name}|": values[name] for name in mechanism.sizes}
    if program is None or END not in program.needs or END in values:
        return {**values, **sizes}
    _, motion = construct(without_loads(mechanism), ("velocity",))
    return {**values, **sizes, **stroke_ends(mechanism, values, motion.needs)}
