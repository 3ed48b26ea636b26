"""Speed against accuracy of a hoist: closed forms with each way to their root, and integration step by step.

Errors are those of the lift-off, of the force over time (the worst until one period after the lift-off) and of the
greatest force, in parts of the exact values; these are found with longer numbers than float64.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program
from ..boards.exact import ExactBoard
from ..contest import FULL, Clock, Contest, Effort, Entry, Kind, ran, timed
from ..laws import LAWS, TURN
from .course import rope_forces
from .finders import FINDERS, find, lift_off_equation
from .integrators import integrate
from .model import model, model_program
from .steppers import EXPLICIT, RK4, STEPPERS

Array = NDArray[np.float64]
LIFT_OFF, COURSE, PEAK = "lift_off", "course", "peak"
KINDS = (Kind(LIFT_OFF, ("t_1",)), Kind(COURSE, ("F_12", "P_12")), Kind(PEAK, ("F_max",)))
FORMULAS, MISSED, DRAWN, HAND = "hoist-closed", "rk4-missed", "hoist-drawn", "hand"
TOLERANCES = (1e-2, 1e-4, 1e-8, 1e-15)
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)  # k h, rad
TINY = (0.005, 0.002, 0.001)  # beside these for the method of the least order
MOST_STEPS = 10_000  # of a run; ten times as many of the method of the least order
MOST_AT_ONCE = 100_000  # hoists; a million would fill a gigabyte
PLACES = 200  # times at which closed forms are compared
CORRECTIONS = 4  # of the exact root: from 1e-8 on two are enough
COMPARED = ("V_t", "m", "g", "P_st", "C_01", "C_12", "C", "k", "k_1", "t_1", "P_m", "D_0", "D_1")
AFTER = (*COMPARED, "F_12_max", "P_12_max", "F_max")


@cache
def _from_lift_off() -> Program:
    """Return the calculations, without those that find the lift-off."""
    steps = tuple(step for step in model_program() if step.name not in ("t_1", "_t_1"))
    return Program(steps).needed_for(AFTER)


def follow(values: Mapping[str, Any], t_1: Any) -> dict[str, Any]:
    """Return the quantities of a hoist that lifts off at `t_1`, found in whatever way."""
    board = ExactBoard({**values, "t_1": t_1, "_rest": 0.0})
    with np.errstate(invalid="ignore", divide="ignore"):
        board.follow(_from_lift_off())
    return {name: board.values[name] for name in ("a", "S", *AFTER)}


def exact(values: Mapping[str, float]) -> dict[str, Any]:
    """Return the quantities with longer numbers than float64, where the machine has them: Newton's steps to t_1."""
    long = {name: np.longdouble(value) for name, value in values.items()}
    t_1 = np.longdouble(model(values, ("t_1",))["t_1"])
    found = follow(long, t_1)
    height = found["P_st"] / found["C"]
    swing = (found["V_t"], long["a"], found["k"])
    for _ in range(CORRECTIONS):
        t_1 = t_1 - (LAWS["lagging"](*swing, t_1) - height) / LAWS["load_rate"](*swing, t_1)
    return follow(long, t_1)


@dataclass(frozen=True, slots=True, eq=False)
class _Race:
    """The rivals for one hoist."""

    values: Mapping[str, float]
    right: Mapping[str, Any]
    clock: Clock
    effort: Effort

    @property
    def places(self) -> Array:
        """Times that are compared, from the beginning to one period after the lift-off."""
        return _places(self.right)

    def closed(self) -> Iterator[Entry]:
        """Go through closed forms of so many hoists at once."""
        for size in (size for size in self.effort.batches if size <= MOST_AT_ONCE):
            many = {name: np.full(size, value) if size > 1 else value for name, value in self.values.items()}
            t_1 = timed(partial(model, many, ("t_1",)), self.clock) / size
            whole = timed(partial(model, many, AFTER), self.clock) / size
            alone = model(self.values, ("t_1",))["t_1"]
            yield from self._entries(FORMULAS, size, follow(self.values, alone), (t_1, whole), size)

    def finders(self) -> Iterator[Entry]:
        """Go through closed forms with each way to the root, and tolerances."""
        found = model(self.values, COMPARED)
        equation = lift_off_equation(found["V_t"], self.values["a"], found["k"], found["P_st"] / found["C"])
        for finder in FINDERS:
            for tolerance in TOLERANCES:
                x = find(finder, equation, tolerance).root
                alone = timed(partial(find, finder, equation, tolerance), self.clock)
                if not np.isfinite(x):
                    yield from self._nothing(finder, tolerance)
                    continue
                t_1 = x / found["k"]
                after = timed(partial(follow, self.values, t_1), self.clock)
                yield from self._entries(finder, tolerance, follow(self.values, t_1), (alone, alone + after), 1)

    def steps(self) -> Iterator[Entry]:
        """Go through integrators and steps; runs that are refused, or too long, give nothing."""
        found = model(self.values, COMPARED) | {"a": self.values["a"]}
        angle = float(self.right["k"] * (self.right["t_1"] + TURN / self.right["k_1"]))  # k t of a whole run
        ways = [(method, method, True) for method in STEPPERS] + [(MISSED, RK4, False)]
        for name, method, located in ways:
            for step in (*STEPS, *(TINY if method == EXPLICIT else ())):
                if angle > step * MOST_STEPS * (10 if method == EXPLICIT else 1):
                    yield from self._nothing(name, step)
                    continue
                work = partial(integrate, found, method, step, located)
                run, spent = ran(work, self.clock)
                if run.refused[0]:
                    yield from self._nothing(name, step)
                    continue
                known = ~np.isnan(run.F_12[:, 0])
                t, force = run.t[known, 0], run.F_12[known, 0]
                errors = self._course(t, force)
                yield from self._three(name, step, (run.t_1[0], run.F_max[0]), (t, errors), (spent, spent), 1)

    def _nothing(self, method: str, setting: float) -> Iterator[Entry]:
        """Go through what a method gives that has failed, or is refused."""
        at = float(self.right["t_1"])
        yield from (Entry(method, setting, kind.name, None, None, "", at, None, 1, 1.0) for kind in KINDS)

    def _course(self, t: Array, force: Array) -> Array:
        """Return errors of a force over time, in parts of the greatest."""
        right = rope_forces(self.right, t.astype(np.longdouble))[1]
        errors: Array = np.abs((force - right) * (1.0 / self.right["F_max"])).astype(float)
        return errors

    def _entries(
        self, method: str, setting: float, found: Mapping[str, Any], seconds: tuple[float, float], at_once: int
    ) -> Iterator[Entry]:
        t = self.places
        errors = self._course(t, rope_forces(found, t)[1])
        yield from self._three(method, setting, (found["t_1"], found["F_max"]), (t, errors), seconds, at_once)

    def _three(
        self,
        method: str,
        setting: float,
        ends: tuple[Any, Any],
        course: tuple[Array, Array],
        seconds: tuple[float, float],
        at_once: int,
    ) -> Iterator[Entry]:
        """Go through the errors of the three kinds: `seconds` of the lift-off alone, and of everything."""
        t_1, peak = (
            float(abs(np.longdouble(found) / self.right[name] - 1.0))
            for found, name in zip(ends, ("t_1", "F_max"), strict=True)
        )
        t, errors = course
        worst = int(np.argmax(errors))
        name = "F_12" if t[worst] < self.right["t_1"] else "P_12"
        yield Entry(method, setting, LIFT_OFF, t_1, t_1, "t_1", float(self.right["t_1"]), seconds[0], at_once, 0.0)
        most, middle = float(errors[worst]), float(np.median(errors))
        yield Entry(method, setting, COURSE, most, middle, name, float(t[worst]), seconds[1], at_once, 0.0)
        yield Entry(method, setting, PEAK, peak, peak, "F_max", float(self.right["t_1"]), seconds[1], at_once, 0.0)


def _places(found: Mapping[str, Any]) -> Array:
    end = float(found["t_1"] + TURN / found["k_1"])
    places: Array = end * ((np.arange(PLACES) + 0.5) / PLACES)
    return places


def rivals(values: Mapping[str, float], clock: Clock, effort: Effort = FULL) -> Contest:
    """Let closed forms and integrators compete.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens of a hoist on a support that yields, whose formulas are valid, SI.
    clock : function
        Returns seconds, best those of the processor: `time.process_time`.
    """
    race = _Race(values, exact(values), clock, effort)
    entries = (*race.closed(), *race.finders(), *race.steps())
    return Contest(KINDS, race.places, entries, effort)
