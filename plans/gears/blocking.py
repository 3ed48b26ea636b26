"""The blocking contour of a pair: the curves in the plane of x_1 and x_2 that bound the shifts which can be used.

Places of the plane are complex numbers x_1 + i x_2. A curve is where a function of both shifts is zero; positive is the
permitted side. Curves are traced over a grid and put onto their function to the last digits on every line of the grid
that they cross; where two curves cross is found by Newton's steps from the crossing of their chords.

Source: Bolotovskaya, Bolotovsky et al., Handbook of gear correction (blocking contours).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .gear import WHEELS
from .geometry import geometry
from .tracing import Places, crossings, grid, near_crossings, traced

Array = NDArray[np.float64]
CELLS = 160  # of the grid along either axis
SAME = 1e-9  # places of the plane nearer than this are one
HIGHEST = 6.0  # shift that no contour reaches
LEAST_WINDOW = 1.5
MARGIN = 0.08  # of the window, round the contour
BLOCKING = ("undercut_1", "undercut_2", "interference_1", "interference_2", "contact_1", "pointed_1", "pointed_2")
CURVES = (*BLOCKING, "contact_1.2", "thin_1", "thin_2")
_KINDS = {"undercut": "12", "interference": "12", "contact": ("1", "1.2"), "pointed": "12", "thin": "12"}
OF_CURVE = {f"{kind}_{of}": (kind, of) for kind, every in _KINDS.items() for of in every}  # kind, wheel or ratio
RATIOS = {"contact_1": 1.0, "contact_1.2": 1.2}
# what is compared: the shift with the least one, curvatures, the contact ratio, the thickness of the tip
COMPARED = {
    **{f"undercut_{i}": (f"x_{i}", f"x_min{i}") for i in WHEELS},
    **{f"interference_{i}": (f"rho_p{i}", f"rho_l{i}") for i in WHEELS},
    **dict.fromkeys(RATIOS, ("epsilon_alpha",)),
    **{f"{kind}_{i}": (f"s_a{i}",) for kind in ("pointed", "thin") for i in WHEELS},
}


@dataclass(frozen=True, slots=True)
class Crossing:
    """Where two curves cross."""

    first: str
    second: str
    place: complex


@dataclass(frozen=True)
class Plane:
    """The plane of the shifts of a pair.

    Parameters
    ----------
    values : mapping of str to float
        The complete givens; their x_1 and x_2 are the chosen point.
    least_tip : float
        The least thickness of a tooth at its tip, in modules, that the curves `thin_1` and `thin_2` stand for.
    low, high : complex
        Corners of the window in which the curves are traced.
    """

    values: Mapping[str, float]
    least_tip: float
    low: complex
    high: complex
    cells: int = CELLS
    _traced: dict[str, list[Places]] = field(default_factory=dict, repr=False)
    _on_grid: dict[str, Array] = field(default_factory=dict, repr=False)

    @property
    def chosen(self) -> complex:
        """The point of the pair's own shifts."""
        return complex(self.values["x_1"], self.values["x_2"])

    def measures(self, places: Any, wanted: Iterable[str] = CURVES) -> dict[str, Array]:
        """Return the functions whose zeros are the curves, at places, by name; NaN where no pair can mesh.

        Shifts are compared in modules, radii of curvature and thicknesses as well.
        """
        names = tuple(wanted)
        places = np.asarray(places, complex)
        found = geometry(
            {**self.values, "x_1": places.real, "x_2": places.imag}, [name for key in names for name in COMPARED[key]]
        )
        return {name: self._measure(name, [found[part] for part in COMPARED[name]]) for name in names}

    def _measure(self, name: str, parts: list[Array]) -> Array:
        kind, unit = OF_CURVE[name][0], 1.0 / self.values["m"]
        if kind == "contact":
            return np.asarray(parts[0] - RATIOS[name])
        if kind in ("pointed", "thin"):
            return np.asarray(parts[0] * unit - (self.least_tip if kind == "thin" else 0.0))
        return np.asarray((parts[0] - parts[1]) * (unit if kind == "interference" else 1.0))

    def measure(self, name: str) -> Callable[[Any], Array]:
        """Return one of the functions."""
        return lambda places: self.measures(places, (name,))[name]

    def permits(self, places: Any, curves: Iterable[str] = BLOCKING, room: float = 0.0) -> NDArray[np.bool_]:
        """Return whether places are on the permitted side of all of some curves, or nearer to them than `room`."""
        names = tuple(curves)
        found = self.measures(places, names)
        inside: NDArray[np.bool_] = np.logical_and.reduce([found[name] >= -room for name in names])
        return inside

    def curve(self, name: str) -> list[Places]:
        """Return a curve inside the window: its pieces, each a run of places on it."""
        if name not in self._traced:
            if not self._on_grid:  # of all curves at once: they share most of what is calculated
                self._on_grid.update(self.measures(grid(self.low, self.high, self.cells)))
            self._traced[name] = traced(self.measure(name), self.low, self.high, self.cells, self._on_grid[name])
        return self._traced[name]

    def crossings(self, curves: Iterable[str] = BLOCKING) -> list[Crossing]:
        """Return where curves cross each other inside the window."""
        found = []
        reach = 2.0 * abs(self.high - self.low) / self.cells
        for pair in combinations(tuple(curves), 2):
            first, second = pair
            starts = near_crossings(self.curve(first), self.curve(second))
            if starts.size:
                places = crossings(partial(self._both, pair), starts, reach)
                found += [Crossing(first, second, place) for place in places.tolist()]
        return found

    def _both(self, pair: tuple[str, str], places: Places) -> tuple[Array, Array]:
        found = self.measures(places, pair)
        return found[pair[0]], found[pair[1]]

    def corners(self, curves: Iterable[str] = BLOCKING) -> list[Crossing]:
        """Return the corners of the contour: crossings that all other curves permit."""
        names = tuple(curves)
        found = []
        for corner in self.crossings(names):
            others = [name for name in names if name not in (corner.first, corner.second)]
            if bool(self.permits(corner.place, others, SAME)):
                found.append(corner)
        return found

    def contour(self, curves: Iterable[str] = BLOCKING) -> list[tuple[str, Places]]:
        """Return the pieces of curves that all others permit: the sides of the contour, from corner to corner.

        A piece that the window cuts off has no corner at that end.
        """
        names = tuple(curves)
        corners, found = self.corners(names), []
        for name in names:
            own = np.array([corner.place for corner in corners if name in (corner.first, corner.second)], complex)
            others = [other for other in names if other != name]
            for run in self.curve(name):
                inside = self.permits(run, others)
                for begin, end in _stretches(inside):
                    found.append((name, _to_corners(run, begin, end, own)))
        return found


def _stretches(inside: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the stretches that are inside: indices of their first place and after their last."""
    changes = np.diff(np.concatenate(([0], inside.astype(int), [0])))
    return list(zip(np.flatnonzero(changes > 0).tolist(), np.flatnonzero(changes < 0).tolist(), strict=True))


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


def plane_of(values: Mapping[str, float], least_tip: float = 0.3, cells: int = CELLS) -> Plane:
    """Return the plane of shifts of a pair with its complete givens, in a window round the contour.

    Wheels with many teeth have contours for gearing beyond the pole, too; the window is round that which holds the
    chosen point or is nearest to it. Where no shifts are permitted at all it is round this point and the least shifts.
    """
    least = geometry(values, ("x_min1", "x_min2"))
    low, chosen = complex(least["x_min1"], least["x_min2"]), complex(values["x_1"], values["x_2"])
    wide = Plane(values, least_tip, low, complex(HIGHEST, HIGHEST), cells)
    places = grid(wide.low, wide.high, cells)
    inside = places[_connected(wide.permits(places), np.abs(places - chosen))]
    seen = np.append(inside if inside.size else np.array([low, low + complex(LEAST_WINDOW, LEAST_WINDOW)]), chosen)
    size = wide.high - wide.low
    cell = complex(size.real / cells, size.imag / cells)  # the contour may go on up to the next place of the grid
    low = complex(float(np.min(seen.real)), float(np.min(seen.imag))) - cell
    high = complex(float(np.max(seen.real)), float(np.max(seen.imag))) + cell
    margin = MARGIN * (high - low)
    return Plane(values, least_tip, low - margin, high + margin, cells)
