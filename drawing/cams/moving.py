"""A cam on the page that moves: it turns under its follower; over the plan of its profile the follower goes round."""

from __future__ import annotations

import math
from typing import Any

from ...plans.cams.construction import PLATE_PROFILE, PROFILE
from ...plans.cams.course import TABLED
from ..moving import Data
from ..moving.courses import Moving, driven, outline
from .scene import CamScene

ROD = 0.9  # of the greatest radius, the length of a rod beyond the follower's place
TURNED = 0.55  # of the least radius, the length of the mark by which the cam is seen to turn
GUIDES = 0.35  # of the rod's length, where it runs in its guides
RADIUS = "R_roller"
FIRST = ("s", "ds", "d2s", "theta", "theta_rocker")


def moving(scene: CamScene) -> Moving:
    """Return what moves of a cam: one view for each of its followers."""
    solved, words = scene.solved, scene.words
    sizes = {"h": solved.motion.h} | ({} if solved.rolling is None else {"R_roller": solved.rolling.profile.R})
    measured: dict[str, Data] = {name: {"of": [], "now": size} for name, size in sizes.items()}
    views, over, marks = list[Data](), dict[str, list[Data]](), list[list[Any]]()
    for curve, follower, profile in solved.profiles:
        plate, samples = follower == "plate", solved.motion.samples()
        round_cam = (profile.centre if plate else profile.pitch)(samples)  # type: ignore[union-attr]
        far, near = float(abs(round_cam).max()), float(abs(profile.outline()).min())
        place, about = ("inverted_plate.B", PLATE_PROFILE) if plate else ("inverted.B", PROFILE)
        measured[reach := f"far_{follower}"] = {"of": [place], "now": far}
        marks.append(["O", "turn", 0.0, [TURNED * near / far, reach]])
        body = [_body(profile.outline().tolist(), far, curve.replace("pitch", "profile"), "cam")]
        if not plate:
            body.append(_body(round_cam.tolist(), far, curve, "axis"))
        body += [{"k": "side", "a": "O", "b": marks[-1]}, {"k": "pivot", "at": "O"}]
        left, top = -1.05 * far, (1.0 + ROD) * far
        if plate:
            assert solved.plate is not None
            shapes = _plate(solved.plate.part, reach)
        elif solved.rocker is not None:
            pivot = complex(solved.rocker.profile.follower.pivot(solved.rocker.sizes))  # type: ignore[union-attr]
            left, top, shapes = min(left, 1.1 * pivot.real), far, _rocker()
        else:
            shapes = _straight(scene, far, reach)
        views.append(
            {
                "name": "position" if not views else f"moving_{follower}",
                "heading": words[f"moving.cam_{follower}"],
                "symbol": "",
                "extent": [left, -1.05 * far, 1.05 * far, max(top * 1.02, 1.3 * far)],
                "by": reach,
                "shapes": [*body, *shapes],
            }
        )
        over[about] = _about(follower, place, scene, reach)
    more: Data = {"turns": True, "rate": "omega", "crank": ["O", marks[0]], "by": 1.0, "unit": "°", "digits": 1}
    drive = driven("phi", "φ", (0.0, math.tau), float(solved.givens["omega"]), **more)
    shown = tuple(name for name in TABLED if name != "phi")
    symbols = {f"{name}_rocker": words.symbol(name) for name in ("theta", "gamma")}
    points, opens = {"O": 0j, "right": 1.0 + 0j, "upright": 1j}, PROFILE if PROFILE in over else PLATE_PROFILE
    return Moving(drive, views, points, shown, FIRST, over, symbols, opens, measured)


def _body(points: list[complex], far: float, columns: str, kind: str) -> Data:
    """Return an outline of the cam; of other sizes it is where its columns over the turn are."""
    of = [f"{columns}.x", f"{columns}.y"]
    return {"k": "body", "at": "O", "turn": "turn", "d": outline(points, far), "of": of, "class": kind}


def _straight(scene: CamScene, far: float, reach: str) -> list[Data]:
    """Return a roller on a rod between its guides, with the normal at the contact."""
    up = far * (1.0 + GUIDES * ROD)
    levels = ([(level - scene.rolling.sizes.s_0) / far, reach] for level in (up, 1.3 * up))
    low, high = levels
    guides = [
        {
            "k": "side",
            "main": True,
            **{end: ["roller.0", "upright", of, [side, RADIUS]] for end, of in (("a", low), ("b", high))},
        }
        for side in (-0.5, 0.5)
    ]
    return [*guides, {"k": "bar", "a": "roller.B", "b": ["roller.B", "upright", [ROD, reach], 0.0]}, *_roller()]


def _rocker() -> list[Data]:
    """Return a rocker with its roller, with the normal at the contact."""
    return [{"k": "bar", "a": "rocker.C", "b": "roller.B"}, {"k": "pivot", "at": "rocker.C"}, *_roller()]


def _roller() -> list[Data]:
    ends = (["roller.B", "roller.n", [side, RADIUS], 0.0] for side in (-2.5, 2.5))
    normal = dict(zip("ab", ends, strict=True))
    disk = {"k": "disk", "at": "roller.B", "r": RADIUS}
    return [disk, {"k": "side", **normal}, {"k": "pin", "at": "roller.B"}, _contact("roller.K")]


def _plate(part: float, reach: str) -> list[Data]:
    """Return a plate on its rod; its half is a part of the stroke."""
    ends = (["plate.B", "right", [side * part, "h"], 0.0] for side in (-1, 1))
    rod = {"k": "bar", "a": "plate.B", "b": ["plate.B", "upright", [ROD, reach], 0.0]}
    return [rod, {"k": "bar", **dict(zip("ab", ends, strict=True))}, _contact("plate.K")]


def _contact(point: str) -> Data:
    return {"k": "mark", "at": point, "text": "<i>K</i>"}


def _about(follower: str, place: str, scene: CamScene, reach: str) -> list[Data]:
    """Return the follower as it goes round the cam that stands still: over the plan of the profile."""
    rod = {"k": "bar", "a": place, "b": [place, "up", [0.3, reach], 0.0], "lit": True}
    if follower == "plate":
        assert scene.plate is not None
        R = scene.plate.sizes.R_plate
        return [{"k": "bar", "a": [place, "across", -R, 0.0], "b": [place, "across", R, 0.0], "lit": True}, rod]
    if scene.solved.rocker is not None:
        rod["b"] = "inverted.A"
    return [rod, {"k": "disk", "at": place, "r": RADIUS, "lit": True}]
