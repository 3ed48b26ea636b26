"""Nothing but the structure asked for: it is drawn with its scheme, and nothing else."""

from __future__ import annotations

import re

import pytest

from kulman import sheet


@pytest.mark.parametrize("task", ["nau-slider-crank", "madi-four-bar", "bertyaev-six-bar", "scheme-20-press-automaton"])
def test_a_structure_is_drawn_with_its_scheme(task: str) -> None:
    svg = sheet(task, only="structure", lang="en").svg()

    assert set(re.findall(r'class="view" data-name="([^"]+)"', svg)) == {
        "givens",
        "structure",
        "position",
    }
