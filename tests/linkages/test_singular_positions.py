"""Singular and nearly singular positions: status, reason, what remains defined, and the limits from both sides."""

from __future__ import annotations

import cmath
import json
import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from kulman import cli
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES
from kulman.plans.boards.precision import fifty_digits
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, conditions_of, solve_linkage
from kulman.plans.quantities import references
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.both_sides import Limit, limits
from kulman.tests.support.singular_cases import CASES
from kulman.tests.support.special_position import Case

EPS = 2.0**-52
BESIDE = (0.0, 0.1, -0.1, 0.0)  # radians or metres from the position to others of the same batch
ARMS = ("h_", "delta_")  # of a force that vanishes any arm will do; of two values that vanish there is no ratio
ORDINARY = [case for case in CASES if case.status in ("ok", "singular")]


@cache
def solved(case: Case) -> SolvedLinkage:
    return solve_linkage(case.of, case.values)


@cache
def tends(case: Case) -> dict[str, Limit]:
    return limits(solved(case), case.along, case.exact)


def undefined(case: Case) -> set[str]:
    found = solved(case)
    return {name for name in found.program.names if cmath.isnan(found.values[name])}


def test_there_are_cases_of_every_status() -> None:
    assert len(CASES) == len({case.name for case in CASES}) >= 50
    assert {case.status for case in CASES} == set(STATUSES)


SLOW = {"triad a billionth of a radian before", "triad a billionth of a radian beyond"}  # searched for so near


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=[pytest.mark.soak] * (case.name in SLOW), id=str(case)) for case in CASES]
)
def test_status_is_as_expected_alone_and_in_a_batch(case: Case) -> None:
    # groups of class III are followed to each place, which takes its time
    places = [case.values[case.along] + off * (not case.of.starts) for off in BESIDE]

    statuses, results = in_batch(case, places)

    assert solved(case).status == case.status
    assert statuses[0] == statuses[3] == case.status
    lost = {name for name, values in results.items() if np.isnan(values[0])}
    assert lost == undefined(case)
    for k, place in enumerate(places):
        beside = place != case.values[case.along]
        alone = solve_linkage(case.of, {**case.values, case.along: place}) if beside else solved(case)
        assert alone.status == statuses[k]
        if alone.mechanism == solved(case).mechanism:  # moments may be taken about another joint elsewhere
            assert [name for name in results if not same(results[name][k], alone.values[name])] == []


def in_batch(case: Case, places: list[float]) -> tuple[list[str], dict[str, Any]]:
    mechanism, program = solved(case).mechanism, solved(case).program
    givens = board_givens(mechanism, {**case.values, case.along: np.array(places)}, program)
    results, codes = batch(program, givens, program.names)
    return [STATUSES[code] for code in codes], results


def same(first: Any, second: Any) -> bool:
    return bool(first == second or (np.isnan(first) and np.isnan(second)))


@pytest.mark.parametrize("case", CASES, ids=str)
def test_reason_names_lines_and_points(case: Case) -> None:
    error = solved(case).error()

    if case.says is None:
        assert error is None
        assert case.status in ("ok", "ill-conditioned")
        return
    key, named = case.says
    assert error is not None
    assert (error.key, error.status_word, error.status) == (key, case.status, 3)
    assert {name: error.data[name] for name in named} == named
    for language in LANGUAGES:
        text = error.text(language)
        assert all(str(value) in text for value in named.values())


@pytest.mark.parametrize("case", CASES, ids=str)
def test_what_is_lost_is_undefined_and_the_rest_is_there(case: Case) -> None:
    gone = {name for name, item in solved(case).quantities.items() if item.value is None and item.x is None}

    assert set(case.lost) <= gone
    assert gone.isdisjoint(case.kept)
    assert bool(gone) == (case.status in ("singular", "no-assembly"))
    assert set(case.kept) <= solved(case).quantities.keys()
    for item in solved(case).quantities.values():
        parts = [part for part in (item.value, item.x, item.y) if part is not None]
        assert all(map(math.isfinite, parts))


@pytest.mark.parametrize("case", ORDINARY, ids=str)
def test_what_is_defined_is_the_limit_from_both_sides_and_what_is_lost_has_none(case: Case) -> None:
    found = solved(case)
    sizes = references(found.program, found.values)
    wrong, hidden = {}, set()
    for name, limit in tends(case).items():
        value = found.values[name]
        if cmath.isnan(value):
            hidden |= {name} if abs(limit.value or 0.0) > 1e-12 else set()
        elif limit.value is None or abs(value - limit.value) > tolerance(limit, sizes[name]):
            wrong[name] = (value, limit)

    assert {name: pair for name, pair in wrong.items() if not name.startswith(ARMS)} == {}
    assert [name for name in hidden if not name.startswith(ARMS) and name not in case.hidden] == []


def tolerance(limit: Limit, size: float) -> float:
    """Return 1e-12 of the largest vector; where there is only one side, what is left of the way, 1e-9 of it."""
    return (1e-12 if limit.below is not None and limit.above is not None else 1e-9) * max(size, 1.0)


@pytest.mark.parametrize("case", [case for case in CASES if case.limits], ids=str)
def test_limits_are_those_of_geometry(case: Case) -> None:
    found = solved(case)
    sizes = references(found.program, found.values)
    for name, expected in case.limits.items():
        limit = tends(case)[name]

        if math.isnan(expected):
            assert limit.value is None, name
            assert cmath.isnan(found.values[name]), name
        else:
            assert limit.value is not None, name
            size = abs(limit.value) if isinstance(found.values[name], complex) else limit.value.real
            assert size == pytest.approx(expected, rel=1e-12, abs=1e-12 * max(sizes[name], 1.0)), name


@pytest.mark.parametrize("case", [case for case in CASES if case.status == "ill-conditioned"], ids=str)
def test_ill_conditioned_positions_err_by_no_more_than_their_condition_says(case: Case) -> None:
    found = solved(case)
    exact = fifty_digits(found.program, found.givens)
    sizes, known = references(found.program, found.values), conditions_of(found)

    for name, size in sizes.items():
        condition = known[name].value
        if condition is not None and not name.startswith(ARMS):
            miss = abs(complex(exact[name] - found.values[name]))
            assert miss <= 8.0 * EPS * (condition + 1.0) * size, (name, miss / size, condition)
    assert min(item.sine for item in known.values()) < 1e-3


COMMANDS = {
    "ok": ("nau-slider-crank --set phi=0", "V_B", None),
    "ill-conditioned": ("nau-slider-crank --set phi=90 --set l_OA=50 --set l_AB=50,000001", "V_B", None),
    "singular": ("madi-four-bar --set phi=180 --set l_AB=120 --set l_BC=390 --set l_DC=240", "V_C", "⊥BC"),
    "singular pins": ("madi-four-bar --set phi=0 --set l_AB=510 --set l_BC=380", "V_C", "B"),
    "singular guide": ("scheme-09-shaper --set phi=90 --set l_DE=20", "V_E", "⊥DE"),
    "no-assembly": ("nau-slider-crank --set phi=90 --set l_OA=50 --set l_AB=49,999999", "B", "1e-06 mm"),
    "no-assembly slide": ("scheme-18-hydraulic-drive --set s=-40 --set l_AB=200", "V_B", "mm"),
}


@pytest.mark.parametrize("kind", COMMANDS)
def test_the_command_line_tells_status_and_cause(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    command, name, cause = COMMANDS[kind]
    status = kind.partition(" ")[0]

    with pytest.raises(SystemExit) as stopped:
        cli.main(["solve", *command.split(), "--json"])

    out, err = capsys.readouterr()
    found = json.loads(out)
    parts = [found["quantities"][name].get(part) for part in ("value", "x", "y")]
    assert found["status"] == status
    assert stopped.value.code == (0 if cause is None else 3)
    assert (parts == [None] * 3) == (cause is not None)
    assert (cause or "") in err
    assert found["quantities"]["omega_1" if "omega_1" in found["quantities"] else "V_A"]["value"] is not None
