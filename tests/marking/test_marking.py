"""The verdict of every line: honest hands pass, an error counts once, and what is free to choose is never wrong."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

from kulman.plans.hands.shaky import preset
from kulman.plans.marking.answers import Answer, Verdict
from kulman.plans.marking.key import Key, answer_key
from kulman.plans.marking.verdicts import CLEAR, Marking, mark
from kulman.scales.errors import InputError
from kulman.tests.support.marking_cases import LINKAGES, in_millimetres, key, paper, right_answers, students
from kulman.tests.support.mechanisms import SEED

TASK = "nau-slider-crank"
EXAMPLE = key(TASK, "example")
MUS = EXAMPLE.paper.mus


def verdicts(marking: Marking, *names: str) -> list[str]:
    return [str(marking[name].verdict) for name in names]


def altered(of: Key, **answers: Answer) -> Marking:
    """Mark right answers, some of them altered."""
    return mark(of, [answers.get(a.name, a) for a in right_answers(of, directions=False)])


def size(name: str) -> float:
    return float(abs(EXAMPLE[name]))


@pytest.mark.parametrize(
    ("task", "count", "directions"),
    [
        *(pytest.param(task, 4, True, id=task) for task in LINKAGES),
        *(pytest.param(task, 200, False, id=f"{task}-200", marks=pytest.mark.soak) for task in LINKAGES),
    ],
)
def test_answers_of_honest_hands_are_right(task: str, count: int, directions: bool) -> None:
    marked = [
        mark(key(task), answers).answered for answers in students(key(task), paper(task), count, SEED, directions)
    ]

    assert np.mean([line.verdict.passed for lines in marked for line in lines]) >= 0.97
    assert np.mean([any(line.off > CLEAR for line in lines) for lines in marked]) <= 0.1


@pytest.mark.parametrize("task", ["scheme-01-compressor", "scheme-08-planer"])
def test_no_line_of_an_honest_hand_fails_often(task: str) -> None:
    marked = [mark(key(task), answers) for answers in students(key(task), paper(task), 24, SEED, directions=False)]

    failed = {name: np.mean([marking[name].verdict.faulty for marking in marked]) for name in key(task).questions}

    assert max(failed.values()) <= 0.25, failed


@pytest.mark.parametrize("task", ["scheme-11-slotter", "scheme-12-shaking-conveyor", "scheme-20-press-automaton"])
def test_what_honest_hands_calculate_from_their_own_numbers_is_right(task: str) -> None:
    of = key(task)
    marked = [mark(of, answers) for answers in students(of, paper(task), 24, SEED, directions=False)]

    calculated = [name for name, question in of.questions.items() if question.step.verb == "calc"]
    failed = {name: np.mean([marking[name].verdict.faulty for marking in marked]) for name in calculated}
    assert max(failed.values()) <= 0.1, failed


NO_SCALES = ["madi-four-bar", "scheme-13-toggle-press", "scheme-16-hay-baler", "scheme-20-press-automaton"]


@pytest.mark.parametrize("everything", [False, True], ids=["drawn", "all vectors"])
def test_millimetres_of_honest_hands_are_right_without_scale_factors(everything: bool) -> None:
    lines = [
        line
        for task in NO_SCALES
        for answers in students(key(task), paper(task), 2, SEED, directions=False)
        for line in mark(key(task), in_millimetres(key(task), answers, everything)).answered
    ]

    assert any(line.answer and line.answer.mm for line in lines)
    assert np.mean([line.verdict.passed for line in lines]) >= 0.97


def test_a_weight_that_is_measured_may_miss_what_two_marks_do() -> None:
    of, name = key("scheme-13-toggle-press"), "G_5"
    mu, right = of.paper.mus[of.questions[name].plan], abs(of[name])

    measured = [Answer(name, mm=right / mu + off, mu=mu) for off in (0.5, 1.5)]
    calculated = Answer(name, mm=right / mu + 0.5, mu=mu, value=right + 0.5 * mu)

    found = [verdicts(mark(of, [one]), name)[0] for one in (*measured, calculated)]
    assert found == ["right", "wrong", "wrong"]


def test_right_answers_are_right_in_every_line() -> None:
    for task in LINKAGES[::4]:
        marking = mark(key(task), right_answers(key(task)))

        assert {line.verdict for line in marking.lines} == {Verdict.RIGHT}
        assert marking.first_wrong is None


def test_an_error_counts_once_and_what_follows_from_it_is_carried() -> None:
    wrong = 1.4 * size("V_BA")
    follows = {"omega_2": 1.4, "a_BA_n": 1.4**2}
    answers = {name: Answer(name, value=factor * size(name)) for name, factor in follows.items()}

    marking = altered(EXAMPLE, V_BA=Answer("V_BA", value=wrong), **answers)

    assert verdicts(marking, "V_BA", "omega_2", "a_BA_n") == ["wrong", "carried", "carried"]
    assert marking.first_wrong == "V_BA"
    assert marking.step is not None
    assert (marking.step.verb, marking.step.name) == ("meet", "velocity.B")


def test_who_goes_on_with_right_values_after_an_error_is_right() -> None:
    marking = altered(EXAMPLE, V_BA=Answer("V_BA", value=1.4 * size("V_BA")))

    assert verdicts(marking, "V_BA", "omega_2", "a_BA_n", "a_B") == ["wrong", "right", "right", "right"]


def test_a_wrong_normal_part_that_is_laid_off_carries_to_the_acceleration() -> None:
    a, n, u = EXAMPLE["a_A"], 2.0 * EXAMPLE["a_BA_n"], EXAMPLE.values["n_AB"]
    follows = a + n - u * ((a + n).imag / u.imag)  # by hand: through the end of the normal part the normal to AB

    marking = altered(EXAMPLE, a_BA_n=Answer("a_BA_n", value=abs(n)), a_B=Answer("a_B", value=abs(follows)))

    assert abs(follows) != pytest.approx(size("a_B"), rel=0.1)
    assert verdicts(marking, "a_BA_n", "a_B") == ["wrong", "carried"]


def test_a_point_read_off_a_wrong_mark_is_carried_when_the_mark_is_known() -> None:
    a, b = EXAMPLE["V_A"], 1.3 * EXAMPLE["V_B"]
    givens = EXAMPLE.paper.givens
    s2 = a + (b - a) * (givens["l_AS2"] / givens["l_AB"])

    marking = altered(
        EXAMPLE,
        V_BA=Answer("V_BA", value=abs(b - a), direction=cmath.phase(b - a)),
        V_B=Answer("V_B", value=abs(b)),
        V_S2=Answer("V_S2", value=abs(s2)),
    )

    assert abs(abs(s2) - size("V_S2")) > 2.0 * EXAMPLE.allowed["V_S2"]
    assert marking.first_wrong == "V_BA"
    assert verdicts(marking, "V_B", "V_S2") == ["carried", "carried"]


@pytest.mark.parametrize("factor", [0.4, 0.5, 1.0, 1.7, 2.0])
@pytest.mark.parametrize("inverse", [False, True], ids=["value per mm", "mm per unit"])
def test_the_scale_factor_and_its_convention_are_free(factor: float, inverse: bool) -> None:
    mu = factor * MUS["velocity"]
    written = 1.0 / mu if inverse else mu
    answers = [Answer(name, mm=size(name) / mu, mu=written) for name in ("V_A", "V_BA", "V_B", "V_S2")]

    marking = mark(EXAMPLE, answers)

    assert {line.verdict for line in marking.answered} == {Verdict.RIGHT}


def test_millimetres_without_a_scale_factor_are_those_of_their_plan() -> None:
    mu = 1.3 * MUS["velocity"]
    with_one = [Answer("V_A", mm=size("V_A") / mu, mu=mu), Answer("V_B", mm=size("V_B") / mu)]
    with_none = [Answer(name, mm=size(name) / mu) for name in ("V_A", "V_B", "V_S2")]

    for answers in (with_one, with_none):
        assert {line.verdict for line in mark(EXAMPLE, answers).answered} == {Verdict.RIGHT}


def test_a_small_plan_makes_no_error_right() -> None:
    mu = 40.0 * MUS["velocity"]  # V_B of 2 mm: a tolerance of 2 mm would let anything pass
    answers = [Answer("V_A", mm=size("V_A") / mu, mu=mu), Answer("V_B", mm=1.5 * size("V_B") / mu, mu=mu)]

    assert verdicts(mark(EXAMPLE, answers), "V_A", "V_B") == ["right", "wrong"]


@pytest.mark.parametrize("name", ["R_12_t", "M_bal"])
def test_a_consistent_minus_is_right(name: str) -> None:
    right = EXAMPLE[name]
    turned, sense = cmath.phase(-right) if isinstance(right, complex) else None, None
    if not isinstance(right, complex):
        sense = -1 if right > 0.0 else 1

    assumed = Answer(name, value=-abs(right), direction=turned, sense=sense)  # it came out against the assumed sense
    wrong = Answer(name, value=abs(right), direction=turned, sense=sense)
    alone = Answer(name, value=-abs(right))

    assert verdicts(mark(EXAMPLE, [assumed]), name) == ["right"]
    assert verdicts(mark(EXAMPLE, [alone]), name) == ["right"]
    assert verdicts(mark(EXAMPLE, [wrong]), name) == ["wrong"]
    assert mark(EXAMPLE, [wrong])[name].about == "direction"


def test_the_sense_of_other_rates_is_not_free() -> None:
    right = EXAMPLE["omega_2"]

    marking = mark(EXAMPLE, [Answer("omega_2", value=abs(right), sense=-int(math.copysign(1.0, right)))])

    assert verdicts(marking, "omega_2") == ["wrong"]
    assert marking["omega_2"].about == "direction"


def test_a_slip_of_arithmetic_is_told_from_a_wrong_segment() -> None:
    mu = MUS["velocity"]
    slip = Answer("V_B", mm=size("V_B") / mu, mu=mu, value=1.3 * size("V_B"))
    segment = Answer("V_B", mm=1.3 * size("V_B") / mu, mu=mu, value=1.3 * size("V_B"))

    assert verdicts(mark(EXAMPLE, [slip]), "V_B") == ["arithmetic"]
    assert verdicts(mark(EXAMPLE, [segment]), "V_B") == ["wrong"]


def test_wrong_units_and_scales_are_told_from_wrong_segments() -> None:
    mu = MUS["velocity"]
    names = ("V_A", "V_BA", "V_B", "V_S2")
    thousand = Answer("R_12", value=1e-3 * size("R_12"))
    other = [Answer(name, mm=size(name) / mu, mu=1.7 * mu, value=1.7 * size(name)) for name in names]
    inverted = Answer("V_B", mm=size("V_B") / mu, mu=mu, value=size("V_B") / mu**2)

    assert verdicts(mark(EXAMPLE, [thousand]), "R_12") == ["scale"]
    assert verdicts(mark(EXAMPLE, other), *names) == ["scale", "carried", "carried", "carried"]  # a plan is linear
    assert set(verdicts(mark(EXAMPLE, [other[1], other[3]]), "V_BA", "V_S2")) == {"scale"}
    assert verdicts(mark(EXAMPLE, [inverted]), "V_B") == ["scale"]


@pytest.mark.parametrize(("name", "factor"), [("a_BA_n", 0.064), ("omega_2", 5.39), ("omega_2", 10.0)])
def test_a_factor_that_no_unit_of_the_quantity_has_is_wrong(name: str, factor: float) -> None:
    assert verdicts(mark(EXAMPLE, [Answer(name, value=factor * size(name))]), name) == ["wrong"]


@pytest.mark.parametrize(
    ("names", "factor"),
    [
        pytest.param(("V_A", "V_B"), 1e3, id="mm/s"),
        pytest.param(("h_21",), 1e3, id="mm"),
        pytest.param(("omega_2", "epsilon_2"), 180.0 / math.pi, id="degrees"),
        pytest.param(("omega_1",), 30.0 / math.pi, id="rpm"),
    ],
)
def test_another_unit_of_a_right_value_is_no_slip_of_arithmetic(names: tuple[str, ...], factor: float) -> None:
    mus = {name: MUS.get(EXAMPLE.questions[name].plan) for name in names}
    answers = [
        Answer(name, mm=size(name) / mu if (mu := mus[name]) else None, mu=mu, value=factor * size(name))
        for name in names
    ]

    assert verdicts(mark(EXAMPLE, answers), *names)[0] == "scale"
    assert mark(EXAMPLE, answers[-1:])[names[-1]].verdict is Verdict.SCALE


def test_a_calculated_part_may_miss_what_it_is_calculated_from_may_and_its_marks() -> None:
    mu = MUS["acceleration"]
    calculated = 2.0 * EXAMPLE.allowed["V_BA"] / size("V_BA") * size("a_BA_n")

    allowed = EXAMPLE.allowed["a_BA_n"]

    assert allowed <= 1.1 * math.hypot(calculated, 0.7 * mu)
    assert allowed < EXAMPLE.tolerance.mm * mu


def test_values_near_zero_have_the_millimetres_and_not_a_part() -> None:
    solution_key = key("scheme-09-shaper")
    mu = solution_key.paper.mus["forces_2"]

    assert abs(solution_key["R_12_n"]) < 1e-9
    assert verdicts(mark(solution_key, [Answer("R_12_n", value=1.5 * mu)]), "R_12_n") == ["right"]
    assert verdicts(mark(solution_key, [Answer("R_12_n", value=50.0 * mu)]), "R_12_n") == ["wrong"]


@pytest.mark.parametrize("bad", [0.0, 1e300, math.inf, math.nan, -1e-300])
def test_impossible_answers_stop_nothing(bad: float) -> None:
    task = "scheme-09-shaper"
    answers = [Answer(name, value=bad, mm=bad, mu=bad) for name in ("l_CA", "V_A3C", "omega_3", "R_12")]
    rest = [a for a in right_answers(key(task)) if a.name not in {b.name for b in answers}]

    marking = mark(key(task), [*answers, *rest])

    assert verdicts(marking, "V_A", "a_A") == ["right", "right"]
    assert np.mean([line.verdict is Verdict.RIGHT for line in marking.lines]) > 0.9


def test_what_is_not_answered_is_missing_and_the_first_of_two_answers_counts() -> None:
    marking = mark(EXAMPLE, [Answer("V_B", value=size("V_B")), Answer("V_B", value=0.0), Answer("a_B")])

    assert verdicts(marking, "V_B", "a_B", "V_BA") == ["right", "missing", "missing"]
    assert len(marking.answered) == 1


def test_unknown_quantities_are_refused() -> None:
    with pytest.raises(InputError, match="V_BB"):
        mark(EXAMPLE, [Answer("V_BB", value=1.0)])


def test_a_teachers_own_tolerance_takes_the_place_of_the_rule() -> None:
    limits = {"V_B": 1e-3 * size("V_B")}
    strict = answer_key(EXAMPLE.paper, preset("normal").tolerance, limits, {"V_B", "V_BA"})
    answer = Answer("V_B", value=1.01 * size("V_B"))

    assert verdicts(mark(EXAMPLE, [answer]), "V_B") == ["right"]
    assert verdicts(mark(strict, [answer]), "V_B") == ["wrong"]
    assert list(strict.questions) == ["V_BA", "V_B"]


def test_strict_presets_fail_what_lenient_ones_pass() -> None:
    answer = [Answer("a_B", value=1.06 * size("a_B"))]
    found = {
        name: verdicts(mark(answer_key(EXAMPLE.paper, preset(name).tolerance), answer), "a_B")[0]
        for name in ("cad", "careful", "lenient")
    }

    assert found == {"cad": "wrong", "careful": "wrong", "lenient": "right"}


def test_marking_is_the_same_in_any_order_of_answers() -> None:
    answers = [replace(a, value=1.2 * (a.value or 0.0)) for a in right_answers(EXAMPLE)]

    forth, back = mark(EXAMPLE, answers), mark(EXAMPLE, answers[::-1])

    assert [line.verdict for line in forth.lines] == [line.verdict for line in back.lines]
