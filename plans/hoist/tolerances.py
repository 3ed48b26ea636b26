"""What a teacher should let pass of the times that solve the equations of a hoist: they may be read off drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..hands.hand import Tolerance
from ..marking.key import rounded
from ..solved import PAPER_MM
from .solve import SolvedHoist


def tolerances_of(solved: SolvedHoist, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much times may miss, SI: what chords err by, and the error of a segment of the drawing."""
    return dict(_times(solved, tolerance))


def _times(solved: SolvedHoist, tolerance: Tolerance) -> Iterator[tuple[str, float]]:
    for name, quantity in solved.quantities.items():
        drawn = solved.quantities.get(f"{name}_drawn")
        if drawn is None or quantity.value is None or drawn.value is None or not math.isfinite(drawn.value):
            continue
        mu = float(solved.values["mu_t1"]) * PAPER_MM
        of_segment = tolerance.of_segment(abs(drawn.value) / mu) * mu
        yield name, max(abs(drawn.value - quantity.value) + of_segment, rounded(quantity.value, tolerance))
        yield f"{name}_drawn", max(of_segment, rounded(quantity.value, tolerance))
