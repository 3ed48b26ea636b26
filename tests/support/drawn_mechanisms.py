"""Slider-crank, four-bar and shaper drawn by a student: position, velocities, accelerations, forces, lever.

Givens are plain SI numbers (`phi` in degrees, `n_1` rpm, `turn` the sense of the crank). Each function follows the
steps of a textbook with whatever the student has written so far.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from .drawn_by_hand import Sheet, lever_arm, lever_couple, moment_sum, opposite, reaction, tangential, turn

Givens = dict[str, float]
Force = tuple[str, complex]  # name, where it acts on the plan of positions, mm


def driver(sheet: Sheet, g: Givens, pin: str) -> tuple[complex, complex, complex]:
    """Return the pin of the crank on the plans of positions, velocities and accelerations."""
    hand, length = sheet.hand, g["crank"]
    factors = {"M01": 1.0, "M02": 1.0 / 60.0, "M03": 2.0 * math.pi, "M04": math.pi / 60.0, "M05": 6.0}
    factor = next((factors[s.id] for s in sheet.slips if s.id in factors), math.pi / 30.0)
    omega = sheet.write("omega_1", g["n_1"] * factor * g["turn"])
    A = hand.lay(
        0j, complex(math.cos(math.radians(g["phi"])), math.sin(math.radians(g["phi"]))), length / sheet.mu("mu_l")
    )
    speed = abs(omega) * length
    normal = 1j * A * g["turn"] * (-1.0 if sheet.slip("M23") else 1.0)
    if wrong := sheet.slip("M24"):
        normal = A if wrong.way == "out" else -A
    sheet.calculated(f"V_{pin}", "velocity", speed, normal)
    a = hand.lay(0j, normal, sheet.size(f"V_{pin}") / sheet.mu("velocity"))
    square = abs(omega) * length if sheet.slip("M115", f"a_{pin}") else omega * omega * length
    square = omega * omega if sheet.slip("M116", f"a_{pin}") else square
    inward = A if sheet.slip("M37") else -A
    sheet.calculated(f"a_{pin}", "acceleration", square, inward)
    return A, a, hand.lay(0j, inward, sheet.size(f"a_{pin}") / sheet.mu("acceleration"))


def slider_crank(sheet: Sheet, g: Givens) -> Sheet:
    """Crank OA, rod AB with S2, slider B on the x axis."""
    hand, mu_l = sheet.hand, sheet.mu("mu_l")
    A, a, a1 = driver(sheet, g, "A")
    B = hand.arc(A, g["l_AB"] / mu_l, 0j, 1, round(g["side"]))
    AB, rod = B - A, g["l_AB"]
    part = g["l_AS2"] / rod
    S2 = hand.lay(A, AB, g["l_AS2"] / mu_l)

    b = sheet.meet("velocity", "V_BA", a, AB, 0j, 1)
    _swap_read(sheet, "velocity", ("V_BA", a, b), ("V_B", 0j, b))
    s2 = sheet.divided("velocity", "V_S2", a, b, part)
    sheet.read("V_S2", "velocity", 0j, s2)
    omega = sheet.rate("omega_2", "V_BA", rod, abs(AB), turn(AB, b - a))

    n = sheet.normal("a_BA_n", "V_BA", rod, omega, abs(AB))
    sheet.calculated("a_BA_n", "acceleration", n, AB * sheet.outward("a_BA_n"))
    end = hand.lay(a1, AB * sheet.outward("a_BA_n"), sheet.size("a_BA_n") / sheet.mu("acceleration"))
    k = 0j
    if sheet.slip("M53"):
        k = hand.lay(
            0j, 1j * b * math.copysign(1.0, omega), 2 * abs(omega) * sheet.size("V_B") / sheet.mu("acceleration")
        )
    b1 = sheet.meet("acceleration", "a_BA_t", end, AB, k, 1)
    sheet.read("a_BA_t", "acceleration", end, b1)
    sheet.read("a_BA", "acceleration", a1, b1)
    sheet.read("a_B", "acceleration", 0j, b1)
    s2_ = sheet.divided("acceleration", "a_S2", a1, b1, part)
    sheet.read("a_S2", "acceleration", 0j, s2_)
    epsilon = sheet.rate("epsilon_2", "a_BA_t", rod, abs(AB), turn(AB, b1 - end))

    along = -1.0 if sheet.slip("M65") else 1.0
    sheet.write("F_3", g["F_3"], None, complex(g["press"] * along))
    F_i2 = sheet.inertia("F_i2", g["m_2"], "a_S2")
    sheet.write("M_i2", -g["J_S2"] * epsilon * (4.0 if sheet.slip("M61") else 1.0))
    sheet.inertia("F_i3", g["m_3"], "a_B")
    for name in ("F_3", "F_i2", "F_i3"):
        sheet.on_paper(name, "mu_F_23")
    _group_of_rod(sheet, g, (A, B, _acts(sheet, "F_i2", S2, A, B)), F_i2)
    _input(sheet, A, [("R_21", A)], "h_21")

    M = _lever_of_forces(sheet, [("F_i2", s2, "S2"), ("F_i3", b, "B"), ("F_3", b, "B")], {"S2": s2, "B": b, "A": a})
    M += lever_couple(sheet, "M_i2", [("B", b), ("A", a)], AB, rod)
    F = sheet.write("F_bal", M / (sheet.size("V_A") * g["turn"]))
    sheet.write("M_bal_lever", F * (1.0 if sheet.slip("M82") else g["crank"]))
    return sheet


def _swap_read(
    sheet: Sheet, plan: str, relative: tuple[str, complex, complex], whole: tuple[str, complex, complex]
) -> None:
    """Read a relative and an absolute velocity, each for the other where they are mixed up."""
    if sheet.slip("M21"):
        relative, whole = (relative[0], *whole[1:]), (whole[0], *relative[1:])
    sheet.read(relative[0], plan, *relative[1:])
    sheet.read(whole[0], plan, *whole[1:])


def _acts(sheet: Sheet, name: str, at: complex, first: complex, second: complex) -> complex:
    """Return where a force of inertia is thought to act."""
    if wrong := sheet.slip("M62", name):
        return {"first": first, "second": second, "middle": (first + second) / 2.0}[wrong.way]
    return at


def _group_of_rod(sheet: Sheet, g: Givens, at: tuple[complex, complex, complex], F_i2: complex) -> None:
    """Draw the force plan of rod and slider."""
    A, B, S2 = at
    hand, plan, rod, AB, mu_l = sheet.hand, "mu_F_23", g["l_AB"], B - A, sheet.mu("mu_l")
    h = sheet.arm("h_2", "mu_l", A if sheet.slip("M67", "h_2") else B, S2, F_i2)
    length = rod / mu_l if sheet.slip("M68", "R_12_t") else rod
    arm = h / mu_l if sheet.slip("M68", "R_12_t") else h
    whole = moment_sum(sheet, "R_12_t", [("F_i2", arm)], ["M_i2"])
    one = hand.lay(0j, (t := tangential(sheet, "R_12_t", whole, length, plan, 1j * AB)), abs(t))
    middle = sheet.chain(plan, one, "F_i2")
    last = sheet.chain(plan, middle, "F_i3", "F_3")
    closing = hand.cross(last, 1 if sheet.slip("M73") else 1j, 0j, AB)
    reaction(sheet, "R_03", plan, last, closing)
    reaction(sheet, "R_12_n", plan, closing, 0j)
    reaction(sheet, "R_12", plan, closing, one)
    reaction(sheet, "R_32", plan, middle, last if sheet.slip("M76") else closing)
    opposite(sheet, "R_21", "R_12", "mu_F_1")
    opposite(sheet, "R_23", "R_32")
    sheet.write("M_03", 0.0)
    sheet.write("h_03", 0.0)


def _input(sheet: Sheet, A: complex, forces: list[Force], arm: str) -> None:
    """Balance the crank by a moment."""
    R_21 = sheet.vector("R_21")
    end = sheet.chain("mu_F_1", 0j, "R_21")
    sheet.read("R_01", "mu_F_1", end, 0j)
    h = sheet.arm(arm, "mu_l", 0j, A, R_21)
    sheet.write("M_bal", -sheet.size("R_21") * h * (1000.0 if sheet.slip("M124") else 1.0))


def _lever_of_forces(sheet: Sheet, forces: list[tuple[str, complex, str]], points: dict[str, complex]) -> float:
    """Return the moments of forces (name, point of the velocity plan, letter) on the lever."""
    whole = 0.0
    for name, at, _ in forces:
        if wrong := sheet.slip("M78", name):
            at = points[wrong.way]
        part = lever_arm(sheet, name, sheet.vector(name), at)
        whole += -part if sheet.slip("M118", f"lever {name}") else part
    return whole


def four_bar(sheet: Sheet, g: Givens) -> Sheet:
    """Crank AB, coupler BC with S2, rocker DC with S3."""
    hand, mu_l = sheet.hand, sheet.mu("mu_l")
    B, b, b1 = driver(sheet, g, "B")
    S1 = hand.lay(0j, B, g["l_AS1"] / mu_l)
    D, BCl, DCl = complex(g["l_AD"] / mu_l), g["l_BC"], g["l_DC"]
    C = hand.arcs(B, BCl / mu_l, D, DCl / mu_l, round(g["side"]))
    BC, DC = C - B, C - D
    S2, S3 = hand.lay(B, BC, g["l_BS2"] / mu_l), hand.lay(D, DC, g["l_DS3"] / mu_l)
    parts = {"S1": g["l_AS1"] / g["crank"], "S2": g["l_BS2"] / BCl, "S3": g["l_DS3"] / DCl}

    s1 = sheet.divided("velocity", "V_S1", 0j, b, parts["S1"])
    sheet.read("V_S1", "velocity", 0j, s1)
    c = sheet.meet("velocity", "V_CB", b, BC, 0j, DC if sheet.slip("M25", "V_C") else 1j * DC)
    _swap_read(sheet, "velocity", ("V_CB", b, c), ("V_C", 0j, c))
    s2, s3 = sheet.divided("velocity", "V_S2", b, c, parts["S2"]), sheet.divided("velocity", "V_S3", 0j, c, parts["S3"])
    sheet.read("V_S2", "velocity", 0j, s2)
    sheet.read("V_S3", "velocity", 0j, s3)
    omega_2 = sheet.rate("omega_2", "V_CB", BCl, abs(BC), turn(BC, c - b))
    omega_3 = sheet.rate("omega_3", "V_C", DCl, abs(DC), turn(DC, c))

    mu = sheet.mu("acceleration")
    s1_ = sheet.divided("acceleration", "a_S1", 0j, b1, parts["S1"])
    sheet.read("a_S1", "acceleration", 0j, s1_)
    ends = []
    for name, of, start, link, length, omega in (
        ("a_CB_n", "V_CB", b1, BC, BCl, omega_2),
        ("a_C_n", "V_C", 0j, DC, DCl, omega_3),
    ):
        along = link * sheet.outward(name)
        sheet.calculated(name, "acceleration", sheet.normal(name, of, length, omega, abs(link)), along)
        ends.append(hand.lay(start, along, sheet.size(name) / mu))
    c1 = sheet.meet("acceleration", "a_CB_t", ends[0], BC, ends[1], 1j * DC)
    sheet.read("a_CB_t", "acceleration", ends[0], c1)
    sheet.read("a_CB", "acceleration", b1, c1)
    sheet.read("a_C_t", "acceleration", ends[1], c1)
    sheet.read("a_C", "acceleration", 0j, c1)
    s2_ = sheet.divided("acceleration", "a_S2", b1, c1, parts["S2"])
    s3_ = sheet.divided("acceleration", "a_S3", 0j, c1, parts["S3"])
    sheet.read("a_S2", "acceleration", 0j, s2_)
    sheet.read("a_S3", "acceleration", 0j, s3_)
    epsilon_2 = sheet.rate("epsilon_2", "a_CB_t", BCl, abs(BC), turn(BC, c1 - ends[0]))
    epsilon_3 = sheet.rate("epsilon_3", "a_C_t", DCl, abs(DC), turn(DC, c1 - ends[1]))

    sheet.write("M_3", g["M_3"] * math.copysign(1.0, omega_3) * (1.0 if sheet.slip("M65") else -1.0))
    for number in (1, 2, 3):
        sheet.inertia(f"F_i{number}", g[f"m_{number}"], f"a_S{number}")
        sheet.on_paper(f"F_i{number}", "mu_F_1" if number == 1 else "mu_F_23")
    J = 4.0 if sheet.slip("M61") else 1.0
    sheet.write("M_i2", -g["J_S2"] * epsilon_2 * J)
    sheet.write("M_i3", -g["J_S3"] * epsilon_3 * J)
    left = sheet.slip("M119")
    terms = [sheet.size(name) for name in ("M_3", "M_i3") if not (left and left.way == name)]
    sheet.write("M_sum", sum(terms))
    _group_of_two(sheet, g, (B, C, D), (_acts(sheet, "F_i2", S2, B, C), _acts(sheet, "F_i3", S3, D, C)))
    _input_by_force(sheet, g, B, S1)

    points = {"S1": s1, "S2": s2, "S3": s3, "B": b, "C": c}
    M = _lever_of_forces(sheet, [("F_i1", s1, "S1"), ("F_i2", s2, "S2"), ("F_i3", s3, "S3")], points)
    M += lever_couple(sheet, "M_i2", [("C", c), ("B", b)], BC, BCl)
    M += lever_couple(sheet, "M_sum", [("C", c)], DC, DCl)
    sheet.write("F_bal_lever", M / (sheet.size("V_B") * g["turn"]))
    return sheet


def _group_of_two(
    sheet: Sheet, g: Givens, joints: tuple[complex, complex, complex], at: tuple[complex, complex]
) -> None:
    """Draw the force plan of coupler and rocker."""
    B, C, D = joints
    hand, plan, mu_l = sheet.hand, "mu_F_23", sheet.mu("mu_l")
    BC, DC, tangent = C - B, C - D, []
    for name, link, force, couple, point, length, other in (
        ("R_12_t", BC, "F_i2", "M_i2", at[0], g["l_BC"], B),
        ("R_03_t", DC, "F_i3", "M_sum", at[1], g["l_DC"], D),
    ):
        arm = "h_" + force[-1]
        h = sheet.arm(arm, "mu_l", other if sheet.slip("M67", arm) else C, point, sheet.vector(force))
        in_mm = mu_l if sheet.slip("M68", name) else 1.0
        whole = moment_sum(sheet, name, [(force, h / in_mm)], [couple])
        tangent.append(tangential(sheet, name, whole, length / in_mm, plan, 1j * link))
    one = hand.lay(0j, tangent[0], abs(tangent[0]))
    parted = sheet.chain(plan, one, "F_i2")
    chained = sheet.chain(plan, parted, "F_i3")
    last = hand.lay(chained, tangent[1], abs(tangent[1]))
    closing = hand.cross(last, DC, 0j, BC)
    reaction(sheet, "R_12_n", plan, closing, 0j)
    reaction(sheet, "R_12", plan, closing, one)
    reaction(sheet, "R_03_n", plan, last, closing)
    reaction(sheet, "R_03", plan, chained, closing)
    reaction(sheet, "R_32", plan, parted, last if sheet.slip("M76") else closing)
    opposite(sheet, "R_21", "R_12", "mu_F_1")
    opposite(sheet, "R_23", "R_32")


def _input_by_force(sheet: Sheet, g: Givens, B: complex, S1: complex) -> None:
    """Balance the crank by a force across it at its pin."""
    hand, plan = sheet.hand, "mu_F_1"
    whole = sheet.size("R_21") * sheet.arm("h_21", "mu_l", 0j, B, sheet.vector("R_21"))
    sheet.write("h_1", 0.0)
    F = sheet.write("F_bal", -whole / g["crank"])
    sheet.on_paper("F_bal", plan)
    sheet.lines["F_bal"].mm = abs(sheet.lines["F_bal"].mm or 0.0)
    end = sheet.chain(plan, 0j, "R_21", "F_i1")
    end = hand.lay(end, 1j * B * math.copysign(1.0, F), abs(F) / sheet.mu(plan))
    sheet.read("R_01", plan, end, 0j)


def shaper(sheet: Sheet, g: Givens) -> Sheet:
    """Crank OA, block A on the slotted lever CD, rod DE, ram E on a guide along the x axis."""
    hand, mu_l = sheet.hand, sheet.mu("mu_l")
    A, a, a1 = driver(sheet, g, "A")
    C = complex(0.0, -g["l_OC"] / mu_l)
    u = (A - C) / abs(A - C)
    CA = sheet.write("l_CA", (mm := hand.length(C, A)) * mu_l, mm)
    sheet.plans["l_CA"] = "mu_l"
    D, S3 = hand.lay(C, u, g["l_CD"] / mu_l), hand.lay(C, u, g["l_CS3"] / mu_l)
    guide = complex(0.0, (0.0 if sheet.slip("M12") else g["y_E"]) / mu_l)
    E = hand.arc(D, g["l_DE"] / mu_l, guide, 1, round(g["side"]))
    DE = E - D
    S4 = hand.lay(D, DE, g["l_DS4"] / mu_l)

    e, points = _shaper_velocities(sheet, g, (a, u, CA, DE, abs(A - C)))
    _shaper_accelerations(sheet, g, (a1, u, CA, DE), points)

    working = e.real < 0.0
    for number, length in ((3, g["l_CD"]), (4, g["l_DE"])):
        m = sheet.write(f"m_{number}", g["q"] * length)
        sheet.write(f"J_S{number}", 0.1 * m * length * length * (4.0 if sheet.slip("M61") else 1.0))
    sheet.write(
        "F_5", g["F_5"] if working or sheet.slip("M65") else 0.0, None, -1 + 0j if sheet.slip("M65") else 1 + 0j
    )
    masses = {3: sheet.size("m_3"), 4: sheet.size("m_4"), 5: g["m_5"]}
    for number, mass in masses.items():
        sheet.inertia(f"F_i{number}", mass, "a_E" if number == 5 else f"a_S{number}")
        sheet.write(f"G_{number}", mass * (1.0 if sheet.slip("M63", f"G_{number}") else 9.81), None, -1j)
        for force in (f"F_i{number}", f"G_{number}"):
            sheet.on_paper(force, "mu_F_23" if number == 3 else "mu_F_45")
    sheet.on_paper("F_5", "mu_F_45")
    for number in (3, 4):
        sheet.write(f"M_i{number}", -sheet.size(f"J_S{number}") * sheet.size(f"epsilon_{number}"))
    _group_of_ram(sheet, g, D, E, _acts(sheet, "F_i4", S4, D, E))
    _group_of_slot(sheet, (A, C, D, _acts(sheet, "F_i3", S3, C, D)), CA)
    _input(sheet, A, [("R_21", A)], "h_21")

    at = {"F_i3": "S3", "G_3": "S3", "F_i4": "S4", "G_4": "S4", "F_i5": "E", "G_5": "E", "F_5": "E"}
    M = _lever_of_forces(sheet, [(name, points[p], p) for name, p in at.items()], points)
    M += lever_couple(sheet, "M_i4", [("E", points["E"]), ("D", points["D"])], DE, g["l_DE"])
    M += lever_couple(sheet, "M_i3", [("A3", points["A3"])], u, CA)
    F = sheet.write("F_bal", M / (sheet.size("V_A") * g["turn"]))
    sheet.write("M_bal_lever", F * (1.0 if sheet.slip("M82") else g["crank"]))
    return sheet


def _shaper_velocities(
    sheet: Sheet, g: Givens, at: tuple[complex, complex, float, complex, float]
) -> tuple[complex, dict[str, complex]]:
    a, u, CA, DE, mm = at
    hand, mu = sheet.hand, sheet.mu("velocity")
    if sheet.slip("M33"):
        a3 = hand.cross(0j, u, a, 1j * u)
    elif sheet.slip("M34"):
        a3 = hand.cross(0j, 1j * u, a, 1j * a)
    elif sheet.slip("M35"):
        a3 = a
    else:
        a3 = hand.cross(0j, 1j * u, a, u)
    sheet.read("V_A3C", "velocity", 0j, a3)
    sheet.read("V_A3A2", "velocity", a, a3)
    sheet.lines["V_A3"] = sheet.lines["V_A3C"]
    sheet.plans["V_A3"] = "velocity"
    omega_3 = sheet.rate("omega_3", "V_A3C", CA, mm, turn(u, a3))
    sheet.write("omega_2", omega_3)
    normal = 1j * u * math.copysign(1.0, omega_3)
    ends = {}
    for point, length in (("D", g["l_CD"]), ("S3", g["l_CS3"])):
        sheet.calculated(f"V_{point}C", "velocity", abs(omega_3) * length, normal)
        ends[point] = hand.lay(0j, normal, sheet.size(f"V_{point}C") / mu)
        sheet.read(f"V_{point}", "velocity", 0j, ends[point])
    d = ends["D"]
    e = sheet.meet("velocity", "V_ED", d, DE, 0j, 1)
    _swap_read(sheet, "velocity", ("V_ED", d, e), ("V_E", 0j, e))
    s4 = sheet.divided("velocity", "V_S4", d, e, g["l_DS4"] / g["l_DE"])
    sheet.read("V_S4", "velocity", 0j, s4)
    sheet.rate("omega_4", "V_ED", g["l_DE"], abs(DE), turn(DE, e - d))
    return e, {**ends, "A": a, "A3": a3, "E": e, "S4": s4}


def _coriolis(sheet: Sheet, slide: complex) -> complex:
    """Write the acceleration of Coriolis down; return it in mm."""
    omega = sheet.size("omega_3")
    size, along = 2.0 * abs(omega) * sheet.size("V_A3A2"), 1j * slide * math.copysign(1.0, omega)
    if sheet.slip("M48"):
        size = 0.0
    if sheet.slip("M49"):
        along = -along
    if sheet.slip("M50"):
        size *= 0.5
    if wrong := sheet.slip("M51"):
        one, other = ("omega_1", "V_A3A2") if wrong.way == "omega" else ("omega_3", "V_A")
        size = 2.0 * abs(sheet.size(one)) * sheet.size(other)
    if sheet.slip("M52"):
        along = slide
    sheet.calculated("a_A3A2_k", "acceleration", size, along)
    return along / abs(along) * sheet.size("a_A3A2_k") / sheet.mu("acceleration") if along else 0j


def _shaper_accelerations(
    sheet: Sheet, g: Givens, at: tuple[complex, complex, float, complex], points: dict[str, complex]
) -> None:
    a1, u, CA, DE = at
    hand, mu, plan = sheet.hand, sheet.mu("acceleration"), "acceleration"
    omega_3 = sheet.size("omega_3")
    n = sheet.normal("a_A3C_n", "V_A3C", CA, omega_3, CA / sheet.mu("mu_l"))
    away = u * sheet.outward("a_A3C_n")
    sheet.calculated("a_A3C_n", plan, n, away)
    end = hand.lay(0j, away, sheet.size("a_A3C_n") / mu)
    k = hand.lay(a1, (slide := _coriolis(sheet, points["A3"] - points["A"])), abs(slide))
    a3 = hand.cross(end, 1j * u, k, u)
    sheet.read("a_A3C_t", plan, end, a3)
    sheet.read("a_A3A2_r", plan, k, a3)
    sheet.read("a_A3", plan, 0j, a3)
    epsilon_3 = sheet.rate("epsilon_3", "a_A3C_t", CA, CA / sheet.mu("mu_l"), turn(u, a3 - end))
    sheet.write("epsilon_2", epsilon_3)
    ends = {}
    for point, length in (("D", g["l_CD"]), ("S3", g["l_CS3"])):
        part, across = f"a_{point}C_n", 1j * u * math.copysign(1.0, epsilon_3)
        sheet.calculated(part, plan, omega_3**2 * length, -u)
        sheet.calculated(f"a_{point}C_t", plan, abs(epsilon_3) * length, across)
        tip = hand.lay(0j, -u, sheet.size(part) / mu)
        ends[point] = hand.lay(tip, across, sheet.size(f"a_{point}C_t") / mu)
        sheet.read(f"a_{point}", plan, 0j, ends[point])
    d = ends["D"]
    along = DE * sheet.outward("a_ED_n")
    n = sheet.normal("a_ED_n", "V_ED", g["l_DE"], sheet.size("omega_4"), abs(DE))
    sheet.calculated("a_ED_n", plan, n, along)
    end = hand.lay(d, along, sheet.size("a_ED_n") / mu)
    e = sheet.meet(plan, "a_ED_t", end, DE, 0j, 1)
    sheet.read("a_ED_t", plan, end, e)
    sheet.read("a_ED", plan, d, e)
    sheet.read("a_E", plan, 0j, e)
    s4 = sheet.divided(plan, "a_S4", d, e, g["l_DS4"] / g["l_DE"])
    sheet.read("a_S4", plan, 0j, s4)
    sheet.rate("epsilon_4", "a_ED_t", g["l_DE"], abs(DE), turn(DE, e - end))


def _group_of_ram(sheet: Sheet, g: Givens, D: complex, E: complex, S4: complex) -> None:
    """Draw the force plan of rod and ram."""
    hand, plan, DE = sheet.hand, "mu_F_45", E - D
    about = D if sheet.slip("M67", "h_4") else E
    arms = [(f, sheet.arm(h, "mu_l", about, S4, sheet.vector(f))) for f, h in (("F_i4", "h_4"), ("G_4", "h_G_4"))]
    in_mm = sheet.mu("mu_l") if sheet.slip("M68", "R_34_t") else 1.0
    whole = moment_sum(sheet, "R_34_t", [(f, h / in_mm) for f, h in arms], ["M_i4"])
    one = hand.lay(0j, (t := tangential(sheet, "R_34_t", whole, g["l_DE"] / in_mm, plan, 1j * DE)), abs(t))
    middle = sheet.chain(plan, one, "F_i4", "G_4")
    last = sheet.chain(plan, middle, "F_i5", "G_5", "F_5")
    closing = hand.cross(last, 1 if sheet.slip("M73") else 1j, 0j, DE)
    reaction(sheet, "R_05", plan, last, closing)
    reaction(sheet, "R_34_n", plan, closing, 0j)
    reaction(sheet, "R_34", plan, closing, one)
    reaction(sheet, "R_54", plan, middle, last if sheet.slip("M76") else closing)
    opposite(sheet, "R_43", "R_34", "mu_F_23")
    opposite(sheet, "R_45", "R_54")
    sheet.write("M_05", 0.0)
    sheet.write("h_05", 0.0)


def _group_of_slot(sheet: Sheet, at: tuple[complex, complex, complex, complex], CA: float) -> None:
    """Find R_12 from the moments about C, and the reaction of the frame."""
    A, C, D, S3 = at
    hand, plan, u = sheet.hand, "mu_F_23", (A - C) / abs(A - C)
    arms = [
        (f, sheet.arm(h, "mu_l", C, p, sheet.vector(f)))
        for f, h, p in (("F_i3", "h_3", S3), ("G_3", "h_G_3", S3), ("R_43", "h_43", D))
    ]
    if sheet.slip("M72"):
        arms = [(f, h) for f, h in arms if f != "R_43"]
    in_mm = sheet.mu("mu_l") if sheet.slip("M68", "R_12_t") else 1.0
    whole = moment_sum(sheet, "R_12_t", [(f, h / in_mm) for f, h in arms], ["M_i3"])
    t = tangential(sheet, "R_12_t", whole, CA / in_mm, plan, -1j * u)
    one = hand.lay(0j, t, abs(t))
    for name in ("R_32", "R_12", "R_23", "R_21"):
        sheet.write(name, sheet.size("R_12_t"), None, t if name in ("R_12", "R_23") else -t)
    if sheet.slip("M71", "R_21"):
        sheet.write("R_21", sheet.size("R_12"), None, t)
    sheet.write("R_12_n", 0.0, 0.0)
    for name in ("R_32", "R_12"):
        sheet.on_paper(name, plan)
    sheet.on_paper("R_21", "mu_F_1")
    sheet.write("M_32", 0.0)
    sheet.write("h_32", 0.0)
    hung = ("F_i3", "G_3") if sheet.slip("M72") else ("F_i3", "G_3", "R_43")
    end = sheet.chain(plan, one, *hung)
    reaction(sheet, "R_03", plan, end, 0j)


MECHANISMS: dict[str, Callable[[Sheet, Givens], Sheet]] = {
    "nau-slider-crank": slider_crank,
    "madi-four-bar": four_bar,
    "scheme-09-shaper": shaper,
}
