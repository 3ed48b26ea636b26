"""The blocking contour of a pair: the curves in the plane of x_1 and x_2 that bound the shifts which can be used.

Places of the plane are complex numbers x_1 + i x_2. A curve is where a function of both shifts is zero, an array of
real numbers for one of places, NaN where it is not defined; positive is the permitted side. Curves are traced over a
grid and put onto their function to the last digits on every line of the grid that they cross; where two curves cross is
found by Newton's steps from the crossing of their chords.

Source: Bolotovskaya, Bolotovsky et al., Handbook of gear correction (blocking contours).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
import shapely
from contourpy import contour_generator
from numpy.typing import NDArray

from .gear import WHEELS
from .geometry import geometry

Array = NDArray[np.float64]
Places = NDArray[Any]  # complex
Function = Callable[[Any], Array]
CHORDS = 14  # rounds, of which ten suffice
STILL = 1e-12  # part of an edge by which a place may still move when it has been found
NEWTON = 6  # steps, from places that are crossings of chords
MISSED = 0.5  # part of a chord by which two may miss each other
SAME = 1e-9  # places nearer than this are one
STEP = 1e-6  # of a difference quotient
ZERO = 1e-11  # what is left of both functions where two curves cross


def _grid(low: complex, high: complex, cells: int) -> Places:
    """Return the places of a grid of `cells` times `cells`, shape (cells + 1, cells + 1): rows along the abscissa."""
    x, y = np.linspace(low.real, high.real, cells + 1), np.linspace(low.imag, high.imag, cells + 1)
    places: Places = x[:, np.newaxis] + 1j * y
    return places


def traced(function: Function, low: complex, high: complex, cells: int, known: Array | None = None) -> list[Places]:
    """Return the pieces of the curve in a window, longest first: each a run of places on it, closed if it is a loop.

    Every place is on an edge of the grid, put to the last digits there. `known` are the function's values on the grid.
    """
    places, nodes = _grid(low, high, cells), np.arange(cells + 1)
    values = function(places) if known is None else known
    above = np.ma.masked_invalid(np.where(values == 0.0, np.finfo(float).tiny, values).T)  # a zero is permitted
    runs = []
    for line in map(np.asarray, contour_generator(nodes, nodes, above, name="serial", corner_mask=False).lines(0.0)):
        node = np.rint(line).astype(int)
        along, rows = np.abs(line - node).argmax(axis=1), np.arange(len(line))  # the axis along which each edge runs
        node[rows, along] = np.minimum(np.floor(line[rows, along]), cells - 1)
        beyond = node.copy()
        beyond[rows, along] += 1
        run = _zeros(function, places[node[:, 0], node[:, 1]], places[beyond[:, 0], beyond[:, 1]])
        first, last = ((along[end], *node[end].tolist()) for end in (0, -1))
        runs.append(run if first <= last else run[::-1])  # always from the same end
    return sorted(runs, key=len, reverse=True)


def _zeros(function: Function, first: Places, last: Places) -> Places:
    """Return places between `first` and `last` at which the function changes its sign, by the Illinois rule.

    Chords are drawn between values of different sign; a value that stays is halved, so that both ends come near.
    """
    if not first.size:
        return first
    edges, old, new = np.abs(last - first), function(first), function(last)
    for _ in range(CHORDS):
        slope = new - old
        part = np.where(slope == 0.0, 0.0, new / np.where(slope == 0.0, 1.0, slope))
        middle = last - part * (last - first)
        value = function(middle)
        other = (value >= 0.0) != (new >= 0.0)
        first, old = np.where(other, last, first), np.where(other, new, 0.5 * old)
        still = np.abs(middle - last) <= STILL * edges
        last, new = middle, value
        if still.all():
            break
    return last


def _near_crossings(first: Iterable[Places], second: Iterable[Places]) -> Places:
    """Return the places where chords of two curves cross, those that only just miss each other among them."""
    ours, others = (
        shapely.linestrings(np.concatenate(chords or [np.zeros((0, 2), complex)]).view(float).reshape(-1, 2, 2))
        for chords in ([np.stack((run[:-1], run[1:]), axis=-1) for run in curve] for curve in (first, second))
    )
    i, j = shapely.STRtree(others).query(ours, predicate="dwithin", distance=MISSED * shapely.length(ours))
    between = shapely.get_coordinates(shapely.shortest_line(ours[i], others[j]))
    ends: Places = between.view(complex).reshape(-1, 2)
    return np.asarray(ends.mean(axis=1))


def crossings(both: Callable[[Any], Mapping[str, Array]], starts: Places, reach: float) -> Places:
    """Return the places, each once, where two functions are zero, from starts not farther from them than `reach`.

    Newton's steps, from all starts at once; those that lead nowhere are left out.
    """
    places = starts.astype(complex)
    around = np.array([0.0, STEP, -STEP, 1j * STEP, -1j * STEP])
    for _ in range(NEWTON):
        f, g = both(places[:, np.newaxis] + around).values()
        (f_x, f_y), (g_x, g_y) = (((h[:, 1] - h[:, 2]), (h[:, 3] - h[:, 4])) for h in (f, g))
        determinant = f_x * g_y - f_y * g_x
        with np.errstate(divide="ignore", invalid="ignore"):
            x, y = (f[:, 0] * g_y - g[:, 0] * f_y) / determinant, (g[:, 0] * f_x - f[:, 0] * g_x) / determinant
        places = places - 2.0 * STEP * (x + 1j * y)
        near = np.abs(places - starts) <= reach  # also leaves out what is undefined
        places, starts = places[near], starts[near]
    f, g = both(places).values()
    found: list[complex] = []
    for place in places[(np.abs(f) < ZERO) & (np.abs(g) < ZERO)].tolist():
        if all(abs(place - other) > SAME for other in found):
            found.append(place)
    return np.array(found, complex)


CELLS = 160  # of the grid along either axis
HIGHEST = 6.0  # shift that no contour reaches
LEAST_WINDOW = 1.5
MARGIN = 0.08  # of the window, round the contour


class _Limit(NamedTuple):
    """A curve: where a quantity is no `greater` than another one or a number; of lengths, in modules."""

    greater: str
    less: str | float  # `LEAST_TIP` is the least thickness of a tooth at its tip
    length: bool = False


LEAST_TIP = "tip"
OF_CURVE = {
    **{f"undercut_{i}": _Limit(f"x_{i}", f"x_min{i}") for i in WHEELS},
    **{f"interference_{i}": _Limit(f"rho_p{i}", f"rho_l{i}", True) for i in WHEELS},
    "contact_1": _Limit("epsilon_alpha", 1.0),
    **{f"pointed_{i}": _Limit(f"s_a{i}", 0.0, True) for i in WHEELS},
    "contact_1.2": _Limit("epsilon_alpha", 1.2),
    **{f"thin_{i}": _Limit(f"s_a{i}", LEAST_TIP, True) for i in WHEELS},
}
CURVES = tuple(OF_CURVE)
BLOCKING = CURVES[:7]


class _Crossing(NamedTuple):
    """Where two curves cross."""

    first: str
    second: str
    place: complex


@dataclass(frozen=True)
class Plane:
    """The plane of the shifts of a pair."""

    values: Mapping[str, float]  # the complete givens; their x_1 and x_2 are the chosen point
    least_tip: float  # thickness of a tooth at its tip, in modules, that the curves `thin_1` and `thin_2` stand for
    low: complex  # corner of the window in which the curves are traced
    high: complex

    def measures(self, places: Any, wanted: Iterable[str] = CURVES) -> dict[str, Array]:
        """Return the functions whose zeros are the curves, at places, by name; NaN where no pair can mesh.

        Shifts are compared in modules, radii of curvature and thicknesses as well.
        """
        limits, places = {name: OF_CURVE[name] for name in wanted}, np.asarray(places, complex)
        names = [name for limit in limits.values() for name in limit[:2] if isinstance(name, str) and name != LEAST_TIP]
        shifted = {**self.values, "x_1": places.real, "x_2": places.imag}
        sizes, measured = {**geometry(shifted, names), LEAST_TIP: self.least_tip * self.values["m"]}, {}
        for name, (greater, less, length) in limits.items():
            over = sizes[greater] - (sizes[less] if isinstance(less, str) else less)
            measured[name] = np.asarray(over / self.values["m"] if length else over)
        return measured

    def permits(self, places: Any, curves: Iterable[str] = BLOCKING, room: float = 0.0) -> NDArray[np.bool_]:
        """Return whether places are on the permitted side of all of some curves, or nearer to them than `room`."""
        found = self.measures(places, curves).values()
        inside: NDArray[np.bool_] = np.logical_and.reduce([measure >= -room for measure in found])
        return inside

    @cached_property
    def curves(self) -> dict[str, list[Places]]:
        """All curves inside the window, by name: their pieces, each a run of places on it."""
        known = self.measures(_grid(self.low, self.high, CELLS))  # of all at once: they share most of it

        def measure(places: Any, name: str) -> Array:
            return self.measures(places, (name,))[name]

        window = self.low, self.high, CELLS
        return {name: traced(partial(measure, name=name), *window, known[name]) for name in CURVES}

    def crossings(self) -> list[_Crossing]:
        """Return where the curves that block cross each other inside the window."""
        found, reach = [], 2.0 * abs(self.high - self.low) / CELLS
        for pair in combinations(BLOCKING, 2):
            first, second = pair
            starts = _near_crossings(self.curves[first], self.curves[second])
            if starts.size:
                places = crossings(partial(self.measures, wanted=pair), starts, reach)
                found += [_Crossing(first, second, place) for place in places.tolist()]
        return found

    def corners(self) -> list[_Crossing]:
        """Return the corners of the contour: crossings that all other curves permit."""
        others = {corner: [name for name in BLOCKING if name not in corner] for corner in self.crossings()}
        return [corner for corner, names in others.items() if bool(self.permits(corner.place, names, SAME))]

    def contour(self) -> list[tuple[str, Places]]:
        """Return the pieces of curves that all others permit: the sides of the contour, from corner to corner.

        A piece that the window cuts off has no corner at that end.
        """
        corners, found = self.corners(), []
        for name in BLOCKING:
            own = np.array([corner.place for corner in corners if name in (corner.first, corner.second)], complex)
            others = [other for other in BLOCKING if other != name]
            for run in self.curves[name]:
                changes = np.diff(np.concatenate(([0], self.permits(run, others).astype(int), [0])))
                ends = (np.flatnonzero(side * changes > 0).tolist() for side in (1, -1))  # of stretches inside
                found += [(name, _to_corners(run, begin, end, own)) for begin, end in zip(*ends, strict=True)]
        return found


def _to_corners(run: Places, begin: int, end: int, corners: Places) -> Places:
    """Return a stretch of a run with the corners in which it ends."""
    piece = run[begin:end]
    for at, outside in ((0, begin - 1), (len(piece), end)):
        if corners.size and 0 <= outside < len(run):
            last = piece[0 if at == 0 else -1]
            corner = corners[np.argmin(np.abs(corners - 0.5 * (last + run[outside])))]
            piece = np.insert(piece, at, corner) if at == 0 else np.append(piece, corner)
    return piece


def _connected(inside: NDArray[np.bool_], distance: Array) -> NDArray[np.bool_]:
    """Return that connected part of what is inside whose nearest place has the least distance."""
    if not inside.any():
        return inside
    part: NDArray[np.bool_] = inside & (distance == np.min(distance[inside]))
    while True:
        wider: NDArray[np.bool_] = part.copy()
        wider[1:] |= part[:-1]
        wider[:-1] |= part[1:]
        wider[:, 1:] |= part[:, :-1]
        wider[:, :-1] |= part[:, 1:]
        wider &= inside
        if bool((wider == part).all()):
            return part
        part = wider


def plane_of(values: Mapping[str, float], least_tip: float = 0.3) -> Plane:
    """Return the plane of shifts of a pair with its complete givens, in a window round the contour.

    Wheels with many teeth have contours for gearing beyond the pole, too; the window is round that which holds the
    chosen point or is nearest to it. Where no shifts are permitted at all it is round this point and the least shifts.
    """
    least = geometry(values, ("x_min1", "x_min2"))
    low, chosen = complex(least["x_min1"], least["x_min2"]), complex(values["x_1"], values["x_2"])
    wide = Plane(values, least_tip, low, complex(HIGHEST, HIGHEST))
    places = _grid(wide.low, wide.high, CELLS)
    inside = places[_connected(wide.permits(places), np.abs(places - chosen))]
    seen = np.append(inside if inside.size else np.array([low, low + complex(LEAST_WINDOW, LEAST_WINDOW)]), chosen)
    size = wide.high - wide.low
    cell = complex(size.real / CELLS, size.imag / CELLS)  # the contour may go on up to the next place of the grid
    low = complex(float(np.min(seen.real)), float(np.min(seen.imag))) - cell
    high = complex(float(np.max(seen.real)), float(np.max(seen.imag))) + cell
    margin = MARGIN * (high - low)
    return Plane(values, least_tip, low - margin, high + margin)
