"""Presses with a group of class III: a crank, a connecting rod, a ternary link, a rocker, and a rocker or a ram."""

from __future__ import annotations

import math
from dataclasses import replace

from kulman.plans.linkages.mechanism import ZERO, Driver, Link, Load, Mechanism, Prismatic, Revolute, Start

ORIGIN = (ZERO, ZERO)


def press(C: tuple[str, str] = ("l_BC", ZERO)) -> Mechanism:
    """Return a press whose central link 3 has the joint C there."""
    return Mechanism(
        (
            Link(1, {"O": ORIGIN, "A": ("l_OA", ZERO)}),
            Link(2, {"A": ORIGIN, "B": ("l_AB", ZERO)}),
            Link(3, {"B": ORIGIN, "C": C, "D": ("x_D", "y_D"), "S3": ("x_S", "y_S")}, "S3", "m_3", "J_S3"),
            Link(4, {"E": ORIGIN, "C": ("l_EC", ZERO)}),
            Link(5, {"F": ORIGIN, "D": ("l_FD", ZERO)}, "D", "m_5"),
        ),
        (
            Revolute("O", (0, 1), ORIGIN),
            *(Revolute(point, links) for point, links in (("A", (1, 2)), ("B", (2, 3)), ("C", (3, 4)), ("D", (3, 5)))),
            Revolute("E", (4, 0), ("x_E", "y_E")),
            Revolute("F", (5, 0), ("x_F", "y_F")),
        ),
        Driver(1, "O", "A", "phi", "n_1", "sense_1"),
        (Load("F_5", 5, "D", "F_5", "alpha"),),
        starts=(Start(3, "x_0", "y_0", "angle_0", "phi_0"),),
    )


PRESS = press()
RAM = replace(
    PRESS,
    links=(*PRESS.links[:4], Link(5, {"D": ORIGIN}, "D", "m_5")),
    pairs=(*PRESS.pairs[:6], Prismatic("D", (5, 0), ("x_G", ZERO), "up")),
)
VALUES = {
    **{"phi": 0.7, "l_OA": 0.1, "l_AB": 0.4, "l_BC": 0.3, "x_D": 0.12, "y_D": 0.2, "l_EC": 0.35, "l_FD": 0.3},
    **{"x_E": 0.75, "y_E": -0.2, "x_F": 0.6, "y_F": 0.5, "n_1": 10.0, "sense_1": 1.0, "F_5": 300.0, "alpha": 1.3},
    **{"x_S": 0.1, "y_S": 0.08, "m_3": 2.0, "J_S3": 0.03, "m_5": 1.5, "x_G": 0.5, "up": math.pi / 2},
    **{"x_0": 0.46, "y_0": 0.1, "angle_0": 0.2, "phi_0": 0.5},
}


RAM_VALUES = {
    **VALUES,
    **{"l_AB": 0.57, "l_BC": 0.266, "x_D": 0.084, "y_D": 0.324, "l_EC": 0.404, "x_G": 0.405},
    **{"x_0": 0.55, "y_0": 0.05, "angle_0": 1.74},
}


def two_presses() -> tuple[Mechanism, dict[str, float]]:
    """Return a press and a second triad, links 6 to 9, between its links 4 and 5 and the frame."""
    links = (
        Link(6, {"C": ORIGIN, "H": ("l_CH", ZERO)}),
        Link(7, {"H": ORIGIN, "I": ("l_HI", ZERO), "K": ("x_K", "y_K")}, "K", "m_3", "J_S3"),
        Link(8, {"M": ORIGIN, "I": ("l_MI", ZERO)}),
        Link(9, {"N": ORIGIN, "K": ("l_NK", ZERO)}),
    )
    pairs = (
        Revolute("C", (4, 6)),
        *(Revolute(point, pair) for point, pair in (("H", (6, 7)), ("I", (7, 8)), ("K", (7, 9)))),
        Revolute("M", (8, 0), ("x_M", "y_M")),
        Revolute("N", (9, 0), ("x_N", "y_N")),
    )
    second = Start(7, "x_1", "y_1", "angle_1", "phi_1")
    of = replace(PRESS, links=(*PRESS.links, *links), pairs=(*PRESS.pairs, *pairs), starts=(*PRESS.starts, second))
    own = {"l_CH": 0.366, "l_HI": 0.396, "x_K": 0.163, "y_K": 0.252, "l_MI": 0.387, "l_NK": 0.479, "x_M": 1.443}
    own |= {"y_M": -0.266, "x_N": 1.495, "y_N": 0.352, "x_1": 1.17, "y_1": -0.24, "angle_1": 0.61, "phi_1": 0.9}
    return of, {**VALUES, **own}
