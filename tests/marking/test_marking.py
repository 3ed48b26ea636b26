"""The verdict of every line, as a teacher can trust it: honest hands pass, an error counts once, luck earns naught."""

from __future__ import annotations

import cmath
import math
import random
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kulman import check
from kulman.plans.hands.shaky import preset
from kulman.plans.hands.spread import drawn
from kulman.plans.marking.answers import Answer, Said, Verdict
from kulman.plans.marking.key import Key, answer_key
from kulman.plans.marking.student import StudentBoard
from kulman.plans.marking.verdicts import CLEAR, Marking, mark
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.cases import some
from kulman.tests.support.marking_cases import (
    LINKAGES,
    answer,
    in_millimetres,
    key,
    mistakes,
    paper,
    right_answers,
)
from kulman.tests.support.marking_cases import students as drawn_by
from kulman.tests.support.mechanisms import SEED
from kulman.tests.support.students import SLIPS, marked, population
from kulman.variants.marking.marked import Desk, Marked
from kulman.variants.marking.reading import Answers, Reply
from kulman.variants.marking.result import class_lines, class_rows, result_of
from kulman.variants.roster import Who

TASK = "nau-slider-crank"
EXAMPLE, OF = key(TASK, "example"), key(TASK, "3")
MUS = EXAMPLE.paper.mus
VELOCITIES = ("V_A", "V_BA", "V_B", "V_S2")
DRAWN = {"V_BA": 1.03, "V_S2": 0.98, "a_B": 1.03, "a_S2": 0.97, "h_2": 0.95, "h_lever_F_i2": 1.04, "h_21": 1.05}


def verdicts(marking: Marking, *names: str) -> list[str]:
    return [str(marking[name].verdict) for name in names]


def alone(*answers: Answer) -> list[str]:
    """Return the verdicts on answers to the example, each of which is the only one."""
    return [str(mark(EXAMPLE, [one])[one.name].verdict) for one in answers]


def altered(**answers: Answer) -> Marking:
    """Mark right answers to the example, some of them altered."""
    return mark(EXAMPLE, [answers.get(a.name, a) for a in right_answers(EXAMPLE, directions=False)])


def size(name: str, of: Key = EXAMPLE) -> float:
    return float(abs(of[name]))


def sized(**factors: float) -> list[Answer]:
    """Return right answers to variant 3 in sizes, some of them times a factor."""
    answers = right_answers(OF, directions=False)
    return [replace(a, value=(a.value or 0.0) * factors.get(a.name, 1.0)) for a in answers]


@pytest.mark.parametrize(
    ("task", "count", "directions"),
    [
        *some([(task, 4, True) for task in LINKAGES], *range(0, 99, 3)),
        *(pytest.param(task, 200, False, id=f"{task}-200", marks=pytest.mark.soak) for task in LINKAGES),
    ],
)
def test_answers_of_honest_hands_are_right(task: str, count: int, directions: bool) -> None:
    lines = [mark(key(task), one).answered for one in drawn_by(key(task), paper(task), count, SEED, directions)]

    assert np.mean([line.verdict.passed for some in lines for line in some]) >= 0.97
    assert np.mean([any(line.off > CLEAR for line in some) for some in lines]) <= 0.1


@pytest.mark.parametrize(
    ("task", "calculated", "most"),
    some(
        [
            *((task, False, 0.25) for task in ("scheme-01-compressor", "scheme-08-planer")),
            *((task, True, 0.1) for task in ("scheme-11-slotter", "scheme-12-shaking-conveyor")),
            ("scheme-20-press-automaton", True, 0.1),
        ],
        0,
        3,
    ),
)
def test_no_line_of_an_honest_hand_fails_often_least_what_is_calculated(
    task: str, calculated: bool, most: float
) -> None:
    of = key(task)
    markings = [mark(of, answers) for answers in drawn_by(of, paper(task), 24, SEED, directions=False)]

    names = [name for name, question in of.questions.items() if not calculated or question.step.verb == "calc"]
    failed = {name: np.mean([marking[name].verdict.faulty for marking in markings]) for name in names}
    assert max(failed.values()) <= most, failed


@pytest.mark.parametrize("everything", [False, True], ids=["drawn", "all vectors"])
def test_millimetres_of_honest_hands_are_right_without_scale_factors(everything: bool) -> None:
    lines = [
        line
        for task in ("madi-four-bar", "scheme-13-toggle-press", "scheme-16-hay-baler", "scheme-20-press-automaton")
        for answers in drawn_by(key(task), paper(task), 2, SEED, directions=False)
        for line in mark(key(task), in_millimetres(key(task), answers, everything)).answered
    ]

    assert any(line.answer and line.answer.mm for line in lines)
    assert np.mean([line.verdict.passed for line in lines]) >= 0.97


def test_a_value_too_small_for_a_hand_is_neither_right_nor_wrong_where_an_answer_misses_it() -> None:
    of = key("scheme-12-shaking-conveyor")
    small = ("a_ED_t", "epsilon_4", "h_4")

    told = [[str(mark(of, [Answer(n, value=x * abs(of[n]))])[n].verdict) for n in small] for x in (0.0, 0.3, 1.0, 90.0)]

    assert told == [["small"] * 3, ["small"] * 3, ["right"] * 3, ["wrong"] * 3]
    opposite = mark(of, [answer("a_ED_t", -of["a_ED_t"])])
    assert verdicts(opposite, "a_ED_t") == ["small"]


def test_a_number_calculated_wrongly_comes_before_a_later_line_that_misses_more() -> None:
    of = key(TASK)
    factors = {"a_BA_n": 1.15, "h_lever_F_i2": 1.6}
    said = [replace(a, value=(a.value or 0.0) * factors.get(a.name, 1.0)) for a in right_answers(of, False)]

    marking = mark(of, said)

    assert marking["a_BA_n"].off < CLEAR < marking["h_lever_F_i2"].off
    assert marking.first_wrong == "a_BA_n"


@pytest.mark.parametrize("task", LINKAGES)
def test_no_tolerance_is_much_wider_than_what_a_hand_misses(task: str) -> None:
    of = key(task)
    made = drawn(of.paper, preset("normal").hand, np.random.default_rng(SEED), 400)

    wide = {}
    for name, allowed in of.allowed.items():
        size = abs(of[name]) if name in of.questions else 0.0
        if 1e-6 * allowed < size < allowed / 0.15:  # neither nothing, nor held to the usual five per cent or so
            missed = float(np.nanquantile(abs(np.abs(made[name]) - size), 0.99))
            wide[name] = allowed / missed

    assert max(wide.values(), default=0.0) <= 6.0, max(wide, key=lambda name: wide[name])


def test_right_answers_are_right_in_every_line() -> None:
    for task in LINKAGES[::4]:
        marking = mark(key(task), right_answers(key(task)))

        assert {line.verdict for line in marking.lines} == {Verdict.RIGHT}
        assert marking.first_wrong is None


def test_an_error_counts_once_and_what_follows_from_it_is_carried_or_right() -> None:
    wrong = Answer("V_BA", value=1.4 * size("V_BA"))
    follows = {name: Answer(name, value=1.4**n * size(name)) for name, n in (("omega_2", 1), ("a_BA_n", 2))}

    carried, right = altered(V_BA=wrong, **follows), altered(V_BA=wrong)

    assert verdicts(carried, "V_BA", "omega_2", "a_BA_n") == ["wrong", "carried", "carried"]
    assert verdicts(right, "V_BA", "omega_2", "a_BA_n", "a_B") == ["wrong", "right", "right", "right"]
    assert carried.first_wrong == "V_BA"
    assert carried.step is not None
    assert (carried.step.verb, carried.step.name) == ("meet", "velocity.B")


def test_a_wrong_normal_part_that_is_laid_off_carries_to_the_acceleration() -> None:
    a, n, u = EXAMPLE["a_A"], 2.0 * EXAMPLE["a_BA_n"], EXAMPLE.values["n_AB"]
    follows = a + n - u * ((a + n).imag / u.imag)  # by hand: through the end of the normal part the normal to AB

    marking = altered(a_BA_n=Answer("a_BA_n", value=abs(n)), a_B=Answer("a_B", value=abs(follows)))

    assert abs(follows) != pytest.approx(size("a_B"), rel=0.1)
    assert verdicts(marking, "a_BA_n", "a_B") == ["wrong", "carried"]


def test_a_point_read_off_a_wrong_mark_is_carried_when_the_mark_is_known() -> None:
    a, b, givens = EXAMPLE["V_A"], 1.3 * EXAMPLE["V_B"], EXAMPLE.paper.givens
    s2 = a + (b - a) * (givens["l_AS2"] / givens["l_AB"])
    relative = Answer("V_BA", value=abs(b - a), direction=cmath.phase(b - a))

    marking = altered(V_BA=relative, V_B=Answer("V_B", value=abs(b)), V_S2=Answer("V_S2", value=abs(s2)))

    assert abs(abs(s2) - size("V_S2")) > 2.0 * EXAMPLE.allowed["V_S2"]
    assert marking.first_wrong == "V_BA"
    assert verdicts(marking, "V_B", "V_S2") == ["carried", "carried"]


def drawn_by_hand(**factors: float) -> list[Answer]:
    """Return the answers of a student who has measured a little otherwise, and calculates from that."""

    def take(name: str, value: Any) -> tuple[Said | None, bool]:
        return (Said(abs(OF[name]) * DRAWN[name], None, None), True) if name in DRAWN else (None, False)

    board = StudentBoard(OF.paper.program, OF.paper.givens, take)
    board.go_on()
    values = {name: OF[name] * DRAWN[name] if name in DRAWN else board.follows[name] for name in OF.questions}
    return [answer(name, x * factors.get(name, 1.0), directions=False) for name, x in values.items()]


@pytest.mark.parametrize("factor", [0.98, 1.02, 1.21])
@pytest.mark.parametrize("name", ["F_bal", "M_bal", "M_i2", "omega_2", "F_i2"])
def test_what_is_calculated_must_follow_from_the_students_own_numbers(name: str, factor: float) -> None:
    marking = mark(OF, drawn_by_hand(**{name: factor}))

    line = marking[name]
    assert mark(OF, drawn_by_hand()).first_wrong is None
    assert (line.verdict, marking.first_wrong) == (Verdict.WRONG, name)
    assert line.allowed < 0.012 * abs(line.follows)


def test_a_calculated_line_is_shown_the_number_that_it_was_judged_by(tmp_path: Path) -> None:
    (file := tmp_path / "answers.csv").write_text(
        "quantity;value\n" + "".join(f"{a.name};{a.value}\n" for a in drawn_by_hand(F_bal=1.05)), encoding="utf-8"
    )
    asked = check(TASK, "3", lang="en")

    report = asked.mark(asked.read(str(file))[0])

    row = next(row for _, rows in report.parts for row in rows if row.line.name == "F_bal")
    own = mark(OF, drawn_by_hand())["F_bal"].said
    assert row.right.endswith(f"→ {own:.4g} N")
    assert float(row.tolerance.split()[1]) < 0.01 * own


@pytest.mark.parametrize("id", ["M79", "M80"])
def test_moments_on_the_lever_that_are_lost_or_turned_are_found(id: str) -> None:
    book = mistakes(TASK)
    planted = [s for s in book.signatures if s.broken.mistake == id]

    assert planted
    for one in planted:
        sizes = {name: (abs(one.values[name]), size(name, book.key)) for name in book.key.questions}
        moved = [name for name, (found, right) in sizes.items() if abs(found - right) > 0.02 * right]
        answers = [answer(name, one.values[name], directions=False) for name in book.key.questions]
        assert mark(book.key, answers).first_wrong == moved[0]


@pytest.mark.parametrize("inverse", [False, True], ids=["value per mm", "mm per unit"])
def test_the_scale_factor_and_its_convention_are_free(inverse: bool) -> None:
    for factor in (0.4, 0.5, 1.0, 1.7, 2.0):
        mu = factor * MUS["velocity"]
        answers = [Answer(name, mm=size(name) / mu, mu=1.0 / mu if inverse else mu) for name in VELOCITIES]

        assert {line.verdict for line in mark(EXAMPLE, answers).answered} == {Verdict.RIGHT}


def test_millimetres_without_a_scale_factor_are_those_of_their_plan() -> None:
    mu = 1.3 * MUS["velocity"]
    with_one = [Answer("V_A", mm=size("V_A") / mu, mu=mu), Answer("V_B", mm=size("V_B") / mu)]
    with_none = [Answer(name, mm=size(name) / mu) for name in ("V_A", "V_B", "V_S2")]

    for answers in (with_one, with_none):
        assert {line.verdict for line in mark(EXAMPLE, answers).answered} == {Verdict.RIGHT}


@pytest.mark.parametrize("name", ["R_12_t", "M_bal"])
def test_a_consistent_minus_is_right(name: str) -> None:
    right = EXAMPLE[name]
    turned, sense = cmath.phase(-right) if isinstance(right, complex) else None, None
    if not isinstance(right, complex):
        sense = -1 if right > 0.0 else 1

    assumed = Answer(name, value=-abs(right), direction=turned, sense=sense)  # it came out against the assumed sense
    wrong = replace(assumed, value=abs(right))

    assert alone(assumed, Answer(name, value=-abs(right)), wrong) == ["right", "right", "wrong"]
    assert mark(EXAMPLE, [wrong])[name].about == "direction"


def test_a_direction_or_a_sense_alone_is_no_answer() -> None:
    """It could be guessed: all senses right, and not one size, made full marks."""
    whole = right_answers(EXAMPLE)
    alone = [replace(a, mm=None, value=None) for a in whole]

    assert any(a.direction is not None or a.sense is not None for a in alone)
    assert {line.verdict.value for line in mark(EXAMPLE, alone).lines} == {"missing"}


@pytest.mark.parametrize("task", some(LINKAGES, *range(0, 99, 3)))
def test_a_vector_or_a_rate_the_wrong_way_is_wrong_however_right_its_equal_is(task: str) -> None:
    """Of links that turn alike one was called right the other way, too, since the rate of the other one was right."""
    of, passed = key(task), []
    right = right_answers(of)
    for place, one in enumerate(right):
        if (one.direction is not None or one.sense) and abs(of[one.name]) > CLEAR * of.allowed[one.name]:
            direction = None if one.direction is None else one.direction + math.pi
            turned = replace(one, direction=direction, sense=one.sense and -one.sense)
            line = mark(of, [*right[:place], turned, *right[place + 1 :]])[one.name]
            passed += [one.name] * line.verdict.passed

    assert passed == []


@pytest.mark.parametrize("task", some(LINKAGES, *range(1, 99, 3)))
def test_a_word_of_direction_means_a_quarter_of_all_and_a_number_itself(task: str) -> None:
    """A vector at 175.8° to which a student wrote *left* was wrong by 4.2°."""
    of = key(task)
    exact = {one.name: one.direction for one in right_answers(of) if one.direction is not None}
    words = {name: math.pi / 2 * round(angle / (math.pi / 2)) for name, angle in exact.items()}
    other = {name: word + math.copysign(math.pi / 2, word - exact[name]) for name, word in words.items()}

    def told(directions: Mapping[str, float], side: bool) -> dict[str, Verdict]:
        said = [replace(a, direction=directions.get(a.name, a.direction), side=side) for a in right_answers(of)]
        return {line.name: line.verdict for line in mark(of, said).lines}

    clear = [name for name in exact if abs(of[name]) > CLEAR * of.allowed[name]]
    far = [name for name in clear if abs(words[name] - exact[name]) > math.radians(20.0)]
    assert set(told(words, side=True).values()) <= {Verdict.RIGHT, Verdict.SMALL}
    assert all(told({name: other[name]}, side=True)[name] is Verdict.WRONG for name in clear[:9])
    assert all(told({name: words[name]}, side=False)[name] is Verdict.WRONG for name in far[:9])


def test_the_sense_of_other_rates_is_not_free_and_a_wrong_size_not_called_a_direction() -> None:
    right = EXAMPLE["omega_2"]
    turned = Answer("omega_2", value=abs(right), sense=-int(math.copysign(1.0, right)))
    both = [Answer("F_3", value=15.1, direction=math.pi), Answer("V_B", value=size("V_B", OF), direction=math.pi)]

    assert (alone(turned), mark(EXAMPLE, [turned])["omega_2"].about) == (["wrong"], "direction")
    marking = mark(OF, both)
    assert abs(OF["F_3"]) > 4000.0
    assert (marking["F_3"].about, marking["V_B"].about) == ("size", "direction")


def test_a_plan_drawn_to_the_scale_that_is_written_makes_no_line_wrong_by_its_scale() -> None:
    """What the segments of a plan show differs from what is written by what a hand misses: 0.3 % here."""
    mu = 54.373
    calculated = Answer("F_bal", mm=75.5, mu=mu, value=4105.0, rounded=0.5)
    said = [
        Answer("R_21", mm=95.5, mu=mu, value=5193.0, rounded=0.5),
        Answer("h_21", mm=37.0, mu=0.0025, value=0.0925, rounded=5e-5),
        Answer("h_1", value=0.0),
    ]

    marking = mark(key("madi-four-bar"), [*said, calculated])

    assert verdicts(marking, "R_21", "h_21", "F_bal") == ["right", "right", "wrong"]


def test_slips_of_arithmetic_units_and_scales_are_told_from_wrong_segments() -> None:
    mu, v = MUS["velocity"], size("V_B")
    slip, segment = (Answer("V_B", mm=mm / mu, mu=mu, value=1.3 * v) for mm in (v, 1.3 * v))
    inverted = Answer("V_B", mm=v / mu, mu=mu, value=v / mu**2)
    thousand = Answer("R_12", value=1e-3 * size("R_12"))
    other = [Answer(name, mm=size(name) / mu, mu=1.7 * mu, value=1.7 * size(name)) for name in VELOCITIES]

    assert alone(slip, segment, inverted, thousand) == ["arithmetic", "wrong", "scale", "scale"]
    of_plan = verdicts(mark(EXAMPLE, other), *VELOCITIES)  # a plan is linear
    assert of_plan == ["scale", "carried", "carried", "carried"]
    assert verdicts(mark(EXAMPLE, [other[1], other[3]]), "V_BA", "V_S2") == ["scale", "scale"]
    for name, factor in (("a_BA_n", 0.064), ("omega_2", 5.39), ("omega_2", 10.0)):  # which none of its units has
        assert alone(Answer(name, value=factor * size(name))) == ["wrong"]


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
        Answer(name, mm=size(name) / mu if mu else None, mu=mu, value=factor * size(name)) for name, mu in mus.items()
    ]

    assert verdicts(mark(EXAMPLE, answers), *names)[0] == "scale"
    assert alone(answers[-1]) == ["scale"]


def test_a_small_plan_makes_no_error_right() -> None:
    mu = 40.0 * MUS["velocity"]  # V_B of 2 mm: a tolerance of 2 mm would let anything pass
    answers = [Answer("V_A", mm=size("V_A") / mu, mu=mu), Answer("V_B", mm=1.5 * size("V_B") / mu, mu=mu)]

    assert verdicts(mark(EXAMPLE, answers), "V_A", "V_B") == ["right", "wrong"]


def test_a_weight_that_is_measured_may_miss_what_two_marks_do() -> None:
    of, name = key("scheme-13-toggle-press"), "G_5"
    mu, right = of.paper.mus[of.questions[name].plan], size(name, of)

    measured = [Answer(name, mm=right / mu + off, mu=mu) for off in (0.5, 1.5)]
    calculated = Answer(name, mm=right / mu + 0.5, mu=mu, value=right + 0.5 * mu)

    found = [verdicts(mark(of, [one]), name)[0] for one in (*measured, calculated)]
    assert found == ["right", "wrong", "wrong"]


@pytest.mark.parametrize("task", LINKAGES[::3])
def test_an_arm_may_be_missed_as_any_segment_and_more_where_its_points_are_led_astray(task: str) -> None:
    of = key(task)
    arms = {name: of.paper.mus[q.plan] for name, q in of.questions.items() if q.step.verb == "arm" and of.allowed[name]}

    least = {name: of.tolerance.of_segment(size(name, of) / mu) * mu for name, mu in arms.items()}
    assert all(of.allowed[name] >= least[name] * (1.0 - 1e-9) for name in arms)
    assert not arms or any(of.allowed[name] > 1.01 * least[name] for name in arms) == (task != TASK)


def test_a_calculated_part_may_miss_what_it_is_calculated_from_may_and_its_marks() -> None:
    mu, allowed = MUS["acceleration"], EXAMPLE.allowed
    calculated = 2.0 * allowed["V_BA"] / size("V_BA") * size("a_BA_n")

    assert allowed["a_BA_n"] <= 1.1 * math.hypot(calculated, 0.7 * mu)
    assert allowed["a_BA_n"] < EXAMPLE.tolerance.mm * mu


def test_values_near_zero_have_the_millimetres_and_not_a_part() -> None:
    of = key("scheme-09-shaper")
    mu = of.paper.mus["forces_2"]

    assert size("R_12_n", of) < 1e-9
    for mm, verdict in ((1.5, "right"), (50.0, "wrong")):
        assert verdicts(mark(of, [Answer("R_12_n", value=mm * mu)]), "R_12_n") == [verdict]


def test_tolerances_follow_a_smaller_value_of_the_students_own() -> None:
    small = {"V_BA": 0.05, "omega_2": 0.05, "a_BA_n": 0.05**2}
    right, wrong = mark(OF, sized(**small)), mark(OF, sized(**{**small, "omega_2": 0.075, "a_BA_n": 2.0 * 0.05**2}))

    assert verdicts(right, "V_BA", "omega_2", "a_BA_n") == ["wrong", "carried", "carried"]
    assert verdicts(wrong, "V_BA", "omega_2") == ["wrong", "wrong"]


def test_half_of_the_last_digit_is_no_error() -> None:
    v, l = size("V_BA", OF), OF.paper.givens["l_AB"]

    assert abs(v / l - 16.0) > 0.01 * 16.0
    for half, verdict in ((0.5, "right"), (0.05, "wrong")):
        answers = [Answer("V_BA", value=v), Answer("omega_2", value=16.0, rounded=half)]
        assert verdicts(mark(OF, answers), "omega_2") == [verdict]


def test_a_teachers_tolerance_and_presets_are_those_that_count() -> None:
    limits = {"V_B": 1e-3 * size("V_B")}
    strict = answer_key(EXAMPLE.paper, preset("normal").tolerance, limits, {"V_B", "V_BA"})
    near, a_B = Answer("V_B", value=1.01 * size("V_B")), Answer("a_B", value=1.06 * size("a_B"))

    assert alone(near) == ["right"]
    assert verdicts(mark(strict, [near]), "V_B") == ["wrong"]
    assert list(strict.questions) == ["V_BA", "V_B"]
    for name, verdict in (("cad", "wrong"), ("careful", "wrong"), ("lenient", "right")):
        assert verdicts(mark(answer_key(EXAMPLE.paper, preset(name).tolerance), [a_B]), "a_B") == [verdict]


@pytest.mark.parametrize("bad", [0.0, 1e300, math.inf, math.nan, -1e-300])
def test_impossible_answers_stop_nothing(bad: float) -> None:
    of = key("scheme-09-shaper")
    answers = [Answer(name, value=bad, mm=bad, mu=bad) for name in ("l_CA", "V_A3C", "omega_3", "R_12")]
    rest = [a for a in right_answers(of) if a.name not in {b.name for b in answers}]

    marking = mark(of, [*answers, *rest])

    assert verdicts(marking, "V_A", "a_A") == ["right", "right"]
    assert np.mean([line.verdict is Verdict.RIGHT for line in marking.lines]) > 0.9


def test_a_zero_by_which_a_law_divides_stops_nothing() -> None:
    """The whole class was left without marks: of a conveyor whose driver was said to stand came a division by zero."""
    of = key("scheme-12-shaking-conveyor")
    right = right_answers(of, directions=False)

    assert (
        mark(of, [replace(a, value=0.0) if a.name == "omega_1" else a for a in right])["omega_1"].verdict
        is Verdict.WRONG
    )


def test_marking_takes_answers_in_any_order_the_first_of_two_and_no_unknown_ones() -> None:
    answers = [replace(a, value=1.2 * (a.value or 0.0)) for a in right_answers(EXAMPLE)]
    forth, back = mark(EXAMPLE, answers), mark(EXAMPLE, answers[::-1])
    assert [line.verdict for line in forth.lines] == [line.verdict for line in back.lines]

    marking = mark(EXAMPLE, [Answer("V_B", value=size("V_B")), Answer("V_B", value=0.0), Answer("a_B")])
    assert verdicts(marking, "V_B", "a_B", "V_BA") == ["right", "missing", "missing"]
    assert len(marking.answered) == 1

    with pytest.raises(InputError, match="V_BB"):
        mark(EXAMPLE, [Answer("V_BB", value=1.0)])


def handed_in(sizes: Mapping[str, float], task: str = TASK, variant: str = "3") -> Marked:
    """Mark values of one student at the desk."""
    lines = {name: Reply(name, value=value, place="form") for name, value in sizes.items()}
    return Desk(check(task, variant, lang="en")).mark(Answers("form", Who(), {}, lines, {}))


def right_sizes(**factors: float) -> dict[str, float]:
    return {name: size(name, OF) * factors.get(name, 1.0) for name in OF.questions}


@pytest.mark.parametrize("task", some(SLIPS, 0))
def test_random_numbers_earn_next_to_nothing(task: str) -> None:
    outcomes = marked(population("random", task, 2, random.Random(SEED)))

    assert sum(x.mark for x in outcomes) / len(outcomes) <= 10.0


@pytest.mark.parametrize("task", ["nau-slider-crank", "scheme-09-shaper"])
def test_the_sheet_of_another_variant_is_told_and_earns_little(task: str) -> None:
    outcomes = marked(population("other", task, 2, random.Random(SEED)))

    assert all(x.fits for x in outcomes)
    assert max(x.mark for x in outcomes) <= 20.0


def test_lines_that_follow_from_mostly_wrong_numbers_are_told_apart() -> None:
    chaos = {name: 3.0 ** math.sin(40.0 * place) for place, name in enumerate(OF.questions)}
    chaos |= {"R_21": chaos["R_12"], "R_23": chaos["R_32"]}

    result = handed_in(right_sizes(**chaos))

    assert (verdicts(result.marking, "R_21"), result.marking.first_wrong) == ([str(Verdict.UNCOUNTED)], "V_A")
    assert result.mark <= 15.0
    header, row = list(class_rows([result_of(result, "en")], "en"))[:2]
    told = dict(zip(header, row, strict=True))
    assert told["follows from wrong numbers, not counted"] == result.count(Verdict.UNCOUNTED) > 0
    assert told["wrong here"] == result.count(Verdict.WRONG)


def test_what_all_later_lines_need_costs_more_than_a_side_value_and_a_zero_nothing() -> None:
    whole, needed, side = (handed_in(right_sizes(**factors)) for factors in ({}, {"V_BA": 1.5}, {"V_S2": 1.5}))
    assert whole.mark == 100.0
    assert sum(whole.parts.values()) == pytest.approx(1.0)
    assert 100.0 - needed.mark >= 2.0 * (100.0 - side.mark) > 0.0

    zeros = handed_in({"h_03": 0.0, "M_03": 0.0})
    assert (zeros.parts["h_03"], zeros.parts["M_03"], zeros.mark) == (0.0, 0.0, 0.0)
    assert handed_in(right_sizes(), "scheme-09-shaper", "1").parts["R_12_n"] == 0.0


@pytest.mark.parametrize("language", LANGUAGES)
def test_mistakes_of_a_class_are_said_in_words(language: str) -> None:
    result = replace(result_of(handed_in(right_sizes()), language), mistakes=("M29", "M30"))

    shown = [*class_lines([result], language), *(str(row) for row in class_rows([result], language))]

    assert any("M29" in line for line in shown)
    assert all(re.search(rf"{name}: \w{{3}}", line) for line in shown for name in ("M29", "M30") if name in line)
