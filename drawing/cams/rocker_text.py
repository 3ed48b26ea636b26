"""Calculations of a cam with a rocker: its swing as a travel, the angle at the pivot, rules of design."""

from __future__ import annotations

import math

from ...plans.cams.formulas import ARC
from ..printed import Input, Shown, worked
from ..table import text_block
from ..view import View
from .scene import CamScene
from .text import MM, Lines, length, rules

DEGREES = math.degrees(1.0)


def rocker_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a rocker, with the rules for its roller and the transmission angles."""
    cam, words = scene.solved.rocker, scene.words
    assert cam is not None
    sizes, swing = cam.sizes, cam.rocker.motion.h
    travel = [Input(math.degrees(swing), True, name="psi", times=DEGREES), length("l_rocker", sizes.l, True)]
    given = "l_OC" in scene.givens
    sides = [length("l_rocker", sizes.l, True), length("l_OC", sizes.l_OC, given), length("r_0", sizes.r_0)]
    lines: Lines = [
        (f"{words['said.cam_arc']}:",),
        worked(words, "h", ARC, travel, MM),
        (f"{words['said.cam_first_angle']}:",),
        worked(words, "psi_0", "angle_of_triangle", sides, Shown("deg", DEGREES)),
        *rules(scene),
    ]
    return text_block("equations_rocker", words["heading.cam_rocker"], lines, scene.style, width)
