"""What honest drawings give: the interval of each quantity, on paper and beside the largest vector of its plan."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from ..boards.exact import run
from ..laws import cross, dot
from ..quantities import POINTS
from ..references import plans_of, references, results
from .hand import Hand
from .shaky import Paper, ShakyBoard, draw

Array = NDArray[Any]
DRAWINGS = 1000
SHARE = 0.95  # of all drawings: what most of them keep
NOTHING = 1e-12  # part of the largest vector that is rounding


@dataclass(frozen=True, slots=True)
class Spread:
    """What many drawings give for one quantity.

    Parameters
    ----------
    exact, low, high : float or None
        The exact value (of a vector its magnitude), and the ends of the interval of drawn ones, SI; None for a point.
    deviation : float
        Standard deviation, SI; of a point that of its distance from the exact place, from zero.
    miss : float
        What a vector or point misses by, direction and all: not more in the part `share` of all drawings, SI; NaN where
        fewer can be drawn.
    mm, mm_miss : float or None
        Deviation and miss on paper, where a plan shows the quantity.
    percent, of_largest : float or None
        Deviation in per cent of the value, and of the largest vector of its plan.
    undrawn : float
        Part of the drawings in which it cannot be drawn.
    degrees : float or None
        What a vector turns by at most, in the part `share` of all drawings, NaN where fewer can be drawn; None for one
        that is zero.
    """

    exact: float | None
    low: float | None
    high: float | None
    deviation: float
    miss: float
    mm: float | None
    mm_miss: float | None
    percent: float | None
    of_largest: float | None
    undrawn: float
    degrees: float | None = None


@dataclass(frozen=True, slots=True)
class Drawn:
    """Many drawings of one construction, beside the exact one."""

    paper: Paper
    exact: Mapping[str, Any]
    board: ShakyBoard

    def __getitem__(self, name: str) -> Array:
        """Return what each drawing gives for a name, NaN where it cannot be drawn."""
        return np.broadcast_to(self.board.values[name], self.board.codes.shape)

    def spreads(self, share: float = SHARE) -> dict[str, Spread]:
        """Return what the drawings give for every quantity; `share` of them lie in the intervals."""
        sizes = references(self.paper.program, self.exact)
        plans = plans_of(self.paper.program)
        found = {}
        for step in results(self.paper.program):
            mu = self.paper.mus.get(plans.get(step.name, ""))
            found[step.name] = self._spread(step.name, step.verb in POINTS, mu, sizes[step.name], share)
        return found

    def _spread(self, name: str, point: bool, mu: float | None, size: float, share: float) -> Spread:
        exact, drawings = self.exact[name], self[name]
        values = drawings[~np.isnan(drawings)]
        undrawn = 1.0 - values.size / self.board.codes.size
        if not values.size or not np.isfinite(exact):  # infinite is what a rigid beam has
            nothing = float("nan")
            return Spread(None, None, None, nothing, nothing, None, None, None, None, undrawn)
        misses = np.abs(values - exact)
        miss = float(kept(drawings, exact, share))
        if point:
            deviation, value, low, high = float(np.sqrt(np.mean(misses**2))), None, None, None
        else:
            numbers = np.abs(values) if np.iscomplexobj(values) else values
            value = abs(exact) if isinstance(exact, complex) else float(exact)
            low, high = map(float, np.quantile(numbers, (0.5 - share / 2.0, 0.5 + share / 2.0)))
            deviation = float(np.std(numbers)) if name in self.board.missed else 0.0
        return Spread(
            value,
            low,
            high,
            deviation,
            miss,
            None if mu is None else deviation / mu,
            None if mu is None else miss / mu,
            _per_cent(deviation, value, size),
            _per_cent(deviation, size, size),
            undrawn,
            None if point else _turning(drawings, exact, size, share),
        )


def kept(drawings: Array, exact: Any, share: float = SHARE) -> Array:
    """Return by how much drawings miss the exact value at most, in the part `share` of them: of all, drawn or not.

    Parameters
    ----------
    drawings : float64 or complex128 array of shape (..., drawings)
        What each gives, NaN where it cannot be drawn.
    exact : number, or array that broadcasts to `drawings`
        What it should be.

    Returns
    -------
    float64 array of shape (...)
        NaN where fewer than that can be drawn.

    >>> float(kept(np.array([1.0, 4.0, np.nan, 2.0]), 1.0, 0.75))
    3.0
    """
    misses = np.sort(np.abs(drawings - exact), axis=-1)  # what cannot be drawn comes last
    found: Array = misses[..., math.ceil(share * misses.shape[-1]) - 1]
    return found


def _turning(values: Array, exact: Any, size: float, share: float) -> float | None:
    """Return the degrees by which most drawn vectors turn from the exact one."""
    if not isinstance(exact, complex) or abs(exact) <= NOTHING * size:
        return None
    angles = np.arctan2(cross(exact, values), dot(exact, values))
    return math.degrees(kept(angles, 0.0, share))


def _per_cent(part: float, whole: float | None, size: float) -> float | None:
    """Return per cents of a whole, None where that is nothing beside `size`."""
    return None if whole is None or abs(whole) <= NOTHING * size else part / abs(whole) * 100.0


def drawn(paper: Paper, hand: Hand, random: Generator, drawings: int = DRAWINGS) -> Drawn:
    """Draw a construction many times with a shaky hand.

    >>> import numpy as np
    >>> from kulman import solve
    >>> from kulman.plans.hands.hand import preset
    >>> from kulman.plans.hands.shaky import paper_of
    >>> from kulman.plans.hands.spread import drawn
    >>> solution = solve("nau-slider-crank", "example")
    >>> paper = paper_of(solution.solved, {"mu_l": 0.001, "mu_V": 0.05, "mu_a": 2.0, "mu_F_23": 10.0, "mu_F_1": 10.0})
    >>> spreads = drawn(paper, preset("normal").hand, np.random.default_rng(1)).spreads()
    >>> 0.1 < spreads["V_B"].mm < 2.0
    True
    """
    exact = run(paper.program, paper.givens).values
    return Drawn(paper, exact, draw(paper, hand, random, drawings))
