"""The charts of hoists: tables, pictures, rows, JSON, arguments, hoists that cannot have them."""

from __future__ import annotations

import csv
import json
import re
from functools import partial
from pathlib import Path

import pytest
from matplotlib.text import Text

from kulman import cli
from kulman.plans.hoist.forces import choose
from kulman.plans.lab import hoists as races
from kulman.plans.lab import race as contests
from kulman.plans.lab.hoists import step_limits
from kulman.plans.lab.integrators import STEPPERS
from kulman.plans.lab.race import Effort
from kulman.plans.lab.ropes import depth
from kulman.scales.errors import InputError
from kulman.variants.charts import hoist as charts
from kulman.variants.charts.charts import Charts, chart

TASK = "karpenko-hoist"
NAMES = ("accuracy", "stability", "roots", "depth", "choice")


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


@pytest.fixture(scope="module")
def made() -> Charts:
    with pytest.MonkeyPatch.context() as patch:
        quickened(patch)
        return chart(TASK, "V03", lang="en")


def quickened(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(contests, "ROUNDS", 1)
    patch.setattr(races, "STEPS", (0.4, 0.2))
    patch.setattr(races, "TINY", ())
    patch.setattr("kulman.variants.charts.charts.EFFORT", Effort((1, 10), 10))
    patch.setattr(charts, "step_limits", partial(step_limits, steps=(4.0, 2.4, 0.32, 0.16, 0.08), tiny=(0.01, 0.005)))
    patch.setattr(charts, "depth", partial(depth, masses=(1, 4), ratios=(1e-3, 1e-2, 1e-1)))
    patch.setattr(charts, "choose", partial(choose, places=16))


def test_all_charts_of_a_hoist_are_made(made: Charts) -> None:
    table = made.table()

    assert [*made.charts] == [*NAMES]
    for said in (
        "orders and limits of stability",
        "0: always grows",
        "Nearly triple root",
        "rigid bridge",
        "loop tries",
    ):
        assert said in table


@pytest.mark.parametrize("language", ["uk", *(pytest.param(one, marks=pytest.mark.soak) for one in ("ru", "en"))])
def test_pictures_speak_every_language(made: Charts, language: str) -> None:
    words = {
        "en": ("relative error of t₁", "RK4: order", "Illinois", "at the drum", "place of the drum"),
        "uk": ("відносна похибка t₁", "РК4: порядок", "Іллінойс", "біля барабана", "місце барабана"),
        "ru": ("относительная погрешность t₁", "РК4: порядок", "Иллинойс", "у барабана", "место барабана"),
    }[language]
    spoken = made.words.speaking(language)

    shown = [text.get_text() for one in made.charts.values() for text in one.figure(spoken).findobj(match=Text)]

    assert [word for word in words if not any(word in text for text in shown)] == []


def test_rows_are_written_for_every_chart_and_read_back(made: Charts, tmp_path: Path) -> None:
    files = made.save(tmp_path / "a.csv")

    assert [path.name for path in files] == [f"a-{name}.csv" for name in NAMES]
    rows = {}
    for name in NAMES:
        with (tmp_path / f"a-{name}.csv").open(encoding="utf-8", newline="") as stream:
            rows[name] = list(csv.DictReader(stream))
    refused = {(row["method"], float(row["step [rad]"])) for row in rows["stability"] if row["refused"] == "1"}
    assert {step for method, step in refused if method == "verlet"} == {4.0, 2.4}
    assert all(row["error"] == "" for row in rows["stability"] if row["refused"] == "1")
    assert all(float(row["t [s]"]) > 0.0 for row in rows["accuracy"])
    assert len(rows["choice"]) == 16 * 16
    assert {row["kind"] for row in rows["depth"]} == {"simpler", "rope", "one_mass"}


def test_json_holds_everything(made: Charts) -> None:
    data = json.loads(json.dumps(made.to_json(), allow_nan=False))

    methods = data["stability"]["methods"]
    assert {name: round(methods[name]["order"]) for name in STEPPERS} == {
        "rk4": 4,
        "verlet": 2,
        "trapezoid": 2,
        "symplectic": 2,
        "euler": 1,
    }
    assert methods["trapezoid"]["stable"]
    assert methods["rk4"]["limit"] == pytest.approx(8.0**0.5, rel=1e-9)
    assert data["roots"]["triple"]["methods"]["secant"]["error"] is None
    assert data["depth"]["enough_to"] > data["depth"]["ratio"]
    assert data["choice"]["trials"][-1]["safety"] >= data["choice"]["safety_required"]
    assert {entry["kind"] for entry in data["accuracy"]["entries"]} == {"lift_off", "course", "peak"}


def test_pictures_have_no_colour(made: Charts, tmp_path: Path) -> None:
    (path,) = Charts(made.case, made.words, {"choice": made["choice"]}).save(tmp_path / "a.svg")

    colours = set(re.findall(r"#([0-9a-f]{6})\b", path.read_text(encoding="utf-8")))
    assert [colour for colour in colours if len({colour[:2], colour[2:4], colour[4:]}) > 1] == []


def test_tolerance_says_which_ropes_are_light_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    quickened(monkeypatch)
    fine, coarse = (
        chart(TASK, "V09", chart="depth", tolerance=part, lang="en")["depth"].found  # type: ignore[attr-defined]
        for part in (0.5, 2.0)
    )

    assert fine.enough_to < coarse.enough_to
    assert set(fine.spare) <= set(coarse.spare)


def test_rigid_support_has_only_charts_without_phase_1(monkeypatch: pytest.MonkeyPatch) -> None:
    quickened(monkeypatch)
    found = chart(TASK, set={"I_0": "inf"}, lang="en")

    assert [*found.charts] == ["depth", "choice"]
    assert {warning.key for warning in found.warnings} == {"chart-hoist-rigid"}
    with pytest.raises(InputError) as refused:
        chart(TASK, set={"I_0": "inf"}, chart="stability")
    assert refused.value.key == "chart-hoist-rigid"


def test_formulas_that_do_not_hold_have_no_rivals(monkeypatch: pytest.MonkeyPatch) -> None:
    quickened(monkeypatch)

    with pytest.raises(InputError) as refused:
        chart(TASK, "V10", set={"I_0": 1e-6, "V_0": 0.5}, chart="accuracy")

    assert refused.value.key == "chart-hoist-one-sided"


def test_unknown_chart_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        cli.main(["chart", TASK, "--chart", "sections"])

    assert stopped.value.code == 2
    assert "roots" in capsys.readouterr().err
