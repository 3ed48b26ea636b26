"""The plans of a cam with a rocker: smallest sizes from its positions, and the profile by inversion.

On `rocker_sizes` the pivot is `0`; `B1` is the roller's centre in a position, `D1` the end of the analogue of its
velocity, laid off along the rocker towards the pivot where it rises against the sense of the cam's turning. A cam's
centre sees `D1` along the normal, so that the line through `D1` at the permitted transmission angle, of the direction
`limit(1)`, bounds where it may lie. `C` is the centre of the smallest cam that all positions permit; `psi_0` the angle
at the pivot between the rocker's lowest position and the line of centres.

On `profile` the pivot goes round the cam against its sense, `A1`; `B1` is the roller's centre, `D1` the same point as
above, seen from the cam, `K1` where the roller touches the practical profile.

Source: Artobolevsky, Theory of mechanisms and machines (cams with an oscillating follower).
"""

from __future__ import annotations

from ..board import Board
from .division import Division
from .inversion import PROFILE
from .size_plans import OUTWARDS

ROCKER_SIZES = "rocker_sizes"


def limit(line: int) -> str:
    """Return the name of the direction of the limit through `D` of a section line."""
    return f"_limit{line}"


def rocker_sizes(board: Board, division: Division) -> None:
    """Draw the rocker in all positions, their limits, and the centre of the smallest cam."""
    board.pole(f"{ROCKER_SIZES}.0")
    for i in division.lines:
        board.turn(f"_arm{i}", f"_swing{i}")
        board.calc(f"_x{i}_arm", "part_of_travel", "l_rocker", f"_analogue{i}")
        b, d = (f"{ROCKER_SIZES}.{letter}{i}" for letter in "BD")
        board.lay(b, f"{ROCKER_SIZES}.0", f"_arm{i}", "l_rocker")
        board.back(d, b, f"_arm{i}", f"_x{i}_arm")
        if i in division.rise or i in division.fall:
            board.turn(limit(i), f"_limit_angle{i}")
    for name, part in (("_centre_x", "_centre_x_part"), ("_centre_y", "_centre_y_part")):
        board.calc(name, "part_of_travel", "l_rocker", part)
    board.place(f"{ROCKER_SIZES}.C", "_centre_x", "_centre_y")
    board.distance("r_0", f"{ROCKER_SIZES}.C", f"{ROCKER_SIZES}.B0")
    board.distance("l_OC", f"{ROCKER_SIZES}.0", f"{ROCKER_SIZES}.C")
    board.calc("psi_0", "angle_of_triangle", "l_rocker", "l_OC", "r_0")
    for phase in OUTWARDS:
        board.calc(f"gamma_{phase}_min", "given", f"_gamma_{phase}_least")


def rocker_profile(board: Board, division: Division) -> None:
    """Draw the pitch curve and the practical profile."""
    centre = f"{PROFILE}.O"
    board.pole(centre)
    for i in division.lines:
        a, b, d, k = (f"{PROFILE}.{letter}{i}" for letter in "ABDK")
        board.turn(f"_pivot{i}", f"_pivot_angle{i}")
        board.lay(a, centre, f"_pivot{i}", "l_OC")
        board.turn(f"_arm{i}_turned", f"_arm_angle{i}")
        board.lay(b, a, f"_arm{i}_turned", "l_rocker")
        board.back(d, b, f"_arm{i}_turned", f"_x{i}_arm")
        board.measure(f"_normal_length{i}", centre, d)
        board.direction(f"_normal{i}", centre, d, f"_normal_length{i}")
        board.back(k, b, f"_normal{i}", "R_roller")
    board.calc("rho_min", "part_of_travel", "l_rocker", "_rho_part")
