"""One pair of teeth from the start of their contact to its end: where they touch, how they slide, how many pairs do.

Places are distances from N1 along the line of action, rho_1, which is also the radius of curvature of the pinion's
flank there. Velocities are analogues, by the angle of the pinion: its angular velocity times them are velocities. What
figures show beside marks is here, too, densely: curves of specific sliding, and the rack that cuts the pinion.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..laws import LAWS
from ..solved import Columned, Course, Ends, Rows
from .solve import SolvedGear
from .teeth import Array, Wheel

MANY, CUT = 200, math.radians(0.05)  # points of flanks and fillets of a wheel to be cut; between those of its arcs
NEAR = 1e-9  # part of the base pitch within which a contact begins or ends


class _Zone(NamedTuple):
    """A part of the line of action, from `first` to `last`, rho_1 in m, on which so many `pairs` of teeth touch."""

    first: float
    last: float
    pairs: int


class GearCourse(Course):
    """A pair over the contact of one pair of teeth: places divide the active line evenly, its ends among them."""

    usual = 101  # every hundredth of the active line

    def __init__(self, solved: SolvedGear) -> None:
        self.solved, self.sizes, self.pitch = solved, solved.sizes, solved.sizes["p_b"]
        self.first, self.last = solved.meshing.touching

    def places(self, count: int) -> Array:
        """Return so many places on the line of action."""
        return np.linspace(self.first, self.last, count)

    def columns(self, places: Any) -> list[Columned]:
        """Return the columns at places of the line of action, m: `phi` is zero where the teeth touch in the pole.

        `rho_i` and `r_i` are radii of curvature and distances from the centres, `v_ki` velocities along the profiles,
        `v_s` that of sliding, `theta_..` specific sliding, `pairs` how many pairs of teeth touch.
        """
        return [Columned(*column) for column in self._table(np.asarray(places, float))]

    def formulas(self, given: Callable[[str], Any]) -> dict[str, Any]:
        """Return the columns, directions of the wheels' teeth, and where this pair and its neighbours touch."""
        rho_1, meshing = given("rho_1"), self.solved.meshing
        found = {name: value for name, _, value in self._table(rho_1)}
        for i, side, turned in zip((1, 2), (1j, -1j), meshing.turned(found["phi"]), strict=True):
            found[f"turn_{i}"] = (np.cos(turned) + 1j * np.sin(turned)) * side
        return found | {f"action.K{n}": meshing.place(rho_1 + n * self.pitch) for n in self.neighbours}

    def _table(self, rho_1: Any) -> list[tuple[str, str, Any]]:
        """Return names, units and values of the columns."""
        sizes = self.sizes
        u, rho_2 = sizes["u"], LAWS["excess"](sizes["l_N1N2"], rho_1)
        v_k2 = LAWS["at_ratio"](rho_2, u)
        r_1, r_2 = (
            LAWS["half_of"](LAWS["diameter_of_curvature"](rho, sizes[name]))
            for rho, name in ((rho_1, "d_b1"), (rho_2, "d_b2"))
        )
        lengths = {"rho_1": rho_1, "rho_2": rho_2, "r_1": r_1, "r_2": r_2, "v_k1": rho_1, "v_k2": v_k2}
        lengths["v_s"] = LAWS["excess"](rho_1, v_k2)
        return [
            ("phi", "rad", LAWS["contact_angle"](rho_1, sizes["rho_w1"], 0.5 * sizes["d_b1"])),
            *((name, "m", length) for name, length in lengths.items()),
            ("theta_12", "1", LAWS["sliding_of_pinion"](rho_1, rho_2, u)),
            ("theta_21", "1", LAWS["sliding_of_wheel"](rho_2, rho_1, u)),
            ("pairs", "1", self.pairs(rho_1)),
        ]

    def outlines(self) -> dict[str, Any]:
        """Return both wheels, a tooth of each on the x axis."""
        teeth = enumerate(self.solved.meshing.teeth, start=1)
        return {f"wheel_{i}": tooth.teeth(round(tooth.z), MANY, CUT)[:-1] for i, tooth in teeth}

    def pairs(self, rho_1: Any) -> Any:
        """Return how many pairs of teeth touch when one of them does so at these places."""
        ways = (self.last - rho_1, rho_1 - self.first)
        return sum(np.floor(way / self.pitch + NEAR) for way in ways) + 1.0

    @property
    def neighbours(self) -> range:
        """The pairs of teeth that may touch together with one, by how many pitches they are before it."""
        most = math.floor((self.last - self.first) / self.pitch + NEAR)
        return range(-most, most + 1)

    @property
    def zones(self) -> list[_Zone]:
        """The parts of the line of action by how many pairs touch, from start to end."""
        first, last, pitch = self.first, self.last, self.pitch
        steps = pitch * np.arange(math.floor((last - first) / pitch + NEAR) + 1)
        places = [first]
        for place in sorted((first + steps).tolist() + (last - steps).tolist()):
            if place - places[-1] > NEAR * pitch:
                places.append(place)
        middles = 0.5 * (np.array(places[:-1]) + np.array(places[1:]))
        return [_Zone(a, b, int(n)) for (a, b), n in zip(pairwise(places), self.pairs(middles), strict=True)]

    @property
    def marks(self) -> dict[str, float]:
        """Places on the line of action by their letters, in order: ends, the pole, where one pair alone touches.

        Teeth that are undercut or pointed touch from `start` to `end`, inside of A1A2.
        """
        first, last, sizes = self.first, self.last, self.sizes
        found = {"P": sizes["rho_w1"]}
        for letter, other, place, tip in (("A1", "start", first, "rho_p1"), ("A2", "end", last, "rho_a1")):
            found[letter if abs(place - sizes[tip]) <= NEAR * self.pitch else other] = place
        if last - first > self.pitch:
            found |= {"K1": first + self.pitch, "K2": last - self.pitch}
        return dict(sorted(found.items(), key=lambda item: item[1]))

    def rows(self, count: int | None) -> Rows:
        """Return so many places, without a number the marks of the meshing."""
        known = self.marks
        return super().rows(count) if count is not None else (list(known), self.columns(list(known.values())))

    def extremes(self) -> list[Ends]:
        """Return the extremes of sliding: it changes in one sense, so that they are at the ends of the contact."""
        by_name = {column.name: column for column in self.columns([self.first, self.last])}
        phi, found = by_name["phi"].values, []
        for name in ("theta_12", "theta_21", "v_s"):
            values = by_name[name].values
            places = (int(np.argmax(values)), int(np.argmin(values)))
            most, most_at, least, least_at = (float(of[at]) for at in places for of in (values, phi))
            found.append(Ends(name, by_name[name].unit, most, most_at, least, least_at))
        return found

    def remarks(self) -> Iterator[tuple[str, Mapping[str, Any]]]:
        """Say on which zones how many pairs of teeth touch."""
        for first, last, pairs in self.zones:
            yield (
                "sweep.zone",
                {"first": (first, "m"), "last": (last, "m"), "length": (last - first, "m"), "pairs": pairs},
            )

    def data(self, places: Any) -> dict[str, Any]:
        """Return marks of the contact, and where how many pairs touch."""
        return {"marks": self.marks, "zones": [{"from": a, "to": b, "pairs": pairs} for a, b, pairs in self.zones]}


Curve = list[tuple[float, float]]
PLACES = 240  # of a curve
SLIDING = {1: "sliding_of_pinion", 2: "sliding_of_wheel"}
CORNER = 12  # points of a corner of the rack
NEIGHBOURS = (-1, 0, 1)  # teeth of the rack, in pitches from the one in the middle
TO_POLE = cmath.rect(1.0, 0.5 * math.pi)  # from the real axis to the direction from the centre to the pole


def sliding_curve(solved: SolvedGear, i: int, low: float) -> Curve:
    """Return specific sliding of a wheel by rho_1, from where it is cut off on; closely where it is steep."""
    line, u = solved.sizes["l_N1N2"], solved.sizes["u"]
    ratio = u if i == 1 else 1.0 / u
    first = line / (1.0 + ratio * (1.0 - low))  # own curvature there
    own = first * (line / first) ** np.linspace(0.0, 1.0, PLACES)
    own[-1] = line
    theta = LAWS[SLIDING[i]](own, line - own, u)
    return list(zip((own if i == 1 else line - own).tolist(), theta.tolist(), strict=True))


def active_area(solved: SolvedGear, i: int, low: float) -> Curve:
    """Return the outline of the area between a curve, cut off, and the axis over the active line; it may be empty."""
    line = solved.sizes["l_N1N2"]
    first, last = (min(max(float(solved.sizes[name]), 0.0), line) for name in ("rho_p1", "rho_a1"))
    if last <= first:
        return []
    rho_1 = np.linspace(first, last, PLACES)[1:-1]
    own, other = (rho_1, line - rho_1) if i == 1 else (line - rho_1, rho_1)
    theta = np.maximum(LAWS[SLIDING[i]](own, other, solved.sizes["u"]), low)
    return [(first, 0.0), *zip(rho_1.tolist(), theta.tolist(), strict=True), (last, 0.0)]


class Rack:
    """The rack that cuts the pinion, a tooth of it in a space of the pinion, k times as large as it is.

    All points are complex numbers, the pole is the origin.
    """

    def __init__(self, solved: SolvedGear, k: float) -> None:
        self._sizes, tooth = solved.sizes, solved.meshing.teeth[0]
        self.pinion = Wheel(1, tooth, complex(0.0, -tooth.r * k), 1j, TO_POLE, 1, k, solved.sizes)
        self.shift = self._sizes["x_1"] * self._sizes["m"] * k  # how far the middle line lies above the pitch line
        self.down = cmath.rect(1.0, -tooth.alpha)  # the direction of the line of action of cutting
        self.touch = self.down * (tooth.r * math.sin(tooth.alpha) * k)  # N, where that touches the base circle
        self.edge = self.touch - self.down * (self._sizes["rho_l1"] * k)  # B, where the straight edge ends on it
        # the centre of the corner of the last tooth on the left, on its right side
        self.corner = complex(-math.pi * self._sizes["m"] - tooth.e_f, -tooth.h_0) * k

    def outline(self) -> list[complex]:
        """Return the outline of the rack: flanks from its spaces to the round corners of its tips."""
        m, tooth, sizes = self._sizes["m"], self.pinion.tooth, self._sizes
        depth, middle = (sizes["h_a"] + sizes["c"]) * m, sizes["x_1"] * m
        turns = np.linspace(tooth.alpha, 0.5 * math.pi, CORNER)
        corner = complex(tooth.e_f, middle - depth + tooth.rho_f) + tooth.rho_f * (np.cos(turns) - 1j * np.sin(turns))
        top = complex(0.25 * math.pi * m + depth * math.tan(tooth.alpha), middle + depth)
        half = np.concatenate(([top], corner))  # to the right of the centre line, from the root to the tip
        one = np.concatenate((-half.conj(), half[::-1]))
        return [point * self.pinion.k for n in NEIGHBOURS for point in (one + math.pi * m * n).tolist()]
