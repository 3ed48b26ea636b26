"""A hoist up to its lift-off as a construction: masses and stiffnesses reduced, the force of the rope, formula (11)."""

from __future__ import annotations

from ..board import Board
from . import formulas as formulas  # its laws of calculation

BEAMS = (0, 2)  # the support beam and the bridge beam


def reduced(board: Board) -> None:
    """Reduced mass and stiffnesses, formulas (4) to (7)."""
    board.calc("m", "reduced_mass", "G_1", "G_2", "g")
    board.calc("P_st", "static_force", "m", "g")
    for i in BEAMS:
        board.calc(f"alpha_{i}", "place_factor", f"beta_{i}")
        board.calc(f"b_{i}", "product", f"beta_{i}", f"l_{i}")
    board.calc("C_01", "beam_stiffness", "E_0", "I_0", "alpha_0", "l_0")
    board.calc("C_k", "rope_stiffness", "S", "E_k", "L")
    board.calc("C_2", "beam_stiffness", "E_2", "I_2", "alpha_2", "l_2")
    board.calc("C_12", "in_series", "C_k", "C_2")
    board.calc("C", "in_series", "C_01", "C_12")
    board.calc("k", "frequency_between", "C_01", "C_12", "m")
    board.calc("k_1", "frequency", "C_12", "m")
    board.calc("V_t", "taut_speed", "V_0", "a", "slack")


def lifting_off(board: Board) -> None:
    """The end of phase 1, formula (11), and what the rope and the load do there."""
    board.calc("_mu", "support_share", "C_12", "C_01")
    board.calc("_C_osc", "product", "_mu", "C_12")
    board.calc("_height", "ratio", "P_st", "C")
    board.calc("_t_1", "lift_off", "V_t", "a", "k", "_height")
    board.calc("t_1", "later", "_t_1", "_rest")
    rope_force(board, "F_12_t1", "t_1")
    board.calc("_dosc_t1", "oscillation_rate", "V_t", "a", "k", "t_1")
    board.calc("_dy_t1", "winding_speed", "V_t", "a", "t_1")
    board.calc("_dF_t1", "rope_force", "C", "_dy_t1", "_C_osc", "_dosc_t1")


def rope_force(board: Board, name: str, time: str) -> None:
    """The force of the rope in phase 1 at a time: formula (10)."""
    board.calc(f"_y_{name}", "wound", "V_t", "a", time)
    board.calc(f"_osc_{name}", "oscillation", "V_t", "a", "k", time)
    board.calc(name, "rope_force", "C", f"_y_{name}", "_C_osc", f"_osc_{name}")
