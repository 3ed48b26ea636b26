"""Broken rules give what the list of mistakes says: closed forms of a few lines, found without any board."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from kulman import solve
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper
from kulman.plans.mistakes.book import broken
from kulman.plans.mistakes.rules import BY_SCALE, MISTAKES, Scene
from kulman.tests.support.broken_rules import (
    CRANK,
    DISTANCE,
    LEVER,
    MUS,
    OFFSET,
    OMEGA,
    PHI,
    ROD,
    Motion,
    after,
    close,
    cross,
    dot,
    lever,
    lever_motion,
    motion,
    rod,
    slider_crank,
    slotted_lever,
    ways,
)
from kulman.tests.support.cam_students import MADI, ROCKER, keyed_cam
from kulman.tests.support.marking_cases import mistakes

RIGHT, RIGHT_LEVER = rod(), lever()


@pytest.mark.parametrize(
    ("id", "how", "wanted", "name", "printed"),
    [
        pytest.param("M07", "x2", rod(crank=2 * CRANK), "v", 2.28, id="M07 diameter: v_B"),
        pytest.param("M07", "x2", rod(crank=2 * CRANK), "epsilon", 2.02, id="M07 diameter: epsilon_2"),
        pytest.param("M08", "", rod(phi=math.degrees(PHI)), "", 0.0, id="M08 degrees for radians"),
        pytest.param("M09", "angle", rod(phi=-PHI), "v", -1.076, id="M09 clockwise: v_B"),
        pytest.param("M09", "angle", rod(phi=-PHI), "a", 0.721, id="M09 clockwise: a_B"),
        pytest.param("M12", "none", rod(offset=0.0), "v", 1.037, id="M12 no offset: v_B"),
        pytest.param("M12", "none", rod(offset=0.0), "a", 0.863, id="M12 no offset: a_B"),
        pytest.param("M12", "side", rod(offset=-OFFSET), "v", 1.076, id="M12 wrong side: v_B"),
        pytest.param("M12", "side", rod(offset=-OFFSET), "a", 0.721, id="M12 wrong side: a_B"),
        pytest.param("M38", "", rod(normal=lambda v, w: -w * w * ROD), "a", 0.673, id="M38 normal from A to B"),
        pytest.param("M39", "", rod(normal=lambda v, w: 0.0), "a", 0.837, id="M39 normal forgotten"),
        pytest.param("M40", "v", rod(normal=lambda v, w: v * v / ROD), "a", 1.41, id="M40 normal from v_B"),
        pytest.param("M40", "omega_1", rod(normal=lambda v, w: OMEGA**2 * ROD), "", 0.0, id="M40 normal from omega_1"),
        pytest.param("M41", "v/l", rod(normal=lambda v, w: abs(w)), "", 0.0, id="M41 v / l"),
        pytest.param("M41", "omega", rod(normal=lambda v, w: abs(w) * ROD**2), "", 0.0, id="M41 omega l^2"),
        pytest.param("M115", "", rod(normal=lambda v, w: abs(w) * ROD), "", 0.0, id="M115 omega not squared"),
        pytest.param("M116", "", rod(normal=lambda v, w: w * w), "", 0.0, id="M116 omega^2 without l"),
    ],
)
def test_broken_rules_of_a_slider_crank_give_the_closed_form_and_the_printed_ratio(
    id: str, how: str, wanted: Motion, name: str, printed: float
) -> None:
    found = motion(after(slider_crank(), id, at="_a_BA_n" if id in ("M115", "M116") else "", how=how))

    assert close(motion(slider_crank().values), RIGHT)
    assert close(found, wanted)
    if name:
        assert getattr(found, name) / getattr(RIGHT, name) == pytest.approx(printed, abs=0.006)


@pytest.mark.parametrize(
    ("id", "how", "wanted", "name", "printed"),
    [
        pytest.param("M48", "", lever(lambda k, w, v: 0j), "epsilon", 1.717, id="M48 Coriolis forgotten"),
        pytest.param("M49", "", lever(lambda k, w, v: -2j * w * v * k), "epsilon", 2.433, id="M49 reversed"),
        pytest.param("M50", "", lever(lambda k, w, v: 1j * w * v * k), "epsilon", 1.358, id="M50 without two"),
        pytest.param("M51", "omega", lever(lambda k, w, v: 2j * OMEGA * v * k), "epsilon", -1.717, id="M51 omega_1"),
        pytest.param("M51", "v", lever(lambda k, w, v: -2j * w * OMEGA * LEVER * k), "epsilon", -0.083, id="M51 v_A"),
        pytest.param("M54", "none", lever(normal=0.0), "a", 1.26, id="M54 normal forgotten"),
        pytest.param("M54", "away", lever(normal=-1.0), "a", 1.53, id="M54 normal away"),
        # the list says that epsilon_3 stays right: it does not, the part across the lever is lost
        pytest.param("M52", "with", lever(lambda k, w, v: 2 * w * v * k), "epsilon", 1.717, id="M52 along the lever"),
    ],
)
def test_broken_rules_of_a_slotted_lever_give_the_closed_form_and_the_printed_ratio(
    id: str, how: str, wanted: Motion, name: str, printed: float
) -> None:
    found = lever_motion(after(slotted_lever(), id, how=how))

    assert close(lever_motion(slotted_lever().values), RIGHT_LEVER)
    assert close(found, wanted)
    assert getattr(found, name) / getattr(RIGHT_LEVER, name) == pytest.approx(printed, abs=0.004)


@pytest.mark.parametrize(
    ("id", "v", "a"),
    [
        ("M01", 9.549, 91.19),
        ("M02", 0.1592, 0.02533),
        ("M03", 60.0, 3600.0),
        ("M04", 0.5, 0.25),
        ("M05", 57.30, 3283.0),
    ],
)
def test_a_wrong_speed_multiplies_velocities_and_accelerations(id: str, v: float, a: float) -> None:
    values, right = after(slider_crank(), id, "n_1"), slider_crank().values

    for name in ("V_A", "V_B", "V_BA", "omega_2"):
        assert abs(values[name]) / abs(right[name]) == pytest.approx(v, rel=1e-3)
    for name in ("a_A", "a_B", "a_BA_n", "epsilon_2", "F_i2", "M_i2"):
        assert abs(values[name]) / abs(right[name]) == pytest.approx(a, rel=1e-3)


def test_millimetres_for_metres_leave_the_rates_and_multiply_the_rest() -> None:
    values, right = after(slider_crank(), "M06", "l"), slider_crank().values

    for name, factor in (("V_B", 1e3), ("a_B", 1e3), ("omega_2", 1.0), ("epsilon_2", 1.0), ("F_i2", 1e3)):
        assert abs(values[name]) / abs(right[name]) == pytest.approx(factor, rel=1e-9)


def test_other_assembly_changes_the_senses_and_no_sizes_of_a_central_slider_crank() -> None:
    where = slider_crank()
    central = Scene(replace(where.paper, givens={**where.paper.givens, "e": 0.0}), where.values)

    right, values = run(central.program, central.paper.givens).values, after(central, "M11")

    assert values["omega_2"] == pytest.approx(-right["omega_2"], rel=1e-12)
    assert values["epsilon_2"] == pytest.approx(-right["epsilon_2"], rel=1e-12)


def test_lines_of_the_velocity_plan_broken_give_what_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    A, B = (complex(right[point]) for point in "AB")
    a, b = (complex(right[f"velocity.{point}"]) for point in "AB")

    against = after(where, "M23")
    for name in ("V_A", "V_B", "V_S2", "omega_2"):
        assert against[name] == pytest.approx(-right[name], rel=1e-12)
    assert abs(against["a_B"]) == pytest.approx(abs(right["a_B"]), rel=1e-12)
    for how, sense in (("", 1.0), ("other way", -1.0)):
        drawn = [b for b in ways(where, "M24") if b.change.how == how]
        assert complex(run(drawn[0].program, drawn[0].givens).values["V_A"]) == pytest.approx(
            sense * OMEGA * A, rel=1e-12
        )
    along = after(where, "M25", how="with")
    assert cross(along["V_BA"], B - A) == pytest.approx(0.0, abs=1e-12)
    assert along["V_B"].real / right["V_B"].real == pytest.approx(-2.25, abs=0.006)
    assert abs(along["omega_2"] / right["omega_2"]) == pytest.approx(6.0, abs=0.006)
    # the list says pb* = ab and ab* = pb: in size, both run the other way
    swapped = after(where, "M26")
    assert complex(swapped["velocity.B"]) == pytest.approx(a - b, rel=1e-12)
    assert abs(swapped["V_BA"]) == pytest.approx(abs(right["V_B"]), rel=1e-12)
    assert after(where, "M27")["V_B"].real == pytest.approx(0.0, abs=1e-12)
    assert abs(after(where, "M28")["omega_2"]) == pytest.approx(abs(b) / ROD, rel=1e-12)
    assert after(where, "M29")["omega_2"] == -right["omega_2"]
    assert complex(after(where, "M30", at="velocity.S2")["velocity.S2"]) == pytest.approx(
        a + b - right["velocity.S2"], rel=1e-12
    )
    assert complex(after(where, "M31", at="velocity.S2")["velocity.S2"]) == pytest.approx((a + b) / 2, rel=1e-12)
    mirrored = complex(after(where, "M32", at="velocity.E")["velocity.E"])
    assert (mirrored - a) / (b - a) == pytest.approx(((right["velocity.E"] - a) / (b - a)).conjugate(), rel=1e-12)


def test_the_slotted_pair_broken_gives_what_the_list_says() -> None:
    where, right = slotted_lever(), slotted_lever().values
    v, arm = OMEGA * LEVER, abs(complex(right["A"]) + 1j * DISTANCE)

    exchanged = after(where, "M33", how="with")
    assert abs(exchanged["omega_3"] / right["omega_3"]) == pytest.approx(0.434, abs=0.001)
    assert abs(exchanged["V_A3A2"]) / abs(right["V_A3A2"]) == pytest.approx(2.303, abs=0.001)
    over = after(where, "M34")
    assert abs(over["V_A3"]) > v
    assert abs(over["V_A3"]) * abs(right["V_A3"]) == pytest.approx(v * v, rel=1e-9)
    same = after(where, "M35")
    assert abs(same["V_A3A2"]) == 0.0
    assert abs(same["V_A3"]) / arm == pytest.approx(v / arm, rel=1e-12)


def test_rates_of_the_acceleration_plan_broken_give_what_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    A, B = (complex(right[point]) for point in "AB")

    outward = after(where, "M37")
    assert outward["a_A"] == pytest.approx(-right["a_A"], rel=1e-12)
    along = after(where, "M42", how="with")
    assert cross(along["a_BA_t"], B - A) == pytest.approx(0.0, abs=1e-9)
    full = abs(after(where, "M43")["epsilon_2"])
    assert full == pytest.approx(math.hypot(RIGHT.epsilon, RIGHT.omega**2), rel=1e-9)
    assert abs(after(where, "M44")["epsilon_2"] / RIGHT.epsilon) == pytest.approx(0.49, abs=0.002)
    assert after(where, "M45")["epsilon_2"] == -right["epsilon_2"]
    extra = complex(after(where, "M53", how="omega_2")["a_B"]) - complex(right["a_B"])
    # the vector is normal to the guide: all of it goes into the line of the tangential part
    assert abs(cross(extra - 2j * RIGHT.omega * RIGHT.v, 1.0)) == pytest.approx(0.0, abs=1e-9)


def test_inertia_broken_gives_what_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    moment, length = float(right["M_i2"]), ROD

    assert complex(after(where, "M57", at="F_i2")["F_i2"]) == pytest.approx(-right["F_i2"], rel=1e-12)
    for how, times in (("none", 1.0), ("sense", 2.0)):
        found = after(where, "M60", how=how)
        change = abs(complex(found["R_12_t"]) - complex(right["R_12_t"]))
        assert change == pytest.approx(times * abs(moment) / length, rel=1e-9)
    assert after(where, "M61")["M_i2"] == pytest.approx(4.0 * moment, rel=1e-12)
    weight = after(where, "M63", at="G_2")
    assert abs(weight["G_2"]) == pytest.approx(2.0, rel=1e-12)
    assert abs(after(where, "M63", at="F_i2")["F_i2"]) == pytest.approx(9.81 * abs(right["F_i2"]), rel=1e-12)
    lighter = Scene(replace(where.paper, givens={**where.paper.givens, "g": 1.62}), where.values)
    assert abs(after(lighter, "M63", at="G_2")["G_2"]) == pytest.approx(2.0, rel=1e-12)  # whatever the task's g
    heavy = after(where, "M63", how="all", at="inertia_force")  # every inertia force, no weight
    assert all(complex(heavy[name]) == pytest.approx(9.81 * right[name], rel=1e-12) for name in ("F_i2", "F_i3"))
    assert heavy["G_2"] == right["G_2"]
    light = after(where, "M63", how="all", at="weight")
    assert all(complex(light[name]) == pytest.approx(right[name] / 9.81, rel=1e-12) for name in ("G_2", "G_3"))
    assert light["F_i2"] == right["F_i2"]
    for at, point in (("A", right["A"]), ("middle", (right["A"] + right["B"]) / 2)):
        moved = after(where, "M62", how=at)
        arm = cross(complex(point) - complex(right["S2"]), complex(right["F_i2"]))
        assert abs(moved["_R_12_t"] - right["_R_12_t"]) == pytest.approx(abs(arm) / length, rel=1e-9)


@pytest.mark.parametrize("force", ["F_i2", "G_2", "F_i3", "G_3"])
def test_a_force_left_out_or_reversed_leaves_itself_as_the_residual(force: str) -> None:
    where, right = slider_crank(), slider_crank().values

    for id, times in (("M58", 1.0), ("M59", 2.0)):
        values = after(where, id, at=force, how="polygon")
        change = sum(complex(values[name]) - complex(right[name]) for name in ("R_12", "R_03"))
        assert change == pytest.approx(times * complex(right[force]), rel=1e-9)


def test_reactions_broken_give_what_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    normal, tangential = (complex(right[f"R_12_{part}"]) for part in "nt")

    assert complex(after(where, "M69")["R_12_t"]) == pytest.approx(-tangential, rel=1e-12)
    assert complex(after(where, "M70", how="_n")["R_12"]) == pytest.approx(normal, rel=1e-12)
    assert complex(after(where, "M70", how="_t")["R_12"]) == pytest.approx(tangential, rel=1e-12)
    assert abs(normal) ** 2 + abs(tangential) ** 2 == pytest.approx(abs(right["R_12"]) ** 2, rel=1e-12)
    assert after(where, "M71", at="R_21")["M_bal"] == pytest.approx(-right["M_bal"], rel=1e-12)
    assert cross(after(where, "M73")["R_03"], 1.0) == pytest.approx(0.0, abs=1e-9)
    assert complex(after(where, "M75", at="R_03")["R_03"]) == pytest.approx(-right["R_03"], rel=1e-12)
    for at, arm in (("_M_F_i2_B", "h_2"), ("_M_G_2_B", "h_G_2")):
        whole = after(where, "M66", at=at)[arm]
        assert whole == pytest.approx(abs(complex(right["S2"]) - complex(right["B"])), rel=1e-9)
        assert whole > right[arm]


def test_the_crank_pin_accelerates_as_a_wrong_formula_says() -> None:
    where = slider_crank()

    assert abs(after(where, "M115", at="_a_A")["a_A"]) == pytest.approx(OMEGA * CRANK, rel=1e-12)
    assert abs(after(where, "M116", at="_a_A")["a_A"]) == pytest.approx(OMEGA**2, rel=1e-12)


def test_rates_with_another_length_give_the_ratio_of_lengths() -> None:
    where, right = slider_crank(), slider_crank().values

    for name in ("omega_2", "epsilon_2"):
        for length, of in (("l_OA", CRANK), ("l_AS2", 0.1)):
            found = after(where, "M117", at=name, how=length)
            assert found[name] == pytest.approx(right[name] * ROD / of, rel=1e-12)


def test_lines_of_the_acceleration_plan_from_swapped_points_leave_them_exchanged() -> None:
    where, right = slider_crank(), slider_crank().values
    end = complex(right["acceleration.n_BA"])
    B, A = complex(right["B"]), complex(right["A"])

    b = complex(after(where, "M121")["acceleration.B"])

    assert cross(b - end, 1.0) == pytest.approx(0.0, abs=1e-9)  # the guide's line runs through n
    assert dot(b, B - A) == pytest.approx(0.0, abs=1e-9)  # the normal to the rod through the pole


def test_equations_of_moments_broken_differ_by_a_moment_once_or_twice() -> None:
    where, right = slider_crank(), slider_crank().values
    force, couple = (float(right[name]) for name in ("_M_F_i2_B", "M_i2"))

    turned = after(where, "M118", at="_M_F_i2_B")
    lost = after(where, "M119", at="_R_12_t")
    sense = after(where, "M60", at="_R_12_t")

    for found, change in ((turned, -2.0 * force), (lost, -couple), (sense, -2.0 * couple)):
        assert found["_R_12_t"] - right["_R_12_t"] == pytest.approx(change / ROD, rel=1e-9)
    assert lost["M_i2"] == couple


def test_inertia_forces_of_another_point_have_its_acceleration() -> None:
    where, right = slider_crank(), slider_crank().values

    for name in ("a_A", "a_B"):
        found = after(where, "M122", at="F_i2", how=name)["F_i2"]
        assert complex(found) == pytest.approx(-2.0 * complex(right[name]), rel=1e-12)


def test_arms_in_millimetres_multiply_what_balances_the_crank() -> None:
    where, right = slider_crank(), slider_crank().values

    assert after(where, "M124", at="M_bal")["M_bal"] == pytest.approx(1e3 * right["M_bal"], rel=1e-12)
    assert after(where, "M124", at="M_bal_lever")["M_bal_lever"] == pytest.approx(1e3 * right["M_bal_lever"], rel=1e-12)


def test_the_lever_broken_gives_what_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    forces = {"F_i2": "S2", "G_2": "S2", "F_i3": "B", "G_3": "B"}

    unturned = after(where, "M77")
    for force, point in forces.items():
        speed = complex(right[f"V_{point}"])
        assert unturned[f"_M_{force}_p"] == pytest.approx(cross(speed, complex(right[force])), rel=1e-9, abs=1e-9)
    moved = after(where, "M78", at="_M_F_i2_p", how="B")
    assert moved["_M_F_i2_p"] == pytest.approx(cross(1j * right["V_B"], complex(right["F_i2"])), rel=1e-9)
    pointed = after(where, "M120", at="_M_F_i2_p")
    assert pointed["h_lever_F_i2"] == pytest.approx(abs(right["V_S2"]), rel=1e-9)
    assert pointed["h_lever_F_i2"] > right["h_lever_F_i2"]
    power = float(right["M_i2"] * right["omega_2"])
    for id, how, times in (("M79", "none", 1.0), ("M80", "", 2.0)):
        change = after(where, id, how=how)["M_bal_lever"] - right["M_bal_lever"]
        assert abs(change) == pytest.approx(times * abs(power) / OMEGA, rel=1e-9)
    assert after(where, "M82")["M_bal_lever"] == right["F_bal"]


def test_scales_broken_multiply_the_readings_of_a_plan() -> None:
    where, right = slider_crank(), slider_crank().values
    velocity, acceleration, length = (MUS[plan] for plan in ("velocity", "acceleration", "position"))

    inverted = after(where, "M14", at="velocity")
    other = after(where, "M15", at="velocity", how="acceleration")
    drawn = after(where, "M16")
    for name in ("V_B", "V_BA", "V_S2"):
        assert abs(inverted[name]) == pytest.approx(abs(right[name]) / velocity**2, rel=1e-12)
        assert abs(other[name]) == pytest.approx(abs(right[name]) * acceleration / velocity, rel=1e-12)
    factor = acceleration * length / velocity**2
    assert abs(drawn["a_BA_n"]) == pytest.approx(abs(right["a_BA_n"]) * factor, rel=1e-12)
    assert after(where, "M17", at="omega_2", how="all")["omega_2"] == pytest.approx(
        right["omega_2"] * length, rel=1e-12
    )
    tens = after(where, "M20", at="velocity", how="10.0")
    assert abs(tens["V_B"]) == pytest.approx(10.0 * abs(right["V_B"]), rel=1e-12)
    swapped = after(where, "M21", at="V_BA")
    assert (swapped["V_BA"], swapped["V_B"]) == (right["V_B"], right["V_BA"])
    parts = after(where, "M125", at="a_BA_t")
    assert (parts["a_BA_n"], parts["a_BA_t"]) == (right["a_BA_t"], right["a_BA_n"])
    assert abs(parts["epsilon_2"]) == pytest.approx(abs(right["a_BA_n"]) / right["l_AB"], rel=1e-12)
    letter = after(where, "M56", at="a_B", how="")
    assert abs(letter["a_B"]) == pytest.approx(abs(right["V_B"]) * acceleration / velocity, rel=1e-12)


def test_what_concerns_a_construction_follows_from_its_steps() -> None:
    crank, slotted = ({b.mistake for b in broken(s.paper, s.values)} for s in (slider_crank(), slotted_lever()))

    assert {"M33", "M34", "M35", "M48", "M54"} <= slotted
    assert not {"M33", "M34", "M35", "M48", "M54"} & crank
    assert {"M12", "M26", "M30", "M73"} <= crank
    assert not {"M12", "M38"} & slotted
    assert set(MISTAKES) == {f"M{n:02}" for n in range(1, 126) if n != 87}  # of a displacement counted backwards
    assert len(crank) >= 60


def test_every_mistake_concerns_a_bundled_task_or_a_crank_that_speeds_up() -> None:
    found = set()
    for task in ("nau-slider-crank", "scheme-03-crank-rocker", "scheme-09-shaper", "scheme-06-opposed-compressor"):
        solved = solve(task).solved
        mus = dict.fromkeys(solved.program.plans, 0.01) | {"position": 0.002, "velocity": 0.05, "acceleration": 0.3}
        mus |= {plan: 1.0 + i for i, plan in enumerate(p for p in solved.program.plans if p.startswith("forces"))}
        found |= {b.mistake for b in broken(Paper(solved.program, solved.givens, mus), solved.values)}

    for task in (MADI, ROCKER, "madi-gear"):
        subject = keyed_cam((), task).key  # a pair of gears is made ready for marking like a cam
        found |= {b.mistake for b in broken(subject.paper, subject.values)}

    assert set(MISTAKES) - found == {
        "M32",
        "M46",
        "M123",
    }  # a bent link, a crank that speeds up, a number as it is written


def test_rules_of_one_number_in_several_chapters_are_put_together() -> None:
    cam, crank = keyed_cam().key, slider_crank()

    assert {"M14", "M15", "M17", "M20"} <= {id for id, rules in MISTAKES.items() if len(rules) > 1}
    assert {"M14", "M15", "M17"} <= BY_SCALE
    assert "M20" not in BY_SCALE
    assert {b.mistake for b in broken(cam.paper, cam.values, ("M14", "M17"))} == {"M14", "M17"}
    assert {b.mistake for b in broken(crank.paper, crank.values, ("M14", "M17"))} == {"M14", "M17"}


def test_what_is_run_again_gives_the_whole_run_to_the_last_bit() -> None:
    of_task = mistakes("scheme-10-shaper-two-blocks")

    for found in of_task.signatures[::7]:
        whole = run(found.broken.program, found.broken.givens).values
        assert {name: whole[name] for name in of_task.key.questions} == {
            name: found.values[name] for name in of_task.key.questions
        }
