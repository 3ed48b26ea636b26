"""Scale factors of the three diagrams: from the stroke that the last curve reaches back to the first one.

Each stands twice: after the exact curve of the law, and, with `_chord`, after the curve of chords as it is drawn.
"""

from __future__ import annotations

from ..board import Board
from .division import Division
from .integration import ACCELERATION, TRAVEL, VELOCITY, foot


def exact_factors(board: Board, given: str) -> None:
    """Calculate the scale factors of the exact curves, and with them what these show."""
    board.calc("_x_rise", "on_axis", "phi_rise", "mu_phi")
    if given == ACCELERATION:
        board.calc("_V_max", "first_integral", "_part_v", "l_A1", "_x_rise", "H_a")
        board.calc("_S_max", "second_integral", "_part_s", "l_A1", "_x_rise", "H_a", "H_v")
    else:
        board.calc("_V_max", "part_of_amplitude", "l_A1", "_part_v")
        board.calc("_S_max", "first_integral", "_part_s", "l_A1", "_x_rise", "H_v")
    _factors(board, given, "_S_max", "")
    board.calc("s_max", "to_scale", "mu_s", "_S_max")
    board.calc("ds_max", "to_scale", "mu_ds", "_V_max")
    board.calc("v_max", "to_scale", "mu_v", "_V_max")
    if given == ACCELERATION:
        board.calc("l_A2", "second_amplitude", "l_A1", "u")
        board.calc("A_1", "to_scale", "mu_d2s", "l_A1")
        board.calc("A_2", "to_scale", "mu_d2s", "l_A2")
        board.calc("_A_max", "part_of_amplitude", "l_A1", "_part_a")
        board.calc("a_max", "to_scale", "mu_a", "_A_max")


def chord_factors(board: Board, division: Division, fastest: int, given: str) -> None:
    """Measure the curves of chords: the stroke, the greatest velocity, by how much they do not close."""
    top, last = division.top, division.last
    board.distance("S_max_chord", foot(TRAVEL, top), f"{TRAVEL}.{top}")
    board.distance("s_close", foot(TRAVEL, last), f"{TRAVEL}.{last}")
    _factors(board, given, "S_max_chord", "_chord")
    if given == ACCELERATION:
        board.distance("V_max_chord", foot(VELOCITY, fastest), f"{VELOCITY}.{fastest}")
        board.distance("v_close", foot(VELOCITY, last), f"{VELOCITY}.{last}")
        board.calc("ds_max_chord", "to_scale", "mu_ds_chord", "V_max_chord")


def _factors(board: Board, given: str, height: str, after: str) -> None:
    board.calc(f"mu_s{after}", "scale_factor", "h", height)
    board.calc(f"mu_ds{after}", "derived_scale", f"mu_s{after}", "mu_phi", "H_v")
    board.calc(f"mu_v{after}", "speed_scale", "omega", f"mu_ds{after}")
    board.calc(f"nu{after}", "transfer_angle", f"mu_s{after}", f"mu_ds{after}")
    if given == ACCELERATION:
        board.calc(f"mu_d2s{after}", "derived_scale", f"mu_ds{after}", "mu_phi", "H_a")
        board.calc(f"mu_a{after}", "acceleration_scale", "omega", f"mu_d2s{after}")
        board.calc(f"nu_a{after}", "transfer_angle", f"mu_ds{after}", f"mu_d2s{after}")
