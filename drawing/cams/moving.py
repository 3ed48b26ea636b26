"""A cam on the page that moves: it turns under its follower; over the plan of its profile the follower goes round."""

from __future__ import annotations

import math
from typing import Any

from ...plans.cams.construction import PLATE_PROFILE, PROFILE
from ...plans.cams.course import TABLED
from ..moving import Data
from ..moving.courses import Moving, outline
from .scene import CamScene

ROD = 0.9  # of the greatest radius, the length of a rod beyond the follower's place
TURNED = 0.55  # of the least radius, the length of the mark by which the cam is seen to turn
GUIDES = 0.35  # of the rod's length, where it runs in its guides
FIRST = ("s", "ds", "d2s", "theta", "theta_rocker")


def moving(scene: CamScene) -> Moving:
    """Return what moves of a cam: one view for each of its followers."""
    solved, words = scene.solved, scene.words
    motion, points = solved.motion, {"O": 0j, "right": 1.0 + 0j, "upright": 1j}
    views, over = list[Data](), dict[str, list[Data]]()
    for _, follower, profile in solved.profiles:
        curve = profile.pitch(motion.samples()) if hasattr(profile, "pitch") else profile.centre(motion.samples())
        far, near = float(abs(curve).max()), float(abs(profile.outline()).min())
        body: list[Data] = [
            {"k": "body", "at": "O", "turn": "turn", "d": outline(profile.outline().tolist(), far), "class": "cam"},
            {"k": "side", "a": "O", "b": ["O", "turn", 0.0, TURNED * near]},
            {"k": "pivot", "at": "O"},
        ]
        if follower == "plate":
            shapes = _plate(solved.plate.sizes.R_plate, far) if solved.plate else []
            place, about = ["plate.B", "inverted_plate.B"], PLATE_PROFILE
        else:
            body.insert(1, {"k": "body", "at": "O", "turn": "turn", "d": outline(curve.tolist(), far), "class": "axis"})
            shapes = _rocker(scene, points) if solved.rocker is not None else _straight(scene, points, far)
            place, about = ["roller.B", "inverted.B"], PROFILE
        heading = words[f"moving.cam_{follower}"]
        reach = far + ROD * far * (solved.rocker is None)
        left = min([-1.05 * far, *(at.real * 1.1 for at in points.values())])
        views.append(
            {
                "name": "position" if not views else f"moving_{follower}",
                "heading": heading,
                "symbol": "",
                "extent": [left, -1.05 * far, 1.05 * far, max(reach * 1.02, 1.3 * far)],
                "shapes": [*body, *shapes],
            }
        )
        over[about] = _about(follower, place[1], scene, far)
    nearest = min(float(abs(profile.outline()).min()) for _, _, profile in solved.profiles)
    drive = {
        "name": "phi",
        "symbol": "<i>φ</i>",
        "turns": True,
        "sense": 1,
        "start": 0.0,
        "low": 0.0,
        "high": math.tau,
        "speed": float(solved.givens["omega"]),
        "crank": ["O", ["O", "turn", 0.0, TURNED * nearest]],
        "by": 1.0,
        "unit": "°",
        "digits": 1,
    }
    shown = tuple(name for name in TABLED if name != "phi")
    symbols = {f"{name}_rocker": words.symbol(name) for name in ("theta", "gamma")}
    return Moving(drive, views, points, shown, FIRST, over, symbols, PROFILE if PROFILE in over else PLATE_PROFILE)


def _straight(scene: CamScene, points: dict[str, complex], far: float) -> list[Data]:
    """Return a roller on a rod between its guides, with the normal at the contact."""
    R, x = scene.value_of("R_roller"), scene.rolling.sizes.e
    half, level = 0.5 * R, far * (1.0 + GUIDES * ROD)
    for side in (-1, 1):
        points |= {f"guide{side}": complex(x + side * half, level), f"top{side}": complex(x + side * half, 1.3 * level)}
    top = ["roller.B", "upright", ROD * far, 0.0]
    guides = [{"k": "side", "a": f"guide{side}", "b": f"top{side}", "main": True} for side in (-1, 1)]
    return [*guides, {"k": "bar", "a": "roller.B", "b": top}, *_roller(R)]


def _rocker(scene: CamScene, points: dict[str, complex]) -> list[Data]:
    """Return a rocker with its roller, with the normal at the contact."""
    rolling = scene.rolling
    follower: Any = rolling.profile.follower
    points["C"] = complex(follower.pivot(rolling.sizes))
    rocker = [{"k": "bar", "a": "C", "b": "roller.B"}, {"k": "pivot", "at": "C"}]
    return [*rocker, *_roller(scene.value_of("R_roller"))]


def _roller(R: float) -> list[Data]:
    normal = {"k": "side", "a": ["roller.B", "roller.n", -2.5 * R, 0.0], "b": ["roller.B", "roller.n", 2.5 * R, 0.0]}
    return [{"k": "disk", "at": "roller.B", "r": R}, normal, {"k": "pin", "at": "roller.B"}, _contact("roller.K")]


def _plate(R: float, far: float) -> list[Data]:
    """Return a plate on its rod."""
    ends = [["plate.B", "right", side * R, 0.0] for side in (-1, 1)]
    top = ["plate.B", "upright", ROD * far, 0.0]
    return [
        {"k": "bar", "a": "plate.B", "b": top},
        {"k": "bar", "a": ends[0], "b": ends[1]},
        _contact("plate.K"),
    ]


def _contact(point: str) -> Data:
    return {"k": "mark", "at": point, "text": "<i>K</i>"}


def _about(follower: str, place: str, scene: CamScene, far: float) -> list[Data]:
    """Return the follower as it goes round the cam that stands still: over the plan of the profile."""
    if follower == "plate":
        assert scene.plate is not None
        R = scene.plate.sizes.R_plate
        plate = {"k": "bar", "a": [place, "across", -R, 0.0], "b": [place, "across", R, 0.0], "lit": True}
        return [plate, {"k": "bar", "a": place, "b": [place, "up", 0.3 * far, 0.0], "lit": True}]
    disk = {"k": "disk", "at": place, "r": scene.value_of("R_roller"), "lit": True}
    start = "inverted.A" if scene.solved.rocker is not None else [place, "up", 0.3 * far, 0.0]
    return [{"k": "bar", "a": start, "b": place, "lit": True}, disk]
