"""Dyads in closed form, what is refused, what has a name; a task file with dyads of several kinds."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from kulman.plans.boards.batch import batch
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Couple, Driver, Link, Load, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import SolvedLinkage, board_givens, solve_linkage
from kulman.scales.errors import InputError
from kulman.tests.support.mechanisms import ORIGIN, bodies, nau_slider_crank, pins
from kulman.tests.support.singular_cases import FOUR_BAR, SCOTCH_YOKE, SLOTTED_LEVER, TANGENT, VALUES
from kulman.tests.support.task_files import task_of, with_changes
from kulman.variants.reader import read_text


def solve(of: Mechanism, **changed: float) -> SolvedLinkage:
    return solve_linkage(of, {**VALUES, **changed})


def test_slotted_lever_turns_as_its_closed_form_says() -> None:
    phi, r, c = np.linspace(0, 7, 200), 0.1, 0.3
    program = construct(SLOTTED_LEVER)[1]

    results, codes = batch(program, board_givens(SLOTTED_LEVER, {**VALUES, "phi": phi}), ["omega_3", "V_A3A2"])

    square = r * r + c * c - 2 * r * c * np.cos(phi)
    assert not codes.any()
    assert np.allclose(results["omega_3"], 10 * (r * r - r * c * np.cos(phi)) / square, rtol=0, atol=1e-13)
    assert np.allclose(abs(results["V_A3A2"]), abs(10 * r * c * np.sin(phi)) / np.sqrt(square), rtol=0, atol=1e-13)


def test_yoke_moves_by_the_sine_and_a_slotted_crank_by_the_tangent() -> None:
    yoke, tangent = solve(SCOTCH_YOKE), solve(TANGENT, gamma=math.pi / 2)

    assert yoke.point("S") == pytest.approx(0.1 * math.cos(0.7), rel=1e-15)
    assert yoke.point("V_S") == pytest.approx(-math.sin(0.7), rel=1e-14)
    assert yoke.point("a_S") == pytest.approx(-10 * math.cos(0.7), rel=1e-14)
    assert not {"omega_2", "omega_3", "a_A3A2_k"} & set(yoke.values)
    assert tangent.point("B") == pytest.approx(complex(0.3, 0.3 * math.tan(0.7)), rel=1e-14)
    assert tangent.point("V_B") == pytest.approx(3j / math.cos(0.7) ** 2, rel=1e-14)
    assert tangent.point("a_B") == pytest.approx(60j * math.tan(0.7) / math.cos(0.7) ** 2, rel=1e-13)


def test_what_bears_nothing_has_no_arms_out_of_nothing() -> None:
    lever = solve_linkage(replace(SLOTTED_LEVER, loads=()), {**VALUES, "m": 0.0, "J": 0.0})
    yoke = solve(SCOTCH_YOKE, phi=0.0, F=0.0)

    assert [lever.values[name] for name in ("h_32", "M_32", "M_bal", "M_bal_lever")] == [0.0] * 4
    assert yoke.size("R_03") == yoke.values["h_03"] == 0.0  # its force of inertia is along the guide, through A


TWO_GUIDES = replace(
    SCOTCH_YOKE, pairs=(*SCOTCH_YOKE.pairs[:2], Prismatic("S", (3, 2), ORIGIN, "up"), SCOTCH_YOKE.pairs[3])
)
TWO_LETTERS = replace(
    FOUR_BAR,
    links=(FOUR_BAR.links[0], Link(2, {**FOUR_BAR.links[1].points, "S": ("l_S", ZERO)}), FOUR_BAR.links[2]),
)
# the distance of the pins is measured; a given of that name would be overwritten
MEASURED = replace(SLOTTED_LEVER, pairs=(*pins("O01 A12 C30@l_CA"), SLOTTED_LEVER.pairs[3]))


@pytest.mark.parametrize(
    ("of", "key", "data"),
    [
        pytest.param(TWO_GUIDES, "slider-twice", {"link": 3}, id="slider of two guides"),
        pytest.param(TWO_LETTERS, "name-twice", {"name": "S"}, id="two points with one letter"),
        pytest.param(MEASURED, "name-twice", {"name": "l_CA"}, id="given with the name of a result"),
    ],
)
def test_what_means_two_things_is_refused(of: Mechanism, key: str, data: dict[str, object]) -> None:
    with pytest.raises(InputError) as refused:
        construct(of)

    assert (refused.value.key, refused.value.data) == (key, data)


def test_two_dyads_on_one_crank_pin_and_one_pivot_of_the_frame_move_as_alone() -> None:
    """Two equal dyads side by side: each moves as alone, and the crank and the pivot bear both."""
    links = bodies("", "", "", "A D:l_AB", "C D:l_CB S5:l_S / S5 m J")[3:]
    loads = (*FOUR_BAR.loads, Load("F_5", 5, "S5", "F", "alpha"))
    pairs = (*FOUR_BAR.pairs, *pins("A14 D45:branch C50@l_OC"))

    alone = solve(FOUR_BAR)
    both = solve(Mechanism((*FOUR_BAR.links, *links), pairs, FOUR_BAR.driver, loads))

    assert both.point("V_D") == both.point("V_B") == alone.point("V_B")
    assert both.point("R_14") == both.point("R_12") == alone.point("R_12")
    assert both.values["M_bal"] == pytest.approx(2 * alone.values["M_bal"], rel=1e-14)
    assert both.point("R_01") == pytest.approx(2 * alone.point("R_01"), rel=1e-14)


@pytest.mark.parametrize("of", [FOUR_BAR, SLOTTED_LEVER, SCOTCH_YOKE, TANGENT, nau_slider_crank()])
def test_what_acts_on_the_frame_has_no_name_and_every_guide_has_its_moment(of: Mechanism) -> None:
    _, program = construct(of)

    assert [name for name in program.names if re.fullmatch("[RM]_[0-9]0", name)] == []
    for slider, guide in (pair.links for pair in of.pairs if isinstance(pair, Prismatic)):
        assert {f"M_{guide}{slider}", f"M_{slider}{guide}"} & set(program.names)


def test_length_of_a_bent_link_is_measured_and_listed() -> None:
    points = {"A": ("l_S", "l_S"), "B": ("l_AB", ZERO)}
    bent = replace(FOUR_BAR, links=(FOUR_BAR.links[0], Link(2, points), FOUR_BAR.links[2]))
    free = replace(bent, links=(bent.links[0], Link(2, {**points, "B": ("l_long", ZERO)}), bent.links[2]))

    hidden, listed = solve(bent), solve_linkage(free, {**VALUES, "l_long": VALUES["l_AB"]})

    length = math.hypot(VALUES["l_AB"] - VALUES["l_S"], VALUES["l_S"])
    assert listed.quantities["l_AB"].value == pytest.approx(length)
    assert listed.size("V_BA") == pytest.approx(abs(listed.values["omega_2"]) * length)
    # a coordinate that is called so keeps its name
    assert hidden.quantities["l_AB"].value == VALUES["l_AB"]
    assert hidden.point("V_B") == listed.point("V_B")


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("runs", ["pin", "point"])
def test_branch_of_an_outer_guide_is_that_of_the_dyads_own_pin(runs: str, sign: float) -> None:
    guide = Prismatic("B", (3, 1), ORIGIN, ZERO, branch="branch")  # the pin B runs along the crank
    if runs == "point":
        guide = Prismatic("A", (1, 3), ORIGIN, ZERO, branch="branch")  # the crank's point A runs in a guide of link 3
    driver = Driver(1, "O", "A", "phi", "speed", "sense")
    values = {"phi": 0.7, "speed": 1.0, "sense": 1.0, "l_OA": 1.0, "l_CB": 2.5, "x_C": 1.5, "branch": sign}
    of = Mechanism(bodies("O A:l_OA", "C B:l_CB", "B"), (*pins("O01 C02@x_C B23"), guide), driver)

    solved = solve_linkage(of, values, ("position",))

    along = solved.point("B") * complex(solved.values["u_31"]).conjugate()
    middle = 1.5 * math.cos(0.7)  # the foot of the normal from C to the line through O
    assert along.imag == pytest.approx(0.0, abs=1e-14)
    assert along.real - middle == pytest.approx(sign * math.sqrt(2.5**2 - (1.5 * math.sin(0.7)) ** 2), rel=1e-13)


# A four-bar linkage that speeds up, a slotted lever, a couple.
TASK = """
id = "mine"
source = "own"
notation = "nau"
plans = ["position", "velocity", "acceleration", "forces", "lever"]
title = { en = "Mine", uk = "Моя", ru = "Моя" }
variant = [{ id = "0", phi = 50, n_1 = 60, eps = 12, l_AB = 350, M_3 = 40 }]
[givens]
phi = { unit = "deg" }
n_1 = { unit = "rpm" }
eps = { unit = "rad/s^2" }
l_AB = { unit = "mm" }
M_3 = { unit = "N*m" }
[mechanism]
driver = { link = 1, pivot = "O", point = "A", angle = "phi", speed = "n_1", sense = 1, acceleration = "eps" }
couple = [{ name = "M_3", link = 3, magnitude = "M_3", sense = -1 }]
link = [
  { number = 1, points = { O = ["0 mm", "0 mm"], A = ["100 mm", "0 mm"] } },
  { number = 2, points = { A = ["0 mm", "0 mm"], B = ["l_AB", "0 mm"] } },
  { number = 3, points = { C = ["0 mm", "0 mm"], B = ["300 mm", "0 mm"], D = ["100 mm", "50 mm"] } },
  { number = 4, points = { D = ["0 mm", "0 mm"] } },
  { number = 5, points = { E = ["0 mm", "0 mm"] } },
]
pair = [
  { kind = "revolute", point = "O", links = [0, 1], at = ["0 mm", "0 mm"] },
  { kind = "revolute", point = "A", links = [1, 2] },
  { kind = "revolute", point = "B", links = [2, 3], branch = 1 },
  { kind = "revolute", point = "C", links = [3, 0], at = ["350 mm", "0 mm"] },
  { kind = "revolute", point = "D", links = [3, 4] },
  { kind = "prismatic", point = "D", links = [4, 5], through = ["0 mm", "0 mm"], direction = "0 deg", branch = 1 },
  { kind = "revolute", point = "E", links = [5, 0], at = ["500 mm", "200 mm"] },
]
"""
START = 'start = [{ link = 3, x = "1 mm", y = "2 mm", angle = "30 deg", driver = "50 deg", legs = [2, 4] }]'


def test_task_with_two_dyads_a_couple_and_an_acceleration_is_read_and_solved() -> None:
    task = task_of(TASK)

    solved = solve_linkage(task.mechanism, task.values())

    assert task.mechanism.couples == (Couple("M_3", 3, "M_3", task.mechanism.couples[0].sense),)
    assert [p.branch is not None for p in task.mechanism.pairs if isinstance(p, Revolute)].count(True) == 1
    assert task.mechanism.link(1).points["A"] == ("l_OA", "zero")  # what the file states has its customary name
    assert [group.kind for group in solved.structure.groups] == ["RRR", "RPR"]
    assert solved.status == "ok"
    assert (solved.values["M_3"], solved.values["epsilon_1"]) == (-40.0, 12.0)
    assert (solved.quantities["l_OA"].value, solved.quantities["l_CB"].value) == (0.1, 0.3)
    assert solved.values["M_bal"] == pytest.approx(40 * solved.values["omega_3"] / solved.values["omega_1"], rel=1e-12)


@pytest.mark.parametrize(
    ("change", "key"),
    [
        pytest.param(("[2, 3], branch = 1", "[2, 3], branch = 2"), "sign-bad", id="branch"),
        pytest.param(('"M_3", link = 3', '"M_3", link = 7'), "link-unknown", id="couple on no link"),
        pytest.param(('["l_AB", "0 mm"]', '["0 mm", "0 mm"]'), "joints-coincide", id="no length"),
        pytest.param(("link = [\n", START + "\nlink = [\n"), "start-link", id="start of a link that is not central"),
        pytest.param(
            ("link = [\n", START.replace("3", "9", 1) + "\nlink = [\n"), "link-unknown", id="start of no link"
        ),
    ],
)
def test_fault_of_a_dyad_is_named(change: tuple[str, str], key: str) -> None:
    _, faults = read_text(with_changes(TASK, change), "mine.toml")

    assert key in [getattr(fault, "cause", fault).key for fault in faults]


def test_minus_before_a_length_lays_it_off_the_other_way() -> None:
    text = with_changes(
        TASK,
        ('A = ["100 mm", "0 mm"]', 'A = ["r", "0 mm"], Q = ["-r", "0 mm"]'),
        ("[givens]\n", '[givens]\nr = { unit = "mm", default = 100 }\n'),
    )
    task = task_of(text)

    solved = solve_linkage(task.mechanism, task.values(None, {"r": 80}))

    assert solved.point("Q") == -solved.point("A") != 0
    assert "r" in task.mechanism.givens
    assert read_text(text.replace('"-r", "0 mm"', '"-q", "0 mm"'), "mine.toml")[0] is None
