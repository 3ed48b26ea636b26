"""docs/marking.md and docs/seeds.md cannot rot: commands print what they show, statements are checked."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import pytest

from kulman import check, cli, solve
from kulman.docs import refresh, seeds_tables
from kulman.tests.support.documents import run_here

DOCS = Path(__file__).resolve().parents[2] / "docs"
SEEDS = (DOCS / "seeds.md").read_text(encoding="utf-8")


def printed(capsys: pytest.CaptureFixture[str], task: str, *options: str) -> dict[str, Any]:
    """Return how the printed answers of a task are marked."""
    with pytest.raises(SystemExit):
        cli.main(["check", task, "printed", "--json", *options])
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_commands_of_the_guide_print_what_it_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)
    text = (DOCS / "marking.md").read_text(encoding="utf-8")

    assert refresh.refreshed(text, str(tmp_path)) == text


@pytest.mark.soak
def test_every_line_of_the_sources_is_marked_as_the_document_says() -> None:
    assert seeds_tables.filled(SEEDS) == SEEDS


def test_a_reason_stands_beside_what_is_not_right_and_what_deviates() -> None:
    rows, deviating = {}, {}
    for task, columns in re.findall(r"<!-- (\S+): [\w, ]+ -->\n(.*?)<!-- end -->", SEEDS, re.DOTALL):
        for line in columns.splitlines()[2:]:
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            rows[f"{task} {cells[0]}"] = (set(cells[3:6]) != {"right"}, bool(cells[6]))
            printed_number, right = (float(cell.split()[0].replace("−", "-")) for cell in cells[1:3])
            deviating[f"{task} {cells[0]}"] = abs(printed_number - right) > 1e-3 * abs(right)

    assert len(rows) > 120
    assert [name for name, (wrong, why) in rows.items() if wrong and not why] == []
    assert [name for name, (wrong, why) in rows.items() if why and not wrong and not deviating[name]] == []
    of_cam = [name for name in rows if name.startswith("madi-cam") and deviating[name]]
    assert len(of_cam) > 10
    assert all(rows[name][1] for name in of_cam)


def test_no_rule_explains_the_velocity_plan_of_the_guide(capsys: pytest.CaptureFixture[str]) -> None:
    found = printed(capsys, "nau-slider-crank")

    assert found["first_wrong"] == "V_BA"
    assert all("V_BA" not in candidate["explained"] for candidate in found["mistakes"])


def test_both_turned_moments_of_the_note_are_found(capsys: pytest.CaptureFixture[str]) -> None:
    found = printed(capsys, "madi-four-bar")

    first = found["mistakes"][0]
    assert found["first_wrong"] == "M_sum"
    assert {"M60"} <= {mistake["id"] for mistake in first["mistakes"]} | {*first["same"]}
    assert {"M_sum", "R_12_t"} <= {*first["explained"]}


def test_even_the_tolerance_of_a_computer_finds_a_length_and_one_number_written_twice(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = printed(capsys, "bertyaev-six-bar", "--preset", "cad")

    wrong = [line["quantity"] for line in found["lines"] if line["verdict"] not in ("right", "missing")]
    assert sorted(wrong) == ["epsilon_2", "epsilon_r_2", "l_O1K"]


def test_what_cannot_be_contradicts_its_own_page() -> None:
    along = math.radians(199.5 + 180.0)  # from B to A, and the normal to it
    a = 80.0 * complex(math.cos(math.radians(240)), math.sin(math.radians(240)))
    end = a + complex(3.5, 67.0) * complex(math.cos(along), math.sin(along))

    assert math.sqrt(80**2 + 58**2 - 2 * 80 * 58 * math.cos(math.radians(30))) == pytest.approx(42.0, abs=0.5)
    assert math.hypot(3.5, 67.0) == pytest.approx(67.1, abs=0.05)
    assert abs(end) == pytest.approx(59.0, abs=0.5)
    assert abs(end.imag) > 4.0


@pytest.mark.parametrize(("name", "degrees"), [("V_B", 62.9), ("V_S2", 62.7), ("h_21", 61.5), ("R_03", 61.5)])
def test_the_plan_of_the_guide_is_drawn_at_another_angle(name: str, degrees: float) -> None:
    answers = check("nau-slider-crank").read("printed")[0].lines[name]
    value = answers.value or (answers.mm or 0.0) * 1e-3

    def off(angle: float) -> float:
        solved = solve("nau-slider-crank", "example", set={"phi": f"{angle} deg"})
        return abs(value / (solved[name].value or 1.0) - 1.0)

    assert off(degrees) < 0.002
    assert min((60.0, degrees, 66.0), key=off) == degrees
