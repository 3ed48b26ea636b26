"""A gear pair on the page that moves: it rolls, the contact runs along its line, teeth in contact light up."""

from __future__ import annotations

import math

from ...plans.gears.course import GearCourse
from ..moving import Data, html
from ..moving.courses import Moving, driven, outline
from ..words import indexed
from .scene import GearScene

FLANK, ARC = 40, 0.01  # points of a flank; rad between those of tips and roots
NEAR = 2.6  # modules that are seen to both sides of the pole at least, beside the active line
AROUND = 1.15
SECONDS = 6.0  # that the contact of a pair of teeth takes on the page
SHOWN = ("rho_1", "phi", "rho_2", "r_1", "r_2", "v_k1", "v_k2", "v_s", "theta_12", "theta_21", "pairs")
FIRST = ("theta_12", "theta_21", "v_s", "pairs")


def moving(scene: GearScene) -> Moving:
    """Return what moves of a pair: its middle near by, and the whole of it."""
    course, meshing, sizes, words = GearCourse(scene.solved), scene.meshing, scene.solved.sizes, scene.words
    first, last = course.first, course.last
    below, above = meshing.centres
    points = {"O1": below, "O2": above, "P": 0j, "right": 1.0 + 0j}
    ends = {"N1": 0.0, "N2": sizes["l_N1N2"], "A1": sizes["rho_p1"], "A2": sizes["rho_a1"], "S": first, "E": last}
    points |= {name: meshing.place(rho) for name, rho in ends.items()}
    reach = max(NEAR * sizes["m"], abs(points["A1"]) * AROUND, abs(points["A2"]) * AROUND)
    radii = [tooth.r_a * 1.02 for tooth in meshing.teeth]
    wide = max(radii)
    shapes = _wheels(scene, course, reach)
    views = [
        {"name": "position", "heading": words["moving.gear"], "extent": [-reach, -reach, reach, reach]},
        {
            "name": "pair",
            "heading": words["moving.gears"],
            "extent": [-wide, below.imag - radii[0], wide, above.imag + radii[1]],
        },
    ]
    own: list[Data] = [
        {"k": "side", "a": "N1", "b": "N2"},
        {"k": "bar", "a": "S", "b": "E"},
        *({"k": "disk", "at": f"O{i}", "r": 0.5 * sizes[f"d_w{i}"], "class": "axis"} for i in (1, 2)),
        *({"k": "pivot", "at": f"O{i}"} for i in (1, 2)),
        *({"k": "mark", "at": mark, "text": html(indexed(mark))} for mark in ("P", "A1", "A2")),
    ]
    touches: list[Data] = [
        {"k": "pin", "at": f"action.K{n}", "lit": True, "when": _while(course, n)} for n in course.neighbours
    ]
    for view in views:
        view |= {"symbol": "", "shapes": [{**shape} for shape in (*shapes, *own, *touches)]}
    shown: Data = {"crank": ["P", "action.K0"], "by": 1e3, "unit": words.unit("mm"), "digits": 2}
    drive = driven("rho_1", "ρ_{1}", (first, last), (last - first) / SECONDS, again=course.pitch, **shown)
    return Moving(drive, views, points, SHOWN, FIRST, symbols={"pairs": words["moving.pairs"]}, opens="meshing")


def _while(course: GearCourse, n: int) -> list[float | str]:
    """Return between which places of this pair another one, so many pitches before it, touches."""
    return ["rho_1", course.first - n * course.pitch, course.last - n * course.pitch]


def _wheels(scene: GearScene, course: GearCourse, size: float) -> list[Data]:
    """Return both wheels, and over them the teeth that may touch, which light up while they do.

    Their outlines are as exact as a view of that size shows them.
    """
    shapes: list[Data] = []
    ways = zip((1, 2), scene.meshing.teeth, (1, -1), strict=True)
    for i, tooth, way in ways:
        points, wheel = tooth.outline(FLANK, ARC).tolist(), {"k": "body", "at": f"O{i}", "turn": f"turn_{i}"}
        one = outline(points, size)
        shapes.append({**wheel, "d": one, "times": round(tooth.z), "class": "cam"})
        for n in course.neighbours:
            by = way * scene.meshing.sense * n * math.tau / tooth.z
            shapes.append({**wheel, "d": one, "by": by, "class": "touching", "open": True, "when": _while(course, n)})
    return shapes
