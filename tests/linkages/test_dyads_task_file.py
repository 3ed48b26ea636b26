"""A task file with dyads of other kinds: a four-bar linkage that speeds up, a slotted lever, a couple."""

from __future__ import annotations

import pytest

from kulman.plans.linkages.mechanism import Couple, Revolute
from kulman.plans.linkages.solved import solve_linkage
from kulman.variants.reader import read_text

TASK = """
id = "mine"
source = "own"
notation = "nau"
plans = ["position", "velocity", "acceleration", "forces", "lever"]
[title]
en = "Mine"
uk = "Моя"
ru = "Моя"
[givens]
phi = { unit = "deg" }
n_1 = { unit = "rpm" }
eps = { unit = "rad/s^2" }
l_AB = { unit = "mm" }
M_3 = { unit = "N*m" }
[[mechanism.link]]
number = 1
points = { O = ["0 mm", "0 mm"], A = ["100 mm", "0 mm"] }
[[mechanism.link]]
number = 2
points = { A = ["0 mm", "0 mm"], B = ["l_AB", "0 mm"] }
[[mechanism.link]]
number = 3
points = { C = ["0 mm", "0 mm"], B = ["300 mm", "0 mm"], D = ["100 mm", "50 mm"] }
[[mechanism.link]]
number = 4
points = { D = ["0 mm", "0 mm"] }
[[mechanism.link]]
number = 5
points = { E = ["0 mm", "0 mm"] }
[[mechanism.pair]]
kind = "revolute"
point = "O"
links = [0, 1]
at = ["0 mm", "0 mm"]
[[mechanism.pair]]
kind = "revolute"
point = "A"
links = [1, 2]
[[mechanism.pair]]
kind = "revolute"
point = "B"
links = [2, 3]
branch = BRANCH
[[mechanism.pair]]
kind = "revolute"
point = "C"
links = [3, 0]
at = ["350 mm", "0 mm"]
[[mechanism.pair]]
kind = "revolute"
point = "D"
links = [3, 4]
[[mechanism.pair]]
kind = "prismatic"
point = "D"
links = [4, 5]
through = ["0 mm", "0 mm"]
direction = "0 deg"
branch = 1
[[mechanism.pair]]
kind = "revolute"
point = "E"
links = [5, 0]
at = ["500 mm", "200 mm"]
[mechanism.driver]
link = 1
pivot = "O"
point = "A"
angle = "phi"
speed = "n_1"
sense = 1
acceleration = "eps"
[[mechanism.couple]]
name = "M_3"
link = LINK
magnitude = "M_3"
sense = -1
[[variant]]
id = "0"
phi = 50
n_1 = 60
eps = 12
l_AB = 350
M_3 = 40
"""
GOOD = TASK.replace("BRANCH", "1").replace("LINK", "3")


def test_task_with_two_dyads_a_couple_and_an_acceleration_is_read_and_solved() -> None:
    task, faults = read_text(GOOD, "mine.toml")
    assert task is not None, faults

    found = solve_linkage(task.mechanism, task.values())

    assert task.mechanism.couples == (Couple("M_3", 3, "M_3", task.mechanism.couples[0].sense),)
    assert [p.branch is not None for p in task.mechanism.pairs if isinstance(p, Revolute)].count(True) == 1
    assert [group.kind for group in found.structure.groups] == ["RRR", "RPR"]
    assert found.status == "ok"
    assert found.values["M_3"] == -40.0
    assert found.values["epsilon_1"] == 12.0
    assert found.values["M_bal"] == pytest.approx(40 * found.values["omega_3"] / found.values["omega_1"], rel=1e-12)


@pytest.mark.parametrize(
    ("text", "key"),
    [
        pytest.param(TASK.replace("BRANCH", "2").replace("LINK", "3"), "sign-bad", id="branch"),
        pytest.param(TASK.replace("BRANCH", "1").replace("LINK", "7"), "link-unknown", id="couple on no link"),
        pytest.param(GOOD.replace('["l_AB", "0 mm"]', '["0 mm", "0 mm"]'), "joints-coincide", id="no length"),
    ],
)
def test_fault_in_the_new_keys_is_named(text: str, key: str) -> None:
    _, faults = read_text(text, "mine.toml")

    assert key in [getattr(fault, "cause", fault).key for fault in faults]


def test_minus_before_a_length_lays_it_off_the_other_way() -> None:
    crank = 'A = ["r", "0 mm"], Q = ["-r", "0 mm"]'
    text = GOOD.replace('A = ["100 mm", "0 mm"]', crank).replace(
        "[givens]\n", '[givens]\nr = { unit = "mm", default = 100 }\n'
    )

    task, faults = read_text(text, "mine.toml")
    assert task is not None, faults
    found = solve_linkage(task.mechanism, task.values(None, {"r": 80}))

    assert found.point("Q") == -found.point("A") != 0
    assert "r" in task.mechanism.givens
    refused, _ = read_text(text.replace('"-r", "0 mm"', '"-q", "0 mm"'), "mine.toml")
    assert refused is None


def test_length_that_the_mechanism_states_itself_has_its_customary_name() -> None:
    task, faults = read_text(GOOD, "mine.toml")
    assert task is not None, faults

    found = solve_linkage(task.mechanism, task.values())

    assert task.mechanism.link(1).points["A"] == ("l_OA", "zero")
    assert found.quantities["l_OA"].value == 0.1
    assert found.quantities["l_CB"].value == 0.3


START = """[[mechanism.start]]
link = 3
x = "1 mm"
y = "2 mm"
angle = "30 deg"
driver = "50 deg"
legs = [2, 4]
"""


def test_start_of_a_link_that_is_not_central_is_refused() -> None:
    _, faults = read_text(GOOD.replace("[mechanism.driver]", START + "[mechanism.driver]"), "mine.toml")
    _, unknown = read_text(
        GOOD.replace("[mechanism.driver]", START.replace("link = 3", "link = 9") + "[mechanism.driver]"), "mine.toml"
    )

    assert [fault.text("en").split(": ", 2)[1:] for fault in faults] == [
        ["mechanism.start.link", "link 3 is not the central link of a group of class III, so that it needs no start"]
    ]
    assert [getattr(fault, "cause", fault).key for fault in unknown] == ["link-unknown"]
