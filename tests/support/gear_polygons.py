"""Wheels cut by a rack in many steps, and pairs of them in mesh, as polygons of another library; millimetres."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import shapely
from shapely.geometry import LineString, Polygon

from kulman.plans.gears.teeth import Meshing, Tooth

MM = 1e3


def polygon(points: np.ndarray) -> Polygon:
    """Return an area with its corners given in metres."""
    return Polygon(np.column_stack((points.real, points.imag)) * MM)


def line(points: np.ndarray) -> LineString:
    """Return a broken line with its places given in metres."""
    return LineString(np.column_stack((points.real, points.imag)) * MM)


def wheel_of(tooth: Tooth, points: int) -> np.ndarray:
    """Return points of a whole wheel counter-clockwise, closed without a repeated point."""
    return tooth.teeth(round(tooth.z), points)[:-1]


def rack(values: Mapping[str, float], x: float, z: float) -> np.ndarray:
    """Return the outline of a cutting tooth of the rack, mm, as it stands in the middle of a space.

    Its centre line is the abscissa, the wheel's centre the origin: the pitch line is the wheel's r away. The corner is
    the circle that touches flank and tip, found by its tangents; the flank goes on outwards beyond every blank.
    """
    m, alpha = values["m"] * MM, values["alpha"]
    middle = 0.5 * m * z + x * m  # the line on which tooth and space are equally wide
    tip = middle - (values["h_a"] + values["c"]) * m
    boundary = middle - (values["h_l"] - values["h_a"]) * m
    half_tip = 0.25 * math.pi * m - (middle - tip) * math.tan(alpha)
    # from the point where flank and tip line meet both tangents of the circle are equally long
    tangent = min((boundary - tip) / math.cos(alpha), half_tip)
    radius = tangent / math.tan(0.5 * (0.5 * math.pi - alpha))
    turn = np.linspace(alpha, 0.5 * math.pi, 120)
    centre = complex(tip + radius, half_tip - tangent)
    corner = centre + radius * (-np.sin(turn) + 1j * np.cos(turn))
    far = middle + 4.0 * m
    outer = complex(far, 0.25 * math.pi * m + 4.0 * m * math.tan(alpha))
    upper = np.concatenate(([outer], corner))
    return np.concatenate((upper, upper[::-1].conj()))


def cut_by_rack(values: Mapping[str, float], tooth: Tooth, x: float, step: float) -> float:
    """Return the area of one tooth that a rack leaves of a blank, mm2, rolled in steps of an angle, rad.

    Both spaces beside the tooth are cut; the blank is the sector from the middle of one to the middle of the other.
    """
    r, r_a, half = tooth.r * MM, tooth.r_a * MM, math.pi / tooth.z
    arc = np.exp(1j * np.linspace(-half, half, 2000)) * r_a
    blank = Polygon(np.column_stack((np.append(arc.real, 0.0), np.append(arc.imag, 0.0))))
    outline = rack(values, x, tooth.z)
    reach = math.acos(min(1.0, tooth.r_b / max(tooth.r_a, tooth.r))) + 1.4 * math.pi / tooth.z + 1.2
    angles = np.arange(-reach, reach, step)
    # the rack moves along its pitch line by as much as the reference circle turns
    moved = (outline + 1j * r * angles[:, np.newaxis]) * np.exp(-1j * angles)[:, np.newaxis]
    turned = np.concatenate([moved * np.exp(1j * side) for side in (-half, half)])
    tools = shapely.polygons(np.stack((turned.real, turned.imag), axis=-1))
    shapely.prepare(blank)  # with an index of its sides
    near = tools[shapely.intersects(blank, tools)]
    left = blank.difference(shapely.unary_union(near))
    parts = list(left.geoms) if hasattr(left, "geoms") else [left]
    return float(max(part.area for part in parts))


def sector_of(tooth: Tooth) -> float:
    """Return the area of the tooth's own outline with the centre, mm2."""
    return float(polygon(np.append(tooth.outline(600, math.radians(0.02)), 0.0)).area)


def flanks_touch(meshing: Meshing, angle: float, room: float) -> int:
    """Return how many pairs of flanks are nearer to each other than `room`, mm, at an angle of the pinion."""
    flanks = [tooth.flank(np.linspace(tooth.rho_start, tooth.rho_end, 1000)) for tooth in meshing.teeth]
    if meshing.sense < 0:
        flanks = [flank.conj() for flank in flanks]
    one, other = (
        centre + flank * direction
        for centre, flank, direction in zip(meshing.centres, flanks, meshing.directions(angle), strict=True)
    )
    steps = [np.exp(2j * math.pi / tooth.z) for tooth in meshing.teeth]
    count = 0
    for k in range(-2, 3):
        first = line(meshing.centres[0] + (one - meshing.centres[0]) * steps[0] ** k)
        second = line(meshing.centres[1] + (other - meshing.centres[1]) * steps[1] ** -k)
        shapely.prepare(first)  # with an index of its pieces
        count += bool(shapely.dwithin(first, second, room))
    return count
