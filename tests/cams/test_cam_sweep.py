"""The command `sweep` of a cam: its table, the points of its profiles as CSV, extremes, what is refused."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman import cli
from kulman.plans.cams.course import CamCourse
from kulman.plans.cams.solve import SolvedCam
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.sweeps.swept import CourseSweep

TASK = "madi-cam"


def swept(**asked: object) -> CourseSweep:
    found = kulman.sweep(TASK, lang="en", **asked)  # type: ignore[arg-type]
    assert isinstance(found, CourseSweep)
    return found


def rows_of(text: str, delimiter: str = ",") -> tuple[list[str], list[list[str]]]:
    head, *rows = csv.reader(io.StringIO(text), delimiter=delimiter)
    return head, rows


def test_points_of_the_csv_are_those_of_the_profiles() -> None:
    found = swept(positions=24)
    head, rows = rows_of(found.csv())

    def column(name: str) -> np.ndarray:
        return np.array([float(row[head.index(name)]) for row in rows]) * 1e-3

    phi = np.radians(np.arange(24) * 15.0)
    solved = SolvedCam.of(found.case.solved)
    roller, plate = solved.roller, solved.plate
    assert roller is not None
    assert plate is not None
    for name, points in (
        ("pitch", roller.profile.pitch(phi)),
        ("profile", roller.profile.practical(phi)),
        ("profile_plate", plate.profile.practical(phi)),
    ):
        assert column(f"{name}.x [mm]") + 1j * column(f"{name}.y [mm]") == pytest.approx(points, rel=1e-12, abs=1e-15)
    between = np.hypot(
        column("pitch.x [mm]") - column("profile.x [mm]"), column("pitch.y [mm]") - column("profile.y [mm]")
    )
    assert between == pytest.approx(np.full(24, 7e-3), rel=1e-12)  # the roller's radius


def test_without_positions_files_have_every_degree_and_the_table_the_section_lines() -> None:
    found = swept()
    head, rows = rows_of(found.csv())
    table = found.table().split("\n\n")[0].splitlines()

    assert [float(row[head.index("phi [°]")]) for row in rows] == list(range(360))
    assert {row[-1] for row in rows} == {"ok"}
    assert len(table) == 1 + 26 + 2  # section lines, two of them with both limits
    assert [line.split()[3] for line in table if line.split()[1:2] == ["36"]] == ["20.6901"]


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


def test_json_has_jumps_with_both_limits_and_si(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        cli.main(["sweep", TASK, "--positions", "12", "--json"])

    data = json.loads(capsys.readouterr().out)
    assert stopped.value.code == 0
    assert len(data["columns"]["profile.x"]["value"]) == 12
    assert data["columns"]["s"]["unit"] == "m"
    assert [math.degrees(jump["at"]) for jump in data["jumps"]] == pytest.approx([36.0, 195.0])
    first = data["jumps"][0]
    assert first["before"] == pytest.approx(-2.0 * first["after"])  # A_2 = A_1 / 2
    assert data["undercut"] == []


def test_what_an_undercut_profile_loses_is_marked_in_the_csv_and_said() -> None:
    found = swept(set={"R_roller": "13 mm", "u": "0.2", "gamma_rise": "40 deg", "gamma_fall": "40 deg"})
    _, rows = rows_of(found.csv())
    cuts = found.to_json()["undercut"]

    assert cuts
    marked = {float(row[1]) for row in rows if row[-1] != "ok"}
    inside = {
        float(k)
        for k in range(360)
        for cut in cuts
        if (math.radians(k) - cut["from"]) % math.tau < cut["to"] - cut["from"]
    }
    assert marked == inside
    assert "undercut" in found.table()


@pytest.mark.parametrize("only", ["diagrams", "sizes"])
def test_columns_follow_what_is_solved(only: str) -> None:
    head, _ = rows_of(swept(only=only, positions=8).csv())

    assert ("pitch.x [mm]" in head) == (only == "sizes")
    assert "a [m/s²]" in head


@pytest.mark.parametrize("language", LANGUAGES)
def test_tables_and_files_speak_every_language(language: str) -> None:
    found = kulman.sweep(TASK, lang=language)
    word = {"en": "radius of curvature", "uk": "радіус кривини", "ru": "радиус кривизны"}[language]
    head, rows = rows_of(found.csv(), "," if language == "en" else ";")

    assert word in found.table()
    assert len(rows) == 360
    assert all(len(row) == len(head) for row in rows)


@pytest.mark.parametrize(
    "arguments",
    [["-o", "x.svg"], ["--points", "B"], ["--chords", "B"], ["--from", "30 deg"], ["--positions", "2"]],
    ids=" ".join,
)
def test_what_cams_have_not_is_refused_in_one_line(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    with pytest.raises(SystemExit) as stopped:
        cli.main(["sweep", TASK, *arguments])

    out, err = capsys.readouterr()
    assert (stopped.value.code, out, err.count("\n")) == (2, "", 1)
    assert [*tmp_path.iterdir()] == []


def test_nothing_is_written_when_one_file_is_a_drawing(tmp_path: Path) -> None:
    with pytest.raises(InputError) as problem:
        swept().save(tmp_path / "a.csv", tmp_path / "a.svg")

    assert problem.value.key == "cam-sweep-drawing"
    assert [*tmp_path.iterdir()] == []


def test_a_rocker_has_its_angle_and_columns_of_its_own() -> None:
    path = Path(kulman.__file__).parent / "docs" / "examples" / "rocker-cam.toml"
    found = kulman.sweep(path, lang="en", positions=12)
    assert isinstance(found, CourseSweep)
    head, rows = rows_of(found.csv())

    rocker = SolvedCam.of(found.case.solved).rocker
    assert rocker is not None
    psi = np.array([float(row[head.index("psi [°]")]) for row in rows])
    s = np.array([float(row[head.index("s [mm]")]) for row in rows])
    assert s == pytest.approx(np.radians(psi) * rocker.profile.follower.unit * 1e3, rel=1e-9, abs=1e-9)
    assert "gamma_rocker [°]" in head
    assert "pitch.x [mm]" not in head
    assert "e-" not in found.table()
