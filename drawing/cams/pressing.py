"""The pressure angle of a follower with a roller, on a line or on a rocker: values, limits, which position shows it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...plans.cams.course import pressure_of
from ...plans.cams.motion import FALL, RISE
from ...plans.cams.pressure import SIDES
from ...plans.cams.profile import RollerProfile
from ...plans.cams.sizes import Limits
from ...plans.cams.solve import SolvedCam
from .scene import Array, CamScene, pieces


def rolls(solved: SolvedCam) -> bool:
    """Whether a follower has a roller."""
    return solved.roller is not None or solved.rocker is not None


def rolling(solved: SolvedCam) -> tuple[RollerProfile, Limits]:
    """Return the profile for a roller, and the limits of its pressure angle."""
    cam = solved.roller or solved.rocker
    assert cam is not None
    return cam.profile, cam.limits


def theta(solved: SolvedCam, phi: Any, side: int = 1) -> Array:
    """Return the pressure angle, rad; where the velocity jumps, the limit from one side."""
    pressure = pressure_of(solved)
    assert pressure is not None
    return pressure(phi, side)


def courses(solved: SolvedCam) -> list[tuple[Array, Array]]:
    """Return the smooth pieces of theta over phi, with the limits at both their ends."""
    found = []
    for phase in solved.motion.phases[:3]:
        for phi, *_ in pieces(solved, phase):
            values = np.array(theta(solved, phi))
            values[-1] = theta(solved, phi[-1:], -1)[0]
            found.append((phi, values))
    return found


def permitted(solved: SolvedCam) -> list[tuple[str, float]]:
    """Return the phases with what theta must not pass in them, rad."""
    _, limits = rolling(solved)
    gammas = {RISE: limits.gamma_rise, FALL: limits.gamma_fall}
    return [
        (phase, way * solved.cam.sense * (0.5 * math.pi - gamma))
        for phase, gamma in gammas.items()
        for way in SIDES[phase][: 1 + limits.two_sided]
    ]


def pressed(scene: CamScene, part: float) -> int:
    """Return the section line at which the pressure angle is nearest to a part of the greatest one.

    It is a line within the phase in which the cam presses more aslant, where the angle is best seen.
    """
    solved, division = scene.solved, scene.solved.layout.division
    phases = (division.rise[1:-1], 1), (division.fall[1:-1], -1)
    found = [(way * solved.cam.sense * theta(solved, solved.angles[[*lines]]), lines) for lines, way in phases]
    angles, lines = max(found, key=lambda phase: float(np.max(phase[0])))
    return int(lines[int(np.argmin(np.abs(angles - part * np.max(angles))))])
