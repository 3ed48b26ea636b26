"""What a cam measures on paper: the sheet, `solve` and its JSON say the same, on a small format, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import check, sheet, solve
from kulman.plans.cams.solve import EQUAL, SCALES
from kulman.scales.errors import InputError
from kulman.tests.support.cam_cases import MU_D2S, MU_DS, MU_S, MU_S_D2S, MU_S_DS, measured, printed_scales
from kulman.tests.support.printed_numbers import lines_of
from kulman.tests.support.readback import read
from kulman.variants.marking.report import to_json
from kulman.variants.sheets import Sheet
from kulman.variants.solution import Solution

TASK = "madi-cam"
PART = 0.5  # of the diagrams, for which A3 has no more room
SMALL = {"l_A1": "55 mm", "H_a": "15 mm", "H_v": "15 mm", "mu_phi": "2 deg/mm"}


@pytest.fixture(scope="module")
def small() -> Solution:
    return solve(TASK, format="A3")


@pytest.fixture(scope="module")
def drawn() -> Sheet:
    return sheet(TASK, format="A3")


def test_every_plan_has_a_symbol_of_its_own_for_its_scale_factor() -> None:
    own = [symbol for symbol in SCALES.values() if symbol != "mu_l"]

    assert len(own) == len(set(own))


def test_a_small_sheet_is_one_of_smaller_drawn_lengths(small: Solution) -> None:
    drawn_so = solve(TASK, set=SMALL)

    for name, quantity in drawn_so.quantities.items():
        assert small[name].value == pytest.approx(quantity.value, rel=1e-12, abs=1e-15), name


def test_scale_factors_and_segments_of_a_small_sheet_agree(small: Solution) -> None:
    data = small.to_json()
    for symbol, scale in data["scales"].items():
        if symbol in data["quantities"]:
            assert scale["value"] == data["quantities"][symbol]["value"], symbol
    for name, item in data["quantities"].items():
        if "mm" in item:
            assert item["mm"] == pytest.approx(abs(item["value"]) / data["scales"][item["scale"]]["value"]), name
    assert small["S_max_chord"].value == pytest.approx(PART * solve(TASK)["S_max_chord"].value)
    assert small["A_1"].mm == pytest.approx(PART * 110.0)


def test_a_small_sheet_prints_what_is_solved_for_it(small: Solution, drawn: Sheet) -> None:
    views = read(*(drawn.svg(page) for page in range(1, len(drawn.pages) + 1)))
    symbols = {
        "diagrams": {MU_S: "mu_s", MU_DS: "mu_ds", MU_D2S: "mu_d2s"},
        "sizes": {MU_S_DS: "mu_s_ds"},
        "plate_sizes": {MU_S_D2S: "mu_s_d2s"},
    }

    for view, own in symbols.items():
        printed = printed_scales(views[view])
        for symbol, name in own.items():
            assert printed[symbol] == pytest.approx(small.scales[name].mu, rel=5e-5), name
    assert measured(views["sizes"], "r_0") == pytest.approx(small["r_0"].mm, abs=0.01)
    said = " ".join(lines_of(views["choices"]))
    assert "0,5 заданих довжин: l_{A1} = 55 мм; H_{a} = 15 мм; H_{v} = 15 мм; 1 мм осі φ відповідає 2°" in said
    assert {"110", "30"} <= {text.string for text in views["givens"].texts}  # the table has what the task gives


def test_smaller_diagrams_are_told(small: Solution, drawn: Sheet) -> None:
    told = "on A3 the diagrams have no room: they are drawn at 0.5 of their size, with l_A1 = 55 mm, H_a = 15 mm"

    for warnings in (small.warnings, drawn.warnings):
        assert [warning.key for warning in warnings if warning.key != "scales-changed"] == ["cam-smaller"]
        assert warnings[0].text("en").startswith(told)
    assert solve(TASK).warnings == ()


def test_a_sheet_at_the_lengths_given_says_nothing_of_smaller_ones() -> None:
    whole = read(sheet(TASK, only="diagrams", format="A1").svg())

    assert not any("заданих довжин" in line for line in lines_of(whole["choices"]))


def test_segments_without_a_format_are_those_of_the_usual_sheet() -> None:
    wanted, drawn = solve(TASK), sheet(TASK)

    assert {plan: scale.mu for plan, scale in drawn.scales.items()} == {
        plan: wanted.scales[SCALES[plan]].mu for plan in drawn.scales
    }


@pytest.mark.parametrize("symbol", EQUAL)
def test_a_plan_of_two_diagrams_may_have_a_chosen_scale_factor(symbol: str) -> None:
    chosen = solve(TASK, scales={symbol: 0.0005})

    assert chosen.scales[symbol].mu == 0.0005
    assert chosen["r_0" if symbol == "mu_s_ds" else "r_0_flat_min"].scale == symbol


def test_a_scale_factor_that_follows_from_the_drawing_cannot_be_chosen() -> None:
    with pytest.raises(InputError, match=r"mu_s follows from the lengths on paper .*; chosen may be: mu_l, mu_s_ds"):
        solve(TASK, scales={"mu_s": 0.0002})


def test_what_is_drawn_on_a_small_sheet_is_marked_by_it(tmp_path: Path, small: Solution) -> None:
    answers, own = tmp_path / "answers.csv", (small["s_max"].value or 0.0) / 40.2  # from the student's own segment
    answers.write_text(f"quantity,value\nS_max_chord,40.2\nmu_s,{own!r}\n", encoding="utf-8")

    def verdicts(format: str | None) -> list[str]:
        asked = check(TASK, "17", lang="en", format=format, only="diagrams")
        (found,) = asked.read(str(answers))
        lines = to_json(asked.mark(found))["lines"]
        return [line["verdict"] for line in lines if line["quantity"] in ("S_max_chord", "mu_s")]

    assert verdicts(None) == ["wrong", "carried"]
    assert verdicts("A3") == ["right", "right"]
