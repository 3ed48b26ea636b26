"""The sheet of a whole cycle: positions numbered as points, the crank's sense, guides as long as the strokes, rays."""

from __future__ import annotations

import math
import re
from functools import lru_cache

import kulman
from kulman.tests.support.readback import Sheet, read


@lru_cache(maxsize=2)
def cycle_sheet(task: str = "nau-slider-crank") -> Sheet:
    drawn = kulman.sweep(task, positions=12).drawn()
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
    assert turning[1] == math.copysign(1.0, kulman.solve("nau-slider-crank").solved.values["omega_1"])
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


def test_rates_without_limit_are_cut_off() -> None:
    """The rocker of the tipper turns without limit where its links stretch out, at both ends of the drive's range."""
    sheet = cycle_sheet("scheme-18-hydraulic-drive")
    scales = {t.string.partition(";")[0]: t.string for t in sheet["diagrams"].of("label") if "μ" in t.string}

    assert scales["ω_{3}"].endswith("μ_{ω} = 0.1 (rad/s)/mm")
    assert any("ω_{3}, ε_{3}" in t.string for t in sheet["diagrams"].of("heading"))


def test_guide_of_a_sliding_driver_is_as_long_as_its_range() -> None:
    view = cycle_sheet("scheme-18-hydraulic-drive")["positions"]
    ends = [p.real for s in view.inside("guide") if s.role != "hatch" for p in s.points]
    on_guide = [r.centre.real for r in view.rings if abs(r.centre.imag - view.point("A").imag) < 0.01]

    assert min(ends) < min(on_guide)
    assert max(ends) > max(on_guide)
