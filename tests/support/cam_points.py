"""Points C1 to C8 of the examiner's list for the sheet of a cam, judged on a sheet that was read back."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import shapely

from kulman.tests.support.cam_cases import (
    CamCase,
    Faults,
)
from kulman.tests.support.cam_points_diagrams import c1_three_diagrams, c2_chords, c3_law, c4_scale_factors
from kulman.tests.support.cam_points_profile import c6_inversion, c7_practical, c8_plate
from kulman.tests.support.cam_points_sizes import c5_sizes
from kulman.tests.support.glyphs import advance
from kulman.tests.support.overlaps import TINY
from kulman.tests.support.readback import CAP, Sheet, Text, polygon, thick


def touching(case: CamCase, sheet: Sheet) -> Faults:
    """Letters that touch a letter, a main line, an arrowhead, or a mark."""
    for view in sheet.views:
        areas = np.array([_ink(text) for text in view.texts])
        tree = shapely.STRtree(areas)
        for i, j in tree.query(areas, predicate="intersects").T.tolist():
            if i < j and shapely.area(shapely.intersection(areas[i], areas[j])) > TINY:
                yield f"{view.name}: {view.texts[i].string!r} on {view.texts[j].string!r}"
        main = max((s.width for s in view.strokes), default=0.0)
        things = [(thick(s), f"main line {s.path} {s.role}") for s in view.strokes if s.width == main]
        things += [(polygon(t.corners), f"arrowhead {t.path}") for t in view.tips]
        marks = [r for r in view.rings if r.radius < 3.0]
        things += [(shapely.Point(r.centre.real, r.centre.imag).buffer(r.radius), f"mark {r.path}") for r in marks]
        for thing, name in things:
            for i in tree.query(thing, predicate="intersects").tolist():
                yield f"{view.name}: {view.texts[i].string!r} on {name}"


def _ink(text: Text) -> shapely.Geometry:
    """The box of a text, turned with it."""
    if not text.turned:
        return shapely.box(*text.box)
    first, last = text.runs[0], text.runs[-1]
    along = last.at - first.at if len(text.runs) > 1 else 1j
    base = max(text.runs, key=lambda run: run.size)
    same = [run.at for run in text.runs if run.size == base.size]
    along = same[-1] - same[0] if len(same) > 1 else along
    along /= abs(along)
    end = last.at + along * advance(last.string) * last.size
    wide = ((end - same[0]) * along.conjugate()).real
    up = along * 1j * CAP * base.size
    return polygon((same[0], same[0] + along * wide, same[0] + along * wide + up, same[0] + up))


POINTS: dict[str, Callable[[CamCase, Sheet], Faults]] = {
    "C1": c1_three_diagrams,
    "C2": c2_chords,
    "C3": c3_law,
    "C4": c4_scale_factors,
    "C5": c5_sizes,
    "C6": c6_inversion,
    "C7": c7_practical,
    "C8": c8_plate,
    "G5": touching,
}
