"""What honest drawings give: the interval of each quantity, the step that errs most, what is let pass, what fails."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from ..board import POINTS, Step
from ..boards.exact import run
from ..laws import cross, dot
from ..marking.key import answer_key
from ..names import role
from ..quantities import RESULTS, plans_of, references, results
from .shaky import PRESETS, Hand, Paper, ShakyBoard, Shape, Tolerance, draw

Array = NDArray[Any]
DRAWINGS, SEED = 4000, 1  # of what is told of a hand
SHARE = 0.95  # of all drawings: what most of them keep
NOTHING = 1e-12  # part of the largest vector that is rounding
ROUNDING = 1e-9  # part of a tolerance


@dataclass(frozen=True, slots=True)
class _Spread:
    """What many drawings give for one quantity, SI."""

    undrawn: float  # part of the drawings in which it cannot be drawn
    deviation: float = math.nan  # standard deviation; of a point that of its distance from the exact place, from zero
    miss: float = math.nan  # of a vector or point, direction and all, in the part `share` of all; NaN where fewer exist
    exact: float | None = None  # of a vector its magnitude; None for a point, as the ends of the interval of drawn ones
    low: float | None = None
    high: float | None = None
    degrees: float | None = None  # by which a vector turns at most in the part `share` of all; None for one of zero
    size: float = 0.0  # beside which it counts, such as the largest vector of its plan


@dataclass(frozen=True, slots=True)
class _Drawn:
    """Many drawings of one construction, beside the exact one."""

    paper: Paper
    exact: Mapping[str, Any]
    board: ShakyBoard

    def __getitem__(self, name: str) -> Array:
        """Return what each drawing gives for a name, NaN where it cannot be drawn."""
        return np.broadcast_to(self.board.values[name], self.board.codes.shape)

    def spreads(self, share: float = SHARE) -> dict[str, _Spread]:
        """Return what the drawings give for every quantity; `share` of them lie in the intervals."""
        sizes = references(self.paper.program, self.exact)
        return {step.name: self._spread(step, sizes[step.name], share) for step in results(self.paper.program)}

    def _spread(self, step: Step, size: float, share: float) -> _Spread:
        exact, drawings = self.exact[step.name], self[step.name]
        values = drawings[~np.isnan(drawings)]
        undrawn = 1.0 - values.size / drawings.size
        if not values.size or not np.isfinite(exact):  # infinite is what a rigid beam has
            return _Spread(undrawn)
        miss, turned = float(kept(drawings, exact, share)), None
        if step.verb in POINTS:
            return _Spread(undrawn, float(np.sqrt(np.mean(np.abs(values - exact) ** 2))), miss)
        if isinstance(exact, complex):
            if abs(exact) > NOTHING * size:
                angles = np.arctan2(cross(exact, drawings), dot(exact, drawings))
                turned = math.degrees(kept(angles, 0.0, share))
            values, exact = np.abs(values), abs(exact)
        low, high = map(float, np.quantile(values, (0.5 - share / 2.0, 0.5 + share / 2.0)))
        deviation = float(np.std(values)) if step.name in self.board.missed else 0.0
        return _Spread(undrawn, deviation, miss, float(exact), low, high, turned, size)

    def failing(self, allowed: Mapping[str, float]) -> dict[str, float]:
        """Return for each quantity the part of the drawings that a tolerance would fail, undrawn ones among them.

        Of vectors the magnitudes are compared, of points the places. What is undefined or infinite is not marked.
        """
        found = {}
        for step in results(self.paper.program):
            values, exact, most = self[step.name], self.exact[step.name], allowed[step.name] * (1.0 + ROUNDING)
            if step.verb in RESULTS and np.iscomplexobj(values):
                values, exact = np.sqrt(dot(values, values)), abs(exact)
            found[step.name] = float(np.mean(~(abs(values - exact) <= most))) if np.isfinite(exact) else 0.0
        return found


def kept(drawings: Array, exact: Any, share: float = SHARE) -> Array:
    """Return by how much drawings miss the exact value at most, in the part `share` of them: of all, drawn or not.

    Drawings are an array of shape (..., drawings), real or complex, NaN where one cannot be drawn; what is returned has
    the shape (...), with NaN where fewer than that can be drawn.

    >>> float(kept(np.array([1.0, 4.0, np.nan, 2.0]), 1.0, 0.75))
    3.0
    """
    misses = np.sort(np.abs(drawings - exact), axis=-1)  # what cannot be drawn comes last
    found: Array = misses[..., math.ceil(share * misses.shape[-1]) - 1]
    return found


def drawn(paper: Paper, hand: Hand, random: Generator, drawings: int = 1000) -> _Drawn:
    """Draw a construction many times with a shaky hand.

    >>> import numpy as np
    >>> from kulman import solve
    >>> from kulman.plans.hands.shaky import paper_of, preset
    >>> from kulman.plans.hands.spread import drawn
    >>> solution = solve("nau-slider-crank", "example")
    >>> paper = paper_of(solution.solved, {"mu_l": 0.001, "mu_V": 0.05, "mu_a": 2.0, "mu_F_23": 10.0, "mu_F_1": 10.0})
    >>> spreads = drawn(paper, preset("normal").hand, np.random.default_rng(1)).spreads()
    >>> 0.1 < spreads["V_B"].deviation / paper.mus["velocity"] < 2.0  # mm
    True
    """
    exact = run(paper.program, paper.givens).values
    first_order = _sensitivities(paper, hand, paper.ends, whole=True) if paper.ends else None
    if first_order is None or not first_order.passes:
        return _Drawn(paper, exact, draw(paper, hand, random, drawings))
    errors = first_order.closing(random, drawings)
    board = draw(paper, hand, _InOrder(iter(errors)), drawings)
    # as near to the axis as to first order
    beyond = first_order.missed(board.values) - first_order.ends @ errors
    errors -= np.linalg.pinv(first_order.ends) @ beyond
    return _Drawn(paper, exact, draw(paper, hand, _InOrder(iter(errors)), drawings))


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
class _InOrder:
    """Errors that are known, one step after the other."""

    errors: Iterator[Array]

    def standard_normal(self, size: Shape, /) -> Array:
        return next(self.errors)


@dataclass(frozen=True, slots=True)
class _Sensitivities:
    """How far each quantity misses for each error of one standard deviation.

    `steps` are those at which the errors are made; `misses` arrays of shape (errors,), SI, complex for vectors and
    points. `ends` say how far curves miss the axis to which they must come back, shape (ends, errors), beside the
    standard deviation that `passes`, SI: a drawing whose curves do not close is drawn again, so that its errors hang
    together.
    """

    steps: tuple[str, ...]
    misses: Mapping[str, Array]
    exact: Mapping[str, Any]
    ends: Array
    passes: Mapping[str, float]

    def parts(self, name: str) -> dict[str, float]:
        """Return the steps at which a quantity's error is made, with their parts of its variance, largest first.

        Where the least error of a step already breaks the construction, only such steps, and NaN for their parts.
        """
        squares: dict[str, float] = {}
        for step, miss in zip(self.steps, self.misses[name], strict=True):
            squares[step] = squares.get(step, 0.0) + abs(miss) ** 2
        broken = [step for step, square in squares.items() if square != square]
        if broken:
            return dict.fromkeys(broken, math.nan)
        total = sum(squares.values())
        ranked = sorted(squares.items(), key=lambda item: -item[1])
        return {step: float(square / total) for step, square in ranked if square > 0.0}

    def deviation(self, name: str) -> float:
        """Return the standard deviation of a quantity to first order, of a vector that of its magnitude, SI."""
        misses, exact = self.misses[name], self.exact[name]
        if isinstance(exact, complex) and exact:
            misses = dot(misses, exact * (1.0 / abs(exact)))
        square, open = np.sum(np.abs(misses) ** 2), self.ends @ misses
        return float(np.sqrt(max(square - np.vdot(open, self._weighed(open)).real, 0.0)))

    def missed(self, values: Mapping[str, Any]) -> Array:
        """Return how far curves miss their axis on drawings, as `ends` has it."""
        return np.array([np.imag(values[name] - self.exact[name]) / passes for name, passes in self.passes.items()])

    def closing(self, random: Generator, drawings: int) -> Array:
        """Return errors of drawings that close: any errors, less what brings their curves back to the axis."""
        errors = random.standard_normal((len(self.steps), drawings))
        open = self.ends @ errors + random.standard_normal((len(self.ends), drawings))
        closed: Array = errors - self.ends.T @ self._weighed(open)
        return closed

    def _weighed(self, open: Array) -> Array:
        """Return how much of each end must be taken back where curves miss their axis so."""
        found: Array = np.linalg.solve(np.eye(len(self.ends)) + self.ends @ self.ends.T, open)
        return found


def _sensitivities(paper: Paper, hand: Hand, names: Iterable[str] = (), whole: bool = False) -> _Sensitivities:
    """Draw a construction once for each error of the hand alone.

    `names` are the quantities wanted, all when empty. Steps that they do not need are only done where the `whole` is.
    """
    wanted = (*(tuple(names) or (step.name for step in results(paper.program))), *paper.ends)
    if not whole:
        paper = replace(paper, program=paper.program.needed_for(wanted))
    steps = tuple(draw(paper, hand, _OneByOne(), 1).erred)
    board = draw(paper, hand, _OneByOne(), (2, len(steps)))
    exact, misses = run(paper.program, paper.givens).values, dict[str, Array]()
    apart = {step.name: step.operands for step in paper.program if step.verb == "distance" and steps}
    sided = {
        name: np.where(np.imag(board.values[end] - board.values[start]) < 0.0, -1.0, 1.0)
        for name, (start, end) in apart.items()
    }
    for name in wanted:
        if np.isinf(exact[name]):  # of a rigid beam
            misses[name] = np.zeros(len(steps))
            continue
        forth, back = np.broadcast_to(board.values[name], (2, len(steps)))
        slope, kink = (forth - back) * (0.5 / STEP), abs((forth + back) * 0.5 - exact[name]) * (1.0 / STEP)
        # a distance that should be none grows with either, to one side of its first mark or the other
        misses[name] = np.where(
            kink > abs(slope), kink * np.broadcast_to(sided.get(name, 1.0), (2, len(steps)))[0], slope
        )
    millimetres = MARKS_IN / MOST * max(hand.point, hand.reading)
    passes = {name: millimetres * float(paper.mus[role(name).plan]) for name in paper.ends if millimetres}
    ends = [misses[name].imag / most for name, most in passes.items()]
    return _Sensitivities(steps, misses, exact, np.reshape(ends, (len(ends), len(steps))), passes)


MOST = 2.0  # standard deviations that nearly all honest hands keep
MARKS_IN, DEGREES_IN = 8.0, 2.0  # how many standard deviations of the usual hand its tolerance has


def added_up(paper: Paper, tolerance: Tolerance, names: Iterable[str]) -> dict[str, float]:
    """Return by how much quantities may differ, SI: twice what all errors of the hand come to, as variances do.

    The rule of `tolerances` looks at a segment and at the lines that meet at its ends. The last mark of a curve that is
    drawn chord by chord also misses by what all marks before it have missed.
    """
    wanted = tuple(names)
    of_preset = (one.hand for one in PRESETS.values() if one.tolerance == tolerance)
    mm, degrees = tolerance.mm / MARKS_IN, tolerance.degrees / DEGREES_IN
    found = _sensitivities(paper, next(of_preset, None) or Hand(mm, degrees, mm), wanted)
    return {name: MOST * found.deviation(name) for name in wanted}


@dataclass(frozen=True, slots=True)
class Expectation:
    """What a hand makes of one quantity."""

    spread: _Spread  # where the part `SHARE` of its drawings lie
    step: str | None  # whose errors come through most
    share: float | None  # of this step, in the variance; None where its least error breaks the construction
    allowed: float | None  # what to let pass, SI
    degrees: float | None  # what to let pass of a vector's direction
    failed: float  # part of this hand's drawings that would be marked wrong all the same
    mu: float | None  # value of a millimetre, where a plan shows the quantity
    errs: bool  # whether it hangs on any error at all

    @property
    def half(self) -> float | None:
        """Half the interval, SI; of a point how far its drawings miss it."""
        spread = self.spread
        if spread.low is None or spread.high is None:
            return spread.miss if spread.miss == spread.miss else None
        return 0.5 * (spread.high - spread.low)

    @property
    def mm(self) -> float | None:
        """Half the interval on paper."""
        return None if self.mu is None or self.half is None else self.half / self.mu

    @property
    def percent(self) -> float | None:
        """Half the interval in per cents of the value, None where the value is nothing beside its plan."""
        exact = self.spread.exact
        if self.half is None or not exact or abs(exact) <= NOTHING * self.spread.size:
            return None
        return 100.0 * self.half / abs(exact)

    def as_data(self) -> dict[str, Any]:
        """Return it as the command line's JSON has it, None for what is undefined."""
        spread, mu = self.spread, self.mu or math.nan
        allowed_mm = None if self.allowed is None else self.allowed / mu
        data: dict[str, Any] = {"low": spread.low, "high": spread.high, "mm": self.mm, "percent": self.percent}
        data |= {"miss": spread.miss, "miss_mm": spread.miss / mu, "degrees": spread.degrees}
        data |= {"step": self.step, "share": self.share}
        data |= {"tolerance": self.allowed, "tolerance_mm": allowed_mm, "tolerance_deg": self.degrees}
        data |= {"failed": self.failed, "undrawn": spread.undrawn}
        return {name: None if isinstance(x, float) and not math.isfinite(x) else x for name, x in data.items()}


def expectations(paper: Paper, hand: Hand, tolerance: Tolerance, limits: Mapping[str, float]) -> dict[str, Expectation]:
    """Draw a construction many times with a hand, the same drawings every time, and mark what comes out.

    What to expect is told of every quantity of the construction; what is only given does not err. `limits` are
    tolerances of single quantities in SI, in the place of the rule.
    """
    found = drawn(paper, hand, np.random.default_rng(SEED), DRAWINGS)
    key = answer_key(paper, tolerance, limits)
    parts, failed, plans = _sensitivities(paper, hand), found.failing(key.allowed), plans_of(paper.program)
    made = {}
    for name, spread in found.spreads(SHARE).items():
        # errors that a quantity hangs on may cancel: those of two scale factors in their ratio
        cancelled = spread.exact is not None and spread.deviation <= NOTHING * abs(spread.exact)
        errs = name in found.board.missed and not cancelled
        step, share = next(iter(parts.parts(name).items()), (None, math.nan)) if errs else (None, math.nan)
        allowed, angle = key.allowed[name], key.angles.get(name)
        # of the difference of two values each is marked alone
        marked = math.isfinite(allowed) and np.isfinite(key[name]) and role(name).kind != "delta"
        made[name] = Expectation(
            spread,
            step,
            share if math.isfinite(share) else None,
            allowed if marked else None,
            math.degrees(angle) if marked and angle is not None else None,
            failed[name],
            paper.mus.get(plans.get(name, "")),
            errs,
        )
    return made
