"""Random gear pairs, their quantities by a second route, strings unwound, lines cut by circles; polygons of teeth.

The second route knows no involute function and no formula of a standard: it makes points of flanks and of the rack, and
looks for what is wanted by halving. All are arrays, one element a pair. Wheels cut by a rack in many steps and pairs of
them in mesh are polygons of another library, in millimetres.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np
import shapely
from shapely.geometry import LineString, Polygon

from kulman.plans.gears.gear import STANDARD
from kulman.plans.gears.teeth import Meshing, _Tooth

SEED = 1765
HALVINGS = 70
MADI = {"m": 5e-3, "z_1": 15.0, "z_2": 20.0, "x_1": 0.2, "x_2": 0.85}
Array = np.ndarray
Function = Callable[[Array], Array]
MM = 1e3


def madi(**others: float) -> dict[str, float]:
    """Return the givens of the project's pair, complete, with others in their place."""
    return {**STANDARD, **MADI, **others}


def contacts(meshing: Meshing, angle: float) -> np.ndarray:
    """Return rho_1 of all pairs that touch at an angle of the pinion, rising."""
    first, last = meshing.touching
    pitch, base = meshing.sizes["p_b"], meshing.sizes["rho_w1"] + meshing.teeth[0].r_b * angle
    return base + pitch * np.arange(math.ceil((first - base) / pitch), math.floor((last - base) / pitch) + 1)


def counted_ratio(meshing: Meshing, steps: int = 1000) -> float:
    """Return how many pairs touch on average over a pitch, counted in equal steps."""
    angles = 2.0 * math.pi / meshing.teeth[0].z * (np.arange(steps) + 0.5) / steps
    return float(np.mean([len(contacts(meshing, float(angle))) for angle in angles]))


def random_pairs(random: np.random.Generator, count: int) -> dict[str, Array]:
    """Return the givens of pairs that mesh without interference, plain and with shifts, cut by various racks."""
    parts: list[dict[str, Array]] = []
    while sum(len(part["m"]) for part in parts) < count:
        pairs = _any_pairs(random, 3 * count)
        parts.append({name: values[_usable(pairs)] for name, values in pairs.items()})
    return {name: np.concatenate([part[name] for part in parts])[:count] for name in parts[0]}


def _any_pairs(random: np.random.Generator, count: int) -> dict[str, Array]:
    plain = random.integers(0, 2, count) == 0
    h_a = np.where(plain, 1.0, random.uniform(0.75, 1.05, count))
    x_1, x_2 = random.uniform(-0.4, 1.2, (2, count))
    x_2 = np.maximum(x_2, -0.3 - x_1)
    z_1, z_2 = random.integers(8, 120, (2, count)).astype(float)
    return {
        "m": random.uniform(0.5e-3, 12e-3, count),
        "z_1": z_1,
        "z_2": z_2,
        "x_1": x_1,
        "x_2": x_2,
        "alpha": np.radians(np.where(plain, 20.0, random.uniform(14.0, 26.0, count))),
        "h_a": h_a,
        "h_l": 2.0 * h_a,
        "c": np.where(plain, 0.25, random.uniform(0.15, 0.3, count)),
        "PW": random.uniform(0.02, 0.08, count),
    }


def _usable(pairs: Mapping[str, Array]) -> Array:
    """Whether teeth are whole and the active line lies between N1 and N2, by the second route."""
    with np.errstate(invalid="ignore", divide="ignore"):
        own = second_route(pairs)
    needed = ("rho_p1", "rho_p2", "s_a1", "s_a2", "g_alpha", "e_1", "e_2", "rho_l1", "rho_l2")
    return np.logical_and.reduce([own[name] > 1e-3 * pairs["m"] for name in needed])


def root(function: Function, low: Array, high: Array) -> Array:
    """Return where functions change their sign between two places; NaN where they do not."""
    below = function(low) < 0.0
    none = (function(high) < 0.0) == below
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = (function(middle) < 0.0) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.where(none, np.nan, 0.5 * (low + high))


def unwound(r_b: Array, t: Array) -> Array:
    """Return the end of a string unwound from a circle by the angle t; it begins on the real axis."""
    return r_b * (np.cos(t) + t * np.sin(t) + 1j * (np.sin(t) - t * np.cos(t)))


class Flank:
    """The flanks of a wheel whose thickness on the reference circle is the width of the rack's space there."""

    def __init__(self, r: Array, alpha: Array, s: Array) -> None:
        self.r_b = abs((r * np.exp(1j * alpha)).real)  # the line through the pole at alpha touches it
        self.base = 0.5 * s / r + self._angle(r)  # half the tooth where the string begins

    def unwinding(self, radius: Array) -> Array:
        """Return by which angle the string is unwound at a radius."""
        return np.sqrt((radius - self.r_b) * (radius + self.r_b)) / self.r_b  # the string is a tangent

    def _angle(self, radius: Array) -> Array:
        return np.angle(unwound(self.r_b, self.unwinding(radius)))

    def half(self, radius: Array) -> Array:
        """Return half the tooth's angle at a radius."""
        return self.base - self._angle(radius)

    def point(self, t: Array) -> Array:
        """Return the point of the upper flank where the string is unwound by t; the tooth on the real axis."""
        return np.conj(unwound(self.r_b, t)) * np.exp(1j * self.base)


def _cut(centre: Array, radius: Array, start: Array, along: Array, sign: float) -> Array:
    """Return how far along a line from its start it cuts a circle: the farther place (+1) or the nearer (-1)."""
    away = np.conj(along) * (start - centre)
    return -away.real + sign * np.sqrt(radius**2 - away.imag**2)


def second_route(pair: Mapping[str, Array]) -> dict[str, Array]:
    """Return quantities of pairs by name, in SI."""
    m, alpha, h_a, h_l, c = (pair[name] for name in ("m", "alpha", "h_a", "h_l", "c"))
    z, x = {i: pair[f"z_{i}"] for i in (1, 2)}, {i: pair[f"x_{i}"] for i in (1, 2)}
    own: dict[str, Array] = {"p": math.pi * m, "u": z[2] / z[1], "x_sum": x[1] + x[2]}
    r = {i: z[i] * own["p"] / (2.0 * math.pi) for i in (1, 2)}
    # the rack's space on the line that rolls on the reference circle: half a pitch where the shift is none
    edge = {i: 0.25 * own["p"] + x[i] * m * np.sin(alpha) / np.cos(alpha) for i in (1, 2)}
    flanks = {i: Flank(r[i], alpha, 2.0 * edge[i]) for i in (1, 2)}
    own["a"] = r[1] + r[2]

    def gap(a: Array) -> Array:
        turn = (flanks[i].half(a * z[i] / (z[1] + z[2])) * z[i] for i in (1, 2))
        return math.pi - sum(turn)  # teeth and spaces of both fill the pitch

    touch = flanks[1].r_b + flanks[2].r_b
    a_w = own["a_w"] = root(gap, touch * (1.0 + 1e-15), touch * 3.0)
    own["alpha_w"] = np.arccos(touch / a_w)
    own["y"] = (a_w - own["a"]) / m
    own["delta_y"] = x[1] + x[2] - own["y"]
    r_w = {i: a_w * z[i] / (z[1] + z[2]) for i in (1, 2)}
    r_f = {i: r[i] - (h_a + c - x[i]) * m for i in (1, 2)}
    r_a = {1: a_w - r_f[2] - c * m, 2: a_w - r_f[1] - c * m}
    own["h"] = r_a[1] - r_f[1]
    for i in (1, 2):
        own |= _of_wheel(i, own["p"], z[i], r[i], flanks[i], r_w[i], r_a[i], r_f[i])
        own |= _of_rack(i, pair, r[i], h_l, h_a, x[i])
    own |= _of_meshing(pair, own, r_w, r_a)
    for i in (1, 2):
        own[f"nu_p{i}"] = own[f"rho_p{i}"] / flanks[i].r_b
        own[f"d_p{i}"] = 2.0 * abs(flanks[i].point(own[f"nu_p{i}"]))
        own[f"phi_alpha{i}"] = own["g_alpha"] / flanks[i].r_b
    own["epsilon_alpha"] = own["phi_alpha1"] / own["tau_1"]
    own["p_b"] = own["tau_1"] * flanks[1].r_b
    return own


def _of_wheel(
    i: int, p: Array, z: Array, r: Array, flank: Flank, r_w: Array, r_a: Array, r_f: Array
) -> dict[str, Array]:
    """Return what is seen on one wheel, its circles, teeth and measures."""
    t_a = flank.unwinding(r_a)
    own = {"d": r, "d_w": r_w, "d_a": r_a, "d_f": r_f, "d_b": flank.r_b}
    found = {(f"{name}_{i}" if name == "d" else f"{name}{i}"): 2.0 * value for name, value in own.items()}
    found[f"tau_{i}"] = 2.0 * math.pi / z
    found[f"P_{i}"] = abs(r * np.exp(2j * math.pi / z) - r)
    for name, radius in ((f"s_{i}", r), (f"s_w{i}", r_w), (f"s_a{i}", r_a)):
        found[name] = 2.0 * radius * flank.half(radius)
    found[f"e_{i}"] = p - found[f"s_{i}"]
    found[f"s_b{i}"] = 2.0 * flank.r_b * flank.base
    found[f"alpha_a{i}"] = np.arctan(t_a)
    found[f"rho_a{i}"] = flank.r_b * t_a
    chord = root(lambda t: _normal_meets_axis(flank, t) - r, flank.base + 1e-3, flank.base + 1.4)
    found[f"s_c{i}"] = 2.0 * flank.point(chord).imag
    found[f"h_c{i}"] = r_a - flank.point(chord).real
    return found


def _normal_meets_axis(flank: Flank, t: Array) -> Array:
    """Return where the normal of the upper flank, a tangent of the base circle, meets the tooth's centre line."""
    point, foot = flank.point(t), flank.r_b * np.exp(1j * (flank.base - t))
    return point.real - point.imag * (point.real - foot.real) / (point.imag - foot.imag)


def _of_rack(i: int, pair: Mapping[str, Array], r: Array, h_l: Array, h_a: Array, x: Array) -> dict[str, Array]:
    """Return where the rack's straight edge stops to touch the tooth, and the shift that puts this place into N."""
    alpha, m = pair["alpha"], pair["m"]
    down = np.exp(-1j * alpha)  # the line of action below the pole: as far beside as cos, as far inside as sin

    def beyond(shift: Array) -> Array:
        depth = (h_l - h_a - shift) * m  # of the edge's end below the pole
        # the line of action is cut at that depth; N is where it is nearest to the wheel's centre
        place = depth / -down.imag
        nearest = (np.conj(down) * (-1j * r)).real
        return nearest - place

    return {f"rho_l{i}": beyond(x), f"x_min{i}": root(beyond, np.full_like(r, -90.0), np.full_like(r, 9.0))}


def _of_meshing(
    pair: Mapping[str, Array], own: Mapping[str, Array], r_w: Mapping[int, Array], r_a: Mapping[int, Array]
) -> dict[str, Array]:
    """Return what is seen on the line of centres: the active line, velocities at its ends, the table's points."""
    centres = {1: -1j * r_w[1], 2: 1j * r_w[2]}
    along = np.exp(1j * own["alpha_w"])  # from N1 to N2: the pinion turns clockwise
    n = {i: along * (np.conj(along) * centres[i]).real for i in (1, 2)}
    ends = {
        "A1": along * _cut(centres[2], r_a[2], 0j, along, -1.0),
        "A2": along * _cut(centres[1], r_a[1], 0j, along, 1.0),
    }
    found = {"l_N1N2": abs(n[2] - n[1]), "g_alpha": abs(ends["A2"] - ends["A1"])}
    found |= {"g_f": -(np.conj(along) * ends["A1"]).real, "g_a": (np.conj(along) * ends["A2"]).real}
    found |= {"rho_w1": abs(n[1]), "rho_w2": abs(n[2])}
    found["rho_p1"] = (np.conj(along) * (ends["A1"] - n[1])).real
    found["rho_p2"] = (np.conj(along) * (n[2] - ends["A2"])).real

    def slides(place: Array) -> tuple[Array, Array]:
        speeds = [
            (np.conj(1j * along) * (sign * 1j * (place - centres[i]) / pair[f"z_{i}"])).real
            for i, sign in ((1, -1.0), (2, 1.0))
        ]
        return 1.0 - speeds[1] / speeds[0], 1.0 - speeds[0] / speeds[1]

    for end, place in ends.items():
        found[f"theta_12_{end}"], found[f"theta_21_{end}"] = slides(place)
    places = _table(n, ends)
    for k, place in enumerate(places, 1):
        with np.errstate(divide="ignore"):
            found[f"theta_12_{k:02d}"], found[f"theta_21_{k:02d}"] = slides(place)
        for i in (1, 2):  # the straight line from N_i over the end of PW
            found[f"y_{i}_{k:02d}"] = pair["PW"] * abs(place - n[i]) / abs(n[i])
    return found


def _table(n: Mapping[int, Array], ends: Mapping[str, Array]) -> list[Array]:
    """Return twelve points of N1N2: its ends, A1, the pole, A2 in their order, and equal parts between them."""
    inner = np.stack([ends["A1"], 0.0 * n[1], ends["A2"]])
    order = np.argsort(abs(inner - n[1]), axis=0)
    marks = [n[1], *np.take_along_axis(inner, order, axis=0), n[2]]
    found = [
        (a * (parts - j) + b * j) * (1.0 / parts)
        for a, b, parts in zip(marks, marks[1:], (2, 3, 2, 4), strict=False)
        for j in range(parts)
    ]
    return [*found, n[2]]


def outlines(meshing: Meshing, angle: float, points: int, arc: float = math.radians(1.0)) -> list[np.ndarray]:
    """Return the outlines of both wheels at an angle of the pinion, closed without a repeated point."""
    return [
        centre + tooth.teeth(round(tooth.z), points, arc)[:-1] * direction
        for tooth, centre, direction in zip(meshing.teeth, meshing.centres, meshing.directions(angle), strict=True)
    ]


def polygon(points: np.ndarray) -> Polygon:
    """Return an area with its corners given in metres."""
    return Polygon(np.column_stack((points.real, points.imag)) * MM)


def line(points: np.ndarray) -> LineString:
    """Return a broken line with its places given in metres."""
    return LineString(np.column_stack((points.real, points.imag)) * MM)


def wheel_of(tooth: _Tooth, points: int) -> np.ndarray:
    """Return points of a whole wheel counter-clockwise, closed without a repeated point."""
    return tooth.teeth(round(tooth.z), points)[:-1]


def rack(values: Mapping[str, float], x: float, z: float) -> np.ndarray:
    """Return the outline of a cutting tooth of the rack, mm, as it stands in the middle of a space.

    Its centre line is the abscissa, the wheel's centre the origin: the pitch line is the wheel's r away. The corner is
    the circle that touches flank and tip, found by its tangents; the flank goes on outwards beyond every blank.
    """
    m, alpha = values["m"] * MM, values["alpha"]
    middle = 0.5 * m * z + x * m  # the line on which tooth and space are equally wide
    tip = middle - (values["h_a"] + values["c"]) * m
    boundary = middle - (values["h_l"] - values["h_a"]) * m
    half_tip = 0.25 * math.pi * m - (middle - tip) * math.tan(alpha)
    # from the point where flank and tip line meet both tangents of the circle are equally long
    tangent = min((boundary - tip) / math.cos(alpha), half_tip)
    radius = tangent / math.tan(0.5 * (0.5 * math.pi - alpha))
    turn = np.linspace(alpha, 0.5 * math.pi, 120)
    centre = complex(tip + radius, half_tip - tangent)
    corner = centre + radius * (-np.sin(turn) + 1j * np.cos(turn))
    far = middle + 4.0 * m
    outer = complex(far, 0.25 * math.pi * m + 4.0 * m * math.tan(alpha))
    upper = np.concatenate(([outer], corner))
    return np.concatenate((upper, upper[::-1].conj()))


def cut_by_rack(values: Mapping[str, float], tooth: _Tooth, x: float, step: float) -> float:
    """Return the area of one tooth that a rack leaves of a blank, mm2, rolled in steps of an angle, rad.

    Both spaces beside the tooth are cut; the blank is the sector from the middle of one to the middle of the other.
    """
    r, r_a, half = tooth.r * MM, tooth.r_a * MM, math.pi / tooth.z
    arc = np.exp(1j * np.linspace(-half, half, 2000)) * r_a
    blank = Polygon(np.column_stack((np.append(arc.real, 0.0), np.append(arc.imag, 0.0))))
    outline = rack(values, x, tooth.z)
    reach = math.acos(min(1.0, tooth.r_b / max(tooth.r_a, tooth.r))) + 1.4 * math.pi / tooth.z + 1.2
    angles = np.arange(-reach, reach, step)
    # the rack moves along its pitch line by as much as the reference circle turns
    moved = (outline + 1j * r * angles[:, np.newaxis]) * np.exp(-1j * angles)[:, np.newaxis]
    turned = np.concatenate([moved * np.exp(1j * side) for side in (-half, half)])
    tools = shapely.polygons(np.stack((turned.real, turned.imag), axis=-1))
    shapely.prepare(blank)  # with an index of its sides
    near = tools[shapely.intersects(blank, tools)]
    left = blank.difference(shapely.unary_union(near))
    parts = list(left.geoms) if hasattr(left, "geoms") else [left]
    return float(max(part.area for part in parts))


def sector_of(tooth: _Tooth) -> float:
    """Return the area of the tooth's own outline with the centre, mm2."""
    return float(polygon(np.append(tooth.outline(600, math.radians(0.02)), 0.0)).area)


def flanks_touch(meshing: Meshing, angle: float, room: float) -> int:
    """Return how many pairs of flanks are nearer to each other than `room`, mm, at an angle of the pinion."""
    flanks = [tooth.flank(np.linspace(tooth.rho_start, tooth.rho_end, 1000)) for tooth in meshing.teeth]
    if meshing.sense < 0:
        flanks = [flank.conj() for flank in flanks]
    one, other = (
        centre + flank * direction
        for centre, flank, direction in zip(meshing.centres, flanks, meshing.directions(angle), strict=True)
    )
    steps = [np.exp(2j * math.pi / tooth.z) for tooth in meshing.teeth]
    count = 0
    for k in range(-2, 3):
        first = line(meshing.centres[0] + (one - meshing.centres[0]) * steps[0] ** k)
        second = line(meshing.centres[1] + (other - meshing.centres[1]) * steps[1] ** -k)
        shapely.prepare(first)  # with an index of its pieces
        count += bool(shapely.dwithin(first, second, room))
    return count
