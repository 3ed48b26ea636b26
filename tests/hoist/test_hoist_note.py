"""Notes of hoists: formulas with their numbers are those of the results, the drawings are told in every language."""

from __future__ import annotations

from itertools import chain, pairwise

import pytest

from kulman import note
from kulman.drawing.formats import STYLES
from kulman.drawing.hoist.scene import HoistScene
from kulman.drawing.hoist.text import BENT, BY_DRAWING, HANGING, REDUCED, SLACK, STARTED, formula
from kulman.drawing.notes.blocks import Equations, Figure, Steps, Table
from kulman.drawing.words import Words
from kulman.plans.hoist.forces import forces
from kulman.plans.hoist.solve import SolvedHoist
from kulman.plans.laws import form_of
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.cases import solve_case

TASK = "karpenko-hoist"
FORMULAS = (*REDUCED, SLACK, *STARTED, *HANGING, *BENT)


def said(variant: str, lang: str = "en", **settings: str) -> str:
    blocks = note(TASK, variant, set=settings, lang=lang).document.blocks
    lines = chain.from_iterable(block.lines for block in blocks if isinstance(block, Equations))
    steps = chain.from_iterable(block.texts for block in blocks if isinstance(block, Steps))
    return "\n".join([*map(" ".join, lines), *steps])


@pytest.mark.parametrize("variant", ["V01", "V03", "V04", "V09", "V10"])
def test_expressions_that_are_printed_give_the_results(variant: str) -> None:
    solved = solve_case(TASK, variant, {"slack": "0.03 m"}, None, None).solved
    found = dict(forces(solved.givens).found)
    for told in FORMULAS:
        step = solved.program.by_name[told]
        law, names = BY_DRAWING.get(told) or (step.law, step.operands)
        value = form_of(law)(*(found[name] for name in names))
        assert value == pytest.approx(found[told], rel=1e-12, abs=1e-300), told


def test_numbers_stand_in_the_place_of_letters() -> None:
    case = solve_case(TASK, "V03", None, None, None)
    words = case.kind.lettered(Words.of("en", "nau"), case.solved)
    scene = HoistScene(SolvedHoist.of(case.solved), words, STYLES["A4"], case.givens, {})
    by_name = {told: " ".join(formula(scene, told)) for told in FORMULAS}
    assert by_name["m"] == "m = (G_{1} + G_{2}/3)/g = (32000 + 90/3)/9.81 = 3265 kg (4)"
    assert by_name["R"].endswith("= √((−2534)^{2} + 8241^{2}) = 8622 N")
    assert "3·2.06·10^{11}·5·10^{−5}·22.68/4^{3} = 10948129 N/m (5)" in by_name["C_01"]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_drawing_is_told(lang: str) -> None:
    blocks = note(TASK, "V04", lang=lang).document.blocks
    told = {
        after.view.name: len(before.texts)
        for before, after in pairwise(blocks)
        if isinstance(before, Steps) and isinstance(after, Figure)
    }
    views = [block.view for block in blocks if isinstance(block, Figure)]
    assert told == {view.name: len(view.stages) - 1 for view in views if view.stages}
    assert {*told} == {"scheme", "model", "forces", "lift_off", "extremes", "circle", "beams"}


def test_rigid_beams_are_not_put_in() -> None:
    text = said("V03", I_0="inf", I_2="inf")
    assert "C_{01} = 3·E_{0}·I_{0}·α_{0}/l_{0}^{3} = ∞ N/m (5)" in text
    assert "nan" not in text
    assert "inf" not in text
    assert "w_{0 max}" not in text


def test_slack_is_told_of_where_there_is_one() -> None:
    assert "V_{t} = √(" in said("V03", slack="0.03 m")
    assert "V_{t} = √(" not in said("V03")


def test_formulas_that_are_not_valid_are_not_told() -> None:
    text = said("V04", V_0="4 m/s")
    assert "The closed formulas are not valid here" in text
    assert "P_{12 max} = P_{m} + R" not in text
    assert "(11)" not in text.partition("Divide")[0]


def test_small_and_large_numbers_are_printed_as_people_write_them() -> None:
    blocks = note(TASK, "V03", lang="en").document.blocks
    rows = [row for block in blocks if isinstance(block, Table) for row in block.rows]
    assert any(row[3:] == ("σ_{max}", "256.1", "MPa") for row in rows)
    under = [line for block in blocks if isinstance(block, Figure) for line in block.under]
    assert "F_{01} is the deflection w_{0} of the support beam, too: 0.0000457 m/mm" in under
