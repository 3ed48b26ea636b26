"""Which mistake explains answers: planted ones are found on drawings of a shaky hand, alone and two together."""

from __future__ import annotations

import cmath
import math
import random
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import pytest

from kulman import check, solve
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper
from kulman.plans.marking.answers import Answer, Verdict
from kulman.plans.marking.key import Key
from kulman.plans.marking.verdicts import mark
from kulman.plans.marking.ways import as_drawn
from kulman.plans.mistakes.book import Book, Signature, book, broken, signatures
from kulman.plans.mistakes.explaining import Candidate, _Explanation, explain
from kulman.plans.mistakes.rules import BY_SCALE
from kulman.tests.support.cases import some
from kulman.tests.support.marking_cases import (
    LINKAGES,
    answer,
    in_millimetres,
    key,
    mistakes,
    moves,
    planted,
    right_answers,
)
from kulman.tests.support.mechanisms import SEED

WRONG_BY = 2.0  # tolerances by which a planted mistake moves at least one line
EXAMPLE = "nau-slider-crank"
FEW = [EXAMPLE, "scheme-10-shaper-two-blocks"]


def explained(task: str, answers: list[Answer]) -> _Explanation:
    return explain(mistakes(task), mark(key(task), answers))


def instead(directions: bool = True, **factors: float) -> _Explanation:
    """Explain right answers of which some are so many times too large."""
    right = right_answers(key(EXAMPLE), directions)
    return explained(EXAMPLE, [replace(a, value=(a.value or 0.0) * factors.get(a.name, 1.0)) for a in right])


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
    candidate = instead(**factors).candidates[0]

    assert id in candidate.ids
    assert set(candidate.explained) >= set(list(factors)[:1])


def test_a_normal_part_of_omega_alone_is_named_however_small_it_is_and_an_exchange_with_the_other() -> None:
    of, directions = key(EXAMPLE), False
    normal, tangential = (abs(of[name]) for name in ("a_BA_n", "a_BA_t"))
    rate = normal / of.paper.givens["l_AB"]

    small = instead(directions, a_BA_n=1.0 / abs(of["omega_2"]))
    swapped = instead(
        directions, a_BA_n=tangential / normal, a_BA_t=normal / tangential, epsilon_2=rate / abs(of["epsilon_2"])
    )

    assert small.candidates[0].mistakes[0].mistake == "M115"
    assert swapped.candidates[0].mistakes[0].mistake == "M125"


def test_a_sense_alone_is_a_wrong_sense_and_not_another_motion() -> None:
    sizes = right_answers(key(EXAMPLE), directions=False)
    turned = -1 if key(EXAMPLE)["omega_2"] > 0.0 else 1

    found = explained(EXAMPLE, [replace(a, sense=turned) if a.name == "omega_2" else a for a in sizes])

    assert found.candidates[0].mistakes[0].mistake == "M29"


def test_the_line_of_a_velocity_along_the_link_is_named_from_the_lines_of_its_plan() -> None:
    values = next(s.values for s in mistakes(EXAMPLE).signatures if s.broken.mistake == "M25")
    wrong = {name: answer(name, values[name]) for name in ("V_BA", "V_B", "V_S2", "omega_2")}

    found = explained(EXAMPLE, [wrong.get(a.name, a) for a in right_answers(key(EXAMPLE))])

    assert "M25" in found.candidates[0].ids


@pytest.mark.parametrize(
    ("task", "degrees"),
    [
        pytest.param(EXAMPLE, 90.0, id="another number"),
        pytest.param(EXAMPLE, 180.0, id="another zero"),
        pytest.param("madi-four-bar", 15.0, id="345 laid off the other way"),
        pytest.param("bertyaev-six-bar", 60.0, id="65 misread by a little", marks=pytest.mark.soak),
        pytest.param("bertyaev-six-bar", 115.0, id="65 from the other end of the axis"),
        pytest.param("scheme-09-shaper", 75.0, id="60 of another variant"),
    ],
)
def test_another_angle_of_the_crank_is_named(task: str, degrees: float) -> None:
    of, angle = key(task), math.radians(degrees)
    there = run(of.paper.program, {**of.paper.givens, "phi": angle}).values
    for directions in (True, False):
        first = explained(task, [answer(name, there[name], directions) for name in of.questions]).candidates[0]

        named = [one.givens["phi"] for found in (first.mistakes, *first.same) for one in found]
        assert len(first.mistakes) == 1
        assert any(math.cos(other - angle) > 1.0 - 1e-12 for other in named)


def test_a_driver_without_an_angle_has_none_to_mistake() -> None:
    turned = mistakes("scheme-18-hydraulic-drive").turned

    assert turned.table.shape == (0, len(turned.key.questions))


def test_scales_of_the_students_own_are_those_that_count() -> None:
    of, mu = key(EXAMPLE), 1.6 * key(EXAMPLE).paper.mus["velocity"]
    sizes = {name: abs(of[name]) for name in ("V_A", "V_BA", "V_B", "V_S2")}
    inverted = [Answer(name, mm=v / mu, mu=mu, value=v if name == "V_A" else v / mu**2) for name, v in sizes.items()]

    found = explained(EXAMPLE, inverted)

    assert mark(of, inverted)["V_BA"].verdict is Verdict.SCALE
    assert "M14" in found.candidates[0].ids


@pytest.mark.parametrize(
    ("turning", "direction"),
    [
        pytest.param(-1, lambda angle: angle, id="clockwise is positive"),
        pytest.param(1, lambda angle: -angle, id="angles are counted clockwise"),
        pytest.param(-1, lambda angle: -angle, id="both"),
        pytest.param(-1, lambda angle: angle + math.pi, id="all arrows and signs"),
    ],
)
@pytest.mark.parametrize("task", some(("nau-slider-crank", "scheme-09-shaper", "scheme-03-crank-rocker"), 0, 1))
def test_senses_that_all_are_opposite_are_one_mistake(
    task: str, turning: int, direction: Callable[[float], float]
) -> None:
    of = key(task)
    turns = [name for name, one in of.questions.items() if one.unit in ("rad/s", "rad/s^2", "N*m") and of[name]]

    def opposite(*kept: str) -> _Explanation:
        answers = []
        for one in right_answers(of):
            said = one if one.direction is None else replace(one, direction=direction(one.direction))
            turned = turning if one.name in turns and one.name not in kept else 1
            answers.append(said if one.sense is None else replace(said, sense=turned * one.sense))
        return explained(task, answers)

    found = opposite()

    assert [[one.mistake for one in candidate.mistakes] for candidate in found.candidates] == [["M126"]]
    assert len([line for line in found.marking.lines if line.verdict.faulty]) == 1
    other = opposite(next(name for name in turns if name.startswith("epsilon"))).candidates
    assert turning > 0 or "M126" not in {id for candidate in other for id in candidate.ids}  # where one sense is right


@pytest.mark.parametrize(
    ("name", "by_chance", "exchanged"),
    [("omega_2", 15.86, 17.5), ("F_i2", 1878.0, 1985.0), ("M_i2", 78.09, 87.8), ("F_i3", 857.0, 488.5)],
)
def test_digits_are_exchanged_where_the_other_order_is_the_number_that_was_meant(
    name: str, by_chance: float, exchanged: float
) -> None:
    asked = check("nau-slider-crank", "3", lang="en")
    solved = solve("nau-slider-crank", "3").quantities.values()
    right = {one.name: float(f"{abs(one.value or 0.0):.4g}") for one in solved if one.name in asked.asked.names}

    for value, ids in ((by_chance, []), (exchanged, ["M123"])):
        marked = asked.mark({**right, name: value}).marked
        assert marked.marking.first_wrong == name
        assert [*(marked.candidates[0].ids if marked.candidates else ())] == ids


@pytest.mark.parametrize("parts", [("mm",), ("value",), ("mm", "value")], ids=" ".join)
@pytest.mark.parametrize(
    ("slip", "id"), [({"V_A": "V_BA", "V_BA": "V_A"}, "M127"), ({"V_B": 100.0}, "M128")], ids=["exchanged", "no comma"]
)
@pytest.mark.parametrize("task", some((EXAMPLE, "scheme-01-compressor", "scheme-04-v-engine"), 0, 1))
def test_numbers_of_two_lines_exchanged_and_lost_commas_are_named_and_no_scales_elsewhere(
    task: str, slip: dict[str, str | float], id: str, parts: tuple[str, ...]
) -> None:
    of = key(task)
    mus = {plan: 2.0 * mu for plan, mu in of.paper.mus.items()}
    said = {
        name: Answer(name, mm=round(abs(of[name]) / mus[one.plan], 1), mu=mus[one.plan], value=abs(of[name]))
        for name, one in of.questions.items()
        if one.plan in ("velocity", "acceleration") and one.vector
    }
    wrong = dict(said)
    for name, by in slip.items():
        for part in parts if id == "M127" else parts[-1:]:
            number = getattr(said[by], part) if isinstance(by, str) else getattr(said[name], part) * by
            wrong[name] = replace(wrong[name], **{part: number})

    found = explained(task, [*wrong.values()])

    assert [one.mistake for one in found.candidates[0].mistakes] == [id]
    assert {*found.candidates[0].explained} == {*slip}
    assert len([line for line in found.marking.lines if line.verdict.faulty]) == 1
    by_value = parts != ("mm",)  # where a scale may be wrong as well
    assert by_value or not [one for other in found.candidates for one in other.ids if one in BY_SCALE]


def test_unlike_slips_are_not_explained_by_a_chain_of_more_mistakes_than_lines() -> None:
    right = solve(EXAMPLE, "3", only="velocity,acceleration")
    said = {name: f"{one.value:.4g} {one.unit}" for name, one in right.items() if one.value is not None}
    slips = {"V_BA": "3.429 m/s", "omega_2": "-15.7 rad/s", "a_BA_n": "142 m/s^2"}
    asked = check(EXAMPLE, "3", only="velocity,acceleration")

    marked = asked.mark({name: text for name, text in (said | slips).items() if name in asked.asked.names}).marked

    assert marked.marking.first_wrong == "V_BA"
    assert [[one.mistake for one in found.mistakes] for found in marked.candidates] == []


@pytest.mark.parametrize(
    ("task", "name", "times"),
    some(
        [
            ("scheme-08-planer", "a_S2", 0.43),
            ("nau-slider-crank", "omega_2", 2.0),
            ("scheme-04-v-engine", "epsilon_2", 2.32),
            ("scheme-01-compressor", "V_A", 2.0),
            ("scheme-05-articulated-rod", "a_E", 2.0),
            ("scheme-14-jaw-crusher", "a_BA", 0.41),
        ],
        0,
        1,
        2,
    ),
)
def test_a_value_alone_is_not_explained_by_what_would_spoil_others_as_well(task: str, name: str, times: float) -> None:
    right = right_answers(key(task))

    found = explained(task, [replace(a, value=(a.value or 0.0) * times) if a.name == name else a for a in right])

    assert [line.name for line in found.marking.lines if line.verdict.faulty] == [name]
    assert [[one.place for one in candidate.mistakes] for candidate in found.candidates] == []


@pytest.mark.parametrize(
    ("task", "place"),
    some(
        [
            ("scheme-16-hay-baler", ("M72", "R_42", "left out")),
            ("scheme-02-forging-press", ("M70", "R_12", "_t")),
        ],
        0,
    ),
)
def test_no_scale_factor_is_named_first_where_no_value_is_written(task: str, place: tuple[str, str, str]) -> None:
    found = next(one for one in mistakes(task).signatures if one.broken.place == place)
    drawn = in_millimetres(key(task), planted(mistakes(task), found, SEED), everything=True)

    first = explained(task, [replace(one, mu=key(task).paper.mus[key(task).questions[one.name].plan]) for one in drawn
                             if one.mm is not None]).candidates[0]  # fmt: skip

    assert not BY_SCALE.intersection(one.mistake for one in first.mistakes)


def test_no_scale_factor_explains_a_point_of_its_plan_that_is_drawn_elsewhere() -> None:
    """A vector between two points that were read follows from any scale factor, where no value is written."""
    of = key(EXAMPLE)
    mu, base, tip = of.paper.mus["velocity"], of["V_A"], 0.78 * of["V_B"]
    ends = {"V_A": base, "V_BA": tip - base, "V_B": tip, "V_S2": base + (tip - base) * of["l_AS2"] / of["l_AB"]}

    answers = [Answer(n, mm=abs(v) / mu, mu=mu, direction=cmath.phase(v)) for n, v in ends.items()]
    found = explain(as_drawn(mistakes(EXAMPLE)), mark(of, answers))

    assert not [one.ids for one in found.candidates if BY_SCALE & one.ids]


def test_right_answers_have_no_explanation() -> None:
    for task in FEW:
        assert explained(task, right_answers(key(task))).candidates == ()


def test_no_number_is_told_twice_and_no_pair_where_one_explains_as_much() -> None:
    dice = random.Random(SEED)
    found: list[tuple[Candidate, ...]] = [
        explained(task, planted(mistakes(task), one, dice.randrange(10**6))).candidates
        for task in FEW
        for one in dice.sample(mistakes(task).signatures, 6)
    ]

    for candidates in found:
        told = [(sorted(one.mistake for one in c.mistakes), sorted(c.explained)) for c in candidates]
        assert all(told.count(one) == 1 for one in told)
        for numbers, lines in told:
            less = [other for other in told if set(other[0]) < set(numbers) and len(other[0]) < len(numbers)]
            assert not any(set(lines) <= set(others) for _, others in less)


@pytest.mark.parametrize("place", [("M20", "R_54", "10.0 alone"), ("M74", "forces_1", "forces_45")])
def test_a_mistake_is_told_on_a_drawing_that_its_flat_angles_have_led_astray(place: tuple[str, str, str]) -> None:
    task = "scheme-13-toggle-press"
    found = next(one for one in mistakes(task).signatures if one.broken.place == place)

    told = [explained(task, planted(mistakes(task), found, SEED + i)) for i in range(4)]

    assert sum(any(place[0] in candidate.ids for candidate in one.candidates) for one in told) >= 3


def test_a_line_that_seemed_a_slip_is_the_first_wrong_one_where_the_mistake_explains_it() -> None:
    task, place = "scheme-08-planer", ("M62", "_M_F_i4_E", "E")
    found = next(one for one in mistakes(task).signatures if one.broken.place == place)
    marked = [mark(key(task), planted(mistakes(task), found, SEED + i, directions=False)) for i in range(4)]

    told = [explain(mistakes(task), one).marking for one in marked]

    assert sum(one.first_wrong == "h_4" for one in marked) < 4
    for one in told:
        assert (one.first_wrong, one.step and one.step.name) == ("h_4", "h_4")
        assert one["h_4"].verdict is Verdict.WRONG


def apart(of: Key, moved: dict[str, float], name: str | None) -> bool:
    """Whether `name` is the first wrong line, or one before the first that moves enough and moves itself."""
    names = list(of.questions)
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
    moved = moves(key(task), found, directions)
    explanation = explained(task, planted(mistakes(task), found, seed, directions))
    named = [found.broken.mistake in candidate.ids for candidate in explanation.candidates]
    first = explanation.marking.first_wrong
    after = [x for x in explanation.marking.answered if moved.get(x.name, 0.0) > 1.0 and x.name != first]
    step, passed = apart(key(task), moved, first), sum(line.verdict.passed for line in after)
    return Planted((task, *found.broken.place), step, any(named), any(named[:1]), len(after), passed)


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


@pytest.mark.parametrize("directions", some([True, False], 0), ids=["directions", "sizes"])
@pytest.mark.parametrize(
    ("tasks", "count"),
    [pytest.param(FEW, 6, id="few"), pytest.param(LINKAGES, 10, id="all", marks=pytest.mark.soak)],
)
def test_planted_mistakes_are_found(tasks: list[str], count: int, directions: bool) -> None:
    found = [one for task in tasks for one in plantings(task, count, directions)]

    shares = Counter({name: sum(getattr(one, name) for one in found) for name in ("step", "among", "first")})
    missed = [one for one in found if not (one.step and one.among)]
    assert shares["step"] >= 0.95 * len(found), missed
    assert shares["among"] >= 0.95 * len(found), missed
    assert shares["first"] >= 0.8 * len(found), missed
    assert sum(one.carried for one in found) >= 0.95 * sum(one.downstream for one in found)


def test_a_normal_part_that_two_mistakes_together_calculate_and_do_not_lay_off_is_explained() -> None:
    """What it was calculated from was not on the board: of an acceleration beyond all measure came a KeyError."""
    said = {"V_A": 56.0, "V_BA": 28.5, "V_B": 53.7, "V_S2": 53.5, "omega_2": 150.0, "a_A": 1e30, "a_BA_n": 4680.0}
    of, values = key("nau-slider-crank", "3"), said | {"a_BA_t": 749.0, "a_B": 339.0, "a_S2": 632.0}

    _, marking = explain(book(of), mark(of, [answer(name, value) for name, value in values.items()]))

    assert {line.name for line in marking.answered} == values.keys()
    assert marking["a_A"].verdict is Verdict.WRONG


def test_every_mistake_can_be_made_after_a_force_is_left_out() -> None:
    of = mistakes("scheme-10-shaper-two-blocks")
    left_out = [one for one in of.signatures if one.broken.mistake in ("M58", "M72")]
    assert {one.broken.mistake for one in left_out} == {"M58", "M72"}

    for one in left_out:
        paper = Paper(one.broken.program, one.broken.givens, of.key.paper.mus)
        assert len(list(broken(paper, one.values))) > 200


def twice_broken(of: Book, first: str, second: str) -> Signature:
    one = next(s for s in of.signatures if s.broken.mistake == first)
    paper = Paper(one.broken.program, one.broken.givens, of.key.paper.mus)
    return next(signatures(of.key, (next(broken(paper, one.values, (second,))),), one))


@pytest.mark.parametrize(
    ("first", "second"),
    [
        *(("M28", "M38"), ("M30", "M57"), ("M01", "M45")),
        *(pytest.param(*both, marks=pytest.mark.soak) for both in (("M39", "M69"), ("M07", "M60"), ("M07", "M23"))),
    ],
)
def test_two_mistakes_together_are_found_and_each_counts_once(first: str, second: str) -> None:
    both = twice_broken(mistakes(EXAMPLE), first, second)

    drawn = explained(EXAMPLE, planted(mistakes(EXAMPLE), both, SEED))
    exact = explained(EXAMPLE, [answer(name, both.values[name]) for name in key(EXAMPLE).questions])

    found = [candidate for candidate in drawn.candidates if {first, second} <= candidate.ids]
    assert len(found[0].mistakes) == 2
    if (first, second) in (("M30", "M57"), ("M39", "M69")):  # of the others right lines lie between
        assert {first, second} <= exact.candidates[0].ids
        faulty = [line.name for line in exact.marking.lines if line.verdict.faulty]
        assert (len(faulty), faulty[0]) == (2, exact.marking.first_wrong)


ODD = [0.0, -0.0, 1e300, -1e300, 1e-300, 5e-324, math.inf, -math.inf, math.nan, 1.0, -1.0, 1e5, -3.0]


@pytest.mark.parametrize(("task", "count"), [(EXAMPLE, 2), pytest.param(FEW[1], 4, marks=pytest.mark.soak)])
def test_any_numbers_at_all_can_be_marked_and_explained(task: str, count: int) -> None:
    choose, of, names = random.Random(SEED), key(task), list(key(task).questions)

    def odd() -> float | None:
        return choose.choice([*ODD, *[None] * 6])

    for _ in range(count):
        answers = [
            Answer(name, odd(), odd(), choose.choice([odd(), abs(of[name])]), odd(), choose.choice([None, 1, -1]))
            for name in choose.sample(names, choose.randrange(len(names)))
        ]
        marking, explanation = mark(of, answers), explained(task, answers)

        assert [line.name for line in explanation.marking.lines] == names
        assert all(line.verdict in Verdict for line in marking.lines)
        asked = {a.name for a in answers if a.value is not None and math.isfinite(a.value)}
        assert asked <= {line.name for line in marking.answered}
