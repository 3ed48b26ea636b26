"""Errors of the diagrams of cams: orders of chords, hands, lines beside jumps, closing; ways to the motion."""

import time
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import kulman
from kulman.plans.cams.chords import (
    BETWEEN,
    BOTH,
    CLOSED,
    NODES,
    R_0,
    S_MAX,
    V_MAX,
    Convergence,
    _drift,
    _exact_values,
    _stroke_closed,
    convergence,
    drawn_on,
    late,
    robustness,
)
from kulman.plans.cams.motion import Division, Motion
from kulman.plans.cams.solve import SolvedCam
from kulman.plans.hands.shaky import Hand, draw, preset
from kulman.plans.lab import cams as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.cams import _in_extended, _midpoint, _simpson, errors, rivals
from kulman.plans.lab.race import Contest, Effort
from kulman.scales.errors import InputError

TASK = "madi-cam"


@cache
def cam(law: str = "sawtooth", **settings: str) -> SolvedCam:
    solved = kulman.solve(TASK, set={"law": law, **settings}, only="sizes").solved
    assert isinstance(solved, SolvedCam)
    return solved


@cache
def chords(law: str, u: str = "1/3") -> Convergence:
    return convergence(cam(law, u=u), {}, sections=(24, 48, 96, 192), drawn=())


@pytest.mark.parametrize(
    ("law", "u"), [("sawtooth", "1/3"), ("constant", "0.4"), pytest.param("sawtooth", "0.37", marks=pytest.mark.soak)]
)
def test_chords_are_of_second_order_with_jumps_on_lines_and_of_first_between(law: str, u: str) -> None:
    found = chords(law, u)
    for quantity in (S_MAX, R_0):
        second, first = (found.order(where, quantity) for where in (NODES, BETWEEN))
        if law == "constant":  # its velocity is straight: chords find the stroke exactly
            assert second is None
        else:
            assert second == pytest.approx(2.0, abs=0.1)
        assert first == pytest.approx(1.0, abs=0.15)
    assert found.order(BETWEEN, V_MAX) == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    "law",
    [
        "cosine",
        "polynomial-345",
        *(pytest.param(law, marks=pytest.mark.soak) for law in ("sine", "modified-trapezoid")),
    ],
)
def test_laws_that_jump_at_the_ends_of_a_phase_only_are_of_second_order(law: str) -> None:
    found = chords(law)
    assert [*found.sections] == [NODES]
    for quantity in (V_MAX, S_MAX, R_0):
        assert found.order(NODES, quantity) == pytest.approx(2.0, abs=0.1)
    assert found.order(NODES, CLOSED) is None or found.order(NODES, CLOSED) > 1.9


def test_straight_accelerations_give_the_velocity_without_error_and_constant_velocities_the_travel() -> None:
    assert np.abs(chords("sawtooth").errors[NODES, V_MAX]).max() < 1e-14
    assert chords("sawtooth").order(NODES, V_MAX) is None
    with pytest.raises(InputError) as problem:
        convergence(cam("uniform"), {}, sections=(12, 24), drawn=())
    assert problem.value.key == "chart-exact-chords"


def test_a_hand_without_errors_draws_the_chords() -> None:
    found = convergence(cam(), {"steady": Hand(0.0, 0.0, 0.0)}, sections=(12, 24), drawn=(12, 24))
    for quantity in found.quantities:
        assert found.hands["steady", quantity] == pytest.approx(np.abs(found.errors[NODES, quantity]), abs=1e-12)


def test_sums_boards_and_closed_forms_err_as_they_should() -> None:
    errors_of = {(e.method, e.kind, e.setting): e.error for e in race().entries}
    board = {key[1:]: error for key, error in errors_of.items() if key[0] == races.BOARD}
    [many] = [e for e in race().of("travel") if e.method == races.BOARDS]
    [hand] = [e for e in race().of("travel") if e.method == races.HAND]
    missed = {e.setting: e.error for e in race().of("speed") if e.method == races.MISSED}

    assert len(board) == 2 * len(races.ON_BOARD)  # chords are sums of mean ordinates
    assert {key: errors_of[races.MIDPOINT, *key] for key in board} == pytest.approx(board, rel=1e-9)
    assert (many.at_once, many.error) == (races.CAMS, board["travel", 12])
    assert many.seconds is not None
    assert errors_of["simpson", "travel", 12] < 1e-13  # parabolas are exact for straight accelerations
    assert max(errors_of["closed", kind, 10] for kind in ("travel", "speed")) < 1e-15
    assert missed[3073] / missed[12289] == pytest.approx(4.0, rel=0.02)  # of first order
    assert (hand.seconds, hand.setting) == (None, "n = 12")
    assert 0.1 < hand.error < 1.0


def test_a_better_hand_errs_less_and_takes_more_sections() -> None:
    hands = {name: preset(name).hand for name in ("cad", "lenient")}
    found = convergence(cam(), hands, (S_MAX, CLOSED), (12,), (6, 18, 72))
    assert (found.hands["cad", CLOSED] < 0.5 * found.hands["cad", S_MAX]).all()
    cad, lenient = (found.hands[name, S_MAX] for name in ("cad", "lenient"))
    assert (cad < 0.3 * lenient).all()
    assert cad[1] < 0.5 * cad[0]
    assert cad[1] < cad[2]
    assert lenient[2] > 1.2 * lenient.min()
    assert found.best("cad", S_MAX) == (18, cad[1])


def test_a_drafting_machine_draws_along_the_edges_without_an_error_of_direction() -> None:
    solved, names = cam(), ("diagram_s.f12", "diagram_v.p1", "diagram_v.1")
    division = solved.motion.division(12)
    paper, whole = drawn_on(solved, division, names), drawn_on(solved, division, tuple(_exact_values(solved)))

    machine, free = (
        draw(one, Hand(0.0, 1.0, 0.0), np.random.default_rng(1), 50).values for one in (paper, replace(paper, edges=()))
    )

    assert np.ptp(np.imag(machine["diagram_s.f12"])) == 0.0
    assert np.ptp(np.imag(free["diagram_s.f12"])) > 1e-4
    assert np.ptp(np.real(machine["diagram_v.1"])) < 1e-15  # on its section line
    assert np.ptp(np.imag(machine["diagram_v.1"])) > 1e-5  # at the end of a chord
    assert len(paper.program.names) < 0.5 * len(whole.program.names)  # some values need few steps


def test_lines_at_jumps_only_are_late_and_err_as_far_as_they_are() -> None:
    solved, found = cam(), robustness(cam(), {}, (12, 24))
    division, middle = solved.motion.division(12), found.beside.index(0.0)
    moved = late(solved, division, 0.25).angles - division.angles
    assert [*np.flatnonzero(moved)] == [*division.jumps]
    assert np.degrees(moved[list(division.jumps)]) == pytest.approx([2.25, 2.25])
    assert found.missed[12, S_MAX][middle] == pytest.approx(1.0 / 64.0, rel=1e-9)
    for n in (12, 24):
        far, near = found.missed[n, V_MAX][-1], found.missed[n, V_MAX][(middle + len(found.beside)) // 2]
        assert far == pytest.approx(2.0 * near, rel=0.05)
    assert found.missed[12, S_MAX][-1] == pytest.approx(2.0 * found.missed[24, S_MAX][-1], rel=0.05)


def test_errors_that_cancel_in_a_ratio_are_none() -> None:
    drawing = kulman.solve(TASK, only="diagrams", hand="normal").drawing
    assert drawing is not None
    assert drawing.expected["mu_s_chord"].errs
    assert not drawing.expected["nu_chord"].errs
    assert drawing.expected["nu_chord"].step is None


def test_closing_takes_out_a_drift_of_the_velocity_exactly() -> None:
    """A velocity that is off by straight lines: so much is its integral off."""
    x = np.concatenate((np.linspace(0.0, 0.1, 13), np.linspace(0.12, 0.2, 13)))
    division = Division(x, 12, 13, 25)
    off = np.interp(x, [0.0, 0.1, 0.12, 0.2], [0.0, 0.004, 0.004, -0.002])
    speed = off + np.sin(2.0 * np.pi * x / 0.1) * np.where(x <= 0.1, 1.0, 0.0)
    fine = np.linspace(0.0, 0.2, 200_001)
    offs = np.interp(fine, [0.0, 0.1, 0.12, 0.2], [0.0, 0.004, 0.004, -0.002])
    areas = np.concatenate(([0.0], np.cumsum(0.5 * (offs[1:] + offs[:-1]) * np.diff(fine))))

    found = _drift(speed, x, division, 0.03)

    assert found == pytest.approx(np.interp(x, fine, areas) / 0.03, abs=1e-9)
    assert _stroke_closed(np.outer(x, [1.0, 2.0]) + 0.0, x) == pytest.approx(np.zeros((26, 2)), abs=1e-15)


def test_closing_brings_more_than_care() -> None:
    found = robustness(cam(), {name: preset(name).hand for name in ("careful", "normal")}, (12,))
    steady = robustness(cam("sine"), {"cad": preset("cad").hand})  # no inner jumps: no line to miss
    normal, careful = (found.closings[name].errors for name in ("normal", "careful"))
    assert normal[BOTH] < 0.2 * normal["drawn"]
    assert normal[BOTH] < normal["speed"] < normal["drawn"]
    assert normal[BOTH] < careful["drawn"]
    assert (steady.beside, steady.missed) == ((), {})
    assert steady.closings["cad"].errors[BOTH] < 0.05


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
        for kind, e in errors(motion, division, course, _in_extended(motion, division.angles)).items()
    }


@pytest.mark.parametrize(("way", "order"), [(_midpoint, 2.0), (_simpson, 4.0)])
def test_sums_have_their_orders_where_the_law_bends(way: object, order: float) -> None:
    motion = cam("polynomial-345", u="1/2").motion
    coarse, fine = (motion_errors(motion, way, n) for n in (12, 24))
    for kind in coarse:
        assert np.log2(coarse[kind] / fine[kind]) == pytest.approx(order, abs=0.2)
