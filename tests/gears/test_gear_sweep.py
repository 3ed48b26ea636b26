"""`kulman sweep` of a gear pair: the contact of one pair of teeth, against both wheels turned about their centres."""

from __future__ import annotations

import csv
import io
import json
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from kulman import cli, sweep
from kulman.plans.gears.course import GearCourse
from kulman.plans.gears.gear import CCW, CW, GearPair
from kulman.plans.gears.solve import SolvedGear, solve_gear
from kulman.scales.errors import InputError
from kulman.tests.support.gears import contacts, counted_ratio, madi

TASK = "madi-gear"
CASES = [
    pytest.param({}, CCW, id="project"),
    pytest.param({"x_1": -0.3}, CW, id="undercut"),
    pytest.param({"z_1": 60.0, "z_2": 90.0, "x_1": 0.0, "x_2": 0.0}, CCW, id="many teeth"),
    pytest.param({"x_1": 1.3, "x_2": 0.5}, CW, id="hardly two pairs"),
]


def solved_for(others: dict[str, float], rotation: str) -> SolvedGear:
    return solve_gear(GearPair(rotation), madi(**others))


@pytest.mark.parametrize(("others", "rotation"), CASES)
def test_columns_are_what_turned_wheels_show(others: dict[str, float], rotation: str) -> None:
    solved = solved_for(others, rotation)
    meshing, sense = solved.meshing, solved.pair.sense
    rho_1 = np.linspace(*meshing.touching, 7)

    found = {column.name: column.values for column in GearCourse(solved).columns(rho_1)}

    for k, rho in enumerate(rho_1.tolist()):
        place = meshing.place(rho)
        across = meshing.along * 1j  # along both profiles
        turning = (sense * 1.0, -sense * solved.givens["z_1"] / solved.givens["z_2"])
        v_1, v_2 = (
            (across.conjugate() * (1j * rate * (place - centre))).real
            for rate, centre in zip(turning, meshing.centres, strict=True)
        )
        sign = sense  # the pinion's velocity along its profile counts as positive
        assert found["v_k1"][k] == pytest.approx(sign * v_1, abs=1e-15)
        assert found["v_k2"][k] == pytest.approx(sign * v_2, abs=1e-15)
        assert found["v_s"][k] == pytest.approx(sign * (v_1 - v_2), abs=1e-15)
        assert found["theta_12"][k] == pytest.approx((v_1 - v_2) / v_1, abs=1e-10)
        assert found["theta_21"][k] == pytest.approx((v_2 - v_1) / v_2, abs=1e-10)
        for i, centre in enumerate(meshing.centres, 1):
            assert found[f"r_{i}"][k] == pytest.approx(abs(place - centre), rel=1e-13)
        assert found["phi"][k] == pytest.approx(meshing.angle(rho), abs=1e-15)
        if 0 < k < 6:
            assert found["pairs"][k] == len(contacts(meshing, meshing.angle(rho)))


@pytest.mark.parametrize(("others", "rotation"), CASES)
def test_zones_follow_one_another_and_hold_as_many_pairs_as_touch(others: dict[str, float], rotation: str) -> None:
    solved = solved_for(others, rotation)
    first, last = solved.meshing.touching

    found = GearCourse(solved).zones

    assert (found[0].first, found[-1].last) == (first, pytest.approx(last, rel=1e-14))
    assert all(a.last == b.first and a.pairs != b.pairs for a, b in pairwise(found))
    for zone in found:
        for part in (0.01, 0.5, 0.99):
            rho = zone.first + part * (zone.last - zone.first)
            assert (
                len(contacts(solved.meshing, solved.meshing.angle(rho)))
                == zone.pairs
                == GearCourse(solved).pairs(np.array(rho))
            )
    # as many pairs as touch on average over a pitch
    mean = sum(zone.last - zone.first for zone in found) / solved.sizes["p_b"]
    assert mean == pytest.approx(counted_ratio(solved.meshing, 4000), abs=2e-3)


def test_ends_of_an_undercut_contact_are_not_called_those_of_the_active_line() -> None:
    assert list(GearCourse(solved_for({}, CCW)).marks) == ["A1", "K2", "P", "K1", "A2"]
    assert next(iter(GearCourse(solved_for({"z_1": 10.0, "x_1": -0.2}, CCW)).marks)) == "start"


def test_extremes_are_at_the_ends_of_the_contact() -> None:
    solved = solved_for({}, CCW)
    rho_1 = np.linspace(*solved.meshing.touching, 1001)
    fine = {column.name: column.values for column in GearCourse(solved).columns(rho_1)}

    for one in GearCourse(solved).extremes():
        assert (one.most, one.least) == (np.max(fine[one.name]), np.min(fine[one.name]))
    assert {one.name: one.least for one in GearCourse(solved).extremes()}["theta_12"] == solved.sizes["theta_12_A1"]


def test_table_csv_and_json_tell_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    swept = sweep(TASK, lang="en", positions=5)

    table = swept.table()
    rows = list(csv.reader(io.StringIO(swept.csv())))
    data = json.loads(json.dumps(swept.to_json()))

    assert rows[0][:4] == ["k", "phi [°]", "rho_1 [mm]", "rho_2 [mm]"]
    assert rows[0][-1] == "pairs"
    assert len(rows) == 6
    for k, row in enumerate(rows[1:]):
        assert float(row[2]) * 1e-3 == pytest.approx(data["columns"]["rho_1"]["value"][k], rel=1e-15)
        assert math.radians(float(row[1])) == pytest.approx(data["columns"]["phi"]["value"][k], abs=1e-9)
    assert f"{data['columns']['theta_12']['value'][0]:.3f}".replace("-", "−") in table
    assert [zone["pairs"] for zone in data["zones"]] == [2, 1, 2]
    with pytest.raises(SystemExit):
        cli.main(["sweep", TASK, "-o", str(tmp_path / "x.csv"), "--lang", "uk"])
    assert (tmp_path / "x.csv").read_bytes().count(b"\r\n") == 102
    assert capsys.readouterr().out.strip().endswith("x.csv")


@pytest.mark.parametrize(
    ("asked", "key"),
    [({"points": "A"}, "kind-without"), ({"start": "3 deg"}, "kind-without"), ({"chords": "B"}, "kind-without")],
)
def test_what_a_contact_has_not_is_refused(asked: dict[str, str], key: str) -> None:
    with pytest.raises(InputError) as refused:
        sweep(TASK, **asked)  # type: ignore[arg-type]

    assert refused.value.key == key


def test_a_drawing_of_the_sweep_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        sweep(TASK).save(tmp_path / "a.csv", tmp_path / "b.svg")

    assert refused.value.key == "gear-sweep-drawing"
    assert not list(tmp_path.iterdir())
