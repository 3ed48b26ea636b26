"""Calculations of a cam with a rocker: its swing as a travel, the angle at the pivot, rules of design."""

from __future__ import annotations

import math

from ...plans.laws import LAWS
from ..printed import Terms
from ..table import text_block
from ..view import View
from .scene import CamScene
from .text import Lines, rules, worked

FIRST = "arccos(({l_rocker}^{{2}} + {l_OC}^{{2}} − {r_0}^{{2}})/(2·{l_rocker}·{l_OC}))"


def rocker_block(scene: CamScene, width: float) -> View:
    """Return the sizes of the cam for a rocker, with the rules for its roller and the transmission angles."""
    cam, words = scene.solved.rocker, scene.words
    assert cam is not None
    sizes, swing = cam.sizes, cam.rocker.motion.h
    travel: Terms = [("psi", math.degrees(swing), True), ("l_rocker", sizes.l * 1e3, True)]
    sides: Terms = [
        ("l_rocker", sizes.l * 1e3, True),
        ("l_OC", sizes.l_OC * 1e3, "l_OC" in scene.givens),
        ("r_0", sizes.r_0 * 1e3, False),
    ]
    lines: Lines = [
        (f"{words['said.cam_arc']}:",),
        worked(scene, "h", "({psi}/180)·π·{l_rocker}", lambda a, b: math.radians(a) * b, travel, "mm"),
        (f"{words['said.cam_first_angle']}:",),
        worked(scene, "psi_0", FIRST, _first, sides, "deg"),
        *rules(scene),
    ]
    return text_block("equations_rocker", words["heading.cam_rocker"], lines, scene.style, width)


def _first(l: float, l_OC: float, r_0: float) -> float:
    """Return the angle at the pivot between the rocker in its lowest position and the line of centres, degrees."""
    return math.degrees(LAWS["angle_of_triangle"](l, l_OC, r_0))
