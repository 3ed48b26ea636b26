"""The plans of a student over the right ones: letters beside their vectors, scripts that every browser sets."""

from __future__ import annotations

import re
from itertools import combinations
from xml.etree import ElementTree

import numpy as np
import pytest

from kulman import check
from kulman.tests.support.mechanisms import SEED
from kulman.variants.marking.figures import Box, boxes, plan_figures

TASK = "madi-four-bar"


def figures(task: str) -> list[ElementTree.Element]:
    asked = check(task, lang="en")
    marked = asked.mark(asked.read("printed")[0]).marked
    return [ElementTree.fromstring(svg) for _, svg in plan_figures(marked, "en")]


def test_letters_of_many_vectors_lie_on_no_other() -> None:
    random = np.random.default_rng(SEED)
    ends = [complex(*xy) for xy in random.uniform(0.0, 150.0, (24, 2))]
    vectors = [(tail, tip, 4) for tail, tip in zip(ends[::2], ends[1::2], strict=True)]

    placed = list(boxes(vectors, complex(150.0, 150.0)))

    assert len(placed) == len(vectors)
    assert all(box.lies_in(complex(150.0, 150.0)) for box in placed)
    assert not any(one.meets(other) for one, other in combinations(placed, 2))
    assert Box(0j, 2.0).meets(Box(3.9 + 3.5j, 2.0))


@pytest.mark.parametrize(("tail", "tip"), [(0j, 100 + 0j), (0j, 100j), (0j, 60 + 80j), (50 + 0j, 0j), (9j, 9j)])
def test_letters_stand_beside_their_vector(tail: complex, tip: complex) -> None:
    tail, tip = tail + complex(20.0, 20.0), tip + complex(20.0, 20.0)
    (box,) = boxes([(tail, tip, 3)], complex(140.0, 140.0))

    along = np.linspace(0.0, 1.0, 400) * (tip - tail) + tail - box.middle

    assert not np.any((np.abs(along.real) < box.half) & (np.abs(along.imag) < 1.8))


def test_scripts_are_moved_and_the_line_goes_on_where_it_was() -> None:
    texts = [text for figure in figures(TASK) for text in figure.iter("text")]
    marked = [text for text in texts if "".join(text.itertext()).endswith("✓")]

    assert len(texts) > 20
    assert marked
    for text in texts:
        moves = [float(piece.attrib["dy"]) for piece in text]
        levels = np.cumsum(moves)
        small = ["font-size" in piece.attrib for piece in text]
        assert levels[0] == 0.0
        assert [bool(abs(level) > 0.5) for level in levels] == small
        assert not any("baseline-shift" in piece.attrib for piece in text)
    for text in marked:
        assert sum(float(piece.attrib["dy"]) for piece in text) == pytest.approx(0.0, abs=1e-9)


def test_every_figure_is_well_formed_and_holds_its_lines() -> None:
    for figure in figures(TASK):
        width, height = map(float, figure.attrib["viewBox"].split()[2:])
        numbers = [float(n) for path in figure.iter("path") for n in re.findall(r"-?\d+\.\d+", path.attrib["d"])]

        assert numbers
        assert min(numbers) >= 0.0
        assert max(numbers) <= max(width, height)
