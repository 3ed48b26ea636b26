"""The guide to marking and docs/seeds.md cannot rot: commands print what they show, statements are checked."""

from __future__ import annotations

import cmath
import json
import math
import re
from pathlib import Path
from typing import Any

import pytest

from kulman import check, solve
from kulman.docs import marking_tables, seeds_tables
from kulman.docs.refresh import language
from kulman.tests.support.commands import Run
from kulman.variants.marking.wording import mistake_texts

DOCS = Path(__file__).resolve().parents[2] / "docs"
SEEDS = (DOCS / "seeds.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", marking_tables.DOCUMENTS, ids=lambda path: path.name)
def test_the_guide_lists_every_mistake_in_the_words_of_reports_with_the_same_numbers(path: Path) -> None:
    def numbers(path: Path) -> list[str]:
        rows = re.findall(r"^\| (?:M\d+ )?.+? \| ([\d.,–]+ \| .*?) \|$", path.read_text(encoding="utf-8"), re.MULTILINE)
        return [re.sub(r"[^\d.|–]", "", row.replace(",", ".")) for row in rows]

    listed = re.findall(r"^\| (M\d+) (.+?) \|", path.read_text(encoding="utf-8"), re.MULTILINE)

    assert dict(listed) == mistake_texts(language(path))
    assert len(numbers(path)) == len(listed) + 10
    assert numbers(path) == numbers(path.with_name("marking.en.md"))


@pytest.mark.soak
def test_every_line_of_the_sources_is_marked_as_the_document_says() -> None:
    assert seeds_tables.filled(SEEDS) == SEEDS


def test_a_reason_stands_beside_what_is_not_right_and_what_deviates() -> None:
    rows = {}
    for task, columns in re.findall(r"<!-- (\S+): [\w, ]+ -->\n(.*?)<!-- end -->", SEEDS, re.DOTALL):
        for line in columns.splitlines()[2:]:
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            printed, right = (float(cell.split()[0].replace("−", "-")) for cell in cells[1:3])
            deviates = abs(printed - right) > 1e-3 * abs(right)
            rows[f"{task} {cells[0]}"] = set(cells[3:6]) != {"right"}, deviates, bool(cells[6])

    of_cam = [why for name, (_, deviates, why) in rows.items() if name.startswith("madi-cam") and deviates]
    assert len(rows) > 120
    assert [name for name, (wrong, deviates, why) in rows.items() if wrong and not why] == []
    assert [name for name, (wrong, deviates, why) in rows.items() if why and not wrong and not deviates] == []
    assert len(of_cam) > 10
    assert all(of_cam)


def test_the_sources_are_marked_as_the_guide_tells(run: Run) -> None:
    def printed(task: str, *options: str) -> dict[str, Any]:
        _, out, _ = run("check", task, "printed", "--json", *options)
        found: dict[str, Any] = json.loads(out)
        return found

    no_rule = printed("nau-slider-crank")  # explains the velocity plan
    assert no_rule["first_wrong"] == "V_BA"
    assert all("V_BA" not in candidate["explained"] for candidate in no_rule["mistakes"])

    turned = printed("madi-four-bar")  # both moments of the note
    first = turned["mistakes"][0]
    assert turned["first_wrong"] == "M_sum"
    assert "M60" in {*first["same"], *(mistake["id"] for mistake in first["mistakes"])}
    assert {"M_sum", "R_12_t"} <= {*first["explained"]}

    exact = printed("bertyaev-six-bar", "--preset", "cad")  # a length, and one number written twice
    wrong = [line["quantity"] for line in exact["lines"] if line["verdict"] not in ("right", "missing")]
    assert sorted(wrong) == ["epsilon_2", "epsilon_r_2", "l_O1K"]


def test_what_cannot_be_contradicts_its_own_page() -> None:
    along = cmath.rect(1.0, math.radians(199.5 + 180.0))  # from B to A, and the normal to it
    end = cmath.rect(80.0, math.radians(240)) + complex(3.5, 67.0) * along

    assert math.sqrt(80**2 + 58**2 - 2 * 80 * 58 * math.cos(math.radians(30))) == pytest.approx(42.0, abs=0.5)
    assert math.hypot(3.5, 67.0) == pytest.approx(67.1, abs=0.05)
    assert abs(end) == pytest.approx(59.0, abs=0.5)
    assert abs(end.imag) > 4.0


def test_the_plan_of_the_guide_is_drawn_at_another_angle() -> None:
    lines = check("nau-slider-crank").read("printed")[0].lines
    for name, degrees in (("V_B", 62.9), ("V_S2", 62.7), ("h_21", 61.5), ("R_03", 61.5)):
        value = lines[name].value or (lines[name].mm or 0.0) * 1e-3
        solved = {
            angle: solve("nau-slider-crank", "example", set={"phi": f"{angle} deg"}) for angle in (60, degrees, 66)
        }

        off = {angle: abs(value / (solution[name].value or 1.0) - 1.0) for angle, solution in solved.items()}
        assert off[degrees] < 0.002
        assert min(off, key=lambda angle: off[angle]) == degrees
