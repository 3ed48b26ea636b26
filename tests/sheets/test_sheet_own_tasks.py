"""Sheets of slider-cranks that a user may write: other letters, a crank with a counterweight, a rod without mass."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import kulman

BUNDLED = files("kulman.variants").joinpath("tasks", "nau-slider-crank.toml").read_text(encoding="utf-8")


def drawn(folder: Path, *changes: tuple[str, str]) -> str:
    """Return the SVG of the first variant of the bundled task with some of its text changed."""
    text = BUNDLED
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    file = folder / "own.toml"
    file.write_text(text, encoding="utf-8")
    return kulman.sheet(file, lang="en", format="A1").svg()


def test_a_couple_has_both_primes_whatever_its_joints_are_called(tmp_path: Path) -> None:
    svg = drawn(
        tmp_path,
        ('A = ["l_OA"', 'D = ["l_OA"'),
        ('A = ["0 mm", "0 mm"], B', 'D = ["0 mm", "0 mm"], B'),
        ('point = "A"', 'point = "D"'),
        ("pa=80", "pd=80"),
        ("p'a'=80", "p'd'=80"),
    )

    assert "F″" in svg
    assert "F′" in svg
    assert "h″" in svg
    assert 'data-name="h_lever_M_i2_D"' in svg


def test_the_arm_of_a_counterweight_is_drawn(tmp_path: Path) -> None:
    svg = drawn(
        tmp_path,
        (
            'A = ["l_OA", "0 mm"] }\ncentre = "O"',
            'A = ["l_OA", "0 mm"], S1 = ["-20 mm", "0 mm"] }\ncentre = "S1"\nmass = "m_2"',
        ),
    )

    assert 'data-quantity="F_i1"' in svg
    assert 'class="line-of-action" data-name="F_i1"' in svg


def test_a_rod_without_mass_is_drawn(tmp_path: Path) -> None:
    svg = drawn(tmp_path, ('centre = "S2"\nmass = "m_2"\ninertia = "J_S2"\n', 'centre = "S2"\n'))

    assert 'data-quantity="R_12"' in svg
    assert 'data-quantity="F_i2"' not in svg
