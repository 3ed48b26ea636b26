"""Places for letters that are clear of all that is drawn."""

from __future__ import annotations

import numpy as np
import pytest

from kulman.drawing.formats import STYLES
from kulman.drawing.shapes import Circle, Line, Pen, Text
from kulman.drawing.spots import Obstacles, first_clear
from kulman.drawing.view import Canvas

SIZE = 6.0, 4.0


def segment(a: complex, b: complex) -> np.ndarray:
    """Places along a line, closely."""
    return a + (b - a) * np.linspace(0.0, 1.0, 400)


def apart(place: complex, things: np.ndarray) -> float:
    """How far a box about a place is from the nearest of many places of what is drawn: by formula."""
    beyond_x = np.maximum(np.abs(things.real - place.real) - 3.0, 0.0)
    beyond_y = np.maximum(np.abs(things.imag - place.imag) - 2.0, 0.0)
    return float(np.min(np.hypot(beyond_x, beyond_y)))


@pytest.mark.parametrize("kind", ["segments", "thin", "circles", "boxes"])
def test_the_first_clear_place_is_clear_and_those_before_are_not(kind: str) -> None:
    random = np.random.default_rng(7)
    places = (random.uniform(-30, 30, 200) + 1j * random.uniform(-30, 30, 200)).tolist()
    ends = random.uniform(-30, 30, (10, 4))
    discs = np.outer(np.linspace(0.0, 5.0, 40), np.exp(2j * np.pi * np.arange(200) / 200)).ravel()
    across, up = np.meshgrid(np.linspace(0.0, 9.0, 60), np.linspace(0.0, 7.0, 60))
    lines = np.concatenate([segment(complex(a, b), complex(c, d)) for a, b, c, d in ends])
    firsts = ends[:, 0] + 1j * ends[:, 1]
    drawn = {
        "segments": (ends[:, ::2] + 1j * ends[:, 1::2], lines),
        "thin": (ends[:, ::2] + 1j * ends[:, 1::2], lines),
        "circles": ([(at, 5.0) for at in firsts.tolist()], np.add.outer(firsts, discs).ravel()),
        "boxes": (
            [(a, b, a + 9.0, b + 7.0) for a, b, *_ in ends],
            np.add.outer(firsts, (across + 1j * up).ravel()).ravel(),
        ),
    }
    obstacles, things = drawn[kind]

    found = first_clear(places, SIZE, Obstacles(**{kind: obstacles}), 1.0)

    assert found is not None
    first = next(place for place in places if apart(place, things) > 1.2)
    assert apart(found, things) > 0.99
    assert places.index(found) <= places.index(first)


def test_nothing_is_clear_where_a_circle_covers_all() -> None:
    assert first_clear([0j, 1 + 1j], SIZE, Obstacles(circles=[(0j, 50.0)]), 1.0) is None


def test_a_letter_is_written_once_and_keeps_others_away() -> None:
    canvas = Canvas(STYLES["A3"])
    canvas.add(Line(-9 + 0j, 9 + 0j, Pen.THIN), Circle(0j, 1.0, Pen.MAIN))

    written = [canvas.write("O", [0j, 4j, 9j, 10 + 10j], 3.5) for _ in range(4)]

    letters = [shape for shape in canvas.shapes if isinstance(shape, Text)]
    assert written == [True, True, True, False]
    assert len({letter.at for letter in letters}) == 3
