"""The command `sweep` of a cam: its table, the points of its profiles as CSV, extremes, what is refused."""

from __future__ import annotations

import csv
import io
import math
import re
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman.plans.cams.course import CamCourse
from kulman.plans.cams.solve import SolvedCam
from kulman.scales.errors import InputError
from kulman.tests.support.cams import ROCKER
from kulman.tests.support.commands import Run
from kulman.variants.sweeps.sweeps import CourseSweep

TASK = "madi-cam"


def swept(**asked: object) -> CourseSweep:
    found = kulman.sweep(TASK, lang="en", **asked)  # type: ignore[arg-type]
    assert isinstance(found, CourseSweep)
    return found


def columns_of(found: CourseSweep) -> dict[str, list[str]]:
    head, *rows = csv.reader(io.StringIO(found.csv()))
    return dict(zip(head, map(list, zip(*rows, strict=True)), strict=True))


def curve(columns: dict[str, list[str]], name: str) -> np.ndarray:
    x, y = (np.array(columns[f"{name}.{axis} [mm]"], float) for axis in "xy")
    return 1e-3 * (x + 1j * y)


def test_points_of_the_csv_are_those_of_the_profiles() -> None:
    found = swept(positions=24)
    columns, phi, solved = columns_of(found), np.radians(np.arange(24) * 15.0), SolvedCam.of(found.case.solved)

    roller, plate = solved.roller, solved.plate
    assert roller is not None
    assert plate is not None
    curves = {"pitch": roller.profile.pitch, "profile": roller.profile.practical}
    for name, points in (curves | {"profile_plate": plate.profile.practical}).items():
        assert curve(columns, name) == pytest.approx(points(phi), rel=1e-12, abs=1e-15)
    between = np.abs(curve(columns, "pitch") - curve(columns, "profile"))
    assert between == pytest.approx(np.full(24, 7e-3), rel=1e-12)  # the roller's radius


def test_without_positions_files_have_every_degree_and_the_table_the_section_lines() -> None:
    found = swept()
    columns, table = columns_of(found), found.table().split("\n\n")[0].splitlines()

    assert [*map(float, columns["phi [°]"])] == list(range(360))
    assert {*[*columns.values()][-1]} == {"ok"}
    assert len(table) == 1 + 26 + 2  # section lines, two of them with both limits
    assert [line.split()[3] for line in table if line.split()[1:2] == ["36"]] == ["20.6901"]
    assert len(swept(positions=12).table().split("\n\n")[0].splitlines()) == 1 + 12


def test_velocity_and_acceleration_are_derivatives_of_the_travel() -> None:
    solved = SolvedCam.of(swept().case.solved)
    phi, step = np.radians(np.arange(5.0, 230.0, 7.0)), 1e-4
    at, ahead, behind = (
        {column.name: column.values for column in CamCourse(solved).columns(phi + shift)}
        for shift in (0.0, step, -step)
    )

    seconds = step / 200.0
    assert at["v"] == pytest.approx((ahead["s"] - behind["s"]) / (2.0 * seconds), abs=1e-4)
    assert at["a"] == pytest.approx((ahead["s"] - 2.0 * at["s"] + behind["s"]) / seconds**2, abs=30.0)


def test_extremes_are_those_of_a_close_look_at_both_sides_of_jumps() -> None:
    solved = SolvedCam.of(swept().case.solved)
    phi = solved.motion.samples(1e-3)
    sides = [{column.name: column.values for column in CamCourse(solved).columns(phi, side)} for side in (-1, 1)]

    for found in CamCourse(solved).extremes():
        values = np.concatenate([side[found.name] for side in sides])
        size = np.abs(values).max()
        assert found.most == pytest.approx(values.max(), abs=1e-6 * size)
        assert found.least == pytest.approx(values.min(), abs=1e-6 * size)
    assert {found.name for found in CamCourse(solved).extremes()} == {"s", "v", "a", "theta"}


def test_json_has_jumps_with_both_limits_and_si() -> None:
    data = swept(positions=12).to_json()

    assert len(data["columns"]["profile.x"]["value"]) == 12
    assert data["columns"]["s"]["unit"] == "m"
    assert [math.degrees(jump["at"]) for jump in data["jumps"]] == pytest.approx([36.0, 195.0])
    first = data["jumps"][0]
    assert first["before"] == pytest.approx(-2.0 * first["after"])  # A_2 = A_1 / 2
    assert data["undercut"] == []


def test_what_an_undercut_profile_loses_is_marked_in_the_csv_and_said() -> None:
    found = swept(set={"R_roller": "13 mm", "u": "0.2", "gamma_rise": "40 deg", "gamma_fall": "40 deg"})
    columns, cuts = columns_of(found), found.to_json()["undercut"]

    assert cuts
    marked = [
        float(phi) for phi, state in zip(columns["phi [°]"], [*columns.values()][-1], strict=True) if state != "ok"
    ]
    turns = [(math.radians(k) - cut["from"]) % math.tau < cut["to"] - cut["from"] for k in range(360) for cut in cuts]
    inside = np.reshape(turns, (360, len(cuts))).any(axis=1)
    assert marked == np.flatnonzero(inside).tolist()
    angles = re.findall(r"([\d.]+)°", "".join(line for line in found.table().splitlines() if "undercut" in line))
    ends = [math.degrees(cut[end]) for cut in cuts for end in ("from", "to")]
    assert [float(angle) for angle in angles] == pytest.approx(ends, abs=0.05)
    sharpest = re.findall(r"radius of curvature .*: ([\d.]+) mm at phi = ([\d.]+)°", found.table())
    least = [(end["value"] * 1e3, math.degrees(end["at"])) for end in found.to_json()["rho_min"].values()]
    assert [(float(rho), float(phi)) for rho, phi in sharpest] == [pytest.approx(end, rel=1e-4) for end in least]


def test_columns_follow_what_is_solved() -> None:
    for only in ("diagrams", "sizes"):
        columns = columns_of(swept(only=only, positions=8))
        assert ("pitch.x [mm]" in columns) == (only == "sizes")
        assert "a [m/s²]" in columns


def test_what_cams_have_not_is_refused_in_one_line_and_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run
) -> None:
    monkeypatch.chdir(tmp_path)
    for arguments in ("-o x.svg", "--points B", "--chords B", "--from 30deg", "--positions 2"):
        status, out, err = run("sweep", TASK, *arguments.split())
        assert (status, out, err.count("\n")) == (2, "", 1)
    with pytest.raises(InputError) as problem:
        swept().save(tmp_path / "a.csv", tmp_path / "a.svg")
    assert problem.value.key == "sweep-drawing"
    assert [*tmp_path.iterdir()] == []


def test_a_rocker_has_its_angle_and_columns_of_its_own() -> None:
    found = kulman.sweep(ROCKER, lang="en", positions=36)
    assert isinstance(found, CourseSweep)
    columns, rocker = columns_of(found), SolvedCam.of(found.case.solved).rocker

    assert rocker is not None
    psi, s = (np.array(columns[name], float) for name in ("psi [°]", "s [mm]"))
    assert s == pytest.approx(np.radians(psi) * rocker.profile.follower.unit * 1e3, rel=1e-9, abs=1e-9)
    assert psi.max() == pytest.approx(22.0)
    between = np.abs(curve(columns, "pitch_rocker") - curve(columns, "profile_rocker"))
    assert between == pytest.approx(np.full(36, 13e-3), rel=1e-9)
    assert "gamma_rocker [°]" in columns
    assert "pitch.x [mm]" not in columns
    assert "e-" not in found.table()
