"""The lift-off where it is hard to tell: without acceleration, when the support begins to rest just then.

Near k t_1 = 2 pi n both the speed and the acceleration of the load are nearly zero there, and the root of (11) is
nearly triple: sixteen digits leave five of t_1. What is missing is found with fifty digits, from the givens.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from ..board import Program, RecordingBoard
from ..boards.exact import ExactBoard
from ..boards.fifty_digits import DIGITS, fifty_digits
from ..laws import define
from .hoist import VALUES
from .lift_off import lifting_off, reduced
from .roots import lag_rate

ILL = 1e3  # how much larger than those of the givens errors of t_1 may be without more digits
ROUNDS = 400
CLOSE = 1e-20  # part of t_1 that is none
BRACKET = 1e-4  # rad, first guess of how far the root is from that found with sixteen digits


@np.errstate(invalid="ignore", divide="ignore")
def _condition(V: Any, a: Any, k: Any, height: Any, t_1: Any) -> Any:
    """Return by how much errors of m g / C grow in t_1: height / (t_1 * slope), one or less on a rigid support."""
    x = np.where(np.isinf(k), 0.0, np.where(np.isinf(k), 1.0, k) * t_1)
    return np.where(np.isinf(k), 1.0, height / (t_1 * lag_rate(V, a / k, x)))


define(condition_of_root=_condition)


@cache
def _programs() -> tuple[Program, Program]:
    """Return the calculation of the root with its condition, and of what it depends on."""
    board = RecordingBoard()
    reduced(board)
    lifting_off(board)
    board.calc("_condition", "condition_of_root", "V_t", "a", "k", "_height", "_t_1")
    whole = Program(board.steps)
    return whole.needed_for(("_condition",)), whole.needed_for(("V_t", "k", "_height"))


def rest_of_root(values: Mapping[str, Any]) -> Any:
    """Return what has to be added to t_1 as it is found with sixteen digits: zero almost everywhere.

    Parameters
    ----------
    values : mapping of str to float or array
        The complete givens, with any shapes that go together.
    """
    program, exact = _programs()
    board = ExactBoard(values)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board.follow(program)
    condition, t_1 = np.broadcast_arrays(board.values["_condition"], board.values["_t_1"])
    rest = np.zeros(condition.shape)
    ill = np.argwhere(condition > ILL)
    if not len(ill):
        return rest if rest.ndim else 0.0
    arrays = {name: np.broadcast_to(np.asarray(values[name]), rest.shape) for name in VALUES}
    for index in map(tuple, ill):
        one = {name: float(array[index]) for name, array in arrays.items()}
        rest[index] = _rest(exact, one, float(t_1[index]))
    return rest if rest.ndim else float(rest)


def _rest(program: Program, values: Mapping[str, float], t_1: float) -> float:
    """Return the rest of one root: Newton's steps in a bracket that closes, for the function never falls."""
    from mpmath import mp, mpf

    with mp.workdps(DIGITS):
        found = fifty_digits(program, values)
        V, k, height, a = found["V_t"], found["k"], found["_height"], mpf(values["a"])
        u, x = a / k, k * mpf(t_1)

        def surplus(x: Any) -> tuple[Any, Any]:  # (11) once more: fifty digits cancel without harm, `lag` has but 16
            sine, cosine = x - mp.sin(x), 1 - mp.cos(x)
            return V * sine + u * (x * x / 2 - cosine) - k * height, V * cosine + u * sine

        reach = mpf(BRACKET)
        while surplus(x - reach)[0] > 0 or surplus(x + reach)[0] < 0:
            reach *= 2
        low, high = x - reach, x + reach
        for _ in range(ROUNDS):
            value, slope = surplus(x)
            low, high = (x, high) if value <= 0 else (low, x)
            following = x - value / slope if slope else low
            if not low < following < high:
                following = (low + high) / 2
            if abs(following - x) <= CLOSE * x:
                break
            x = following
        return float(following / k - mpf(t_1))
