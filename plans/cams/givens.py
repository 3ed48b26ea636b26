"""The givens of a cam's construction: the numbers of the task, and those that belong to the law of motion.

A law of motion is a table to the board, as it is to a student: parts of the amplitude, of the travel, of the sizes.
"""

from __future__ import annotations

from typing import Any

from .integration import ACCELERATION, VELOCITY, Division
from .motion import FALL, RISE, Array, Motion
from .sizes import RIGHT_ANGLE

NUMBERS = {"_two": 2.0, "_minus_one": -1.0}


def peak(motion: Motion, given: str) -> float:
    """Return the greatest ordinate of the given diagram in the rise, SI: A_1, or the greatest ds/dphi."""
    order = (0.0, 0.0, 1.0) if given == ACCELERATION else (0.0, 1.0, 0.0)
    return motion.maximum(*order, (RISE,)).value


def diagram_givens(motion: Motion, angles: Array, division: Division, given: str) -> dict[str, Any]:
    """Return what the diagrams begin with: angles of section lines, and parts of the amplitude that is given."""
    amplitude, top = peak(motion, given), motion.rise.length
    order = 2 if given == ACCELERATION else 1
    found: dict[str, Any] = dict(NUMBERS)
    middles = 0.5 * (angles[:-1] + angles[1:])
    means = motion.at(middles)[order]
    for i in division.sections:
        found |= {f"_phi{i}": float(angles[i]), f"_phi_middle{i}": float(middles[i - 1])}
        found[f"_part{i}"] = float(means[i - 1]) / amplitude
    for word, side in (("before", -1), ("after", 1)):
        values = motion.at(angles, side)[order]
        found |= {f"_part{i}_{word}": float(values[i]) / amplitude for i in division.lines}
    if given == VELOCITY:
        for phase, lines in ((RISE, division.rise), (FALL, division.fall)):  # of two values at a jump that inside
            words = ("after", *("before" for _ in lines[1:]))
            found |= {f"_node{i}_{phase}": found[f"_part{i}_{word}"] for i, word in zip(lines, words, strict=True)}
        return found | {"_part_v": motion.ds_max.value / amplitude, "_part_s": motion.h / (amplitude * top)}
    found["_part_v"] = motion.ds_max.value / (amplitude * top)
    found["_part_s"] = motion.h / (amplitude * top * top)
    found["_part_a"] = motion.d2s_max.value / amplitude
    return found


def profile_givens(motion: Motion, angles: Array, division: Division, sense: int) -> dict[str, float]:
    """Return the follower's axes in the inverted motion, and travels as parts of the stroke."""
    s, ds, _ = motion.at(angles, -1)
    found = {"_sense": float(sense)}
    for i in division.lines:
        found[f"_axis_angle{i}"] = RIGHT_ANGLE - sense * float(angles[i])
        found |= {f"_s_part{i}": float(s[i]) / motion.h, f"_x_part{i}": sense * float(ds[i]) / motion.h}
    return found
