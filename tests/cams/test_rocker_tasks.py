"""A task file of one's own about a cam with a rocker, from another folder: solved, marked, swept, refused in a line."""

from __future__ import annotations

import csv
import json
import math
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import kulman
from kulman import cli
from kulman.scales.errors import InputError

EXAMPLE = Path(kulman.__file__).parent / "docs" / "examples" / "rocker-cam.toml"
GIVEN_SIZES = 'l_OC = { unit = "mm" }\nr_0 = { unit = "mm" }\n'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copy(EXAMPLE, tmp_path / "mine.toml")
    text = EXAMPLE.read_text(encoding="utf-8").replace('l_OC = { unit = "mm" }\n', GIVEN_SIZES)
    (tmp_path / "sizes.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    return tmp_path


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as stopped:
        cli.main(list(arguments))
    said = capsys.readouterr()
    return int(stopped.value.code or 0), said.out, said.err


def solved(capsys: pytest.CaptureFixture[str], *settings: str, task: str = "mine.toml") -> dict[str, Any]:
    sets = [word for setting in settings for word in ("--set", setting)]
    status, out, _ = run(capsys, "solve", task, "--json", *sets)
    assert status == 0
    return dict(json.loads(out))


def test_the_example_has_no_faults(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "list", "--check", "mine.toml") == (0, "mine.toml: no faults\n", "")


@pytest.mark.parametrize(("name", "unit"), [("h", "mm"), ("e", "mm"), ("rho_flat", "mm"), ("margin", "mm")])
def test_a_number_that_no_rocker_has_is_a_fault_where_it_stands(
    folder: Path, capsys: pytest.CaptureFixture[str], name: str, unit: str
) -> None:
    lines = EXAMPLE.read_text(encoding="utf-8").split("\n")
    at = lines.index("[givens]") + 1
    lines.insert(at, f'{name} = {{ unit = "{unit}", default = 5 }}')
    (folder / "mine.toml").write_text("\n".join(lines), encoding="utf-8")

    status, out, _ = run(capsys, "list", "--check", "mine.toml")

    place = f"mine.toml:{at + 1}:1: givens.{name}"
    assert (status, out) == (2, f"{place}: no follower of this cam has a number '{name}': rocker\n")


@pytest.mark.parametrize(
    ("rotation", "limits"),
    [
        ("cw", "two-sided"),
        pytest.param("ccw", "two-sided", marks=pytest.mark.soak),
        pytest.param("ccw", "one-sided", marks=pytest.mark.soak),
        pytest.param("cw", "one-sided", marks=pytest.mark.soak),
    ],
)
def test_a_given_pivot_costs_radius_and_keeps_the_limits(
    folder: Path, capsys: pytest.CaptureFixture[str], rotation: str, limits: str
) -> None:
    words = f"rotation={rotation}", f"limits={limits}"
    free, given = solved(capsys, *words), solved(capsys, *words, "l_OC=140 mm")

    def value(found: dict[str, Any], name: str) -> float:
        return float(found["quantities"][name]["value"])

    assert value(given, "l_OC") == pytest.approx(0.14, rel=1e-12)
    assert value(given, "r_0") > value(free, "r_0")
    for found in (free, given):
        assert all(found["checks"][f"gamma_{phase}"]["ok"] for phase in ("rise", "fall"))
        assert found["warnings"] == []


def test_r_0_and_the_pivot_given_are_the_sides_of_the_triangle(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = solved(capsys, "r_0=50 mm", "l_OC=125 mm", task="sizes.toml")

    sizes = {name: found["quantities"][name]["value"] for name in ("r_0", "l_OC", "l_rocker")}
    assert sizes == pytest.approx({"r_0": 0.05, "l_OC": 0.125, "l_rocker": 0.11}, rel=1e-12)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (
            ("l_OC=70 mm",),
            "at l_OC = 70 mm no place of the cam's centre keeps gamma_fall; the smallest cam has l_OC = 117.28 mm",
        ),
        (
            ("psi=80 deg", "gamma_rise=75 deg", "gamma_fall=75 deg"),
            "no place of the cam's centre keeps gamma_rise, gamma_fall",
        ),
        (("r_0=50 mm",), "r_0 of a cam with a rocker is given together with l_OC"),
        (("r_0=14 mm", "l_OC=130 mm"), "l_rocker = 110 mm, l_OC = 130 mm and r_0 = 14 mm make no triangle"),
        (("R_roller=36 mm",), "the roller, 36 mm, is not smaller than r_0"),
    ],
)
def test_what_no_rocker_can_have_is_said_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str], settings: tuple[str, ...], said: str
) -> None:
    sets = [word for setting in settings for word in ("--set", setting)]

    status, out, err = run(capsys, "sheet", "sizes.toml", *sets, "-o", "no.svg")

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.startswith(said)
    assert not (folder / "no.svg").exists()


def test_an_undercut_profile_of_a_rocker_is_told_in_degrees(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = run(capsys, "solve", "mine.toml", "--set", "R_roller=34 mm")
    found = kulman.solve("mine.toml", set={"R_roller": "34 mm"})
    (cut,) = found.solved.rocker.profile.undercuts  # type: ignore[attr-defined]

    start, end, lost = (math.degrees(angle) for angle in (cut.start, cut.end, cut.lost))

    assert status == 0
    assert f"undercut: from {start:.4g}° to {end:.4g}° the rocker loses up to {lost:.3g}° of its swing" in err
    check = found.checks["undercut_rocker"]
    assert (check["ok"], check["unit"]) == (False, "rad")
    assert check["value"] == pytest.approx(cut.lost)


def test_the_form_asks_for_the_sizes_and_marks_right_answers(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = solved(capsys)["quantities"]
    assert run(capsys, "check", "mine.toml", "--form", "form.csv", "--lang", "en")[0] == 0
    rows = list(csv.reader((folder / "form.csv").read_text(encoding="utf-8-sig").splitlines()))
    head = next(row for row in rows if row[:1] == ["quantity"])
    asked = [row[0] for row in rows if row and row[0] in found]
    assert {"r_0", "l_OC", "rho_min", "gamma_rise_min"} <= set(asked)
    for row in rows:
        if row and row[0] in ("r_0", "l_OC", "rho_min"):
            row[head.index("value")] = repr(found[row[0]]["value"] * 1e3)  # the form asks for millimetres
        if row and row[0] == "variant":
            row[1] = "1"
    with (folder / "answers.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)

    _, out, _ = run(capsys, "check", "mine.toml", "answers.csv", "--json")

    lines = {line["quantity"]: line["verdict"] for line in json.loads(out)["lines"]}
    assert [name for name, verdict in lines.items() if verdict == "right"] == ["r_0", "l_OC", "rho_min"]


@pytest.mark.soak
def test_the_form_does_not_ask_for_a_given_pivot(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "check", "mine.toml", "-v", "2", "--form", "form.csv", "--lang", "en")[0] == 0

    names = [row[0] for row in csv.reader((folder / "form.csv").read_text(encoding="utf-8-sig").splitlines()) if row]

    assert "r_0" in names
    assert "l_OC" not in names


def test_the_sweep_writes_the_swing_and_the_profile(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "sweep", "mine.toml", "--positions", "36", "-o", "profile.csv", "--lang", "en")[0] == 0

    head, *rows = csv.reader((folder / "profile.csv").read_text(encoding="utf-8-sig").splitlines())

    table = {name: [row[k] for row in rows] for k, name in enumerate(head)}
    pitch, profile = (
        np.array([float(x) for x in table[f"{curve}.x [mm]"]])
        + 1j * np.array([float(y) for y in table[f"{curve}.y [mm]"]])
        for curve in ("pitch_rocker", "profile_rocker")
    )
    assert max(float(psi) for psi in table["psi [°]"]) == pytest.approx(22.0)
    assert np.abs(pitch - profile) == pytest.approx(np.full(36, 13.0), rel=1e-9)


def test_a_given_r_0_with_no_rocker_is_refused_from_python() -> None:
    with pytest.raises(InputError, match="no eccentricity keeps"):
        kulman.solve("madi-cam", set={"r_0": "40 mm"})


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        pytest.param('l_OC = "130 mm"', 'l_OC = "70 mm"', "at l_OC = 70 mm no place", id="pivot"),
        pytest.param(
            'R_roller = "14 mm"',
            'R_roller = "70 mm"',
            "the roller, 70 mm, is not smaller",
            id="roller",
            marks=pytest.mark.soak,
        ),
        pytest.param(
            'psi = "25 deg"', 'psi = "85 deg"', "no place of the cam's centre keeps", id="swing", marks=pytest.mark.soak
        ),
    ],
)
def test_a_rocker_that_nothing_permits_is_a_fault_of_its_variant(
    folder: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: str
) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    assert old in text
    (folder / "mine.toml").write_text(text.replace(old, new), encoding="utf-8")
    second = text[: text.rindex("[[variant]]")].count("\n") + 1

    status, out, err = run(capsys, "list", "--check", "mine.toml")

    assert (status, out.count("\n"), err.count("\n")) == (2, 1, 1)
    assert out.startswith(f"mine.toml:{second}:1: variant.2: ")
    assert said in out
    assert run(capsys, "solve", "mine.toml", "-v", "2")[0] == 2
    assert solved(capsys)["status"] == "ok"


def test_the_stroke_of_a_rocker_is_calculated_on_the_board() -> None:
    solved = kulman.solve(EXAMPLE).solved
    steps = {step.name: step for step in solved.program}

    assert (steps["h"].verb, steps["h"].law, steps["h"].operands) == ("calc", "arc_length", ("psi", "l_rocker"))
    assert "h" not in solved.givens
    assert solved.values["h"] == pytest.approx(solved.givens["psi"] * solved.givens["l_rocker"], rel=1e-15)
    assert kulman.solve(EXAMPLE, only="diagrams")["mu_s"].value == kulman.solve(EXAMPLE)["mu_s"].value
