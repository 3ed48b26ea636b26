"""The plans from which the smallest sizes are read: the travel over its analogues, in equal scales.

`sizes` shows S over ds/dphi: points `1_rise`, `13_fall` on the section lines, from the curves of chords. On each limit
a tangent runs at the permitted transmission angle from `T_rise`, `T_fall` on the axis; where they meet, in `A`, a cam's
centre has the limits on both sides. `C` is the centre of the smallest cam, `0` the lowest place of the roller's centre.

`plate_sizes` shows S over d2s/dphi2; a tangent at 45 degrees to the negative branch meets the axis of travels in `T`.

Sources: Artobolevsky, Theory of mechanisms and machines (S-ds/dphi diagram); Geronimus (tangent at 45 degrees).
"""

from __future__ import annotations

from collections.abc import Iterable

from ..board import Board
from .division import Division
from .integration import ACCELERATION, RIGHT, TRAVEL, UP, VELOCITY, foot
from .sizes import BACK

SIZES, PLATE_SIZES = "sizes", "plate_sizes"
PHASES = {f"{phase}{end}": phase for phase in ("rise", "fall") for end in ("", BACK)}  # of limits
OUTWARDS = {"rise": 1, "fall": -1}  # to which side of the abscissas a phase lies when the cam turns counter-clockwise


def phase_of(limit: str) -> str:
    """Return the phase that a limit belongs to: `rise` or `fall`, both sides of the normal alike."""
    return PHASES[limit]


def is_back(limit: str) -> bool:
    """Whether a limit is that of the side to which the cam does not push."""
    return PHASES[limit] != limit


def side_of(limit: str, sense: int) -> int:
    """Return the side of the abscissas, +1 or -1, on which the tangent of a limit lies."""
    return OUTWARDS[phase_of(limit)] * sense * (-1 if is_back(limit) else 1)


def ordinates(board: Board, division: Division, given: str) -> None:
    """Read the curves on every section line, as values: a velocity that is given, because it jumps, in both phases."""
    for i in division.lines:
        _ordinate(board, TRAVEL, f"_s{i}_drawn", "mu_s_chord", i)
        if given == ACCELERATION:
            _ordinate(board, VELOCITY, f"_ds{i}_drawn", "mu_ds_chord", i)
    for phase, lines in (("rise", division.rise), ("fall", division.fall)):
        for i in lines:
            analogue = f"_ds{i}_drawn"
            if given == VELOCITY:
                analogue = f"_ds{i}_{phase}_drawn"
                board.calc(f"_height{i}_{phase}", "part_of_amplitude", "l_A1", f"_node{i}_{phase}")
                board.calc(analogue, "to_scale", "mu_ds_chord", f"_height{i}_{phase}")
            board.calc(f"_x{i}_{phase}_drawn", "turned_with", analogue, "_sense")


def _ordinate(board: Board, plan: str, name: str, mu: str, line: int) -> None:
    board.read(f"{name}_segment", foot(plan, line), f"{plan}.{line}")
    board.calc(name, "ordinate_to_scale", mu, UP, f"{name}_segment")


def roller_sizes(board: Board, division: Division, limits: Iterable[str], corner: Iterable[str]) -> None:
    """Draw S over ds/dphi, the limit tangents, and a cam's centre where the two of `corner` meet.

    Limits are named as the half planes of `sizes.wedge`.
    """
    board.pole(f"{SIZES}.0")
    for phase, lines in (("rise", division.rise), ("fall", division.fall)):
        for i in lines:
            board.place(f"{SIZES}.{i}_{phase}", f"_x{i}_{phase}_drawn", f"_s{i}_drawn")
    for limit in limits:
        slope, side, at = (f"_{word}_{limit}" for word in ("slope", "side", "touch"))
        pieces = division.pieces(phase_of(limit))
        for k, piece in enumerate(pieces):
            coordinates = (*(f"_x{i}_{phase_of(limit)}_drawn" for i in piece), *(f"_s{i}_drawn" for i in piece))
            board.calc(f"{at}{k}", "touching", slope, side, *coordinates)
        board.calc(at, "outermost", side, *(f"{at}{k}" for k in range(len(pieces))))
        board.place(f"{SIZES}.T_{limit}", at, "zero")
        board.turn(f"_tangent_{limit}", f"_inclination_{limit}")
    tangents = [operand for limit in corner for operand in (f"{SIZES}.T_{limit}", f"_tangent_{limit}")]
    board.meet(f"{SIZES}.A", *tangents)
    board.distance("r_0_tangents", f"{SIZES}.0", f"{SIZES}.A")
    board.read("_centre", f"{SIZES}.0", f"{SIZES}.A")
    board.calc("e_tangents", "component", RIGHT, "_centre")


def smallest_roller_cam(board: Board) -> None:
    """Mark the centre of the smallest cam that the exact curves permit."""
    board.calc("e", "part_of_travel", "h", "_e_part")
    board.calc("s_0", "part_of_travel", "h", "_s_0_part")
    board.calc("_below", "negative", "s_0")
    board.pole(f"{SIZES}.0")
    board.place(f"{SIZES}.C", "e", "_below")
    board.distance("r_0", f"{SIZES}.0", f"{SIZES}.C")
    for phase in OUTWARDS:
        board.calc(f"gamma_{phase}_min", "given", f"_gamma_{phase}_least")


def permitted_offsets(board: Board) -> None:
    """Calculate between which offsets a given r_0 keeps the limits."""
    board.calc("e_least", "part_of_travel", "h", "_e_least")
    board.calc("e_most", "part_of_travel", "h", "_e_most")


def plate_sizes(board: Board, division: Division) -> None:
    """Draw S over d2s/dphi2 and the tangent at 45 degrees to its negative branch."""
    board.pole(f"{PLATE_SIZES}.0")
    for i in division.lines:
        for end in ("before", "after"):  # where it jumps, the two ends of a line across
            board.calc(f"_d2s{i}_{end}", "part_of_amplitude", "A_1", f"_part{i}_{end}")
            board.place(f"{PLATE_SIZES}.{i}_{end}", f"_d2s{i}_{end}", f"_s{i}_drawn")
    places: list[str] = []
    for phase in OUTWARDS:
        for k, piece in enumerate(division.pieces(phase)):
            ends = ["after", *["before"] * (len(piece) - 1)]
            xs = [f"_d2s{i}_{end}" for i, end in zip(piece, ends, strict=True)]
            places.append(f"_touch_plate_{phase}{k}")
            board.calc(places[-1], "touching", "_minus_one", "_minus_one", *xs, *(f"_s{i}_drawn" for i in piece))
    board.calc("_touch_plate", "outermost", "_minus_one", *places)
    board.place(f"{PLATE_SIZES}.T", "zero", "_touch_plate")
    board.distance("r_0_flat_tangent", f"{PLATE_SIZES}.0", f"{PLATE_SIZES}.T")


def smallest_plate_cam(board: Board, given: bool) -> None:
    """Calculate the smallest cam for a plate, or how sharp that of a given r_0 is, and the plate."""
    board.calc("r_0_flat_min", "part_of_travel", "h", "_r_0_flat_part")
    if given:
        board.calc("rho_flat_min", "excess", "r_0_flat", "r_0_flat_min")
    else:
        board.calc("r_0_flat", "enlarged", "r_0_flat_min", "rho_flat")
    board.calc("R_plate", "enlarged", "ds_max", "margin")
