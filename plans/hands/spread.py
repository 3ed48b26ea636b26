"""What honest drawings give: the interval of each quantity, on paper and beside its plan; and which step errs most."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from ..boards.exact import run
from ..laws import cross, dot
from ..quantities import POINTS, plans_of, references, results
from .hand import Hand, Tolerance, hand_within
from .shaky import Paper, ShakyBoard, Shape, draw

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


STEP = 1e-3  # standard deviations; the error of a central difference is its square


@dataclass(slots=True)
class _OneByOne:
    """Errors one at a time, forth and back, in the second axis; none at all where there is no such axis."""

    done: int = 0

    def standard_normal(self, size: Shape, /) -> Array:
        errors = np.zeros(size)
        if errors.ndim == 2:
            errors[:, self.done] = STEP, -STEP
        self.done += 1
        return errors


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """How far each quantity misses for each error of one standard deviation.

    `steps` are those at which the errors are made; `misses` arrays of shape (errors,), SI, complex for vectors and
    points.
    """

    steps: tuple[str, ...]
    misses: Mapping[str, Array]
    exact: Mapping[str, Any]

    def parts(self, name: str) -> dict[str, float]:
        """Return the steps at which a quantity's error is made, with their parts of its variance, largest first.

        Where the least error of a step already breaks the construction, only such steps, and NaN for their parts.
        """
        squares: dict[str, float] = {}
        for step, miss in zip(self.steps, self.misses[name], strict=True):
            squares[step] = squares.get(step, 0.0) + abs(miss) ** 2
        broken = [step for step, square in squares.items() if square != square]
        if broken:
            return dict.fromkeys(broken, float("nan"))
        total = sum(squares.values())
        ranked = sorted(squares.items(), key=lambda item: -item[1])
        return {step: float(square / total) for step, square in ranked if square > 0.0}

    def deviation(self, name: str) -> float:
        """Return the standard deviation of a quantity to first order, of a vector that of its magnitude, SI."""
        misses, exact = self.misses[name], self.exact[name]
        if isinstance(exact, complex) and exact:
            misses = dot(misses, exact * (1.0 / abs(exact)))
        return float(np.sqrt(np.sum(np.abs(misses) ** 2)))


def sensitivities(paper: Paper, hand: Hand, names: Iterable[str] = ()) -> Sensitivities:
    """Draw a construction once for each error of the hand alone.

    Parameters
    ----------
    names : iterable of str
        Quantities wanted; all when empty. Steps that they do not need are not done.
    """
    wanted = tuple(names) or tuple(step.name for step in results(paper.program))
    paper = replace(paper, program=paper.program.needed_for(wanted))
    steps = tuple(draw(paper, hand, _OneByOne(), 1).erred)
    board = draw(paper, hand, _OneByOne(), (2, len(steps)))
    exact = run(paper.program, paper.givens).values
    misses = {name: _misses(np.broadcast_to(board.values[name], (2, len(steps))), exact[name]) for name in wanted}
    return Sensitivities(steps, misses, exact)


def _misses(values: Array, exact: Any) -> Array:
    """Return what errors forth and back do: a distance that should be none grows with either."""
    if np.isinf(exact):  # of a rigid beam
        return np.zeros(values.shape[1:])
    forth, back = values
    slope, kink = (forth - back) * (0.5 / STEP), abs((forth + back) * 0.5 - exact) * (1.0 / STEP)
    found: Array = np.where(kink > abs(slope), kink, slope)
    return found


MOST = 2.0  # standard deviations that nearly all honest hands keep


def added_up(paper: Paper, tolerance: Tolerance, names: Iterable[str]) -> dict[str, float]:
    """Return by how much quantities may differ, SI: twice what all errors of the hand come to, as variances do.

    The rule of `tolerances` looks at a segment and at the lines that meet at its ends. The last mark of a curve that is
    drawn chord by chord also misses by what all marks before it have missed.
    """
    wanted = tuple(names)
    found = sensitivities(paper, hand_within(tolerance), wanted)
    return {name: MOST * found.deviation(name) for name in wanted}
