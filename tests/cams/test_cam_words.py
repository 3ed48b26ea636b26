"""What people read of a cam: units, notes, messages; a machine reads SI."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path

import pytest

from kulman import cli, load_task, sheet, solve
from kulman.scales.errors import InputError
from kulman.tests.support.printed_numbers import lines_of
from kulman.tests.support.readback import read

TASK = "madi-cam"
ROCKER = str(Path(__file__).parents[2] / "docs" / "examples" / "rocker-cam.toml")


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[str, str]:
    with pytest.raises(SystemExit):
        cli.main(arguments)
    out, err = capsys.readouterr()
    return out, err


def unit_in(table: str, name: str) -> str:
    (line,) = [line.split() for line in table.splitlines() if line.split()[:1] == [name]]
    return line[2]


def new_cam(folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    file = str(folder / "mine.toml")
    run(capsys, "new", file, "--kind", "cam", "--lang", "en")
    return file


def test_angles_are_read_in_degrees_and_lengths_in_millimetres(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for task in (TASK, ROCKER, new_cam(tmp_path, capsys)):
        table = solve(task, lang="en").table()

        assert " rad\n" not in table
        assert {unit_in(table, name) for name in ("nu", "gamma_rise_min", "gamma_fall_min")} == {"°"}, task
        assert {unit_in(table, name) for name in ("r_0", "H_a", "H_v", "S_max_chord", "rho_min")} == {"mm"}, task
    assert unit_in(solve(ROCKER, lang="en").table(), "psi_0") == "°"
    assert re.search(r"^nu +27\.6365 +°$", solve(TASK, lang="en").table(), re.MULTILINE)


def test_machines_read_si(capsys: pytest.CaptureFixture[str]) -> None:
    out, _ = run(capsys, "solve", TASK, "--json")

    found = json.loads(out)["quantities"]["gamma_rise_min"]
    assert found == {"value": pytest.approx(math.radians(75.0)), "unit": "rad"}


def test_a_file_may_show_other_units(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = Path(new_cam(tmp_path, capsys))
    text = file.read_text(encoding="utf-8")

    file.write_text(text.replace("[givens]", '[display]\nlength = "cm"\nangle = "rad"\n\n[givens]'), encoding="utf-8")

    table = solve(str(file), lang="en").table()
    assert (unit_in(table, "r_0"), unit_in(table, "v_max"), unit_in(table, "nu")) == ("cm", "cm/s", "rad")


def test_a_form_asks_for_degrees_and_the_report_answers_in_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    form = tmp_path / "form.csv"
    run(capsys, "check", TASK, "--form", str(form), "--lang", "en")
    rows = {row[0]: row for row in csv.reader(form.read_text(encoding="utf-8-sig").splitlines()) if row}
    form.write_text("quantity,value\nnu,27.6\ngamma_rise_min,75\n", encoding="utf-8")

    out, _ = run(capsys, "check", TASK, str(form), "--lang", "en")

    assert rows["nu"][6] == rows["gamma_rise_min"][6] == "°"
    assert "27.6 °" in out
    assert "75 °" in out
    assert "rad" not in out.replace("radius", "")


def test_the_name_of_a_diagram_keeps_its_letter_in_a_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    form = tmp_path / "form.csv"
    form.write_text("quantity,value\nr_0_flat_min,55\n", encoding="utf-8")

    out, _ = run(capsys, "check", TASK, str(form), "--lang", "en")

    assert "First wrong step: r_0 pl min, S – d" in out


def test_the_pivot_of_a_rocker_is_a_segment_of_its_plan() -> None:
    assert solve(ROCKER)["l_OC"].mm == pytest.approx(117.28, abs=0.01)


@pytest.mark.parametrize("lang", ["uk", "ru", "en"])
def test_the_reconstructed_law_is_told_on_the_sheet_and_by_solve(lang: str) -> None:
    note = load_task(TASK).note[lang]
    read_back = read(sheet(TASK, only="diagrams", lang=lang).svg())

    assert note in " ".join(" ".join(lines_of(read_back["choices"])).split())
    assert solve(TASK, lang=lang).to_json()["note"] == note


def test_the_reconstructed_law_is_told_by_list_and_after_the_table(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    told = f"note: {load_task(TASK).note['en']}\n"

    assert f"    {told}" in run(capsys, "list")[0]
    assert run(capsys, "solve", TASK, "--only", "diagrams") == (solve(TASK, only="diagrams").table() + "\n", told)
    noted = [task["id"] for task in json.loads(run(capsys, "list", "--json")[0])["tasks"] if "note" in task]
    assert TASK in noted
    assert "note" not in json.loads(run(capsys, "solve", "nau-slider-crank", "--json")[0])


def test_a_linkage_may_have_a_note_on_its_sheet(tmp_path: Path) -> None:
    file = tmp_path / "press.toml"
    text = (Path(ROCKER).parent / "crank-press.toml").read_text(encoding="utf-8")
    table = "[note]\n" + "".join(f'{lang} = "a word {lang}"\n' for lang in ("uk", "ru", "en"))

    file.write_text(text.replace("[givens]", f"{table}\n[givens]", 1), encoding="utf-8")

    drawn = read(sheet(str(file), only="position", lang="en").svg())
    assert lines_of(drawn["note"]) == ["a word en"]


def test_the_scale_factor_of_angles_stays_in_radians() -> None:
    view = read(sheet(TASK, only="diagrams", lang="en").svg())["diagrams"]

    assert any("0.017453 rad/mm" in text.string for text in view.texts)


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("--set", "u_fall=0"), "u_fall: '0': must be greater than 0 and less than 1"),
        (("--set", "law_fall=sine"), "task madi-cam does not state law_fall, which a task of this kind may have: "),
        (("--set", "psi=20"), "task madi-cam does not state psi, which a task of this kind may have: "),
        (("--set", "Rroller=8"), "madi-cam has no given 'Rroller'; did you mean 'R_roller'?"),
        (
            ("--scale", "OA=80"),
            "'OA': no segment chooses a scale factor here; expected one of: mu_l, mu_s_ds, mu_s_d2s",
        ),
        (("--scale", "mu_x=3"), "task madi-cam has no scale factor 'mu_x'; did you mean 'mu_l'?"),
    ],
)
def test_what_cannot_be_set_is_explained(
    arguments: tuple[str, str], line: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")

    out, err = run(capsys, "solve", TASK, *arguments)

    assert out == ""
    assert err.startswith(line)
    assert err.count("\n") == 1


def test_the_fall_may_have_another_part() -> None:
    assert solve(TASK, set={"u_fall": 0.6})["mu_s"].value == solve(TASK)["mu_s"].value
    assert solve(TASK, set={"u_fall": 0.6})["r_0"].value != solve(TASK)["r_0"].value


def test_a_scale_factor_that_has_no_room_is_named() -> None:
    with pytest.raises(InputError, match=r"^mu_l = 0\.0001 m/mm: the plan has no room on A1; take a coarser scale"):
        sheet(TASK, scales={"mu_l": 0.0001}, only="profile")


def test_a_follower_that_is_pressed_to_one_side_alone_has_no_more_than_a_right_angle() -> None:
    assert solve(TASK, set={"e": 100})["gamma_rise_min"].value == pytest.approx(math.pi / 2)


def test_a_task_whose_source_prints_no_answers_says_so(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")

    assert run(capsys, "check", ROCKER, "printed") == ("", "the source of rocker-cam prints no answers\n")


def test_a_notebook_shows_the_note() -> None:
    assert f"<p>{load_task(TASK).note['en']}</p><pre>" in solve(TASK, lang="en", only="pressure")._repr_html_()
