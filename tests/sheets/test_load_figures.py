"""Load diagrams and factors of inertia that a task gives: the sheet shows them."""

from __future__ import annotations

from functools import cache

import pytest

from kulman import sheet, solve
from kulman.tests.support.printed_numbers import numbers_of, table
from kulman.tests.support.readback import Sheet, View, read
from kulman.tests.support.sheet_geometry import same


@cache
def drawn(task: str, lang: str = "en") -> Sheet:
    found = sheet(task, only="velocity,acceleration,structure,forces", format="A1", lang=lang)
    return read(*(found.svg(number) for number in range(1, len(found.pages) + 1)))


def mu(view: View, letter: str) -> float:
    (text,) = [t.string for t in view.of("heading") if t.string.startswith(f"μ_{{{letter}}}")]
    return numbers_of(text.partition("=")[2].partition(" (")[0], "en")[0]


@pytest.mark.parametrize(
    ("task", "name", "load"),
    [("scheme-01-compressor", "p_gas", "F_3"), ("scheme-13-toggle-press", "p_drawing", "F_5")],
)
def test_load_diagram_is_drawn_to_its_scales(task: str, name: str, load: str) -> None:
    """Corners of the curve are the task's places and values; the marked ordinate is the load of this position."""
    values = solve(task).solved.values
    view = drawn(task)[f"load_{name}"]
    (line,) = [s for s in view.inside("curve", name) if len(s.points) > 2]
    origin = line.points[0] - 1j * values["zero"]
    stroke = abs(values["_stroke_end"] - values["_stroke_begin"])
    top = max(point.imag for point in line.points) - origin.imag

    (mark,) = view.lines("ordinate", load)

    assert abs((line.points[-1].real - origin.real) * mu(view, "s") - stroke) < 0.01 * mu(view, "s")
    assert abs(top * mu(view, "F") - values["F_max"]) < 0.01 * mu(view, "F")
    assert abs(abs(mark.points[1] - mark.points[0]) * mu(view, "F") - abs(values[load])) < 0.01 * mu(view, "F")
    assert abs((mark.points[0].real - origin.real) * mu(view, "s") - values["_stroke_part"] * stroke) < 0.01
    assert not same(mark.points[0], mark.points[1])


def test_given_data_have_the_factors_of_inertia() -> None:
    rows = {row[0]: row[1] for row in table(drawn("scheme-13-toggle-press")["givens"])}

    assert rows["j_{2} = j_{3} = j_{4}"] == "0.1"
