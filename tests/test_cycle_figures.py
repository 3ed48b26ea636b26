"""The sheet of a whole cycle: positions numbered as points, the crank's sense, guides as long as the strokes, rays."""

from __future__ import annotations

import math
import re
from functools import lru_cache

import kulman
from kulman.tests.readback import Sheet, read


@lru_cache(maxsize=1)
def cycle_sheet() -> Sheet:
    drawn = kulman.sweep("nau-slider-crank", "3").drawn()
    return read(*(drawn.svg(number) for number in range(1, len(drawn.pages) + 1)))


def labels(view: str) -> list[str]:
    return [text.string for text in cycle_sheet()[view].of("label")]


def test_positions_are_numbered_as_points() -> None:
    """A bare number is that of a link."""
    written = labels("positions")

    assert {f"A_{{{number}}}" for number in range(12)} <= set(written)
    numbers = [n for text in written if text.startswith("B_") for n in re.findall(r"\d+", text)]
    assert sorted(map(int, numbers)) == list(range(12))
    assert sorted(text for text in written if text.isdigit()) == ["1", "2", "3"]


def test_plan_of_positions_shows_how_the_crank_turns() -> None:
    view = cycle_sheet()["positions"]
    turning = view.turning("omega_1")

    assert turning is not None
    assert turning[1] == math.copysign(1.0, kulman.solve("nau-slider-crank", "3").solved.values["omega_1"])
    assert "ω_{1}" in labels("positions")


def test_guide_is_as_long_as_the_stroke() -> None:
    view = cycle_sheet()["positions"]
    ends = [p.real for s in view.inside("guide") if s.role != "hatch" for p in s.points]
    places = [ring.centre.real for ring in view.rings if abs(ring.centre.imag - view.point("B").imag) < 0.01]
    on_guide = [x for x in places if x < view.point("O").real - 60.0]

    assert min(ends) < min(on_guide)
    assert max(ends) > max(on_guide)


def test_rays_have_the_numbers_of_their_chords() -> None:
    view = cycle_sheet()["diagrams"]
    rays = [s.name for s in view.lines("ray")]
    numbers = sorted(int(n) for name in rays for n in name.split())

    assert numbers == sorted([*range(1, 13)] * 2)
    assert all(name.replace(" ", ", ") in labels("diagrams") for name in rays)
