"""The whole construction of a cam: diagrams with scale factors, plans of the smallest sizes, profiles by inversion.

Scale factors of the three diagrams go from the stroke that the last curve reaches back to the first one. Each stands
twice: after the exact curve of the law, and, with `_chord`, after the curve of chords as it is drawn.

The smallest sizes are read from plans of the travel over its analogues, in equal scales.

`sizes` shows S over ds/dphi, to the side to which a velocity upwards turns by a right angle with the cam, so that the
cam's centre lies there as on `profile`: points `1_rise`, `13_fall` on the section lines, from the curves of chords. On
each limit a tangent runs at the permitted transmission angle from `T_rise`, `T_fall` on the axis; where they meet, in
`A`, a cam's centre has the limits on both sides. `C` is the centre of the smallest cam, `0` the lowest place of the
roller's centre.

`plate_sizes` shows S over d2s/dphi2; a tangent at 45 degrees to the negative branch meets the axis of travels in `T`.

By inversion the cam stands still, and the follower goes round it against the sense of the cam.

On `profile` the line of a follower with a roller touches the circle of the offset in `E1`; `B1` is the roller's centre,
a point of the pitch curve; `P1` the instant centre of cam and follower, through which the normal runs; `K1` where the
roller touches the practical profile. On `plate_profile` `B1` is the plate's centre on its axis, `K1` where it touches.

A rocker has both of its own.

On `rocker_sizes` the pivot is `0`; `B1` is the roller's centre in a position, `D1` the end of the analogue of its
velocity, laid off along the rocker towards the pivot where it rises against the sense of the cam's turning. A cam's
centre sees `D1` along the normal, so that the line through `D1` at the permitted transmission angle, of the direction
`_limit1`, bounds where it may lie. `C` is the centre of the smallest cam that all positions permit; `psi_0` the angle
at the pivot between the rocker's lowest position and the line of centres.

On its `profile` the pivot goes round the cam against its sense, `A1`; `B1` is the roller's centre, `D1` the same point
as above, seen from the cam, `K1` where the roller touches the practical profile. Graphical integration by chords leads
from acceleration to velocity, to the travel. Three diagrams stand on one axis of angles, divided into sections. The
mean ordinate of every section is projected on the ordinate axis and joined to a pole at the distance H to the left of
it; on the next diagram the chord of the section is drawn parallel to that ray, from the end of the chord before it to
the next section line. All of it is drawn in millimetres of paper: scale factors come from it, not before it.

Marks, on the plans `diagram_a`, `diagram_v`, `diagram_s`: `0` the origin, where the curve begins; `1`, `2`, ... the
nodes of the curve on the section lines; `f1` the foot of a section line; on a diagram that is integrated `O` the pole,
`m1` the mean ordinate of the first section, `p1` its projection; `_ray(plan, 1)` names the direction of the ray.

Lengths on paper are metres of paper; scale factors are values in SI per millimetre.

Sources: Artobolevsky, Theory of mechanisms and machines (S-ds/dphi diagram, inversion of motion, cams with an
oscillating follower, method of chords); Geronimus (tangent at 45 degrees).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..board import Board, Program, RecordingBoard, with_needs
from ..laws import Sign, as_number, bracketed, define, dot
from ..names import Name
from .cam import DIAGRAMS_PART, PLANS, PRESSURE_PART, PROFILE_PART, SIZES_PART
from .followers import PlateCam, RollerCam
from .motion import FALL, RISE, Division

MM_PER_M = Sign(1e3, "")  # millimetres in a metre of paper, in which lengths on it are printed
ARC = "arc_length"  # the law of the stroke of a rocker
SHARPEST = "sharpest"  # the law of the least radius of curvature


def _touching(slope: Any, side: Any, *coordinates: Any) -> Any:
    """Return where a line that touches a smooth curve from the side +1 or -1 of the abscissas meets their axis.

    Along the line the abscissa grows by `slope` times the ordinate. `coordinates` are the abscissas of the points, then
    their ordinates; the curve through the outermost point and its neighbours is a parabola.
    """
    half = len(coordinates) // 2
    pairs = zip(coordinates[:half], coordinates[half:], strict=True)
    out = np.stack(np.broadcast_arrays(*(side * (x - slope * y) for x, y in pairs)))
    most = np.max(out, axis=0)
    if half > 2:
        middle = np.clip(np.argmax(out, axis=0), 1, half - 2)[np.newaxis]
        before, here, after = (np.take_along_axis(out, middle + k, axis=0)[0] for k in (-1, 0, 1))
        bend, rise = 2.0 * here - before - after, 0.5 * (after - before)
        inside = np.abs(rise) < bend  # else the outermost point is an end of the curve
        most = np.where(inside, here + 0.5 * rise * rise / np.where(inside, bend, 1.0), most)
    return as_number(most) * side


def _sharpest(stroke: Any, e: Any, s_0: Any, *parts: Any) -> Any:
    """Return the least radius of curvature of a roller's pitch curve on its section lines, where it is convex.

    `parts` are all s, then all s' with the sense of turning, then all s'', in parts of the stroke. The roller's centre
    is e + i (s_0 + s) on paper that turns with the cam.
    """
    deep = max(np.ndim(size) for size in (stroke, e, s_0))
    s, ds, d2s = stroke * np.array(parts).reshape(3, -1, *(1,) * deep)
    up, aside = s_0 + s, ds - e
    bend = up * (up - d2s) + aside * (aside + ds)
    convex = bend > 0.0
    radii = np.where(convex, np.sqrt(up * up + aside * aside) ** 3 / np.where(convex, bend, 1.0), np.inf)
    return as_number(np.min(radii, axis=0))


define(
    # the travel of a rocker's roller
    arc_length=(
        lambda angle, radius: angle * radius,
        lambda angle, radius: bracketed(angle / Sign(math.pi, "180")) * math.pi * radius,
    ),
    # both lobes have the same area
    second_amplitude=lambda amplitude, u: amplitude * u / (1.0 - u),
    on_axis=lambda angle, mu: angle / (mu * MM_PER_M),
    # an ordinate of the given diagram is a part of its amplitude
    part_of_amplitude=lambda amplitude, part: amplitude * part,
    # greatest ordinates of the curves drawn after a law: parts of A * x / H_a and of A * x^2 / (H_a * H_v)
    first_integral=lambda part, amplitude, length, pole: part * amplitude * length / pole,
    second_integral=lambda part, amplitude, length, pole, other: part * amplitude * length * length / (pole * other),
    scale_factor=lambda value, length: value / (length * MM_PER_M),
    # mu_ds and mu_d2s
    derived_scale=lambda mu, mu_axis, pole: mu / (mu_axis * pole * MM_PER_M),
    # mu_v and mu_a
    speed_scale=lambda omega, mu: omega * mu,
    acceleration_scale=lambda omega, mu: omega * omega * mu,
    to_scale=lambda mu, length: mu * length * MM_PER_M,
    ordinate_to_scale=lambda mu, up, segment: dot(up, segment) * mu * MM_PER_M,
    # tg nu = mu_s / mu_ds
    transfer_angle=lambda opposite, adjacent: as_number(np.arctan2(opposite, adjacent)),
    # a size of a mechanism is proportional to the travel
    part_of_travel=lambda travel, part: travel * part,
    # where a tangent of a given direction meets the axis: of every smooth piece, and of the whole curve
    touching=_touching,
    outermost=lambda side, *places: (
        as_number(np.max(np.stack(np.broadcast_arrays(*(side * place for place in places))), axis=0)) * side
    ),
    # on the S-ds/dphi diagram: the abscissa of a velocity upwards that is turned by a right angle with the cam
    turned_with=lambda analogue, sense: -analogue * sense,
    negative=lambda value: -value,
    # the angle between the sides a and b; sides in one line may be off by rounding
    angle_of_triangle=(
        lambda a, b, opposite: as_number(
            np.arccos(np.clip((a * a + b * b - opposite * opposite) / (2.0 * a * b), -1.0, 1.0))
        ),
        lambda a, b, opposite: np.arccos((a * a + b * b - opposite * opposite) / (2.0 * a * b)),
    ),
    # rho_min = |v|^3 / (v x v'), v and v' being the derivatives of the roller's centre by the angle of the cam
    **{SHARPEST: _sharpest},
    # R = |ds/dphi|max + 5..8 mm, r_0 = r_0min + rho_min
    enlarged=lambda size, margin: size + margin,
)

ACCELERATION, VELOCITY, TRAVEL = "diagram_a", "diagram_v", "diagram_s"
DIAGRAMS = (ACCELERATION, VELOCITY, TRAVEL)
RIGHT, UP = "_right", "_up"


def _foot(plan: str, line: int) -> str:
    """Return the mark where a section line meets the axis of angles."""
    return f"{plan}.f{line}" if line else f"{plan}.0"


def _ray(plan: str, section: int) -> str:
    """Return the name of the direction of a section's ray on the diagram that is integrated."""
    return f"_{plan}_ray{section}"


def _mean(section: int) -> Name:
    """Return the name of the mean ordinate of a section on the given diagram."""
    return Name(f"_mean{section}", "mean", str(section))


def _integrate(board: Board, plan: str, onto: str, pole_distance: str, sections: Iterable[int]) -> None:
    """Integrate the diagram `plan`, whose mean ordinates are marked, by chords onto the diagram `onto`."""
    origin, pole = f"{plan}.0", f"{plan}.O"
    board.back(pole, origin, RIGHT, pole_distance)
    for i in sections:
        projection, length = f"{plan}.p{i}", f"_{plan}_l{i}"
        board.meet(projection, f"{plan}.m{i}", RIGHT, origin, UP)
        board.measure(length, pole, projection)
        board.direction(_ray(plan, i), pole, projection, length)
        board.meet(f"{onto}.{i}", f"{onto}.{i - 1}", _ray(plan, i), _foot(onto, i), UP)


def _diagrams(board: Board, sections: range, given: str) -> None:
    """Draw the diagrams from the one that is given on: the analogue of acceleration, or that of velocity."""
    board.turn(RIGHT, "zero")
    board.normal(UP, RIGHT)
    for plan in DIAGRAMS[DIAGRAMS.index(given) :]:
        board.pole(f"{plan}.0")
        for i in sections:
            board.calc(f"_x{i}", "on_axis", f"_phi{i}", "mu_phi")
            board.lay(_foot(plan, i), f"{plan}.0", RIGHT, f"_x{i}")
    for i in sections:  # mean ordinates, each in the middle of its section
        board.calc(f"_middle{i}", "on_axis", f"_phi_middle{i}", "mu_phi")
        board.calc(_mean(i), "part_of_amplitude", "l_A1", f"_part{i}")
        board.place(f"{given}.m{i}", f"_middle{i}", _mean(i))
    if given == ACCELERATION:
        _integrate(board, ACCELERATION, VELOCITY, "H_a", sections)
        for i in sections:  # of a curve of chords they are the middles of the chords
            board.divide(f"{VELOCITY}.m{i}", f"{VELOCITY}.{i - 1}", f"{VELOCITY}.{i}", "one", "_two")
    _integrate(board, VELOCITY, TRAVEL, "H_v", sections)


# scale factors and angles of transfer: the law and what it takes; the last ones where the acceleration is given
FACTORS = {
    "mu_s": ("scale_factor", "h", "S_max"),
    "mu_ds": ("derived_scale", "mu_s", "mu_phi", "H_v"),
    "mu_v": ("speed_scale", "omega", "mu_ds"),
    "nu": ("transfer_angle", "mu_s", "mu_ds"),
    "mu_d2s": ("derived_scale", "mu_ds", "mu_phi", "H_a"),
    "mu_a": ("acceleration_scale", "omega", "mu_d2s"),
    "nu_a": ("transfer_angle", "mu_ds", "mu_d2s"),
}
OF_ACCELERATION = ("mu_d2s", "mu_a", "nu_a")
# what is found from curves of chords, and what it stands for
EXACT_OF = {f"{name}_chord": name for name in (*FACTORS, "S_max", "V_max", "ds_max")}
CHORD_OF = {exact: name for name, exact in EXACT_OF.items()}
EXACT = {"S_max": "_S_max", "V_max": "_V_max"}  # what the greatest ordinates of the exact curves are called


def _factors(board: Board, given: str, called: Mapping[str, str]) -> None:
    """Calculate them from the stroke on the diagram; what is `called` otherwise has that name."""
    for name, (law, *operands) in FACTORS.items():
        if given == ACCELERATION or name not in OF_ACCELERATION:
            board.calc(called.get(name, name), law, *(called.get(operand, operand) for operand in operands))


def _exact_factors(board: Board, given: str) -> None:
    """Calculate the scale factors of the exact curves, and with them what these show."""
    board.calc("_x_rise", "on_axis", "phi_rise", "mu_phi")
    if given == ACCELERATION:
        board.calc("_V_max", "first_integral", "_part_v", "l_A1", "_x_rise", "H_a")
        board.calc("_S_max", "second_integral", "_part_s", "l_A1", "_x_rise", "H_a", "H_v")
    else:
        board.calc("_V_max", "part_of_amplitude", "l_A1", "_part_v")
        board.calc("_S_max", "first_integral", "_part_s", "l_A1", "_x_rise", "H_v")
    _factors(board, given, EXACT)
    board.calc("s_max", "to_scale", "mu_s", "_S_max")
    board.calc("ds_max", "to_scale", "mu_ds", "_V_max")
    board.calc("v_max", "to_scale", "mu_v", "_V_max")
    if given == ACCELERATION:
        board.calc("l_A2", "second_amplitude", "l_A1", "u")
        board.calc("A_1", "to_scale", "mu_d2s", "l_A1")
        board.calc("A_2", "to_scale", "mu_d2s", "l_A2")
        board.calc("_A_max", "part_of_amplitude", "l_A1", "_part_a")
        board.calc("a_max", "to_scale", "mu_a", "_A_max")


def _chord_factors(board: Board, division: Division, fastest: int, given: str) -> None:
    """Measure the curves of chords: the stroke, the greatest velocity, by how much they do not close."""
    _height(board, "S_max_chord", TRAVEL, division.top)
    _height(board, "s_close", TRAVEL, division.last)
    _factors(board, given, CHORD_OF)
    if given == ACCELERATION:
        _height(board, "V_max_chord", VELOCITY, fastest)
        _height(board, "v_close", VELOCITY, division.last)
        board.calc("ds_max_chord", "to_scale", "mu_ds_chord", "V_max_chord")


def _height(board: Board, name: str, plan: str, line: int) -> None:
    board.distance(name, _foot(plan, line), f"{plan}.{line}")


PROFILE, PLATE_PROFILE = "profile", "plate_profile"


def _rolling_profile(board: Board, division: Division, rocks: bool) -> None:
    """Draw the pitch curve and the practical profile of a cam for a roller, on a line or on a rocker."""
    board.pole(f"{PROFILE}.O")
    for i in division.lines:
        a, b, d, e, k, p = (f"{PROFILE}.{letter}{i}" for letter in "ABDEKP")
        if rocks:
            board.turn(f"_pivot{i}", f"_pivot_angle{i}")
            board.lay(a, f"{PROFILE}.O", f"_pivot{i}", "l_OC")
            board.turn(f"_arm{i}_turned", f"_arm_angle{i}")
            board.lay(b, a, f"_arm{i}_turned", "l_rocker")
            board.back(d, b, f"_arm{i}_turned", f"_x{i}_arm")
        else:
            board.back(e, f"{PROFILE}.O", f"_left{i}", "e")
            board.calc(f"_reach{i}", "enlarged", "s_0", f"_s{i}")
            board.lay(b, e, f"_axis{i}", f"_reach{i}")
            board.back(p, f"{PROFILE}.O", f"_left{i}", f"_x{i}_exact")
        normal = (f"{PROFILE}.O", d) if rocks else (p, b)
        board.measure(f"_normal_length{i}", *normal)
        board.direction(f"_normal{i}", *normal, f"_normal_length{i}")
        board.back(k, b, f"_normal{i}", "R_roller")
    board.calc("rho_min", "part_of_travel", "l_rocker" if rocks else "h", "_rho_part")


def _plate_profile(board: Board, division: Division) -> None:
    """Draw the plate in all positions and where it touches the profile."""
    board.pole(f"{PLATE_PROFILE}.O")
    for i in division.lines:
        board.calc(f"_plate_reach{i}", "enlarged", "r_0_flat", f"_s{i}")
        board.lay(f"{PLATE_PROFILE}.B{i}", f"{PLATE_PROFILE}.O", f"_axis{i}", f"_plate_reach{i}")
        board.back(f"{PLATE_PROFILE}.K{i}", f"{PLATE_PROFILE}.B{i}", f"_left{i}", f"_x{i}_exact")


SIZES, PLATE_SIZES, ROCKER_SIZES = "sizes", "plate_sizes", "rocker_sizes"


def _ordinates(board: Board, division: Division, given: str) -> None:
    """Read the curves on every section line, as values: a velocity that is given, because it jumps, in both phases."""
    curves = {TRAVEL: ("_s", "mu_s_chord")} | ({VELOCITY: ("_ds", "mu_ds_chord")} if given == ACCELERATION else {})
    for i in division.lines:
        for plan, (letter, mu) in curves.items():
            name = f"{letter}{i}_drawn"
            board.read(f"{name}_segment", _foot(plan, i), f"{plan}.{i}")
            board.calc(name, "ordinate_to_scale", mu, UP, f"{name}_segment")
    for i, phase in division.on_lines:
        analogue = f"_ds{i}_drawn"
        if given == VELOCITY:
            analogue = f"_ds{i}_{phase}_drawn"
            board.calc(f"_height{i}_{phase}", "part_of_amplitude", "l_A1", f"_node{i}_{phase}")
            board.calc(analogue, "to_scale", "mu_ds_chord", f"_height{i}_{phase}")
        board.calc(f"_x{i}_{phase}_drawn", "turned_with", analogue, "_sense")


def _roller_sizes(board: Board, division: Division, cam: RollerCam) -> None:
    """Draw S over ds/dphi with the limit tangents; mark where two of them meet, and the centre of the cam.

    It is the smallest cam that the exact curves permit, or that of a given r_0, with its range.
    """
    board.pole(f"{SIZES}.0")
    for i, phase in division.on_lines:
        board.place(f"{SIZES}.{i}_{phase}", f"_x{i}_{phase}_drawn", f"_s{i}_drawn")
    for limit in cam.limits.each:
        slope, side, at = (f"_{word}_{limit.name}" for word in ("slope", "side", "touch"))
        pieces = division.pieces(limit.phase)
        for k, piece in enumerate(pieces):
            coordinates = (*(f"_x{i}_{limit.phase}_drawn" for i in piece), *(f"_s{i}_drawn" for i in piece))
            board.calc(f"{at}{k}", "touching", slope, side, *coordinates)
        board.calc(at, "outermost", side, *(f"{at}{k}" for k in range(len(pieces))))
        board.place(f"{SIZES}.T_{limit.name}", at, "zero")
        board.turn(f"_tangent_{limit.name}", f"_inclination_{limit.name}")
    tangents = [operand for name in cam.by_tangents.on for operand in (f"{SIZES}.T_{name}", f"_tangent_{name}")]
    board.meet(f"{SIZES}.A", *tangents)
    board.distance("r_0_tangents", f"{SIZES}.A", f"{SIZES}.0")
    board.read("_centre", f"{SIZES}.A", f"{SIZES}.0")
    board.calc("e_tangents", "component", RIGHT, "_centre")
    board.calc("e", "part_of_travel", "h", "_e_part")
    board.calc("s_0", "part_of_travel", "h", "_s_0_part")
    board.calc("_beside", "negative", "e")
    board.calc("_below", "negative", "s_0")
    board.pole(f"{SIZES}.0")
    board.place(f"{SIZES}.C", "_beside", "_below")
    board.distance("r_0", f"{SIZES}.0", f"{SIZES}.C")
    _least_angles(board)
    for end in ("e_least", "e_most") if cam.offsets else ():
        board.calc(end, "part_of_travel", "h", f"_{end}")


def _least_angles(board: Board) -> None:
    for phase in (RISE, FALL):
        board.calc(f"gamma_{phase}_min", "given", f"_gamma_{phase}_least")


def _plate_sizes(board: Board, division: Division, given: bool) -> None:
    """Draw S over d2s/dphi2 and the tangent at 45 degrees to its negative branch.

    Calculate the smallest cam for a plate, or how sharp that of a `given` r_0 is, and the plate.
    """
    board.pole(f"{PLATE_SIZES}.0")
    for i in division.lines:
        for end in ("before", "after"):  # where it jumps, the two ends of a line across
            board.calc(f"_d2s{i}_{end}", "part_of_amplitude", "A_1", f"_part{i}_{end}")
            board.place(f"{PLATE_SIZES}.{i}_{end}", f"_d2s{i}_{end}", f"_s{i}_drawn")
    places: list[str] = []
    for phase in (RISE, FALL):
        for k, piece in enumerate(division.pieces(phase)):
            ends = ["after", *["before"] * (len(piece) - 1)]
            xs = [f"_d2s{i}_{end}" for i, end in zip(piece, ends, strict=True)]
            places.append(f"_touch_plate_{phase}{k}")
            board.calc(places[-1], "touching", "_minus_one", "_minus_one", *xs, *(f"_s{i}_drawn" for i in piece))
    board.calc("_touch_plate", "outermost", "_minus_one", *places)
    board.place(f"{PLATE_SIZES}.T", "zero", "_touch_plate")
    board.distance("r_0_flat_tangent", f"{PLATE_SIZES}.0", f"{PLATE_SIZES}.T")
    board.calc("r_0_flat_min", "part_of_travel", "h", "_r_0_flat_part")
    if given:
        board.calc("rho_flat_min", "excess", "r_0_flat", "r_0_flat_min")
    else:
        board.calc("r_0_flat", "enlarged", "r_0_flat_min", "rho_flat")
    board.calc("R_plate", "enlarged", "ds_max", "margin")


def _rocker_sizes(board: Board, division: Division) -> None:
    """Draw the rocker in all positions, their limits, and the centre of the smallest cam."""
    board.pole(f"{ROCKER_SIZES}.0")
    for i in division.lines:
        board.turn(f"_arm{i}", f"_swing{i}")
        board.calc(f"_x{i}_arm", "part_of_travel", "l_rocker", f"_analogue{i}")
        b, d = (f"{ROCKER_SIZES}.{letter}{i}" for letter in "BD")
        board.lay(b, f"{ROCKER_SIZES}.0", f"_arm{i}", "l_rocker")
        board.back(d, b, f"_arm{i}", f"_x{i}_arm")
        if i in division.rise or i in division.fall:
            board.turn(f"_limit{i}", f"_limit_angle{i}")
    for name in ("_centre_x", "_centre_y"):
        board.calc(name, "part_of_travel", "l_rocker", f"{name}_part")
    board.place(f"{ROCKER_SIZES}.C", "_centre_x", "_centre_y")
    board.distance("r_0", f"{ROCKER_SIZES}.C", f"{ROCKER_SIZES}.B0")
    board.distance("l_OC", f"{ROCKER_SIZES}.0", f"{ROCKER_SIZES}.C")
    board.calc("psi_0", "angle_of_triangle", "l_rocker", "l_OC", "r_0")
    _least_angles(board)


NEEDS = {DIAGRAMS_PART: (), SIZES_PART: (DIAGRAMS_PART,), PROFILE_PART: (SIZES_PART,), PRESSURE_PART: (SIZES_PART,)}


@dataclass(frozen=True, slots=True)
class Layout:
    """What the construction of a cam depends on beside numbers.

    `given` is the diagram that the law gives; `fastest` the section line of the greatest velocity; `rocks` tells that
    the travel runs along the arc of a rocker. The cams are those whose sizes are wanted.
    """

    division: Division
    given: str
    fastest: int
    rocks: bool
    rolling: RollerCam | None = None
    plate: PlateCam | None = None


def construct(layout: Layout, plans: Iterable[str] = PLANS) -> Program:
    """Record the construction of the plans wanted and of those they need."""
    board, wanted = RecordingBoard(), with_needs(plans, NEEDS)
    division, given, rolling, plate = layout.division, layout.given, layout.rolling, layout.plate
    if DIAGRAMS_PART in wanted:
        _diagrams(board, division.sections, given)
        if layout.rocks:
            board.calc("h", ARC, "psi", "l_rocker")
        _exact_factors(board, given)
        _chord_factors(board, division, layout.fastest, given)
    if SIZES_PART in wanted:
        _ordinates(board, division, given)
        if layout.rocks:
            _rocker_sizes(board, division)
        elif rolling is not None:
            _roller_sizes(board, division, rolling)
        if plate is not None:
            _plate_sizes(board, division, plate.given)
    if PROFILE_PART in wanted:
        for i in division.lines:  # phase angles against the sense of the cam, travels, analogues of velocity
            board.turn(f"_axis{i}", f"_axis_angle{i}")
            board.normal(f"_left{i}", f"_axis{i}")
            board.calc(f"_s{i}", "part_of_travel", "h", f"_s_part{i}")
            board.calc(f"_x{i}_exact", "part_of_travel", "h", f"_x_part{i}")
        if rolling is not None:
            _rolling_profile(board, division, layout.rocks)
        if plate is not None:
            _plate_profile(board, division)
    return Program(board.steps)
