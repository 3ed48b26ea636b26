"""The charts of cams: tables, pictures, rows, JSON, arguments."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from kulman import cli
from kulman.plans.cams.chords import BETWEEN, NODES, S_MAX, convergence, robustness
from kulman.plans.hands.shaky import PRESETS
from kulman.plans.lab import cams as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.race import Effort
from kulman.variants.charts import cam as charts
from kulman.variants.charts.charts import Charts, chart

TASK = "madi-cam"
FEW = (12, 24, 48, 96)


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


@pytest.fixture(scope="module")
def made() -> Charts:
    with pytest.MonkeyPatch.context() as patch:
        quickened(patch)
        return chart(TASK, lang="en")


def quickened(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(contests, "ROUNDS", 1)
    patch.setattr(races, "BY_HAND", (12,))
    patch.setattr(races, "AT_ONCE", ())
    patch.setattr("kulman.variants.charts.charts.EFFORT", Effort((1, 10), 20))
    patch.setattr(charts, "robustness", partial(robustness, sections=(12,)))
    patch.setattr(charts, "convergence", partial(convergence, sections=FEW, drawn=(6, 18)))


def run(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as stopped:
        cli.main(["chart", TASK, *arguments])
    assert isinstance(stopped.value.code, int)
    return stopped.value.code, *capsys.readouterr()


def test_tables_name_what_they_show(made: Charts) -> None:
    table = made.table()

    assert [*made.charts] == ["sections", "accuracy", "stability"]
    for said in ("Error against the number of sections", "Speed against accuracy", "Stability of the diagrams"):
        assert said in table
    assert "on section lines" in table
    assert "both closed, %" in table


@pytest.mark.parametrize("language", ["uk", *(pytest.param(one, marks=pytest.mark.soak) for one in ("ru", "en"))])
def test_pictures_speak_every_language(made: Charts, language: str, tmp_path: Path) -> None:
    words = {
        "en": ("order", "on section lines", "both closed", "mean ordinates", "careful"),
        "uk": ("порядок", "на лініях поділу", "замкнено обидва", "похибка, частин ходу", "ретельна"),
        "ru": ("порядок", "на линиях деления", "замкнуты оба", "средние ординаты", "тщательная"),
    }[language]
    spoken, drawn = made.words.speaking(language), [*made.charts] if language == "uk" else ["sections", "stability"]

    shown = [text.get_text() for name in drawn for text in made[name].figure(spoken).findobj(match=_is_text)]
    said = " ".join(shown) + made.table(language)

    assert [word for word in words if word not in said] == []


def _is_text(artist: object) -> bool:
    return hasattr(artist, "get_text")


def test_rows_are_written_for_every_chart_and_read_back(made: Charts, tmp_path: Path) -> None:
    files = made.save(tmp_path / "a.csv")

    assert [path.name for path in files] == [f"a-{n}.csv" for n in ("sections", "accuracy", "stability")]
    with (tmp_path / "a-sections.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = made["sections"].found  # type: ignore[attr-defined]
    chosen = [r for r in rows if r["drawn_by"] == "exact" and r["jumps"] == NODES and r["quantity"] == S_MAX]
    assert [float(row["error [%]"]) for row in chosen] == pytest.approx(100.0 * found.errors[NODES, S_MAX])
    assert {row["drawn_by"] for row in rows} == {"exact", *PRESETS}


def test_pictures_are_the_same_twice_and_have_no_colour(made: Charts, tmp_path: Path) -> None:
    one = replace(made, charts={"stability": made["stability"]})
    (first,) = one.save(tmp_path / "a.svg")
    (second,) = one.save(tmp_path / "b.svg")

    text = first.read_text(encoding="utf-8")
    assert "<dc:date>" not in text  # by which pictures of another second would differ
    assert second.read_text(encoding="utf-8") == text
    colours = set(re.findall(r"#([0-9a-f]{6})\b", text))
    assert [colour for colour in colours if len({colour[:2], colour[2:4], colour[4:]}) > 1] == []


def test_json_holds_everything_in_parts(made: Charts) -> None:
    data = json.loads(json.dumps(made.to_json(), allow_nan=False))

    assert data["sections"]["orders"][NODES][S_MAX] == pytest.approx(2.0, abs=0.01)
    assert data["sections"]["orders"][BETWEEN][S_MAX] == pytest.approx(1.0, abs=0.15)
    assert data["stability"]["hands"]["normal"]["travel_error"]["both"] < 0.1
    assert {entry["kind"] for entry in data["accuracy"]["entries"]} == {"travel", "speed"}


def test_one_quantity_may_be_asked_for(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    quickened(monkeypatch)
    status, out, err = run(["--chart", "sections", "--quantities", "r_0_tangents"], capsys)

    assert (status, err) == (0, "")
    assert "r_0_tangents" in out
    assert "S_max_chord" not in out


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(["--chart", "depth"], id="chart"),
        pytest.param(["--chart", "sections", "--quantities", "V_B"], id="quantity"),
        pytest.param(["--set", "law=uniform", "--chart", "sections"], id="exact chords"),
        pytest.param(["-o", "chart.doc"], id="suffix"),
        pytest.param(["--hand", "shaky"], id="hand"),
    ],
)
def test_wrong_arguments_are_answered_in_one_line(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    quickened(monkeypatch)

    status, out, err = run(arguments, capsys)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert [*tmp_path.iterdir()] == []


def test_what_changes_nothing_is_said(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    quickened(monkeypatch)
    status, _, said = run(["--chart", "stability", "--positions", "12", "--tolerance", "5"], capsys)

    assert status == 0
    assert sorted(line.split("'")[1] for line in said.splitlines()) == ["positions", "tolerance"]


@pytest.mark.soak
def test_all_charts_are_made_with_their_full_effort(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["-o", str(tmp_path / "charts.pdf")], capsys)

    assert (status, out, err) == (0, f"{tmp_path / 'charts.pdf'}\n", "")
    assert len(re.findall(rb"/Type /Page\b", (tmp_path / "charts.pdf").read_bytes())) == 3
