"""Task files with loads, strokes, diagrams and sliding drivers: what is read, and how faults are named."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman.plans.linkages.mechanism import SlidingDriver
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.reader import read_text
from kulman.variants.shelf import bundled_text
from kulman.variants.solution import solve
from kulman.variants.sweeps.sweeps import sweep

EXAMPLES = Path(__file__).resolve().parents[2] / "docs" / "examples"
PRESS = (EXAMPLES / "crank-press.toml").read_text(encoding="utf-8")
LIFT = (EXAMPLES / "piston-lift.toml").read_text(encoding="utf-8")


def test_press_is_loaded_by_its_diagram_only_near_the_end_of_its_stroke() -> None:
    task = task_of(PRESS)

    sizes = [solve(task, set={"phi": phi})["F_3"].value for phi in (20, 0, -60, -89.9, -100, -270)]

    assert sizes[0] == sizes[1] == sizes[4] == sizes[5] == 0.0
    assert 0.0 < (sizes[2] or 0.0) < (sizes[3] or 0.0) <= 30_000.0
    assert sizes[3] == pytest.approx(30_000.0, rel=1e-4)


def test_lift_is_driven_by_a_slider_that_may_go_back() -> None:
    task = task_of(LIFT)

    out, back = solve(task), solve(task, set={"v_1": "-0.2 m/s"})

    assert isinstance(task.mechanism.driver, SlidingDriver)
    assert out["F_bal"].value == pytest.approx(-(back["F_bal"].value or 0.0))
    assert (out["F_bal"].value or 0.0) * 0.2 == pytest.approx(90.0 * abs(out["omega_3"].value or 0.0))
    with pytest.raises(InputError) as refused:
        solve(task, set={"v_1": 0})
    assert refused.value.key == "is-zero"


AT_B = 'link = 3\npoint = "B"\nmagnitude = "60 N"'
DRIVES = 'link = 1\npoint = "A"\ntravel'
OVER_ANGLE = '[[mechanism.diagram]]\nname = "P"\nover = "angle"\nat = ["0 deg"]\nvalues = ["0 N"]\n'
PIVOT = '[[mechanism.pair]]\nkind = "revolute"\npoint = "C"\nlinks = [3, 0]\nat = ["1 mm", "0 mm"]\n'
BY_STROKE = 'over = "stroke"\nat = [0, 0.7, 1]'
BY_ANGLE = 'over = "angle"\nat = ["0 deg", "7 deg", "90 deg"]'
BROKEN = {
    "mass twice": (PRESS, ('per_length = "20 kg/m"', 'per_length = "20 kg/m"\nmass = "2 kg"'), "follows-from"),
    "factor without a mass": (PRESS, ('per_length = "20 kg/m"\n', ""), "key-missing"),
    "factor below zero": (PRESS, ("inertia_factor = 0.12", "inertia_factor = -0.1"), "not-positive"),
    "no centre": (PRESS, ('centre = "S2"\n', ""), "key-missing"),
    "length of a slider": (PRESS, ('mass = "14 kg"', 'per_length = "14 kg/m"'), "no-length"),
    "gravity as a speed": (PRESS, ('gravity = "9.81 m/s^2"', 'gravity = "9.81 m/s"'), "value-wrong"),
    "unknown balance": (PRESS, ('balance = "force"', 'balance = "torque"'), "balance-unknown"),
    "unknown stroke": (PRESS, ('stroke = "idle"', 'stroke = "back"'), "stroke-unknown"),
    "no output": (PRESS, ("[mechanism.stroke]\nlink = 3\nsense = 1\n", ""), "stroke-missing"),
    "output that drives": (PRESS, ("[mechanism.stroke]\nlink = 3", "[mechanism.stroke]\nlink = 1"), "stroke-link"),
    "sense of no sign": (PRESS, ("link = 3\nsense = 1", "link = 3\nsense = 2"), "sign-bad"),
    "over nothing": (PRESS, ('over = "stroke"', 'over = "time"'), "diagram-over"),
    "a value missing": (PRESS, ('values = ["0 N", "0 N", "F_max"]', 'values = ["0 N", "F_max"]'), "diagram-uneven"),
    "a value too many": (PRESS, ('back = ["0 N", "0 N", "0 N"]', 'back = ["0 N"]'), "diagram-uneven"),
    "values of two kinds": (PRESS, ('["0 N", "0 N", "F_max"]', '["0 N", "5 N*m", "F_max"]'), "value-wrong"),
    "places that decrease": (PRESS, ("at = [0, 0.7, 1]", "at = [0, 0.7, 0.6]"), "diagram-stroke"),
    "place behind the end": (PRESS, ("at = [0, 0.7, 1]", "at = [0, 0.7, 1.1]"), "diagram-stroke"),
    "places as lengths": (PRESS, ("at = [0, 0.7, 1]", 'at = [0, "7 mm", 1]'), "value-wrong"),
    "idle values over an angle": (PRESS, (BY_STROKE, BY_ANGLE), "diagram-back"),
    "force with a diagram of moments": (PRESS, ('magnitude = "2 N*m"', 'magnitude = "P"'), "value-wrong"),
    "diagram called like a given": (PRESS, ('name = "P"', 'name = "F_max"'), "id-twice"),
    "resisting at a pivot": (PRESS, (AT_B, AT_B.replace("3", "1").replace("B", "O")), "load-still"),
    "speed of nothing": (LIFT, ('speed = "v_1"', 'speed = "0 m/s"'), "is-zero"),
    "speed as a turning": (LIFT, ('speed = "v_1"', 'speed = "2 rad/s"'), "value-wrong"),
    "sliding driver with a pivot": (LIFT, ('travel = "s_1"', 'travel = "s_1"\npivot = "C"'), "key-unknown"),
    "driver's point on no link": (LIFT, (DRIVES, DRIVES.replace("A", "X")), "point-unknown"),
    "driver without a guide": (LIFT, (DRIVES, DRIVES.replace("1", "3").replace("A", "B")), "driver-guide"),
    "frame as the slider": (LIFT, ("links = [1, 0]", "links = [0, 1]"), "moving-guide"),
    "angle of a slider": (LIFT, ("[[variant]]", OVER_ANGLE + "[[variant]]"), "diagram-crank"),
    "pivot at two places": (LIFT, ("[mechanism.driver]", PIVOT + "[mechanism.driver]"), "pivot-twice"),
}


@pytest.mark.parametrize(("text", "change", "key"), BROKEN.values(), ids=BROKEN)
def test_fault_is_named_with_its_line(text: str, change: tuple[str, str], key: str) -> None:
    _, faults = read_text(with_changes(text, change), "mine.toml")

    keys = [getattr(fault, "cause", fault).key.removesuffix("-like") for fault in faults]
    assert key in keys
    fault = faults[keys.index(key)]
    assert all(fault.text(language).startswith("mine.toml:") for language in LANGUAGES)


NEVER_CLOSED = (
    pytest.param(PRESS.replace('-90 deg"', '-90 deg"\noffset = "3 m"'), "", id="diagram over a stroke"),
    pytest.param(bundled_text("scheme-13-toggle-press"), "l_AB", id="load in the working stroke"),
    pytest.param(bundled_text("scheme-20-press-automaton"), "l_AB", id="triad far from its start"),
)


@pytest.mark.parametrize(("text", "changed"), NEVER_CLOSED)
def test_mechanism_that_never_closes_is_said_to_whatever_its_strokes(text: str, changed: str) -> None:
    task = task_of(text)
    values = {changed: "1 mm"} if changed else {}

    solution, position = solve(task, set=values), solve(task, set=values, only="position")

    assert solution.status == "no-assembly"
    assert solution.reason is not None
    assert position.reason is not None
    assert solution.reason.status == 3
    for language in LANGUAGES:
        assert solution.reason.text(language) == position.reason.text(language)
    assert set(sweep(task, set=values).cycle.statuses) == {"no-assembly"}


@pytest.mark.parametrize("over", ["stroke", "angle"])
def test_given_of_a_diagram_may_be_called_like_a_load(over: str) -> None:
    text = PRESS
    if over == "angle":
        text = with_changes(text, (BY_STROKE, BY_ANGLE), ('back = ["0 N", "0 N", "0 N"]\n', ""))
    own, same = task_of(text), task_of(text.replace("F_max", "F_3"))
    swapped = task_of(text.replace("F_max", "F_f"))

    for phi in (-60, 20, 100):
        expected = solve(own, set={"phi": phi}).to_json()["quantities"]
        assert solve(same, set={"phi": phi}).to_json()["quantities"] == expected
        assert solve(swapped, set={"phi": phi}).to_json()["quantities"] == expected


def test_load_called_like_the_size_of_another_is_its_vector() -> None:
    given = PRESS.replace("[givens]", '[givens]\nF_f = { unit = "N" }') + "F_f = 60\n"
    friction = 'magnitude = "60 N"\nstroke = "idle"'
    assert friction in given

    plain = solve(task_of(PRESS), set={"phi": -130})
    sized = solve(task_of(given.replace(friction, friction.replace("60 N", "F_f"))), set={"phi": -130})
    moved = given.replace('name = "F_f"\nlink', 'name = "F_4"\nlink').replace('name = "F_3"', 'name = "F_f"')
    other = solve(task_of(moved.replace(friction, friction.replace("60 N", "F_f"))), set={"phi": -130})

    assert plain["F_f"].value == sized["F_f"].value == pytest.approx(60.0)
    assert other["F_4"].value == plain["F_f"].value
    assert plain["F_3"].value == sized["F_3"].value == other["F_f"].value
    assert plain["F_bal"].value == sized["F_bal"].value == other["F_bal"].value


def test_second_load_of_a_name_says_where_the_first_is() -> None:
    text = PRESS.replace('name = "F_f"', 'name = "F_3"')
    first = next(i for i, line in enumerate(text.splitlines(), 1) if line == 'name = "F_3"')

    (fault,) = read_text(text, "mine.toml")[1]

    assert f"in line {first}" in fault.text("en")
    assert all(str(first) in fault.text(language).partition(": ")[2] for language in LANGUAGES)


def test_places_of_a_diagram_are_checked_in_every_variant_and_setting() -> None:
    given = PRESS.replace("[givens]", '[givens]\nx = { unit = "1" }').replace("at = [0, 0.7, 1]", 'at = [0, "x", 1]')
    second = '\n[[variant]]\nid = "2"\nphi = 20\nn_1 = 60\nF_max = 30\nx = 1.5\n'

    task = task_of(given + "x = 0.5\n")
    _, faults = read_text(given + "x = 0.5\n" + second, "mine.toml")

    assert [getattr(fault, "cause", fault).key for fault in faults] == ["diagram-stroke"]
    with pytest.raises(InputError) as refused:
        solve(task, set={"x": 2})
    assert refused.value.key == "diagram-stroke"


def with_parts(links: str, pairs: str) -> str:
    """Return the press with more links and pairs before the driver."""
    link = [
        f"[[mechanism.link]]\nnumber = {n}\npoints = {{ {points} }}\n" for n, points in enumerate(links.split(";"), 4)
    ]
    pair = [f'[[mechanism.pair]]\nkind = "revolute"\n{words}\n' for words in pairs.split(";")]
    return PRESS.replace("[mechanism.driver]", "".join((*link, *pair)) + "[mechanism.driver]")


def test_three_links_in_one_joint_are_read_whichever_pairs_are_named() -> None:
    """A second rod 4 with a slider 5 on the pin of the crank; a dyad whose rocker shares the pivot of the crank."""
    links = 'A = ["0 mm", "0 mm"], D = ["300 mm", "0 mm"];D = ["0 mm", "0 mm"]'
    guide = 'point = "D"\nlinks = [5, 0]\nthrough = ["0 mm", "0 mm"]\ndirection = "180 deg"'
    pairs = f'point = "A"\nlinks = [1, 4];point = "D"\nlinks = [4, 5];{guide}'
    second = with_parts(links, pairs).replace(f'"revolute"\n{guide}', f'"prismatic"\n{guide}')
    shared = with_parts(
        'O = ["0 mm", "0 mm"], D = ["300 mm", "0 mm"];D = ["0 mm", "0 mm"], B = ["250 mm", "0 mm"]',
        'point = "O"\nlinks = [4, 1];point = "D"\nlinks = [4, 5]\nbranch = 1;point = "B"\nlinks = [5, 2]',
    )

    rods = [solve(task_of(second.replace("[1, 4]", named))) for named in ("[1, 4]", "[4, 1]", "[2, 4]", "[4, 2]")]
    rockers = [
        solve(task_of(shared.replace("links = [0, 1]\n", f"links = {named}\n"))) for named in ("[0, 1]", "[0, 4]")
    ]

    for solution in rods:
        assert [group.kind for group in solution.solved.structure.groups] == ["RRP", "RRP"]
        assert solution["R_01"].value == pytest.approx(rods[0]["R_01"].value, rel=1e-12)
    for solution in (*rods, *rockers):
        first = rods[0] if solution in rods else rockers[0]
        assert solution["F_bal"].value == pytest.approx(first["F_bal"].value, rel=1e-12)
    assert {solution.status for solution in rockers} == {"ok"}
