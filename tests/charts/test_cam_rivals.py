"""Ways to the motion of a cam: their orders, who agrees with whom, what a construction needs."""

from __future__ import annotations

import time
from functools import cache

import numpy as np
import pytest

import kulman
from kulman.plans.cams.chords import V_MAX, drawn_on, exact_values
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.solve import SolvedCam
from kulman.plans.hands.shaky import preset
from kulman.plans.lab import cams as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.cams import errors, in_extended, midpoint, rivals, simpson
from kulman.plans.lab.race import Contest, Effort

TASK = "madi-cam"


@cache
def cam(law: str = "sawtooth", **settings: str) -> SolvedCam:
    solved = kulman.solve(TASK, set={"law": law, **settings}, only="sizes").solved
    assert isinstance(solved, SolvedCam)
    return solved


@cache
def race() -> Contest:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contests, "ROUNDS", 1)
        patch.setattr(races, "BY_HAND", (12,))
        patch.setattr(races, "AT_ONCE", (12,))
        return rivals(cam(), time.process_time, preset("normal").hand, Effort((1, 10), 20))


def motion_errors(motion: Motion, way: object, sections: int) -> dict[str, float]:
    division = motion.division(sections)
    course = way(motion, "diagram_a", division)  # type: ignore[operator]
    return {
        kind: float(e.max())
        for kind, e in errors(motion, division, course, in_extended(motion, division.angles)).items()
    }


def test_sums_of_mean_ordinates_are_the_chords_of_the_board() -> None:
    board = {(e.kind, e.setting): e.error for e in race().entries if e.method == races.BOARD}
    sums = {(e.kind, e.setting): e.error for e in race().entries if e.method == races.MIDPOINT}

    assert len(board) == 2 * len(races.ON_BOARD)
    assert {key: sums[key] for key in board} == pytest.approx(board, rel=1e-9)


def test_many_boards_at_once_err_as_one() -> None:
    (many,) = [e for e in race().of("travel") if e.method == races.BOARDS]
    (alone,) = [e for e in race().of("travel") if e.method == races.BOARD and e.setting == 12]

    assert many.at_once == races.CAMS
    assert many.error == alone.error
    assert many.seconds is not None


@pytest.mark.parametrize(("way", "order"), [(midpoint, 2.0), (simpson, 4.0)])
def test_sums_have_their_orders_where_the_law_bends(way: object, order: float) -> None:
    motion = cam("polynomial-345", u="1/2").motion

    coarse, fine = (motion_errors(motion, way, n) for n in (12, 24))

    for kind in coarse:
        assert np.log2(coarse[kind] / fine[kind]) == pytest.approx(order, abs=0.2)


def test_parabolas_are_exact_for_straight_accelerations_and_closed_forms_for_all() -> None:
    found = {(e.method, e.kind): e.error for e in race().entries if e.setting in (12, 10)}

    assert found["simpson", "travel"] < 1e-13  # type: ignore[operator]
    assert found["closed", "travel"] < 1e-15  # type: ignore[operator]
    assert found["closed", "speed"] < 1e-15  # type: ignore[operator]


def test_jumps_between_lines_make_sums_of_first_order() -> None:
    found = {e.setting: e.error for e in race().of("speed") if e.method == races.MISSED}

    assert found[3073] / found[12289] == pytest.approx(4.0, rel=0.02)  # type: ignore[operator]


def test_a_hand_stands_beside_the_others() -> None:
    (entry,) = [e for e in race().of("travel") if e.method == races.HAND]

    assert entry.seconds is None
    assert entry.setting == "n = 12"
    assert 0.1 < entry.error < 1.0  # type: ignore[operator]


def test_construction_of_some_values_needs_few_steps() -> None:
    solved = cam()
    division = solved.motion.division(12)

    whole, part = (drawn_on(solved, division, names).program for names in (tuple(exact_values(solved)), (V_MAX,)))

    assert len(part.names) < 0.5 * len(whole.names)
