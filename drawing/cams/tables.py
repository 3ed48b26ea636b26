"""The table of the motion on the section lines."""

from __future__ import annotations

import numpy as np

from ..table import table
from ..view import View
from .pressing import rolls, theta
from .scene import CamScene

SAME = 1e-9  # part of the greatest value of its column within which two limits at a jump are one


def motion_table(scene: CamScene) -> View:
    """Return travel, analogues and pressure angle by section lines; at a jump the limits before and after it."""
    solved, words = scene.solved, scene.words
    before, after = (solved.motion.at(solved.angles, side) for side in (-1, 1))
    columns = [[words.number(float(np.degrees(phi)), 2) for phi in solved.angles]]
    columns += [_column(scene, [a * 1e3, b * 1e3]) for a, b in zip(before, after, strict=True)]
    mm = words.unit("mm")
    head = [words["table.cam_row"], f"{words.symbol('phi')}, °"]
    head += [f"{words.symbol(name)}, {mm}" for name in ("s", "ds", "d2s")]
    if rolls(solved):
        angles = [np.degrees(theta(solved, solved.angles, side)) for side in (-1, 1)]
        columns.append(_column(scene, angles))
        head.append(f"{words.symbol('theta')}, °")
    rows = [[str(i), *cells] for i, cells in enumerate(zip(*columns, strict=True))]
    return table("motion", words["heading.cam_table"], [head, *rows], scene.style)


def _column(scene: CamScene, limits: list[np.ndarray]) -> list[str]:
    """Return the cells of a column, two numbers where the limits from both sides differ."""
    least = SAME * max(float(np.max(np.abs(side))) for side in limits)
    cells = []
    for a, b in zip(*(side.tolist() for side in limits), strict=True):
        texts = [scene.words.number(value, 2) for value in ((a,) if abs(b - a) <= least else (a, b))]
        cells.append(" / ".join(texts))
    return cells
