"""Broken rules give what the list of mistakes says, and are named: closed forms of a few lines, without any board."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import astuple, dataclass, replace
from functools import cache
from typing import Any

import pytest

from kulman import solve
from kulman.plans.boards.exact import run
from kulman.plans.hands.shaky import Paper, preset
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Mechanism, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens
from kulman.plans.marking.answers import Answer
from kulman.plans.marking.key import answer_key
from kulman.plans.marking.verdicts import mark
from kulman.plans.mistakes.book import book, broken
from kulman.plans.mistakes.explaining import Candidate, explain
from kulman.plans.mistakes.rules import BY_SCALE, MISTAKES, Broken, Scene
from kulman.tests.support.cams import MADI, ROCKER, keyed_cam
from kulman.tests.support.jacobian_solver import cross, dot
from kulman.tests.support.marking_cases import mistakes
from kulman.tests.support.mechanisms import ORIGIN

CRANK, PHI, OMEGA = 0.08, math.radians(60.0), 20.0
ROD, OFFSET = 0.30, 0.02
N_1 = OMEGA * 30.0 / math.pi  # rpm
MUS = {"position": 0.002, "velocity": 0.02, "acceleration": 0.4}


@dataclass(frozen=True)
class Motion:
    """Rates of a link, and velocity and acceleration of its slider along the guide, or of the sliding."""

    omega: float
    v: float
    epsilon: float
    a: float


def rod(
    crank: float = CRANK,
    phi: float = PHI,
    offset: float = OFFSET,
    omega: float = OMEGA,
    normal: Callable[[float, float], float] = lambda v, omega: omega * omega * ROD,
) -> Motion:
    """Return the motion of the rod and the slider of a slider-crank; `normal` gives the part from B to A."""
    A = cmath.rect(crank, phi)
    u = complex(math.sqrt(ROD**2 - (offset - A.imag) ** 2), offset - A.imag) / ROD
    rate = -(1j * omega * A).imag / (1j * u).imag / ROD
    speed = (1j * omega * A + rate * ROD * 1j * u).real
    known = -(omega**2) * A - normal(speed, rate) * u
    change = -known.imag / (1j * u).imag / ROD
    return Motion(rate, speed, change, (known + change * ROD * 1j * u).real)


LEVER, DISTANCE = 0.10, 0.35


def lever(
    coriolis: Callable[[complex, float, complex], complex] = lambda k, omega, v: 2j * omega * v * k,
    normal: float = 1.0,
) -> Motion:
    """Return the motion of a slotted lever about a pivot below the crank's; `coriolis` of u, omega_3, v_r."""
    A = cmath.rect(LEVER, PHI)
    arm = A + 1j * DISTANCE
    length, u = abs(arm), arm / abs(arm)
    rate = dot(1j * OMEGA * A, 1j * u) / length
    slide = -dot(1j * OMEGA * A, u)
    known = -(OMEGA**2) * A + coriolis(u, rate, slide) + u * rate**2 * length * normal
    return Motion(rate, slide, dot(known, 1j * u) / length, -dot(known, u))


@cache
def slider_crank() -> Scene:
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO), "S2": ("l_AS2", ZERO), "E": ("x_E", "y_E")}, "S2", "m_2", "J_2"),
            Link(3, {"B": ORIGIN}, "B", "m_3"),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("B", (2, 3)),
            Prismatic("B", (3, 0), ORIGIN, ZERO, "e", "side"),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
        gravity="g",
    )
    lengths = {"l_OA": CRANK, "l_AB": ROD, "e": OFFSET, "l_AS2": 0.1, "x_E": 0.12, "y_E": 0.05}
    loads = {"m_2": 2.0, "J_2": 0.015, "m_3": 1.5, "g": 9.81}
    return scene(mechanism, {**lengths, **loads, "side": 1.0})


@cache
def slotted_lever() -> Scene:
    mechanism = Mechanism(
        links=(
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN}),
            Link(3, {"C": ORIGIN, "S3": ("l_CS3", ZERO)}, "S3", "m_3", "J_3"),
        ),
        pairs=(
            Revolute("O", (0, 1), ORIGIN),
            Revolute("A", (1, 2)),
            Revolute("C", (0, 3), (ZERO, "y_C")),
            Prismatic("A", (2, 3), ORIGIN, ZERO),
        ),
        driver=Driver(1, "O", "A", "phi", "n_1", "sense"),
    )
    return scene(mechanism, {"l_OA": LEVER, "y_C": -DISTANCE, "l_CS3": 0.2, "m_3": 3.0, "J_3": 0.1})


def scene(mechanism: Mechanism, values: Mapping[str, float]) -> Scene:
    _, program = construct(mechanism)
    givens = board_givens(mechanism, {**values, "phi": PHI, "n_1": OMEGA, "sense": 1.0, "zero": 0.0}, program)
    mus = {plan: MUS.get(plan, 5.0) for plan in program.plans} | {"lever": MUS["velocity"]}
    return Scene(Paper(program, givens, mus), run(program, givens).values)


def ways(where: Scene, id: str, at: str = "", how: str = "") -> list[Broken]:
    return [b for b in broken(where.paper, where.values, (id,)) if at in ("", b.at) and b.change.how.startswith(how)]


def after(where: Scene, id: str, at: str = "", how: str = "") -> Mapping[str, Any]:
    """Return the values that a broken construction gives."""
    found = ways(where, id, at, how)
    assert len(found) == 1, [b.place for b in found]
    return run(found[0].program, found[0].givens).values


def motion(values: Mapping[str, Any]) -> Motion:
    """Return the motion of rod and slider, signed along the guide."""
    return Motion(values["omega_2"], values["V_B"].real, values["epsilon_2"], values["a_B"].real)


def lever_motion(values: Mapping[str, Any]) -> Motion:
    u = values["u_23"]
    return Motion(values["omega_3"], dot(values["V_A3A2"], u), values["epsilon_3"], dot(values["a_A3A2_r"], u))


VALUES = ("omega_2", "V_B", "epsilon_2", "a_B"), ("omega_3", "V_A3A2", "epsilon_3", "a_A3A2_r")  # of rod, of lever
RIGHT, RIGHT_LEVER = rod(), lever()


def told(found: Motion, slotted: bool = False, **senses: Any) -> Candidate:
    """Return what first explains the sizes that somebody with this motion writes, some of them with a sense."""
    sized = zip(VALUES[slotted], astuple(found), strict=True)
    answers = [senses.get(name) or Answer(name, value=abs(size)) for name, size in sized]
    key = answer_key((slotted_lever() if slotted else slider_crank()).paper, preset("careful").tolerance)
    return explain(book(key), mark(key, answers)).candidates[0]


@pytest.mark.parametrize(
    ("id", "how", "wanted", "printed"),
    [
        pytest.param("M07", "x2", rod(crank=2 * CRANK), {"v": 2.28, "epsilon": 2.02}, id="M07 diameter"),
        pytest.param("M08", "", rod(phi=math.degrees(PHI)), {}, id="M08 degrees for radians"),
        pytest.param("M09", "angle", rod(phi=-PHI), {"v": -1.076, "a": 0.721}, id="M09 clockwise"),
        pytest.param("M12", "none", rod(offset=0.0), {"v": 1.037, "a": 0.863}, id="M12 no offset"),
        pytest.param("M12", "side", rod(offset=-OFFSET), {"v": 1.076, "a": 0.721}, id="M12 wrong side"),
        pytest.param("M38", "", rod(normal=lambda v, w: -w * w * ROD), {"a": 0.673}, id="M38 from A to B"),
        pytest.param("M39", "", rod(normal=lambda v, w: 0.0), {"a": 0.837}, id="M39 normal forgotten"),
        pytest.param("M40", "v", rod(normal=lambda v, w: v * v / ROD), {"a": 1.41}, id="M40 from v_B"),
        pytest.param("M40", "omega_1", rod(normal=lambda v, w: OMEGA**2 * ROD), {}, id="M40 from omega_1"),
        pytest.param("M41", "v/l", rod(normal=lambda v, w: abs(w)), {}, id="M41 v / l"),
        pytest.param("M41", "omega", rod(normal=lambda v, w: abs(w) * ROD**2), {}, id="M41 omega l^2"),
        pytest.param("M115", "", rod(normal=lambda v, w: abs(w) * ROD), {}, id="M115 omega not squared"),
        pytest.param("M116", "", rod(normal=lambda v, w: w * w), {}, id="M116 omega^2 without l"),
        pytest.param("M48", "", lever(lambda k, w, v: 0j), {"epsilon": 1.717}, id="M48 Coriolis forgotten"),
        pytest.param("M49", "", lever(lambda k, w, v: -2j * w * v * k), {"epsilon": 2.433}, id="M49 reversed"),
        pytest.param("M50", "", lever(lambda k, w, v: 1j * w * v * k), {"epsilon": 1.358}, id="M50 without two"),
        pytest.param("M51", "omega", lever(lambda k, w, v: 2j * OMEGA * v * k), {"epsilon": -1.717}, id="M51 omega_1"),
        pytest.param("M51", "v", lever(lambda k, w, v: -2j * w * OMEGA * LEVER * k), {"epsilon": -0.083}, id="M51 v_A"),
        pytest.param("M54", "none", lever(normal=0.0), {"a": 1.26}, id="M54 normal forgotten"),
        pytest.param("M54", "away", lever(normal=-1.0), {"a": 1.53}, id="M54 normal away"),
        # the list says that epsilon_3 stays right: it does not, the part across the lever is lost
        pytest.param("M52", "with", lever(lambda k, w, v: 2 * w * v * k), {"epsilon": 1.717}, id="M52 along the lever"),
    ],
)
def test_broken_rules_give_the_closed_form_and_the_printed_ratio_and_are_named(
    id: str, how: str, wanted: Motion, printed: dict[str, float]
) -> None:
    slotted = id in ("M48", "M49", "M50", "M51", "M52", "M54")
    where, moving, right = ((slider_crank, motion, RIGHT), (slotted_lever, lever_motion, RIGHT_LEVER))[slotted]

    found = moving(after(where(), id, at="_a_BA_n" if id in ("M115", "M116") else "", how=how))

    assert astuple(moving(where().values)) == pytest.approx(astuple(right), rel=1e-9, abs=1e-9)
    assert astuple(found) == pytest.approx(astuple(wanted), rel=1e-9, abs=1e-9)
    for name, ratio in printed.items():
        assert getattr(found, name) / getattr(right, name) == pytest.approx(ratio, abs=0.004 if slotted else 0.006)
    assert id in told(wanted, slotted).ids


def test_mistakes_that_answers_cannot_tell_apart_are_reported_together_until_a_sense_tells_them() -> None:
    found = rod(offset=-OFFSET)  # in sizes the same as an angle laid off clockwise
    senses = {
        "V_B": Answer("V_B", value=abs(found.v), direction=math.pi),
        "omega_2": Answer("omega_2", value=abs(found.omega), sense=-1),
    }

    assert "M05" in told(rod(omega=OMEGA * 180.0 / math.pi)).ids
    assert {"M09", "M12"} <= told(found).ids
    assert "M12" in told(found, **senses).ids
    assert "M09" not in {one.mistake for one in told(found, **senses).mistakes if one.change.how == "angle"}


MU_V, MU_A, MU_L = (MUS[plan] for plan in ("velocity", "acceleration", "position"))
Values = Mapping[str, Any]
# by the name x of a quantity: what it becomes; of |x| its size does, of ±x by how much it changes
Law = Callable[[Values, Any], Any]

OF_SLIDER_CRANK: list[tuple[str, str, str, str, Law]] = [
    ("M06", "l", "", "|V_B| |a_B| |F_i2|", lambda r, x: 1e3 * x),
    ("M06", "l", "", "omega_2 epsilon_2", lambda r, x: x),
    ("M09", "", "sense", "V_A V_B omega_2", lambda r, x: -x),
    ("M09", "", "sense", "a_A a_B epsilon_2 F_i2", lambda r, x: x),
    ("M14", "velocity", "", "|V_B| |V_BA| |V_S2|", lambda r, x: x / MU_V**2),
    ("M15", "velocity", "acceleration", "|V_B| |V_BA| |V_S2|", lambda r, x: x * MU_A / MU_V),
    ("M16", "", "", "|a_BA_n|", lambda r, x: x * MU_A * MU_L / MU_V**2),
    ("M17", "omega_2", "all", "omega_2", lambda r, x: x * MU_L),
    ("M20", "velocity", "10.0", "|V_B|", lambda r, x: 10.0 * x),
    ("M21", "V_BA", "", "V_BA", lambda r, x: r["V_B"]),
    ("M21", "V_BA", "", "V_B", lambda r, x: r["V_BA"]),
    ("M23", "", "", "V_A V_B V_S2 omega_2", lambda r, x: -x),
    ("M23", "", "", "|a_B|", lambda r, x: x),
    ("M24", "", "other way", "V_A", lambda r, x: -OMEGA * r["A"]),
    # the list says pb* = ab and ab* = pb: in size, both run the other way
    ("M26", "", "", "velocity.B", lambda r, x: r["velocity.A"] - x),
    ("M26", "", "", "|V_BA|", lambda r, x: abs(r["V_B"])),
    ("M28", "", "", "|omega_2|", lambda r, x: abs(r["velocity.B"]) / ROD),
    ("M29", "", "", "omega_2", lambda r, x: -x),
    ("M30", "velocity.S2", "", "velocity.S2", lambda r, x: r["velocity.A"] + r["velocity.B"] - x),
    ("M31", "velocity.S2", "", "velocity.S2", lambda r, x: (r["velocity.A"] + r["velocity.B"]) / 2),
    ("M32", "velocity.E", "", "velocity.E", lambda r, x: mirrored(x, r["velocity.A"], r["velocity.B"])),
    ("M37", "", "", "a_A", lambda r, x: -x),
    ("M43", "", "", "|epsilon_2|", lambda r, x: math.hypot(RIGHT.epsilon, RIGHT.omega**2)),
    ("M45", "", "", "epsilon_2", lambda r, x: -x),
    ("M56", "a_B", "", "|a_B|", lambda r, x: abs(r["V_B"]) * MU_A / MU_V),
    ("M57", "F_i2", "", "F_i2", lambda r, x: -x),
    ("M60", "", "none", "±R_12_t", lambda r, x: abs(r["M_i2"]) / ROD),
    ("M60", "", "sense", "±R_12_t", lambda r, x: 2.0 * abs(r["M_i2"]) / ROD),
    ("M60", "_R_12_t", "", "_R_12_t", lambda r, x: x - 2.0 * r["M_i2"] / ROD),
    ("M61", "", "", "M_i2", lambda r, x: 4.0 * x),
    ("M62", "", "A", "±_R_12_t", lambda r, x: shifted(r, r["A"])),
    ("M62", "", "middle", "±_R_12_t", lambda r, x: shifted(r, (r["A"] + r["B"]) / 2)),
    ("M63", "G_2", "", "|G_2|", lambda r, x: 2.0),
    ("M63", "F_i2", "", "|F_i2|", lambda r, x: 9.81 * x),
    ("M63", "inertia_force", "all", "F_i2 F_i3", lambda r, x: 9.81 * x),  # every inertia force, no weight
    ("M63", "inertia_force", "all", "G_2", lambda r, x: x),
    ("M63", "weight", "all", "G_2 G_3", lambda r, x: x / 9.81),
    ("M63", "weight", "all", "F_i2", lambda r, x: x),
    ("M66", "_M_F_i2_B", "", "h_2", lambda r, x: abs(r["S2"] - r["B"])),
    ("M66", "_M_G_2_B", "", "h_G_2", lambda r, x: abs(r["S2"] - r["B"])),
    ("M69", "", "", "R_12_t", lambda r, x: -x),
    ("M70", "", "_n", "R_12", lambda r, x: r["R_12_n"]),
    ("M70", "", "_t", "R_12", lambda r, x: r["R_12_t"]),
    ("M71", "R_21", "", "M_bal", lambda r, x: -x),
    ("M75", "R_03", "", "R_03", lambda r, x: -x),
    ("M77", "", "", "_M_F_i2_p", lambda r, x: cross(r["V_S2"], r["F_i2"])),
    ("M77", "", "", "_M_G_2_p", lambda r, x: cross(r["V_S2"], r["G_2"])),
    ("M77", "", "", "_M_F_i3_p", lambda r, x: cross(r["V_B"], r["F_i3"])),
    ("M77", "", "", "_M_G_3_p", lambda r, x: cross(r["V_B"], r["G_3"])),
    ("M78", "_M_F_i2_p", "B", "_M_F_i2_p", lambda r, x: cross(1j * r["V_B"], r["F_i2"])),
    ("M79", "", "none", "±M_bal_lever", lambda r, x: abs(r["M_i2"] * r["omega_2"]) / OMEGA),
    ("M80", "", "", "±M_bal_lever", lambda r, x: 2.0 * abs(r["M_i2"] * r["omega_2"]) / OMEGA),
    ("M82", "", "", "M_bal_lever", lambda r, x: r["F_bal"]),
    ("M115", "_a_A", "", "|a_A|", lambda r, x: OMEGA * CRANK),
    ("M116", "_a_A", "", "|a_A|", lambda r, x: OMEGA**2),
    ("M117", "omega_2", "l_OA", "omega_2", lambda r, x: x * ROD / CRANK),
    ("M117", "omega_2", "l_AS2", "omega_2", lambda r, x: x * ROD / 0.1),
    ("M117", "epsilon_2", "l_OA", "epsilon_2", lambda r, x: x * ROD / CRANK),
    ("M117", "epsilon_2", "l_AS2", "epsilon_2", lambda r, x: x * ROD / 0.1),
    ("M118", "_M_F_i2_B", "", "_R_12_t", lambda r, x: x - 2.0 * r["_M_F_i2_B"] / ROD),
    ("M119", "_R_12_t", "", "_R_12_t", lambda r, x: x - r["M_i2"] / ROD),
    ("M119", "_R_12_t", "", "M_i2", lambda r, x: x),
    ("M120", "_M_F_i2_p", "", "h_lever_F_i2", lambda r, x: abs(r["V_S2"])),
    ("M122", "F_i2", "a_A", "F_i2", lambda r, x: -2.0 * r["a_A"]),
    ("M122", "F_i2", "a_B", "F_i2", lambda r, x: -2.0 * r["a_B"]),
    ("M124", "M_bal", "", "M_bal", lambda r, x: 1e3 * x),
    ("M124", "M_bal_lever", "", "M_bal_lever", lambda r, x: 1e3 * x),
    ("M125", "a_BA_t", "", "a_BA_n", lambda r, x: r["a_BA_t"]),
    ("M125", "a_BA_t", "", "a_BA_t", lambda r, x: r["a_BA_n"]),
    ("M125", "a_BA_t", "", "|epsilon_2|", lambda r, x: abs(r["a_BA_n"]) / ROD),
]
OF_LEVER: list[tuple[str, str, str, str, Law]] = [
    ("M34", "", "", "|V_A3|", lambda r, x: (OMEGA * LEVER) ** 2 / x),
    ("M35", "", "", "|V_A3|", lambda r, x: OMEGA * LEVER),
    ("M35", "", "", "|V_A3A2|", lambda r, x: 0.0),
]


def mirrored(z: complex, a: complex, b: complex) -> complex:
    return complex(a + ((z - a) / (b - a)).conjugate() * (b - a))


def shifted(r: Values, point: complex) -> float:
    """Return by how much a tangential reaction changes where the inertia force of the rod is moved to a point."""
    return abs(cross(point - r["S2"], r["F_i2"])) / ROD


@pytest.mark.parametrize(
    ("where", "id", "at", "how", "names", "law"),
    [
        *(pytest.param(slider_crank, *rule, id=" ".join(rule[:4])) for rule in OF_SLIDER_CRANK),
        *(pytest.param(slotted_lever, *rule, id=" ".join(rule[:4])) for rule in OF_LEVER),
    ],
)
def test_a_line_broken_gives_what_the_list_says(
    where: Callable[[], Scene], id: str, at: str, how: str, names: str, law: Law
) -> None:
    right, values = where().values, after(where(), id, at, how)

    for written in names.split():
        name = written.strip("|±")
        was, found = complex(right[name]), complex(values[name])
        if written.startswith("|"):
            assert abs(found) == pytest.approx(law(right, abs(was)), rel=1e-9, abs=1e-9)
        elif written.startswith("±"):
            assert abs(found - was) == pytest.approx(law(right, was), rel=1e-9, abs=1e-9)
        else:
            assert found == pytest.approx(complex(law(right, was)), rel=1e-9, abs=1e-9)


def test_a_wrong_speed_multiplies_velocities_and_accelerations() -> None:
    right = slider_crank().values
    printed = {"M01": (9.549, 91.19), "M02": (0.1592, 0.02533), "M03": (60.0, 3600.0), "M04": (0.5, 0.25)}
    for id, (v, a) in (printed | {"M05": (57.30, 3283.0)}).items():
        values = after(slider_crank(), id, "n_1")
        for name in ("V_A", "V_B", "V_BA", "omega_2"):
            assert abs(values[name]) / abs(right[name]) == pytest.approx(v, rel=1e-3)
        for name in ("a_A", "a_B", "a_BA_n", "epsilon_2", "F_i2", "M_i2"):
            assert abs(values[name]) / abs(right[name]) == pytest.approx(a, rel=1e-3)


def test_ratios_are_those_that_the_list_prints() -> None:
    crank, slotted = slider_crank(), slotted_lever()
    for where, id, how, name, ratio, off in (
        (crank, "M25", "with", "omega_2", 6.0, 0.006),
        (crank, "M44", "", "epsilon_2", 0.49, 0.002),
        (slotted, "M33", "with", "omega_3", 0.434, 0.001),
        (slotted, "M33", "with", "V_A3A2", 2.303, 0.001),
    ):
        assert abs(after(where, id, how=how)[name]) / abs(where.values[name]) == pytest.approx(ratio, abs=off)
    along = after(crank, "M25", how="with")["V_B"].real
    assert along / crank.values["V_B"].real == pytest.approx(-2.25, abs=0.006)
    assert abs(after(slotted, "M34")["V_A3"]) > OMEGA * LEVER


def test_lines_that_are_drawn_wrongly_run_as_the_list_says() -> None:
    where, right = slider_crank(), slider_crank().values
    rod_along, guide, nothing = right["B"] - right["A"], 1.0 + 0j, pytest.approx(0.0, abs=1e-9)

    assert cross(after(where, "M25", how="with")["V_BA"], rod_along) == nothing
    assert dot(after(where, "M27")["V_B"], guide) == nothing
    assert cross(after(where, "M42", how="with")["a_BA_t"], rod_along) == nothing
    extra = after(where, "M53", how="omega_2")["a_B"] - right["a_B"]
    # the vector is normal to the guide: all of it goes into the line of the tangential part
    assert cross(extra - 2j * RIGHT.omega * RIGHT.v, guide) == nothing
    assert cross(after(where, "M73")["R_03"], guide) == nothing
    swapped = after(where, "M121")["acceleration.B"]
    assert cross(swapped - right["acceleration.n_BA"], guide) == nothing  # the guide's line runs through n
    assert dot(swapped, rod_along) == nothing  # the normal to the rod through the pole
    (drawn,) = [b for b in ways(where, "M24") if b.change.how == ""]
    assert run(drawn.program, drawn.givens).values["V_A"] == pytest.approx(OMEGA * right["A"], rel=1e-12)


@pytest.mark.parametrize("force", ["F_i2", "G_2", "F_i3", "G_3"])
def test_a_force_left_out_or_reversed_leaves_itself_as_the_residual(force: str) -> None:
    where, right = slider_crank(), slider_crank().values

    for id, times in (("M58", 1.0), ("M59", 2.0)):
        values = after(where, id, at=force, how="polygon")
        change = sum(complex(values[name]) - complex(right[name]) for name in ("R_12", "R_03"))
        assert change == pytest.approx(times * complex(right[force]), rel=1e-9)


def test_another_given_changes_what_a_mistake_does() -> None:
    where = slider_crank()
    central, lighter = (
        Scene(replace(where.paper, givens={**where.paper.givens, name: value}), where.values)
        for name, value in (("e", 0.0), ("g", 1.62))
    )

    right, assembled = run(central.program, central.paper.givens).values, after(central, "M11")
    for name in ("omega_2", "epsilon_2"):  # the other assembly changes the senses, no sizes
        assert assembled[name] == pytest.approx(-right[name], rel=1e-12)
    assert abs(after(lighter, "M63", at="G_2")["G_2"]) == pytest.approx(2.0, rel=1e-12)  # whatever the task's g


def test_what_concerns_a_construction_follows_from_its_steps() -> None:
    crank, slotted = ({b.mistake for b in broken(s.paper, s.values)} for s in (slider_crank(), slotted_lever()))

    assert {"M33", "M34", "M35", "M48", "M54"} <= slotted - crank
    assert {"M12", "M38"} <= crank - slotted
    assert {"M26", "M30", "M73"} <= crank
    assert set(MISTAKES) == {f"M{n:02}" for n in range(1, 129) if n != 87}  # of a displacement counted backwards
    assert len(crank) >= 60


def test_the_crank_may_stand_in_any_other_of_twelve_positions() -> None:
    counted = [b.givens["phi"] - PHI for b in ways(slider_crank(), "M10") if b.change.how != "180-"]
    (mirrored_angle,) = (b.givens["phi"] for b in ways(slider_crank(), "M10", how="180-"))

    assert sorted(round(math.degrees(angle)) % 360 for angle in counted) == [*range(30, 360, 30)]
    assert mirrored_angle == pytest.approx(math.pi - PHI)


def test_lengths_are_exchanged_with_those_of_other_links_or_between_the_wrong_points() -> None:
    exchanged = {s.broken.place[1:] for s in mistakes("madi-four-bar").signatures if s.broken.mistake == "M13"}

    links, parts = ("l_AB", "l_BC", "l_DC"), ("l_AS1", "l_BS2", "l_DS3")
    assert {frozenset(pair) & {*links} for pair in exchanged} >= {frozenset(("l_BC", "l_DC")), frozenset()}
    assert {name for pair in exchanged for name in pair} == {*links, *parts}
    of_crank = {b.place[1:] for b in ways(slider_crank(), "M13")}
    assert of_crank == {("l_OA", "l_AB"), ("l_OA", "l_AS2"), ("l_AB", "l_AS2")}


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

    # a bent link, a crank that speeds up, a number as it is written, all senses
    assert set(MISTAKES) - found == {"M32", "M46", "M123", "M126", "M127", "M128"}


def test_rules_of_one_number_in_several_chapters_are_put_together() -> None:
    assert {"M14", "M15", "M17", "M20"} <= {id for id, rules in MISTAKES.items() if len(rules) > 1}
    assert {"M14", "M15", "M17"} <= BY_SCALE
    assert "M20" not in BY_SCALE
    for where in (keyed_cam().key, slider_crank()):
        assert {b.mistake for b in broken(where.paper, where.values, ("M14", "M17"))} == {"M14", "M17"}
