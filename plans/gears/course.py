"""One pair of teeth from the start of their contact to its end: where they touch, how they slide, how many pairs do.

Places are distances from N1 along the line of action, rho_1, which is also the radius of curvature of the pinion's
flank there. Velocities are analogues, by the angle of the pinion: its angular velocity times them are velocities.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..columned import Columned, Ends
from ..laws import LAWS
from .meshing import Array
from .solve import SolvedGear

NEAR = 1e-9  # part of the base pitch within which a contact begins or ends
SLIDING = ("theta_12", "theta_21", "v_s")  # of which extremes are told


@dataclass(frozen=True, slots=True)
class Zone:
    """A part of the line of action, from `first` to `last`, rho_1 in m, on which so many `pairs` of teeth touch."""

    first: float
    last: float
    pairs: int

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.last - self.first


def columns(solved: SolvedGear, rho_1: Any) -> list[Columned]:
    """Return the columns at places of the line of action, m: `phi` is zero where the teeth touch in the pole.

    `rho_i` and `r_i` are radii of curvature and distances from the centres, `v_ki` velocities along the profiles, `v_s`
    that of sliding, `theta_..` specific sliding, `pairs` how many pairs of teeth touch.
    """
    sizes, rho_1 = solved.sizes, np.asarray(rho_1, float)
    u, r_b1 = sizes["u"], 0.5 * sizes["d_b1"]
    rho_2 = LAWS["excess"](sizes["l_N1N2"], rho_1)
    v_k2 = LAWS["at_ratio"](rho_2, u)
    found = [
        Columned("phi", "rad", LAWS["contact_angle"](rho_1, sizes["rho_w1"], r_b1)),
        Columned("rho_1", "m", rho_1),
        Columned("rho_2", "m", rho_2),
    ]
    for i, rho in ((1, rho_1), (2, rho_2)):
        found.append(Columned(f"r_{i}", "m", LAWS["half_of"](LAWS["diameter_of_curvature"](rho, sizes[f"d_b{i}"]))))
    found += [Columned("v_k1", "m", rho_1), Columned("v_k2", "m", v_k2)]
    found.append(Columned("v_s", "m", LAWS["excess"](rho_1, v_k2)))
    found.append(Columned("theta_12", "1", LAWS["sliding_of_pinion"](rho_1, rho_2, u)))
    found.append(Columned("theta_21", "1", LAWS["sliding_of_wheel"](rho_2, rho_1, u)))
    return [*found, Columned("pairs", "1", pairs(solved, rho_1))]


def pairs(solved: SolvedGear, rho_1: Array) -> Array:
    """Return how many pairs of teeth touch when one of them does so at these places."""
    first, last = solved.meshing.touching
    pitch = solved.sizes["p_b"]
    after, before = (np.floor(way / pitch + NEAR) for way in (last - rho_1, rho_1 - first))
    return np.asarray(after + before + 1.0)


def zones(solved: SolvedGear) -> list[Zone]:
    """Return the parts of the line of action by how many pairs touch, from start to end."""
    first, last = solved.meshing.touching
    pitch = solved.sizes["p_b"]
    most = math.floor((last - first) / pitch + NEAR)
    ends = [first + k * pitch for k in range(most + 1)] + [last - k * pitch for k in range(most + 1)]
    places = [first]
    for place in sorted(ends):
        if place - places[-1] > NEAR * pitch:
            places.append(place)
    middles = 0.5 * (np.array(places[:-1]) + np.array(places[1:]))
    counts = pairs(solved, middles).astype(int).tolist()
    return [Zone(a, b, n) for a, b, n in zip(places, places[1:], counts, strict=False)]


def marks(solved: SolvedGear) -> dict[str, float]:
    """Return places on the line of action by their letters, in order: ends, the pole, where one pair alone touches.

    Teeth that are undercut or pointed touch from `start` to `end`, inside of A1A2.
    """
    first, last = solved.meshing.touching
    sizes, pitch = solved.sizes, solved.sizes["p_b"]
    found = {"P": sizes["rho_w1"]}
    for letter, other, place, tip in (("A1", "start", first, sizes["rho_p1"]), ("A2", "end", last, sizes["rho_a1"])):
        found[letter if abs(place - tip) <= NEAR * pitch else other] = place
    if last - first > pitch:
        found |= {"K1": first + pitch, "K2": last - pitch}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def extremes(solved: SolvedGear) -> list[Ends]:
    """Return the extremes of sliding over the contact: it changes in one sense, so that they are at the ends."""
    at = np.array(solved.meshing.touching)
    by_name = {column.name: column for column in columns(solved, at)}
    phi = by_name["phi"].values
    found = []
    for name in SLIDING:
        values = by_name[name].values
        most, least = int(np.argmax(values)), int(np.argmin(values))
        found.append(
            Ends(
                name,
                by_name[name].unit,
                float(values[most]),
                float(phi[most]),
                float(values[least]),
                float(phi[least]),
            )
        )
    return found
