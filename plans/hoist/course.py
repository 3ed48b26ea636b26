"""A hoist over time, by the formulas or by its motion: travel, height, forces, and how far the beams bend."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Board, Program, RecordingBoard
from ..boards.exact import ExactBoard
from ..laws import LAWS, TURN
from ..solved import Columned
from . import formulas as formulas
from .model import rope_force
from .onesided import OneSided

Array = NDArray[np.float64]
# what is known over time, and in what; the forces of both phases are one
COLUMN_UNITS = {"t": "s", "y": "m", "s": "m", "F_01": "N", "F_12": "N", "sigma": "Pa", "w_0": "m", "w_2": "m"}
EMPTY: Mapping[str, Array] = {}
BOTH, ROPE, SUPPORT, NEITHER = ("both", "rope", "support", "neither")  # what bears the load
BEARS = {(True, True): BOTH, (True, False): ROPE, (False, True): SUPPORT, (False, False): NEITHER}  # rope, support


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A hoist at times of shape (N,): columns in SI, and what bears at each."""

    columned: tuple[Columned, ...]
    states: tuple[str, ...]

    @property
    def columns(self) -> dict[str, Array]:
        """Values of the columns by name."""
        return {column.name: column.values for column in self.columned}


def _forces(board: Board) -> None:
    """The forces of both phases at a time, each as if it were in its own."""
    board.calc("_mu", "support_share", "C_12", "C_01")
    board.calc("_C_osc", "product", "_mu", "C_12")
    rope_force(board, "_rope_1", "t")
    board.calc("_lagging", "lagging", "V_t", "a", "k", "t")
    board.calc("_support_1", "support_force", "C", "_lagging", "P_st")
    board.calc("_T", "excess", "t", "t_1")
    board.calc("_swing", "swing", "D_0", "D_1", "k_1", "_T")
    board.calc("_rope_2", "suspended_force", "P_m", "_swing")


def _after(board: Board) -> None:
    """What follows from the force of the rope in either phase."""
    board.calc("y", "wound", "V_t", "a", "t")
    board.calc("s", "height", "y", "P_st", "C_01", "F_12", "C_12")
    board.calc("sigma", "stress", "F_12", "S")
    board.calc("_pressed", "opposite", "F_01")
    board.calc("w_0", "deflection", "_pressed", "C_01")
    board.calc("w_2", "deflection", "F_12", "C_2")


@cache
def _program(part: Callable[[Board], None]) -> Program:
    board = RecordingBoard()
    part(board)
    return Program(board.steps)


def rope_forces(found: Mapping[str, Any], t: Any) -> tuple[Any, Any]:
    """Return the forces of support and rope by the formulas of the phase that each time is in, N.

    Parameters
    ----------
    found : mapping of str to float
        Quantities `V_t a k k_1 C C_01 C_12 P_st P_m D_0 D_1 t_1`, SI.
    t : array
        Times, s.
    """
    board = ExactBoard({**found, "t": t})
    board.follow(_program(_forces))
    resting = t < found["t_1"]
    values = board.values
    return np.where(resting, values["_support_1"], 0.0), np.where(resting, values["_rope_1"], values["_rope_2"])


def course(found: Mapping[str, Any], motion: OneSided | None, t: Array) -> Course:
    """Look at a hoist at times from its beginning on.

    Parameters
    ----------
    found : mapping of str to float
        All its quantities, SI.
    motion : OneSided, optional
        Its motion where the formulas are not valid.
    t : array of shape (N,)
        Times, s, none after the end of the motion.
    """
    if motion is None:
        F_01, F_12 = rope_forces(found, t)
        states = tuple(np.where(t < found["t_1"], BOTH, ROPE).tolist())
        return _course(found, {"t": t, "F_01": F_01, "F_12": F_12}, states)
    F_12, height = (np.array([of(at) for at in t.tolist()]) for of in (motion.force, motion.height))
    last = len(motion.pieces) - 1
    index = np.minimum(np.searchsorted([piece.end for piece in motion.pieces], t, side="right"), last).tolist()
    bearing = [(motion.pieces[i].rope, motion.pieces[i].support) for i in index]
    states = tuple(BEARS[bears] for bears in bearing)
    pressed = np.array([support for _, support in bearing])
    F_01 = np.where(pressed, height, 0.0) * (found["C_01"] if np.isfinite(found["C_01"]) else 0.0)
    return _course(found, {"t": t, "F_01": F_01, "F_12": F_12}, states, {"s": height})


def _course(
    found: Mapping[str, float],
    known: Mapping[str, Array],
    states: tuple[str, ...],
    instead: Mapping[str, Array] = EMPTY,
) -> Course:
    """Return the course that follows from times and forces, with columns that are known better."""
    board = ExactBoard({**found, **known})
    board.follow(_program(_after))
    values = {**board.values, **instead}
    return Course(
        tuple(Columned(name, of, np.asarray(values[name], float)) for name, of in COLUMN_UNITS.items()), states
    )


def end_of(found: Mapping[str, float], motion: OneSided | None) -> float:
    """Return until when a hoist is looked at: one period after the lift-off, or until its motion repeats itself."""
    return found["t_1"] + TURN / found["k_1"] if motion is None else motion.pieces[-1].end


def marks(found: Mapping[str, float], motion: OneSided | None) -> dict[str, float]:
    """Return the times of the lift-off and of the greatest and least forces after it, in order, s."""
    t_1 = found["t_1"]
    if motion is None:
        half = 0.5 * TURN / found["k_1"]
        least = t_1 + found["T_1"] + (half if found["T_1"] < half else -half)
    else:
        least = motion.extremes(lifted=True)[1][0]
    known = {"F_12_max": found["t_F12_max"], "t_1": t_1, "P_12_max": t_1 + found["T_1"], "P_12_min": least}
    return dict(sorted(known.items(), key=lambda mark: mark[1]))


def article_force(found: Mapping[str, Any], T: Any) -> Any:
    """Return the force of the rope at times after the lift-off as the article has it, N.

    Parameters
    ----------
    found : mapping of str to float
        Quantities `m g a V_0 slack P_st C_12 k_1`, SI.
    T : float or array
        s
    """
    V = LAWS["article_speed"](*(found[name] for name in ("V_0", "a", "slack", "P_st", "C_12")))
    return LAWS["article_force"](*(found[name] for name in ("m", "g", "a")), V, found["C_12"], found["k_1"], T)
