"""Profiles by inversion: the cam stands still, and the follower goes round it against the sense of the cam.

On `profile` the line of a follower with a roller touches the circle of the offset in `E1`; `B1` is the roller's centre,
a point of the pitch curve; `P1` the instant centre of cam and follower, through which the normal runs; `K1` where the
roller touches the practical profile. On `plate_profile` `B1` is the plate's centre on its axis, `K1` where it touches.

Source: Artobolevsky, Theory of mechanisms and machines (inversion of motion).
"""

from __future__ import annotations

from ..board import Board
from .division import Division

PROFILE, PLATE_PROFILE = "profile", "plate_profile"


def positions(board: Board, division: Division) -> None:
    """Lay off the phase angles against the sense of the cam; the travels and the analogues of velocity go with them."""
    for i in division.lines:
        board.turn(f"_axis{i}", f"_axis_angle{i}")
        board.normal(f"_left{i}", f"_axis{i}")
        board.calc(f"_s{i}", "part_of_travel", "h", f"_s_part{i}")
        board.calc(f"_x{i}_exact", "part_of_travel", "h", f"_x_part{i}")


def roller_profile(board: Board, division: Division) -> None:
    """Draw the pitch curve and the practical profile of a cam for a roller."""
    centre = f"{PROFILE}.O"
    board.pole(centre)
    for i in division.lines:
        e, b, p, k = (f"{PROFILE}.{letter}{i}" for letter in "EBPK")
        board.back(e, centre, f"_left{i}", "e")
        board.calc(f"_reach{i}", "enlarged", "s_0", f"_s{i}")
        board.lay(b, e, f"_axis{i}", f"_reach{i}")
        board.back(p, centre, f"_left{i}", f"_x{i}_exact")
        board.measure(f"_normal_length{i}", p, b)
        board.direction(f"_normal{i}", p, b, f"_normal_length{i}")
        board.back(k, b, f"_normal{i}", "R_roller")
    board.calc("rho_min", "part_of_travel", "h", "_rho_part")


def plate_profile(board: Board, division: Division) -> None:
    """Draw the plate in all positions and where it touches the profile."""
    centre = f"{PLATE_PROFILE}.O"
    board.pole(centre)
    for i in division.lines:
        b, k = (f"{PLATE_PROFILE}.{letter}{i}" for letter in "BK")
        board.calc(f"_plate_reach{i}", "enlarged", "r_0_flat", f"_s{i}")
        board.lay(b, centre, f"_axis{i}", f"_plate_reach{i}")
        board.back(k, b, f"_left{i}", f"_x{i}_exact")
