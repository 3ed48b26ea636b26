"""Pairs in mesh: rolled through a pitch as polygons, contacts counted, the line of action, the gaps at the roots."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kulman.plans.gears.geometry import geometry
from kulman.plans.gears.solve import complete
from kulman.plans.gears.teeth import Meshing, meshing_of
from kulman.tests.support.gear_polygons import flanks_touch, line, polygon
from kulman.tests.support.gears import SEED, contacts, counted_ratio, madi, outlines, random_pairs

STEPS = 25  # of a pitch, in which contacts are counted by polygons
TOUCHING = 5e-6  # mm: less apart, two chords of flanks touch
PAIRS = [
    pytest.param({}, 1, id="the project's pair"),
    pytest.param(
        {"z_1": 14.0, "z_2": 25.0, "x_1": 0.5, "x_2": -0.1, "alpha": math.radians(24.0)}, -1, id="24 deg, clockwise"
    ),
    pytest.param({}, -1, id="turning clockwise", marks=pytest.mark.soak),
    pytest.param({"z_1": 18.0, "z_2": 30.0, "x_1": 0.0, "x_2": 0.0}, 1, id="without shifts", marks=pytest.mark.soak),
]


def mesh(others: dict[str, float], sense: int = 1) -> Meshing:
    return meshing_of(complete(madi(**others)), sense)


def overlap(meshing: Meshing, angle: float) -> float:
    """Return the area common to both wheels, mm2."""
    first, second = (polygon(outline) for outline in outlines(meshing, angle, 300, math.radians(0.1)))
    return float(first.intersection(second).area)


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_wheels_roll_through_a_pitch_without_overlap(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)

    for angle in np.linspace(0.0, 2.0 * math.pi / meshing.teeth[0].z, 8):
        assert overlap(meshing, float(angle)) < 1e-6


def test_wheels_of_which_one_is_turned_by_a_thousandth_overlap() -> None:
    meshing = mesh({})

    first, second = outlines(meshing, 0.0, 100)

    for turn in (1e-3, -1e-3):  # there is no backlash
        turned = meshing.centres[0] + (first - meshing.centres[0]) * np.exp(1j * turn)
        assert polygon(turned).intersection(polygon(second)).area > 1e-2


@pytest.mark.parametrize(
    ("others", "sense"), [PAIRS[1], *(pytest.param(*PAIRS[k].values, marks=pytest.mark.soak) for k in (0, 2, 3))]
)
def test_contacts_counted_on_polygons_make_the_contact_ratio(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    epsilon = geometry(madi(**others))["epsilon_alpha"]
    pitch = 2.0 * math.pi / meshing.teeth[0].z

    angles = (np.arange(STEPS) + 0.37) * pitch / STEPS
    counted = [flanks_touch(meshing, float(angle), TOUCHING) for angle in angles]

    assert counted == [len(contacts(meshing, float(angle))) for angle in angles]
    assert np.mean(counted) == pytest.approx(epsilon, abs=1.0 / STEPS + 1e-3)
    assert counted_ratio(meshing) == pytest.approx(epsilon, abs=1.5e-3)


@pytest.mark.soak
def test_many_pairs_roll_without_overlap_and_touch_as_often_as_the_contact_ratio_says() -> None:
    pairs = random_pairs(np.random.default_rng(SEED), 12)
    for k in range(12):
        values = {name: float(column[k]) for name, column in pairs.items()}
        values["m"] = 4e-3
        if max(values["z_1"], values["z_2"]) > 60.0:
            continue
        meshing = meshing_of(complete(values), 1 - 2 * (k % 2))
        pitch = 2.0 * math.pi / values["z_1"]
        for angle in np.linspace(0.0, pitch, 9):
            assert overlap(meshing, float(angle)) < 1e-6
        counted = [flanks_touch(meshing, float(angle), TOUCHING) for angle in (np.arange(150) + 0.5) * pitch / 150]
        assert np.mean(counted) == pytest.approx(geometry(values)["epsilon_alpha"], abs=0.01)


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_line_of_action_touches_both_base_circles_and_passes_the_pole(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    found = geometry(madi(**others))

    ends = first, second = meshing.place(0.0), meshing.place(found["l_N1N2"])
    for n, centre, tooth in zip(ends, meshing.centres, meshing.teeth, strict=True):
        assert abs(n - centre) == pytest.approx(tooth.r_b, rel=1e-13)
        assert abs(((n - centre).conjugate() * meshing.along).real) < 1e-13 * tooth.r
    assert abs((first.conjugate() * second).imag) < 1e-13 * abs(first) * abs(second)  # the pole is between them
    assert abs(second - first) == pytest.approx(found["l_N1N2"], rel=1e-13)
    start, end = (meshing.place(found[rho]) for rho in ("rho_p1", "rho_a1"))
    assert abs(start - meshing.centres[1]) == pytest.approx(meshing.teeth[1].r_a, rel=1e-13)
    assert abs(end - meshing.centres[0]) == pytest.approx(meshing.teeth[0].r_a, rel=1e-13)
    assert abs(end - start) == pytest.approx(found["g_alpha"], rel=1e-12)
    rim = 1j * sense * (0j - meshing.centres[0])  # how the pinion's rim moves at the pole
    assert (rim.conjugate() * meshing.along).real > 0.0  # and drives the wheel


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_flanks_touch_on_the_line_of_action_where_the_contact_is_said_to_be(
    others: dict[str, float], sense: int
) -> None:
    meshing = mesh(others, sense)
    first, last = meshing.touching

    for rho_1 in np.linspace(first, last, 5):
        angle = meshing.angle(float(rho_1))
        place = meshing.place(float(rho_1))
        assert np.min(np.abs(contacts(meshing, angle) - rho_1)) < 1e-15
        lines = [line(np.append(outline, outline[0])) for outline in outlines(meshing, angle, 400)]
        point = line(np.array([place, place + 1e-12]))
        assert all(outline.distance(point) < 1e-4 for outline in lines)


@pytest.mark.parametrize(("others", "sense"), PAIRS)
def test_both_roots_have_the_radial_clearance(others: dict[str, float], sense: int) -> None:
    meshing = mesh(others, sense)
    values = madi(**others)
    distance = abs(meshing.centres[1] - meshing.centres[0])

    for one, other in ((0, 1), (1, 0)):
        gap = distance - meshing.teeth[one].r_a - meshing.teeth[other].r_f
        assert gap == pytest.approx(values["c"] * values["m"], rel=1e-12)


def test_single_contact_lies_between_two_double_ones() -> None:
    meshing = mesh({})
    first, last = meshing.touching
    low, high = last - meshing.sizes["p_b"], first + meshing.sizes["p_b"]

    for rho_1, count in (((first + low) / 2, 2), ((low + high) / 2, 1), ((high + last) / 2, 2)):
        assert len(contacts(meshing, meshing.angle(rho_1))) == count


def test_undercut_and_pointed_teeth_touch_less_long() -> None:
    values = madi(z_1=8.0, x_1=-0.1, z_2=40.0, x_2=0.3)
    meshing = meshing_of(values)

    assert meshing.teeth[0].undercut
    assert meshing.touching[0] > geometry(values)["rho_p1"]
    assert counted_ratio(meshing) < geometry(values)["epsilon_alpha"] - 0.1
    assert overlap(meshing, 0.05) < 1e-6  # the undercut makes room
