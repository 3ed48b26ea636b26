"""The geometry of a gear pair as a construction of calculations only, in the order of a student's note.

Of every wheel's quantities the name ends in its number: d_1 and d_w1. Source: GOST 16532-70.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any

import numpy as np

from ..board import Board, Program, RecordingBoard
from ..boards.exact import ExactBoard
from ..names import role
from . import formulas as formulas  # its laws of calculation
from .gear import WHEELS, ordinate

NAMES = {1: "pinion", 2: "wheel"}
POINTS = tuple(f"{k:02d}" for k in range(1, 13))  # of the table of sliding
# where the points lie: between which of N1, the three places that follow (A1, P, A2 in a common pair), N2, in parts
DIVISIONS = ((0, 2), (1, 3), (2, 2), (3, 4))
PARTS = {f"_part_{j}_{n}": j / n for _, n in DIVISIONS for j in range(n)}
NOTHING = {"_zero": 0.0}


def main_sizes(board: Board) -> None:
    """Sizes of the pair and its wheels: sections 1 to 11 of the note."""
    board.calc("a", "reference_centre", "m", "z_1", "z_2")
    board.calc("x_sum", "sum", "x_1", "x_2")
    board.calc("inv_alpha", "involute", "alpha")
    board.calc("inv_alpha_w", "working_involute", "inv_alpha", "x_sum", "alpha", "z_1", "z_2")
    board.calc("alpha_w", "angle_of_involute", "inv_alpha_w")
    board.calc("a_w", "working_centre", "a", "alpha", "alpha_w")
    for i in WHEELS:
        board.calc(f"d_{i}", "reference_diameter", "m", f"z_{i}")
    board.calc("u", "gear_ratio", "z_1", "z_2")
    for i in WHEELS:
        board.calc(f"d_w{i}", f"rolling_diameter_of_{NAMES[i]}", "a_w", "u")
    board.calc("y", "perceived_shift", "a_w", "a", "m")
    board.calc("delta_y", "excess", "x_sum", "y")
    for i in WHEELS:
        board.calc(f"d_a{i}", "tip_diameter", f"d_{i}", "h_a", f"x_{i}", "delta_y", "m")
    for i in WHEELS:
        board.calc(f"d_f{i}", "root_diameter", f"d_{i}", "h_a", "c", f"x_{i}", "m")


def centre_again(board: Board) -> None:
    """The distance of the centres in four other ways: section 12."""
    board.calc("a_w_rolling", "centre_by_rolling", "d_w1", "d_w2")
    board.calc("a_w_shift", "centre_by_shift", "d_1", "d_2", "y", "m")
    board.calc("a_w_tip1", "centre_by_clearance", "d_a1", "d_f2", "c", "m")
    board.calc("a_w_tip2", "centre_by_clearance", "d_a2", "d_f1", "c", "m")


def auxiliary_sizes(board: Board) -> None:
    """Pitches, thicknesses, angles and curvatures: sections 13 to 21."""
    for i in WHEELS:
        board.calc(f"d_b{i}", "base_diameter", f"d_{i}", "alpha")
        board.calc(f"tau_{i}", "angular_pitch", f"z_{i}")
        board.calc(f"P_{i}", "pitch_chord", f"d_{i}", f"tau_{i}")
    board.calc("p", "pitch", "m")
    for i in WHEELS:
        board.calc(f"s_{i}", "tooth_thickness", "m", f"x_{i}", "alpha")
        board.calc(f"e_{i}", "excess", "p", f"s_{i}")
        board.calc(f"s_w{i}", "thickness_at", f"d_w{i}", f"s_{i}", f"d_{i}", "inv_alpha", "inv_alpha_w")
    board.calc("h", "tooth_depth", "h_a", "c", "delta_y", "m")
    for i in WHEELS:
        board.calc(f"alpha_a{i}", "tip_angle", f"d_b{i}", f"d_a{i}")
    for i, mate in zip(WHEELS, reversed(WHEELS), strict=True):
        board.calc(f"rho_p{i}", "lower_curvature", "a_w", "alpha_w", f"d_b{mate}", f"alpha_a{mate}")
        board.calc(f"nu_p{i}", "unrolled_angle", f"rho_p{i}", f"d_b{i}")
        board.calc(f"d_p{i}", "diameter_of_curvature", f"rho_p{i}", f"d_b{i}")
    board.calc("p_b", "base_pitch", "p", "alpha")


def quality(board: Board) -> None:
    """What the pair is judged by: sections IV and V."""
    for i in WHEELS:
        board.calc(f"x_min{i}", "least_shift", "h_l", "h_a", f"z_{i}", "alpha")
        board.calc(f"rho_l{i}", "boundary_curvature", f"d_{i}", "alpha", "h_l", "h_a", f"x_{i}", "m")
    board.calc("epsilon_alpha", "contact_ratio", "z_1", "alpha_a1", "z_2", "alpha_a2", "alpha_w")
    for i in WHEELS:
        board.calc(f"s_a{i}", "tip_thickness", "m", f"z_{i}", f"x_{i}", "alpha", f"alpha_a{i}")
        board.calc(f"rho_a{i}", "radius_of_curvature", f"d_b{i}", f"alpha_a{i}")
    for end, first, second in (("A1", "rho_p1", "rho_a2"), ("A2", "rho_a1", "rho_p2")):
        board.calc(f"theta_12_{end}", "sliding_of_pinion", first, second, "u")
        board.calc(f"theta_21_{end}", "sliding_of_wheel", second, first, "u")


def action(board: Board) -> None:
    """The line of action with its active part, its parts before and after the pole, and the angles of action."""
    board.calc("l_N1N2", "line_of_action", "a_w", "alpha_w")
    for i in WHEELS:
        board.calc(f"rho_w{i}", "radius_of_curvature", f"d_b{i}", "alpha_w")
    board.calc("g_alpha", "excess", "rho_a1", "rho_p1")
    board.calc("g_f", "excess", "rho_a2", "rho_w2")
    board.calc("g_a", "excess", "rho_a1", "rho_w1")
    for i in WHEELS:
        board.calc(f"phi_alpha{i}", "unrolled_angle", "g_alpha", f"d_b{i}")


def measures(board: Board) -> None:
    """What a tooth is measured by: constant chord with its height, common normal; and the corner of the rack."""
    for i in WHEELS:
        board.calc(f"s_c{i}", "constant_chord", "m", f"x_{i}", "alpha")
        board.calc(f"h_c{i}", "height_of_chord", f"d_a{i}", f"d_{i}", f"s_c{i}", "alpha")
    for i in WHEELS:
        board.calc(f"s_b{i}", "base_thickness", f"s_{i}", f"d_{i}", "inv_alpha", f"d_b{i}")
        board.calc(f"_z_W{i}", "spanned_teeth", f"z_{i}", f"x_{i}", "alpha")
        board.calc(f"z_W{i}", "teeth_touched", f"_z_W{i}", f"rho_p{i}", f"rho_a{i}", f"s_b{i}", "p_b")
        board.calc(f"W_{i}", "common_normal", f"s_b{i}", "p_b", f"z_W{i}")
    board.calc("rho_f", "rack_corner", "h_a", "h_l", "c", "alpha", "m")


def sliding_places(board: Board) -> None:
    """Twelve points of N1N2: their distances from both ends."""
    ends = ("_rho_at_A1", "rho_w1", "_rho_at_A2")
    board.calc("_rho_at_A1", "within_line", "rho_p1", "l_N1N2")
    board.calc("_rho_at_A2", "within_line", "rho_a1", "l_N1N2")
    for k, order in enumerate(("least", "middle", "most"), 1):
        board.calc(f"_rho_mark{k}", f"{order}_of_three", *ends)
    board.calc("_rho_at_P1", "within_line", "rho_w1", "l_N1N2")
    board.calc("_rho_at_P2", "excess", "l_N1N2", "rho_w1")  # so that both ordinates at the pole are equal to the bit
    marks = ("_zero", "_rho_mark1", "_rho_mark2", "_rho_mark3", "l_N1N2")
    places = [(marks[k], marks[k + 1], f"_part_{j}_{n}") for k, n in DIVISIONS for j in range(n)]
    for point, place in zip(POINTS, places, strict=False):
        board.calc(f"_rho_1_{point}", "part_between", *place)
    board.calc(f"_rho_1_{POINTS[-1]}", "sum", "_zero", "l_N1N2")
    for point in POINTS:
        board.calc(f"_rho_2_{point}", "excess", "l_N1N2", f"_rho_1_{point}")


def calculated_sliding(board: Board) -> None:
    """Ordinates of the velocities along the profiles at the twelve points, by proportion, and specific sliding."""
    for point in POINTS:
        for i in WHEELS:
            board.calc(ordinate(i, point), "velocity_ordinate", "PW", f"_rho_{i}_{point}", f"_rho_at_P{i}")
    for point in POINTS:
        for i in WHEELS:
            sliding_at(board, point, i)


def sliding_at(board: Board, point: str, i: int) -> None:
    """Specific sliding of a wheel at a point of the table, by the ordinates."""
    mate = 3 - i
    board.calc(f"theta_{i}{mate}_{point}", "sliding_by_ordinates", f"y_{i}_{point}", f"y_{mate}_{point}")


SIZES = (main_sizes, centre_again, auxiliary_sizes, quality, action, measures)


@cache
def geometry_program() -> Program:
    """Return all calculations, in order, recorded."""
    board = RecordingBoard()
    for part in (*SIZES, sliding_places, calculated_sliding):
        part(board)
    return Program(board.steps)


@cache
def _needed(wanted: tuple[str, ...]) -> Program:
    return geometry_program().needed_for(wanted)


def geometry(values: Mapping[str, Any], wanted: Iterable[str] = ()) -> dict[str, Any]:
    """Return the quantities of a pair by name, in SI, angles in radians, after the givens.

    The `values` are `m z_1 z_2 x_1 x_2 alpha h_a h_l c PW`, of any shapes that go together; the quantities `wanted`, by
    default all, come with those that they need. NaN is what is undefined, such as the angle inside the base circle.
    """
    names = tuple(wanted)
    program = _needed(names) if names else geometry_program()
    board = ExactBoard({**PARTS, **NOTHING, **values})
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        board.follow(program)
    found = {name: board.values[name] for name in (*values, *program.names) if not role(name).hidden}
    return {name: value if np.ndim(value) else float(value) for name, value in found.items()}
