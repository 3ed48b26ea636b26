"""Which mistake explains answers: planted ones are found, from closed forms without a board and with a shaky hand."""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

import pytest

from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper, preset
from kulman.plans.marking.answers import Answer, Verdict
from kulman.plans.marking.key import Key, answer_key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import Book, Signature, book, broken, signatures
from kulman.plans.mistakes.explaining import Candidate, Explanation, explain
from kulman.tests.support.broken_rules import (
    LEVER,
    OFFSET,
    OMEGA,
    PHI,
    ROD,
    Motion,
    lever,
    rod,
    slider_crank,
    slotted_lever,
)
from kulman.tests.support.marking_cases import LINKAGES, answer, key, mistakes, moves, planted, right_answers
from kulman.tests.support.mechanisms import SEED

WRONG_BY = 2.0  # tolerances by which a planted mistake moves at least one line


def rod_answers(found: Motion) -> list[Answer]:
    """Return the sizes that somebody with this motion writes."""
    sizes = {"omega_2": found.omega, "V_B": found.v, "epsilon_2": found.epsilon, "a_B": found.a}
    return [Answer(name, value=abs(size)) for name, size in sizes.items()]


def lever_answers(found: Motion) -> list[Answer]:
    sizes = {"omega_3": found.omega, "V_A3A2": found.v, "epsilon_3": found.epsilon, "a_A3A2_r": found.a}
    return [Answer(name, value=abs(size)) for name, size in sizes.items()]


def of(answers: list[Answer], slotted: bool = False, name: str = "careful") -> Explanation:
    scene = slotted_lever() if slotted else slider_crank()
    of_scene = answer_key(scene.paper, preset(name).tolerance)
    return explain(book(of_scene), mark(of_scene, answers))


@pytest.mark.parametrize(
    ("id", "found"),
    [
        pytest.param("M07", rod(crank=0.16), id="M07"),
        pytest.param("M08", rod(phi=math.degrees(PHI)), id="M08"),
        pytest.param("M09", rod(phi=-PHI), id="M09"),
        pytest.param("M12", rod(offset=0.0), id="M12 none"),
        pytest.param("M12", rod(offset=-OFFSET), id="M12 side"),
        pytest.param("M38", rod(normal=lambda v, w: -w * w * ROD), id="M38"),
        pytest.param("M39", rod(normal=lambda v, w: 0.0), id="M39"),
        pytest.param("M40", rod(normal=lambda v, w: v * v / ROD), id="M40"),
        pytest.param("M05", rod(omega=OMEGA * 180.0 / math.pi), id="M05"),
    ],
)
def test_closed_forms_of_a_slider_crank_are_explained(id: str, found: Motion) -> None:
    explanation = of(rod_answers(found))

    assert id in explanation.candidates[0].ids


@pytest.mark.parametrize(
    ("id", "found"),
    [
        pytest.param("M48", lever(lambda k, w, v: 0j), id="M48"),
        pytest.param("M49", lever(lambda k, w, v: -2j * w * v * k), id="M49"),
        pytest.param("M50", lever(lambda k, w, v: 1j * w * v * k), id="M50"),
        pytest.param("M51", lever(lambda k, w, v: 2j * OMEGA * v * k), id="M51 omega_1"),
        pytest.param("M51", lever(lambda k, w, v: -2j * w * OMEGA * LEVER * k), id="M51 v_A"),
        pytest.param("M52", lever(lambda k, w, v: 2 * w * v * k), id="M52"),
        pytest.param("M54", lever(normal=0.0), id="M54 none"),
        pytest.param("M54", lever(normal=-1.0), id="M54 away"),
    ],
)
def test_closed_forms_of_a_slotted_lever_are_explained(id: str, found: Motion) -> None:
    explanation = of(lever_answers(found), slotted=True)

    assert id in explanation.candidates[0].ids


def sizes_of(name: str, factor: float) -> list[Answer]:
    """Return the sizes of the slider-crank in which one line alone is so many times the right one."""
    made = right_answers(key("nau-slider-crank", "0"), directions=False)
    return [replace(a, value=(a.value or 0.0) * (factor if a.name == name else 1.0)) for a in made]


def test_a_normal_part_of_omega_alone_is_named_however_small_it_is() -> None:
    of_key = key("nau-slider-crank", "0")
    answers = sizes_of("a_BA_n", 1.0 / abs(of_key["omega_2"]))

    assert explain(book(of_key), mark(of_key, answers)).candidates[0].mistakes[0].mistake == "M115"


def test_a_sense_alone_is_a_wrong_sense_and_not_another_motion() -> None:
    of_key = key("nau-slider-crank", "0")
    turned = -1 if of_key["omega_2"] > 0.0 else 1
    answers = [replace(a, sense=turned) if a.name == "omega_2" else a for a in sizes_of("", 1.0)]

    assert explain(book(of_key), mark(of_key, answers)).candidates[0].mistakes[0].mistake == "M29"


def test_exchanged_parts_of_an_acceleration_are_named() -> None:
    of_key = key("nau-slider-crank", "0")
    sizes = {a.name: a for a in right_answers(of_key, directions=False)}
    normal, tangential = sizes["a_BA_n"].value, sizes["a_BA_t"].value
    rate = (normal or 0.0) / of_key.paper.givens["l_AB"]
    said = {"a_BA_n": tangential, "a_BA_t": normal, "epsilon_2": rate}
    answers = [replace(a, value=said.get(name, a.value)) for name, a in sizes.items()]

    assert explain(book(of_key), mark(of_key, answers)).candidates[0].mistakes[0].mistake == "M125"


def test_mistakes_that_answers_cannot_tell_apart_are_reported_together() -> None:
    explanation = of(rod_answers(rod(offset=-OFFSET)))  # in sizes the same as an angle laid off clockwise

    assert {"M09", "M12"} <= explanation.candidates[0].ids


def test_the_sense_tells_them_apart() -> None:
    sizes = rod_answers(rod(offset=-OFFSET))
    senses = [
        Answer("V_B", value=sizes[1].value, direction=math.pi),
        Answer("omega_2", value=sizes[0].value, sense=-1),
    ]

    first = of([*senses, *sizes[2:]]).candidates[0]

    assert "M12" in first.ids
    assert "M09" not in {one.mistake for one in first.mistakes if one.change.how == "angle"}


EXAMPLE = "nau-slider-crank"


def instead(**factors: float) -> Explanation:
    """Explain right answers of which some are so many times too large."""
    right = right_answers(key(EXAMPLE))
    answers = [replace(a, value=(a.value or 0.0) * factors.get(a.name, 1.0)) for a in right]
    return explain(mistakes(EXAMPLE), mark(key(EXAMPLE), answers))


@pytest.mark.parametrize(
    ("id", "factors"),
    [
        pytest.param("M01", {"omega_1": 30.0 / math.pi}, id="rpm in one row"),
        pytest.param("M05", dict.fromkeys(("omega_2", "epsilon_2"), 180.0 / math.pi), id="degrees"),
        pytest.param("M06", dict.fromkeys(("V_A", "V_BA", "V_B", "V_S2"), 1e3), id="mm/s"),
        pytest.param("M06", {"h_21": 1e3}, id="an arm in mm"),
    ],
)
def test_a_mistake_after_which_right_values_were_taken_is_named(id: str, factors: dict[str, float]) -> None:
    explanation = instead(**factors)

    assert id in explanation.candidates[0].ids
    assert set(explanation.candidates[0].explained) >= set(list(factors)[:1])


def test_the_line_of_a_velocity_along_the_link_is_named_from_the_lines_of_its_plan() -> None:
    broken_plan = next(s for s in mistakes(EXAMPLE).signatures if s.broken.mistake == "M25")
    wrong = ("V_BA", "V_B", "V_S2", "omega_2")
    answers = {a.name: a for a in right_answers(key(EXAMPLE))}
    answers |= {name: answer(name, broken_plan.values[name]) for name in wrong}

    explanation = explain(mistakes(EXAMPLE), mark(key(EXAMPLE), answers.values()))

    assert "M25" in explanation.candidates[0].ids


@pytest.mark.parametrize("directions", [True, False], ids=["directions", "sizes"])
@pytest.mark.parametrize(
    ("task", "degrees"),
    [
        pytest.param(EXAMPLE, 90.0, id="another number"),
        pytest.param(EXAMPLE, 180.0, id="another zero"),
        pytest.param("madi-four-bar", 15.0, id="345 laid off the other way"),
        pytest.param("bertyaev-six-bar", 60.0, id="65 misread by a little"),
        pytest.param("bertyaev-six-bar", 115.0, id="65 from the other end of the axis"),
        pytest.param("scheme-09-shaper", 75.0, id="60 of another variant"),
    ],
)
def test_another_angle_of_the_crank_is_named(task: str, degrees: float, directions: bool) -> None:
    of_key, angle = key(task), math.radians(degrees)
    there = run(of_key.paper.program, {**of_key.paper.givens, "phi": angle}).values
    answers = [answer(name, there[name], directions) for name in of_key.questions]

    first = explain(mistakes(task), mark(of_key, answers)).candidates[0]

    named = [one.givens["phi"] for found in (first.mistakes, *first.same) for one in found]
    assert len(first.mistakes) == 1
    assert any(math.cos(other - angle) > 1.0 - 1e-12 for other in named)


def test_a_driver_without_an_angle_has_none_to_mistake() -> None:
    turned = mistakes("scheme-18-hydraulic-drive").turned

    assert turned.table.shape == (0, len(turned.key.questions))


def test_no_number_is_told_twice_and_no_pair_where_one_explains_as_much() -> None:
    found = [one for task in FEW for one in _explained(task, 6)]

    for candidates in found:
        told = [(sorted(one.mistake for one in c.mistakes), sorted(c.explained)) for c in candidates]
        assert all(told.count(one) == 1 for one in told)
        for numbers, explained in told:
            less = [other for other in told if set(other[0]) < set(numbers) and len(other[0]) < len(numbers)]
            assert not any(set(explained) <= set(lines) for _, lines in less)


def _explained(task: str, count: int) -> Iterator[tuple[Candidate, ...]]:
    choose = random.Random(SEED)
    for found in choose.sample(mistakes(task).signatures, count):
        answers = planted(mistakes(task), found, choose.randrange(10**6))
        yield explain(mistakes(task), mark(key(task), answers)).candidates


@pytest.mark.parametrize("place", [("M20", "R_54", "10.0 alone"), ("M74", "forces_1", "forces_45")])
def test_a_mistake_is_told_on_a_drawing_that_its_flat_angles_have_led_astray(place: tuple[str, str, str]) -> None:
    task = "scheme-13-toggle-press"
    found = next(one for one in mistakes(task).signatures if one.broken.place == place)

    told = [explain(mistakes(task), mark(key(task), planted(mistakes(task), found, SEED + i))) for i in range(4)]

    assert sum(any(place[0] in candidate.ids for candidate in one.candidates) for one in told) >= 3


def test_a_line_that_seemed_a_slip_is_the_first_wrong_one_where_the_mistake_explains_it() -> None:
    task, place = "scheme-08-planer", ("M67", "_R_03_t", "")
    found = next(one for one in mistakes(task).signatures if one.broken.place == place)
    marked = [mark(key(task), planted(mistakes(task), found, SEED + i, directions=False)) for i in range(4)]

    told = [explain(mistakes(task), one).marking for one in marked]

    assert sum(one.first_wrong == "h_3" for one in told) > sum(one.first_wrong == "h_3" for one in marked)
    assert {one.first_wrong for one in told} == {"h_3"}
    assert {one.step and one.step.name for one in told} == {"h_3"}
    assert {one["h_3"].verdict for one in told} == {Verdict.WRONG}


def test_right_answers_have_no_explanation() -> None:
    for task in FEW:
        explanation = explain(mistakes(task), mark(key(task), right_answers(key(task))))

        assert explanation.candidates == ()


def test_scales_of_the_students_own_are_those_that_count() -> None:
    of_task, mu = key("nau-slider-crank"), 1.6 * key("nau-slider-crank").paper.mus["velocity"]
    names = ("V_BA", "V_B", "V_S2")
    right = Answer("V_A", mm=abs(of_task["V_A"]) / mu, mu=mu, value=abs(of_task["V_A"]))
    inverted = [Answer(name, mm=abs(of_task[name]) / mu, mu=mu, value=abs(of_task[name]) / mu**2) for name in names]

    marking = mark(of_task, [right, *inverted])
    explanation = explain(mistakes("nau-slider-crank"), marking)

    assert marking["V_BA"].verdict is Verdict.SCALE
    assert "M14" in explanation.candidates[0].ids


def apart(of_task: Key, moved: dict[str, float], name: str | None) -> bool:
    """Whether `name` is the first wrong line, or one before the first that moves enough and moves itself."""
    names = list(of_task.questions)
    clearly = next(i for i, other in enumerate(names) if moved.get(other, 0.0) >= WRONG_BY)
    return name is not None and moved.get(name, 0.0) >= 0.5 and names.index(name) <= clearly


@dataclass(frozen=True)
class Planted:
    """What became of one planted mistake: is the first step right, is it among the candidates, is it the first."""

    where: tuple[str, str, str, str]
    step: bool
    among: bool
    first: bool
    downstream: int
    carried: int


def plant(task: str, found: Signature, seed: int, directions: bool) -> Planted:
    of_task = key(task)
    moved = moves(of_task, found, directions)
    marking = mark(of_task, planted(mistakes(task), found, seed, directions))
    explanation = explain(mistakes(task), marking)
    ids = [candidate.ids for candidate in explanation.candidates]
    id = found.broken.mistake
    first = explanation.marking.first_wrong
    after = [x for x in explanation.marking.answered if moved.get(x.name, 0.0) > 1.0 and x.name != first]
    return Planted(
        (task, *found.broken.place),
        apart(of_task, moved, first),
        any(id in some for some in ids),
        bool(ids) and id in ids[0],
        len(after),
        sum(line.verdict.passed for line in after),
    )


def plantings(task: str, count: int, directions: bool) -> Iterator[Planted]:
    """Plant mistakes one after the other, each of the list with the same chance, those that move something enough."""
    choose = random.Random(f"{task} {directions} {SEED}")
    by_id: dict[str, list[Signature]] = {}
    for one in mistakes(task).signatures:
        by_id.setdefault(one.broken.mistake, []).append(one)
    while count:
        found = choose.choice(by_id[choose.choice(sorted(by_id))])
        if max(moves(key(task), found, directions).values()) >= WRONG_BY:
            yield plant(task, found, choose.randrange(10**6), directions)
            count -= 1


FEW = ["nau-slider-crank", "scheme-10-shaper-two-blocks"]


@pytest.mark.parametrize("directions", [True, False], ids=["directions", "sizes"])
@pytest.mark.parametrize(
    ("tasks", "count"),
    [pytest.param(FEW, 6, id="few"), pytest.param(LINKAGES, 6, id="all", marks=pytest.mark.soak)],
)
def test_planted_mistakes_are_found(tasks: list[str], count: int, directions: bool) -> None:
    found = [one for task in tasks for one in plantings(task, count, directions)]

    shares = Counter(
        {name: sum(getattr(one, name) for one in found) / len(found) for name in ("step", "among", "first")}
    )
    downstream = sum(one.carried for one in found) / sum(one.downstream for one in found)
    missed = [one for one in found if not (one.step and one.among)]
    assert shares["step"] >= 0.95, missed
    assert shares["among"] >= 0.95, missed
    assert shares["first"] >= 0.8, missed
    assert downstream >= 0.95


def test_every_mistake_can_be_made_after_a_force_is_left_out() -> None:
    of_book = book(key("scheme-10-shaper-two-blocks", "1"))
    left_out = [one for one in of_book.signatures if one.broken.mistake in ("M58", "M72")]
    assert {one.broken.mistake for one in left_out} == {"M58", "M72"}

    for one in left_out:
        paper = Paper(one.broken.program, one.broken.givens, of_book.key.paper.mus)
        assert len(list(broken(paper, one.values))) > 200


def twice_broken(of_book: Book, first: str, second: str) -> Signature:
    one = next(s for s in of_book.signatures if s.broken.mistake == first)
    paper = Paper(one.broken.program, one.broken.givens, of_book.key.paper.mus)
    found = next(b for b in broken(paper, one.values, (second,)))
    return next(signatures(of_book.key, (found,), one))


@pytest.mark.parametrize(
    ("first", "second"),
    [("M28", "M38"), ("M30", "M57"), ("M39", "M69"), ("M07", "M60"), ("M01", "M45"), ("M07", "M23")],
)
def test_two_mistakes_together_are_found(first: str, second: str) -> None:
    task = "nau-slider-crank"
    answers = planted(mistakes(task), twice_broken(mistakes(task), first, second), SEED)

    explanation = explain(mistakes(task), mark(key(task), answers))

    candidates = [c for c in explanation.candidates if {first, second} <= c.ids]
    assert candidates
    assert len(candidates[0].mistakes) == 2


@pytest.mark.parametrize(("first", "second"), [("M30", "M57"), ("M39", "M69")])
def test_each_of_two_mistakes_counts_once(first: str, second: str) -> None:
    both = twice_broken(mistakes(EXAMPLE), first, second)
    answers = [answer(name, both.values[name]) for name in key(EXAMPLE).questions]

    explanation = explain(mistakes(EXAMPLE), mark(key(EXAMPLE), answers))

    assert {first, second} <= explanation.candidates[0].ids
    faulty = [line.name for line in explanation.marking.lines if line.verdict.faulty]
    assert len(faulty) == 2
    assert faulty[0] == explanation.marking.first_wrong


ODD = [0.0, -0.0, 1e300, -1e300, 1e-300, 5e-324, math.inf, -math.inf, math.nan, 1.0, -1.0, 1e5, -3.0]


@pytest.mark.parametrize(("task", "count"), [("nau-slider-crank", 10), ("scheme-10-shaper-two-blocks", 3)])
def test_any_numbers_at_all_can_be_marked_and_explained(task: str, count: int) -> None:
    choose = random.Random(SEED)
    of_task, names = key(task), list(key(task).questions)

    def odd() -> float | None:
        return choose.choice([*ODD, *[None] * 6])

    for _ in range(count):
        answers = [
            Answer(name, odd(), odd(), choose.choice([odd(), abs(of_task[name])]), odd(), choose.choice([None, 1, -1]))
            for name in choose.sample(names, choose.randrange(len(names)))
        ]
        marking = mark(of_task, answers)
        explanation = explain(mistakes(task), marking)

        assert [line.name for line in explanation.marking.lines] == names
        assert all(line.verdict in Verdict for line in marking.lines)
        asked = {a.name for a in answers if a.value is not None and math.isfinite(a.value)}
        assert asked <= {line.name for line in marking.answered}
