"""The blocking contour: its curves and corners by the second route, and by looking at many points of the plane."""

from functools import cache

import numpy as np
import pytest

from kulman.plans.gears.blocking import (
    BLOCKING,
    CELLS,
    CURVES,
    Plane,
    crossings,
    grid,
    near_crossings,
    plane_of,
    traced,
)
from kulman.plans.gears.solve import complete
from kulman.tests.support.gears import SEED, madi, second_route

SIZES = ((15.0, 20.0), (12.0, 24.0), (60.0, 90.0), (20.0, 40.0), (10.0, 10.0), (35.0, 36.0))
WHEELS = [pytest.param(*size, marks=pytest.mark.soak if k else ()) for k, size in enumerate(SIZES)]


def others_of(name: str) -> list[str]:
    return [other for other in BLOCKING if other != name]


@cache
def plane(z_1: float, z_2: float) -> Plane:
    """Return the plane of wheels with some shifts; it keeps what it has traced."""
    return plane_of(complete(madi(z_1=z_1, z_2=z_2, x_1=0.45, x_2=0.45)))


def by_second_route(plane: Plane, places: np.ndarray) -> dict[str, np.ndarray]:
    """Return the functions of the curves from points of flanks and lines; curvatures in millimetres."""
    size = np.ones(places.shape)
    pairs = {name: value * size for name, value in plane.values.items()} | {"x_1": places.real, "x_2": places.imag}
    with np.errstate(invalid="ignore", divide="ignore"):
        own = second_route(pairs)
    found = {"contact_1": own["epsilon_alpha"] - 1.0, "contact_1.2": own["epsilon_alpha"] - 1.2}
    for i in (1, 2):
        found[f"undercut_{i}"] = pairs[f"x_{i}"] - own[f"x_min{i}"]
        found[f"interference_{i}"] = (own[f"rho_p{i}"] - own[f"rho_l{i}"]) * 1e3
        found[f"pointed_{i}"] = own[f"s_a{i}"] * 1e3
        found[f"thin_{i}"] = own[f"s_a{i}"] * 1e3 - 0.3 * plane.values["m"] * 1e3
    return found


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_points_of_every_curve_are_on_their_limit(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)

    step = abs(of.high - of.low) / CELLS
    for name in CURVES:
        inside = np.concatenate([run[of.permits(run, others_of(name))] for run in of.curves[name]] or [np.empty(0)])
        assert np.max(np.abs(by_second_route(of, inside)[name]), initial=0.0) < 1e-9, name
        for run in of.curves[name]:
            assert np.max(np.abs(np.diff(run)), initial=0.0) < 2.0 * step


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_curves_cross_where_both_limits_are_reached_and_sides_of_the_contour_meet_there(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)

    corners, sides = of.corners(), of.contour()

    assert len(corners) >= 3
    places = np.array([corner.place for corner in corners])
    around = places[:, np.newaxis] + 1e-3 * np.exp(2j * np.pi * np.arange(90) / 90)
    found, beside = by_second_route(of, places), by_second_route(of, around)
    inside = np.logical_and.reduce([beside[name] > 0.0 for name in BLOCKING])
    ends = np.array([run[k] for _, run in sides for k in (0, -1)])
    for k, corner in enumerate(corners):
        assert abs(found[corner.first][k]) < 1e-8
        assert abs(found[corner.second][k]) < 1e-8
        assert all(found[name][k] > -1e-8 for name in BLOCKING)
        assert 0 < np.count_nonzero(inside[k]) < 90  # the corner of an area
        assert np.any(beside[corner.first][k] < 0.0)
        assert np.any(beside[corner.second][k] < 0.0)
        assert np.count_nonzero(np.abs(ends - corner.place) < 1e-9) == 2
    if z_1 < 20.0:
        assert len(sides) == len(corners)  # a closed contour
    for name, run in sides:
        assert np.all(of.permits(run, others_of(name), 1e-9))


def test_undercut_lines_of_the_project_cross_in_the_least_shifts_and_many_teeth_mesh_beyond_the_pole() -> None:
    of, many = plane_of(madi()), plane_of(complete(madi(z_1=100.0, z_2=120.0, x_1=0.0, x_2=0.0)))
    chosen, beyond = complex(of.values["x_1"], of.values["x_2"]), complex(2.0, -2.2)  # a tip that ends before the pole

    place = next(c.place for c in plane(15.0, 20.0).crossings() if (c.first, c.second) == ("undercut_1", "undercut_2"))

    assert place == pytest.approx(complex(0.1226666617, -0.1697777844), abs=1e-9)
    assert chosen == complex(0.2, 0.85)
    assert bool(of.permits(chosen))
    assert bool(of.permits(chosen, CURVES))
    assert not bool(of.permits(complex(0.2, 1.0), CURVES))  # the contact ratio
    assert bool(many.permits(beyond))
    assert all(limit[0] > 0.0 for limit in by_second_route(many, np.array([beyond])).values())
    assert not bool(many.permits(complex(0.5, -1.5)))


def test_traced_curves_are_exact_cross_in_two_places_and_end_where_they_are_not_defined() -> None:
    def circle(places: np.ndarray) -> np.ndarray:
        return np.abs(places) ** 2 - 1.0

    def slope(places: np.ndarray) -> np.ndarray:
        return np.asarray(places.real - places.imag)

    def half(places: np.ndarray) -> np.ndarray:
        return np.where(places.real > 0.0, circle(places), np.nan)

    round_, straight, arc = (traced(function, -2 - 2j, 2 + 2j, 41) for function in (circle, slope, half))

    (run,), (part,) = round_, arc
    assert run[0] == run[-1]  # closed
    assert np.max(np.abs(np.abs(run) - 1.0)) < 1e-14
    assert abs(np.sum(np.angle(run[1:] / run[:-1]))) == pytest.approx(2.0 * np.pi)
    starts = near_crossings(round_, straight)
    found = crossings(lambda at: {"circle": circle(at), "slope": slope(at)}, starts, 0.2)
    assert np.sort_complex(found) == pytest.approx(np.array([-1 - 1j, 1 + 1j]) / np.sqrt(2.0), abs=1e-12)
    assert crossings(lambda at: {"circle": circle(at), "slope": slope(at) + 9.0}, starts, 0.2).size == 0
    assert np.all(part.real > -0.1)
    assert part[0] != part[-1]


@pytest.mark.parametrize(("z_1", "z_2"), WHEELS)
def test_permitted_area_is_that_of_the_second_route_and_lies_in_the_window(z_1: float, z_2: float) -> None:
    of = plane(z_1, z_2)
    random = np.random.default_rng(SEED)
    size = of.high - of.low
    places = of.low + size.real * random.random(2000) + 1j * size.imag * random.random(2000)

    found = by_second_route(of, places)

    inside = np.logical_and.reduce([found[name] >= 0.0 for name in BLOCKING])
    assert np.array_equal(of.permits(places), inside)
    assert 0.02 < np.mean(inside) < 0.98
    edge = grid(of.low, of.high, 200)
    rim = np.concatenate((edge[0], edge[-1], edge[:, 0], edge[:, -1]))
    if z_1 < 20.0:  # one contour, round which the window is
        assert not np.any(of.permits(rim))


def test_saddle_is_traced_as_two_curves() -> None:
    runs = traced(lambda places: np.asarray(places.real * places.imag - 1e-4), -1 - 1j, 1 + 1j, 11)

    assert len(runs) == 2
    assert all(np.max(np.abs(run.real * run.imag - 1e-4)) < 1e-14 for run in runs)
