"""The angle at a rocker's pivot between its lowest position and the line of centres: as drawn, and as it is said."""

from __future__ import annotations

import cmath
import math
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman.plans.laws import LAWS
from kulman.tests.support.readback import read

EXAMPLE = Path(kulman.__file__).parent / "docs" / "examples" / "rocker-cam.toml"


@pytest.mark.parametrize("setting", [{"rotation": "ccw"}, {"rotation": "cw"}, {"l_OC": "140 mm"}])
def test_the_angle_at_the_pivot_is_that_of_its_positions_drawn(setting: dict[str, str]) -> None:
    found = kulman.solve(EXAMPLE, set=setting)
    angle = found["psi_0"].value

    roller, centre = (complex(found.solved.values[f"rocker_sizes.{mark}"]) for mark in ("B0", "C"))

    assert found["psi_0"].unit == "rad"
    assert angle == pytest.approx(abs(cmath.phase(centre / roller)), rel=1e-9)


def test_the_sheet_says_the_angle_at_the_pivot() -> None:
    drawn = kulman.sheet(EXAMPLE, only="sizes", lang="en", format="A2")
    said = "".join(text.string for page in range(len(drawn.pages)) for text in read(drawn.svg(page + 1)).texts)

    assert f"= {math.degrees(kulman.solve(EXAMPLE)['psi_0'].value or 0.0):.2f}°" in said


def test_a_triangle_of_no_height_has_its_angle() -> None:
    angle = LAWS["angle_of_triangle"]

    assert angle(3.0, 4.0, 5.0) == pytest.approx(math.pi / 2)
    assert angle(0.1, 0.3, 0.2 * (1.0 - 1e-15)) == 0.0
    assert angle(0.1, 0.3, 0.4 * (1.0 + 1e-15)) == math.pi
    assert list(angle(np.array([3.0, 1.0]), 4.0, 5.0)) == pytest.approx([math.pi / 2, math.pi])
