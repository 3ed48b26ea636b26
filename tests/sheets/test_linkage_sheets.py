"""Sheets of all bundled linkages: the examiner's points L1 to L13 against constraint equations; planted faults."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from dataclasses import replace

import pytest

from kulman import solve
from kulman.tests.support.cases import some
from kulman.tests.support.linkage_cases import Linkage
from kulman.tests.support.linkage_points import (
    Faults,
    Judged,
    l3_to_l6_plans,
    l5_similarity,
    l7_senses,
    l9_arms,
    l11_driver,
    l12_lever,
    linkage_faults,
)
from kulman.tests.support.printed_numbers import half_digit, table, value
from kulman.tests.support.readback import Sheet, Stroke, View
from kulman.variants.shelf import bundled, summary

INSET = 5.0  # mm, or cm
MEASURED = "results_(velocity|acceleration|forces)"
CASE = Linkage("scheme-17-sewing-machine", "0", format="A1")
Plant = Callable[[Sheet], None]


def printed(name: str, old: str, new: str) -> Plant:
    """Print another number in a view."""

    def plant(sheet: Sheet) -> None:
        view = sheet[name]
        (i,) = [i for i, text in enumerate(view.texts) if old in text.string]
        view.texts[i] = replace(view.texts[i], string=view.texts[i].string.replace(old, new))

    return plant


def moved(view: View, stroke: Stroke, start: complex, end: complex) -> None:
    first, last = stroke.points
    view.strokes[view.strokes.index(stroke)] = replace(stroke, points=(first + start, last + end))


def arm(name: str, arm: str, aside: complex, longer: float = 0.0) -> Plant:
    """Move an arm by `aside`, in its own direction and across it, and make it longer."""

    def plant(sheet: Sheet) -> None:
        view = sheet[name]
        (line,) = [s for s in view.inside("arm", arm) if s.role == "thin"]
        e = (line.points[1] - line.points[0]) / abs(line.points[1] - line.points[0])
        moved(view, line, e * aside, e * (aside + longer))

    return plant


def arc(name: str, by: complex) -> Plant:
    """Draw an arc of turning about another point."""

    def plant(sheet: Sheet) -> None:
        view = sheet["position"]
        (old,) = [s for s in view.inside("arrow", name) if s.arc]
        assert old.arc is not None
        centre, *rest = old.arc
        points = tuple(point + by for point in old.points)
        view.strokes[view.strokes.index(old)] = replace(old, points=points, arc=(centre + by, *rest))
        heads = [i for i, tip in enumerate(view.tips) if ("arrow", name) in tip.path]
        for i in heads:
            a, b, c = view.tips[i].corners
            view.tips[i] = replace(view.tips[i], corners=(a + by, b + by, c + by))

    return plant


def vector(sheet: Sheet) -> None:
    view = sheet["acceleration"]
    i = max(range(len(view.vectors)), key=lambda i: abs(view.vectors[i].span))
    view.vectors[i] = replace(view.vectors[i], tip=view.vectors[i].tail + 1.01 * view.vectors[i].span)


def side(sheet: Sheet) -> None:
    view = sheet["velocity"]
    del view.strokes[view.strokes.index(view.lines("similarity")[0])]


def couple(sheet: Sheet) -> None:
    view = sheet["lever"]
    i = next(i for i, arrow in enumerate(view.arrows) if "_couple_" in arrow.name)
    view.arrows[i] = replace(view.arrows[i], tail=view.arrows[i].tip, tip=view.arrows[i].tail)


@pytest.mark.parametrize(
    ("judge", "plant"),
    [
        pytest.param(l11_driver, printed("driver", "0,0005", "0,000505"), id="scale of the driver"),
        pytest.param(l7_senses, arc("omega_4", 3 + 0j), id="arc about another point"),
        pytest.param(l9_arms, arm("driver", "h_21", 1j), id="arm from beside the centre"),
        pytest.param(l9_arms, arm("lever", "h_lever_F_4", 1 + 1j), id="arm of the lever from beside the pole"),
        pytest.param(l9_arms, arm("lever", "h_lever_F_4", 0j, 0.5), id="arm past the line of its force"),
        pytest.param(l9_arms, printed("driver", "h_{21} = 17,50", "h_{21} = 17,68"), id="length of an arm"),
        pytest.param(l3_to_l6_plans, vector, id="length of a vector"),
        pytest.param(l5_similarity, side, id="no side of a similar triangle"),
        pytest.param(l12_lever, couple, id="couple of equal senses"),
        pytest.param(l12_lever, printed("results_lever", "42,09", "42,19"), id="arm of a couple"),
    ],
)
def test_planted_fault_is_seen(judge: Callable[[Judged, Sheet], Faults], plant: Plant) -> None:
    parsed = {id(page.root): page.root for page in CASE.sheet.pages}  # is not copied
    spoiled = copy.deepcopy(CASE.sheet, parsed)
    plant(spoiled)

    assert list(judge(CASE, CASE.sheet)) == []
    assert list(judge(CASE, spoiled))


TASKS = {task: tuple(summary(task)["variants"]) for task in bundled("mechanism") if task != "nau-slider-crank"}
SAMPLE = [Linkage(task, variants[k % len(variants)], format="A1") for k, (task, variants) in enumerate(TASKS.items())]


@pytest.mark.parametrize("case", some(SAMPLE[::12], 1), ids=str)
def test_sheet_of_a_scheme_is_without_fault(case: Linkage) -> None:
    assert linkage_faults(case) == []


@pytest.mark.parametrize("case", some((Linkage("nau-slider-crank", "3", format="A1"), *SAMPLE), 0, 5), ids=str)
def test_solve_tells_the_millimetres_that_the_sheet_prints(case: Linkage) -> None:
    found = solve(case.task, case.variant, format="A1", lang="uk")
    told: dict[str, list[float]] = {}  # by symbol: a load's arms about a link's point and on the lever have one
    for name, quantity in found.items():
        told.setdefault(found.words.symbol(name), []).append(quantity.shown(found.words.display).mm or 0.0)

    tables = (table(case.sheet[name]) for name in case.sheet.names if re.match(MEASURED, name))
    printed = {row[0]: row[1] for rows in tables for row in rows if row[0] in told and row[1] != "–"}

    assert "h_{21}" in printed or case.task != "nau-slider-crank"
    shown = {symbol: mm for symbol, mm in printed.items() if min(told[symbol]) >= INSET}  # others are read in details
    faults = {s: min(abs(value(mm) - of) for of in told[s]) / max(half_digit(mm), 0.01) for s, mm in shown.items()}
    assert {symbol: told[symbol] for symbol, by in faults.items() if by > 1.001} == {}  # forces are laid off by numbers


@pytest.mark.soak
@pytest.mark.parametrize("turn", [0, 1])
@pytest.mark.parametrize(("number", "task"), [*enumerate(TASKS)])
def test_sheets_of_a_scheme_on_other_formats_are_without_fault(number: int, task: str, turn: int) -> None:
    """Each on two of these formats by turns."""
    lang, format = (("en", "A3"), ("ru", "A2"), ("uk", "A4"))[(number + turn) % 3]
    case = Linkage(task, TASKS[task][0], lang, format)

    assert linkage_faults(case) == []
