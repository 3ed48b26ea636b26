"""Positions in which something vanishes, coincides, is parallel or out of reach, and what is to be said of each."""

from __future__ import annotations

import math
from dataclasses import replace

from mpmath import mp, mpf

from kulman.plans.linkages.mechanism import Link, Load
from kulman.tests.linkages.test_dyads_special import FOUR_BAR, SCOTCH_YOKE, VALUES
from kulman.tests.linkages.test_triad_following import BENT, DEAD
from kulman.tests.support.mechanisms import general_slider_crank, nau_values, twin, twin_values
from kulman.tests.support.special_position import (
    EVERYTHING,
    NOWHERE,
    PI,
    RIGHT,
    STRAIGHT,
    Case,
    bars,
    concurrent,
    crank,
    hydraulic,
    slot,
    tangent,
    triad,
    yoke,
)

WEIGHTLESS = replace(FOUR_BAR, links=(*FOUR_BAR.links[:2], Link(3, FOUR_BAR.links[2].points)))
ROD_UPRIGHT = ("singular-velocity", {"point": "B", "first": "⊥AB", "second": "∥x–x"})
IN_LINE = ("singular-velocity", {"point": "B", "first": "⊥AB", "second": "⊥CB"})
PLAIN_ZEROS = ("x_O", "y_O", "x_g", "y_g", "e", "m_1", "F_1", "F_C", "F_B", "alpha_F1", "alpha_FC", "alpha_FB")
OBLIQUE = {**nau_values(), **dict.fromkeys(PLAIN_ZEROS, 0.0), "gamma": 0.7, "l_AC": 0.1}
MOTION = ("V_B", "a_B", "R_12", "M_bal")
OMEGA = 765 * PI / 30
EQUAL = {"l_OA": 0.07, "l_AB": 0.31, "l_CB": 0.07, "l_OC": 0.31}

CASES: tuple[Case, ...] = (
    # dead positions of the slider: crank and rod in line
    crank("outer dead position", "ok", {"phi": 0.0}, limits={"V_B": 0.0, "omega_2": -OMEGA * 5 / 13, "M_bal": 0.0}),
    crank("inner dead position", "ok", {"phi": PI}, exact=STRAIGHT, limits={"V_B": 0.0, "omega_2": OMEGA * 5 / 13}),
    Case(
        "dead position on an oblique guide",
        general_slider_crank(),
        {**OBLIQUE, "phi": 0.7},
        "ok",
        limits={"V_B": 0.0, "epsilon_2": 0.0, "R_12_t": 0.0},
    ),
    crank("crank across the guide", "ok", {"phi": PI / 2}, exact=RIGHT, limits={"V_BA": 0.0, "a_BA_n": 0.0}),
    Case(
        "force on the rod through B has no arm about it",
        general_slider_crank(),
        {**OBLIQUE, "phi": 0.7, "F_C": 10.0, "alpha_FC": 0.7},
        "ok",
        limits={"h_F_C": 0.0, "R_12_t": 0.0},
    ),
    Case(
        "offset of the guide that is next to nothing",
        general_slider_crank(),
        {**OBLIQUE, "phi": 0.7, "e": 1e-18},
        "ok",
        limits={"V_B": 0.0},
    ),
    # the rod normal to the guide
    crank(
        "rod shorter than the crank, normal to the guide",
        "singular",
        {"l_OA": 0.1, "l_AB": 0.05, "phi": PI / 6},
        exact={"phi": lambda: mp.pi / 6},
        says=ROD_UPRIGHT,
        lost=MOTION,
        kept=("B", "S2", "V_A", "a_A", "F_3"),
        limits={"V_B": NOWHERE, "omega_2": NOWHERE},
    ),
    crank(
        "rod as long as the crank, both upright",
        "singular",
        {"l_AB": 0.05, "phi": PI / 2},
        exact=RIGHT,
        says=ROD_UPRIGHT,
        lost=MOTION,
        kept=("B",),
        limits={"V_B": NOWHERE, "a_BA_n": OMEGA**2 * 0.05},
        hidden=("a_BA_n", "a_BA", "a_S2", "F_i2"),
    ),
    crank("rod as long as the crank, elsewhere", "ok", {"l_AB": 0.05, "phi": PI / 6}, exact={"phi": lambda: mp.pi / 6}),
    crank("rod as long as the crank, stretched", "ok", {"l_AB": 0.05, "phi": 0.0}, limits={"V_B": 0.0}),
    crank("rod as long as the crank, folded", "ok", {"l_AB": 0.05, "phi": PI, "side": "right"}, exact=STRAIGHT),
    crank("rod longer by 1e-8 of itself", "ill-conditioned", {"l_AB": 0.05 * (1 + 1e-8), "phi": PI / 2}),
    crank("rod longer by 1e-14 of itself", "ill-conditioned", {"l_AB": 0.05 * (1 + 1e-14), "phi": PI / 2}),
    crank(
        "rod shorter by a unit in the last place", "singular", {"l_AB": 0.05 - 6e-18, "phi": PI / 2}, says=ROD_UPRIGHT
    ),
    crank(
        "rod too short by 1e-9 of itself",
        "no-assembly",
        {"l_AB": 0.05 * (1 - 1e-9), "phi": PI / 2},
        says=("no-assembly-here", {"point": "B", "gap": "5e-08"}),
        lost=("B", *MOTION),
        kept=("A", "V_A", "a_A", "F_3"),
    ),
    crank(
        "rod too short by 1e-15 of itself",
        "no-assembly",
        {"l_AB": 0.05 * (1 - 1e-15), "phi": PI / 2},
        says=("no-assembly-here", {"point": "B", "low": "90", "high": "90"}),
    ),
    # four-bar linkages in line
    bars(
        "stretched: the rocker drives from a dead point",
        "singular",
        {"phi": PI, "l_AB": 0.2},
        exact=STRAIGHT,
        says=IN_LINE,
        lost=("omega_3", *MOTION),
        kept=("B", "V_A", "a_A"),
    ),
    bars("folded", "singular", {"phi": 0.0, "l_AB": 0.4}, says=IN_LINE, lost=MOTION, kept=("B",)),
    bars(
        "sum of two links that rounds, stretched",
        "singular",
        {"phi": PI, "l_AB": 0.17, "l_CB": 0.23},
        exact=STRAIGHT,
        says=IN_LINE,
    ),
    bars(
        "limit of assembly of a double rocker",
        "singular",
        {"l_OA": 0.2, "l_CB": 0.1, "phi": math.acos(0.0075 / 0.12)},
        exact={"phi": lambda: mp.acos(mpf("0.0075") / mpf("0.12"))},
        says=IN_LINE,
        lost=MOTION,
        kept=("B", "S"),
        limits={"omega_2": NOWHERE, "omega_3": NOWHERE},
    ),
    bars(
        "a millionth of a degree beyond that limit",
        "no-assembly",
        {"l_OA": 0.2, "l_CB": 0.1, "phi": math.acos(0.0075 / 0.12) + 1.7e-8},
        says=("no-assembly-here", {"point": "B"}),
        lost=("B", *MOTION),
        kept=("A", "V_A"),
    ),
    bars("Grashof's limit, away from the change point", "ok", {"l_OC": 0.35, "phi": 0.0}),
    bars("Grashof's limit, at the change point", "singular", {"l_OC": 0.35, "phi": PI}, exact=STRAIGHT, says=IN_LINE),
    bars(
        "parallelogram at its change point",
        "singular",
        {"l_AB": 0.3, "l_CB": 0.1, "phi": 0.0},
        says=IN_LINE,
        lost=MOTION,
        kept=("B", "S"),
        limits={"omega_2": NOWHERE, "omega_3": NOWHERE},
    ),
    bars("parallelogram of uneven numbers, folded", "singular", {**EQUAL, "phi": PI}, exact=STRAIGHT, says=IN_LINE),
    bars("anti-parallelogram, folded", "singular", {**EQUAL, "phi": PI, "branch": -1.0}, exact=STRAIGHT, says=IN_LINE),
    bars("parallelogram a millionth of a radian on", "ill-conditioned", {"l_AB": 0.3, "l_CB": 0.1, "phi": 1e-6}),
    bars(
        "parallelogram upright: the coupler does not turn",
        "ok",
        {"l_AB": 0.3, "l_CB": 0.1, "phi": PI / 2},
        exact=RIGHT,
        limits={"omega_2": 0.0, "epsilon_2": 0.0, "V_BA": 0.0},
    ),
    bars(
        "kite, all links in line",
        "singular",
        {"l_AB": 0.1, "l_CB": 0.3, "phi": 0.0},
        says=IN_LINE,
        kept=("B",),
    ),
    bars(
        "kite, pins coincide",
        "singular",
        {"l_OA": 0.3, "l_AB": 0.1, "l_CB": 0.1, "phi": 0.0},
        says=("singular-pins", {"first": "A", "second": "C"}),
        lost=("B", *MOTION),
        kept=("V_A", "a_A"),
    ),
    bars(
        "pins coincide, links unequal",
        "no-assembly",
        {"l_OA": 0.3, "l_AB": 0.1, "phi": 0.0},
        says=("no-assembly-here", {"point": "B", "gap": "100"}),
    ),
    bars("both pivots in one point", "ok", {"l_OC": 0.0, "branch": -1.0}, limits={"omega_3": 10.0}),
    bars("both pivots in one point, links in line", "singular", {"l_OC": 0.0, "l_CB": 0.35}, says=IN_LINE),
    Case(
        "force plan whose unknowns are parallel",
        WEIGHTLESS,
        {**VALUES, "phi": PI, "l_AB": 0.2},
        "singular",
        exact=STRAIGHT,
        says=IN_LINE,
        lost=("R_12_n", "R_12", "R_32", "R_03", "M_bal"),
        kept=("F", "h_F", "R_03_t", "R_12_t", "B"),
        limits={"R_12_n": NOWHERE, "R_12_t": 0.0},
        hidden=("R_03_m", "R_12_m"),
    ),
    # slotted links
    slot(
        "slider at the pivot of its lever",
        "singular",
        {"l_OC": 0.1, "phi": 0.0},
        says=("singular-pins", {"first": "C", "second": "A"}),
        lost=("S", "V_A3", *MOTION[2:]),
        kept=("V_A", "a_A"),
        limits={"omega_3": 5.0, "V_A3A2": 1.0, "a_A3A2_k": 10.0, "V_S": NOWHERE},
        hidden=("V_A3C", "V_A3A2", "V_A3", "omega_3", "omega_2", "a_A3C_n", "a_A3A2_k", "a_A3A2_r", "R_12_n"),
    ),
    slot("slider nearly at the pivot", "ill-conditioned", {"l_OC": 0.1, "phi": 1e-5}),
    slot(
        "no sliding: crank in line with the pivots",
        "ok",
        {"phi": PI},
        exact=STRAIGHT,
        limits={"V_A3A2": 0.0, "a_A3A2_k": 0.0, "omega_3": 2.5},
    ),
    slot(
        "lever at rest: crank across the slot",
        "ok",
        {"phi": math.acos(1 / 3)},
        exact={"phi": lambda: mp.acos(mpf(1) / 3)},
        limits={"omega_3": 0.0, "a_A3A2_k": 0.0, "V_A3": 0.0},
    ),
    slot(
        "offset as large as the way to the pin",
        "singular",
        {"phi": 0.0, "e": 0.2},
        says=("singular-velocity", {"point": "A3", "first": "⊥CA", "second": "∥x–x"}),
        lost=("omega_3", "V_A3", "M_bal"),
        kept=("S", "V_A"),
        hidden=("R_12_t",),
    ),
    slot(
        "offset larger than the way by 1e-9 of it",
        "no-assembly",
        {"phi": 0.0, "e": 0.2 * (1 + 1e-9)},
        says=("no-assembly-here", {"point": "A", "gap": "2e-07"}),
    ),
    # two guides
    yoke("yoke at the end of its stroke", "ok", {"phi": 0.0}, limits={"V_S": 0.0, "a_S": 10.0}),
    yoke("yoke without acceleration", "ok", {"phi": PI / 2}, exact=RIGHT, limits={"a_S": 0.0, "F_i3": 0.0}),
    yoke(
        "slot along the guide",
        "singular",
        {"up": 0.0},
        says=("singular-position", {"point": "S", "first": "∥y–y", "second": "∥x–x"}),
        lost=("S", "V_A3", "R_03"),
        kept=("A", "V_A"),
        hidden=("M_03", "F_i3"),
        along="up",
    ),
    yoke("slot nearly along the guide", "ill-conditioned", {"up": 1e-6}),
    tangent(
        "guides of crank and frame parallel",
        "singular",
        {"gamma": 0.7},
        says=("singular-position", {"point": "B", "first": "∥x–x", "second": "∥y–y"}),
        lost=("B", *MOTION),
        kept=("omega_1", "F"),
        hidden=("M_03",),
        along="gamma",
    ),
    tangent("guides nearly parallel", "ill-conditioned", {"gamma": 0.7 + 1e-6}),
    tangent(
        "parallel guides in one line",
        "singular",
        {"gamma": 0.0, "phi": 0.0, "l_OC": 0.0},
        says=("singular-position", {"point": "B"}),
        lost=("B", "V_B"),
        hidden=("B", "S", "V_B1", "V_B", "a_B", "M_03"),
    ),
    # groups of class III
    triad(
        "legs of a triad parallel: its dead position",
        "singular",
        BENT,
        {"phi": DEAD},
        says=("singular-triad", {"link": 3, "legs": "2, 4, 5"}),
        lost=("D", "V_D", "M_bal"),
        kept=("A", "V_A"),
        hidden=("B", "C", "D", "S3"),
    ),
    Case(
        "legs of a triad meet in one point",
        *concurrent(0.4 + 0.2j),
        "singular",
        says=("singular-triad", {"link": 3, "legs": "2, 4, 5"}),
        lost=("D", "V_D", "R_12", "M_bal"),
        kept=("A", "V_A", "a_A"),
        hidden=EVERYTHING,
    ),
    triad("triad a billionth of a radian before", "ill-conditioned", BENT, {"phi": DEAD - 1e-9}),
    triad(
        "triad a billionth of a radian beyond", "no-assembly", BENT, {"phi": DEAD + 1e-9}, says=("no-way", {"link": 3})
    ),
    triad("two legs of a triad parallel", "ok", BENT, {"phi": 0.2}, limits={"omega_3": 0.0, "epsilon_3": 0.0}),
    triad(
        "special point asked of two parallel legs",
        "singular",
        replace(BENT, starts=(replace(BENT.starts[0], legs=(4, 5)),)),
        {"phi": 0.2},
        says=("singular-position", {"point": "X3", "first": "∥EC", "second": "∥FD"}),
        lost=("X3", "V_D"),
        kept=("B", "C", "D", "S3"),
        hidden=EVERYTHING,
    ),
    # a group that fails leaves what others give
    Case(
        "second rod upright on the same pin",
        twin(False),
        {**twin_values(), "gamma": 0.0, "phi": PI / 2, "gamma_5": 0.0, "e_5": 0.0, "l_4": 0.05},
        "singular",
        says=("singular-velocity", {"point": "D", "first": "⊥AD", "second": "∥y–y"}),
        lost=("V_D", "R_14", "R_05", "R_01", "M_bal"),
        kept=("V_B", "a_B", "R_12", "R_03", "D"),
        hidden=("a_DA_n", "a_DA", "a_S4", "F_i4"),
        exact=RIGHT,
    ),
    # a driver that slides
    hydraulic(
        "piston at its stop",
        "singular",
        100,
        says=IN_LINE,
        lost=("V_B", "omega_3", "F_bal"),
        kept=("B", "D", "V_A"),
        limits={"omega_3": NOWHERE},
    ),
    hydraulic("piston a nanometre beyond", "no-assembly", 100 - 1e-6, says=("no-assembly-slide", {"point": "B"})),
    hydraulic("piston a nanometre before", "ill-conditioned", 100 + 1e-6),
    # loads without a direction
    Case(
        "force that resists a yoke at rest",
        replace(SCOTCH_YOKE, loads=(Load("F", 3, "S", "F"),)),
        {**VALUES, "phi": 0.0},
        "ok",
        limits={"V_S": 0.0},
        kept=("F", "R_03", "M_bal"),
        exact={"up": lambda: mp.pi / 2},
    ),
)
