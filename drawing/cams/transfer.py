"""How ordinates of the diagrams come to a plan with one scale factor on both axes: by ratios of scale factors."""

from __future__ import annotations

import math

from ...plans.cams.size_plans import PLATE_SIZES, SIZES
from ...plans.cams.solve import SCALES
from .scene import CamScene

FROM = {SIZES: ("mu_s", "mu_ds"), PLATE_SIZES: ("mu_s", "mu_d2s")}  # scale factors of the diagrams
DRAWN = {"mu_s": "s", "mu_ds": "ds", "mu_d2s": "d2s"}  # what they draw
ANGLES = {SIZES: ("nu", "mu_s", "mu_ds")}  # of the straight line that projects one diagram to the scale of the other
DECIMALS = 4


def transfer(scene: CamScene, plan: str) -> tuple[str, ...]:
    """Return by how much the ordinates of both diagrams are multiplied, and the angle of the projecting line."""
    words = scene.words
    ratios = [f"{words.symbol(DRAWN[mu])}: {ratio(scene, mu, SCALES[plan])}" for mu in FROM[plan]]
    lines = [words["said.cam_equal"], ";  ".join(ratios)]
    if plan in ANGLES:
        nu, over, under = ANGLES[plan]
        angle = scene.degrees(math.atan(scene.mu(over) / scene.mu(under)))
        lines.append(f"tg {words.symbol(nu)} = {ratio(scene, over, under)};  {words.symbol(nu)} = {angle}")
    return tuple(lines)


def ratio(scene: CamScene, over: str, under: str) -> str:
    """Return the ratio of two scale factors in letters and its value."""
    ratio = scene.words.short(round(scene.mu(over) / scene.mu(under), DECIMALS))
    return f"{scene.words.symbol(over)}/{scene.words.symbol(under)} = {ratio}"
