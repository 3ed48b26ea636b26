"""Conclusions of notes of gears and hoists: what they say is what is solved, and every check is told as it came out."""

from __future__ import annotations

import re

import pytest

from kulman import note
from kulman.drawing.notes.blocks import Steps
from kulman.scales.errors import LANGUAGES
from kulman.scales.packaged import packaged
from kulman.scales.scale import Scale
from kulman.tests.support.cases import solve_case
from kulman.variants.case import Case, Settings

GEAR, HOIST = "madi-gear", "karpenko-hoist"
SLACK = {"V_0": "1.5 m/s", "a": "0"}


def concluded(task: str, variant: str | None = None, settings: Settings | None = None, lang: str = "en") -> list[str]:
    return list(told(solve_case(task, variant, settings, None, None), lang))


def told(case: Case, lang: str) -> tuple[str, ...]:
    words, said = case.words(lang), packaged("kulman.drawing.notes", "texts", lang)
    return case.kind.story(case, {"meshing": Scale("mu_l", 0.0005, "m")}, words, said).conclusions


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize(
    ("task", "settings"),
    [(GEAR, None), (GEAR, {"x_1": "-0.3", "x_2": "-0.3"}), (HOIST, None), (HOIST, {"V_0": "4 m/s"})],
)
def test_conclusions_are_whole_sentences_in_every_language(task: str, settings: Settings, lang: str) -> None:
    said = concluded(task, settings=settings, lang=lang)

    assert len(said) >= 4
    for text in said:
        assert text.endswith(".")
        assert text[0].isupper()
        assert not re.search(r"\b(nan|inf|None)\b|  ", text)
        assert lang == "en" or not re.search(r"\d\.\d", text)
        assert lang != "en" or not re.search(r"\d,\d", text)


def test_gears_are_judged_as_their_checks_are() -> None:
    good, bad = (" ".join(concluded(GEAR, settings=s)) for s in (None, {"x_1": "-0.3", "x_2": "-0.3"}))

    assert r"x_{1} = 0.2000 ≥ x_{min 1} = 0.1227; x_{2} = 0.8500 ≥ x_{min 2} = −0.1698" in good
    assert "ε_{α} = 1.2048 ≥ 1.2000. During 20 % of the time two pairs" in good
    assert "roots of the pinion wear more" in good
    assert r"Teeth are undercut: x_{1} = −0.3000 < x_{min 1} = 0.1227" in bad
    assert "No tooth is undercut" not in bad


def test_shifts_that_make_both_wheels_slide_alike_are_said_to() -> None:
    said = concluded(GEAR, settings={"x_sum": "1.05"})

    assert any("both wheels wear alike" in text for text in said)


@pytest.mark.parametrize("variant", ["V03", "V04"])
def test_hoists_compare_the_greatest_force_with_the_static_one(variant: str) -> None:
    case = solve_case(HOIST, variant, None, None, None)
    found = case.solved.quantities
    said = " ".join(told(case, "en"))

    force, rest = (found[name].value or 0.0 for name in ("F_max", "P_st"))
    assert f"{force:.0f} N, comes" in said
    assert f"is mg = {rest:.0f} N: " in said
    factor = re.search(r"/mg = ([\d.]+)\.", said)
    assert factor is not None
    assert float(factor[1]) == pytest.approx(force / rest, abs=5e-4)
    assert ("The rope is strong enough" in said) == ((found["safety"].value or 0.0) >= case.solved.givens["K"])
    assert f"l_{{0}}/{round(case.solved.givens['l_0'] / (found['w_0_max'].value or 1.0))}" in said


def test_hoists_say_where_the_closed_formulas_do_not_hold() -> None:
    said = " ".join(concluded(HOIST, "V04", {"V_0": "4 m/s"}))

    assert "the closed formulas do not hold" in said
    assert "the closed formulas hold" not in said
    assert "article" not in said


@pytest.mark.parametrize(
    ("task", "format"), [(GEAR, "A3"), *(pytest.param(GEAR, f, marks=pytest.mark.soak) for f in ("A1", "A4"))]
)
def test_scale_of_specific_sliding_is_that_of_the_figure(task: str, format: str) -> None:
    written = note(task, only="sliding", format=format, lang="en")

    steps = next(block for block in written.document.blocks if isinstance(block, Steps))
    under = " ".join(line for line in written.figures["sliding"].under)
    value = re.search(r"μ_\{θ\} = [\d.]+ mm\^\{−1\}", under)
    assert value is not None
    assert value[0] in steps.texts[-1]
