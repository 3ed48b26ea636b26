"""The command `chart` and the same from Python: tables, pictures, CSV, JSON, wrong arguments."""

from __future__ import annotations

import csv
import json
import math
import re
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from matplotlib.figure import Figure

from kulman import KulmanError, cli
from kulman.docs import refresh
from kulman.drawing.charts.cycle import _log, _lost, _widen
from kulman.drawing.charts.depth import equal
from kulman.drawing.words import Words
from kulman.plans.lab import race as contests
from kulman.plans.lab.race import Effort
from kulman.scales.errors import LANGUAGES, PositionError
from kulman.tests.support.documents import run_here
from kulman.variants.charts.charts import Charts, chart

TASK = "nau-slider-crank"
BOTH = ("stability", "depth")


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


def quickened(patch: pytest.MonkeyPatch) -> None:
    """Measure times on little work, draw by hand on one format only."""
    patch.setattr("kulman.variants.charts.charts.EFFORT", Effort((1, 10), 20))
    patch.setattr(contests, "ROUNDS", 1)
    patch.setattr("kulman.variants.charts.linkage.SIZES", ("A4",))


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    quickened(monkeypatch)


@pytest.fixture(scope="module")
def all_three() -> Charts:
    """Charts of six positions, measured on little work."""
    with pytest.MonkeyPatch.context() as patch:
        quickened(patch)
        return chart(TASK, positions=6, lang="en")


@cache
def pictures(language: str) -> dict[str, str]:
    """Return the charts of stability and depth as SVG, by their files."""
    with TemporaryDirectory() as folder:
        files = chart(TASK, chart=BOTH, positions=24, lang=language).save(Path(folder) / "a.svg")
        return {path.name: path.read_text(encoding="utf-8") for path in files}


def run(arguments: list[str], capsys: pytest.CaptureFixture[str], task: str = TASK) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as stopped:
        cli.main(["chart", task, *arguments])
    assert isinstance(stopped.value.code, int)
    return stopped.value.code, *capsys.readouterr()


@pytest.mark.usefixtures("quick")
def test_without_files_all_three_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["--positions", "6"], capsys)

    assert (status, err) == (0, "")
    assert [
        head for head in ("Speed against accuracy", "Stability over the cycle", "Depth of the model") if head not in out
    ] == []
    assert re.search(r"plans, float32 +20", out)
    assert re.search(r"^hand +A4 ", out, re.MULTILINE)
    assert re.search(r"without F_i2 +\d", out)
    assert re.search(r"needed at 1 %: F_i2, M_i2, F_i3", out)
    assert "Python 3" in out


@pytest.mark.usefixtures("quick")
def test_the_picture_of_accuracy_names_what_it_shows(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(["--chart", "accuracy", "--positions", "6", "-o", str(tmp_path / "x.svg")], capsys)

    assert (status, out.split()) == (0, [str(tmp_path / "x.svg")])
    text = (tmp_path / "x.svg").read_text(encoding="utf-8")
    assert [label for label in ("Velocities", "Forces", "float32", "hand: A4", "Python 3") if label not in text] == []


def test_a_hand_stands_above_the_times_of_the_others(all_three: Charts) -> None:
    entries = all_three["accuracy"].found.entries  # type: ignore[union-attr]

    axes = all_three["accuracy"].figure(all_three.words.speaking("uk")).axes

    bands = [one for one in axes if [text for text in one.texts if text.get_text() == "рука: A4"]]
    times = [one for one in axes if one.get_ylabel() == "час на положення, с"]
    assert len(bands) == len(times) == len({entry.kind for entry in entries})
    for band, field in zip(bands, times, strict=True):
        assert not [*band.get_yticks()]
        assert band.get_position().y0 == pytest.approx(field.get_position().y1)
        assert band.get_xlim() == field.get_xlim()
        assert "розширена" in [text.get_text() for text in field.texts]
    assert any("«звичайна»" in text.get_text().replace("\n", " ") for one in axes for text in one.texts)


@pytest.mark.parametrize("language", LANGUAGES)
def test_pictures_speak_every_language(language: str) -> None:
    words = {
        "en": ("condition K", "without $F", "tolerance 1 %", "dead position of link 3", "0.01"),
        "uk": ("обумовленість K", "без $F", "допуск 1 %", "мертве положення ланки 3", "0,01"),
        "ru": ("обусловленность K", "без $F", "допуск 1 %", "мёртвое положение звена 3", "0,01"),
    }[language]

    files = pictures(language)

    text = "".join(files.values())
    assert [*files] == ["a-stability.svg", "a-depth.svg"]
    assert [word for word in words if word not in text] == []
    if language != "en":
        assert "normal" not in chart(TASK, chart="stability", positions=6, lang=language).table()


def test_a_picture_of_depth_is_as_tall_as_its_rows_and_its_numbers_equally_precise() -> None:
    heights = {}
    for task in (TASK, "scheme-09-shaper"):
        found = chart(task, chart="depth", positions=12, lang="en")
        heights[task] = found["depth"].figure(found.words).get_figheight()
    words = Words.of("en", "nau")

    assert heights[TASK] < 0.75 * heights["scheme-09-shaper"]
    assert [equal(value, words) for value in (20.0, 2.6, 0.0409, 9.999, 345.0)] == [
        "20.0",
        "2.60",
        "0.0409",
        "10.0",
        "345",
    ]


@pytest.mark.parametrize(("low", "high"), [(2.1, 4.5), (0.5, 9.0), (1.2, 400.0)])
def test_short_logarithmic_axes_name_enough_numbers(low: float, high: float) -> None:
    axes = Figure().add_subplot()
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    _widen(axes)
    _log(axes, "K")

    least, most = axes.get_ylim()
    assert len([tick for tick in axes.get_yticks() if least <= tick <= most]) >= 3
    assert len(_lost(math.log10(least), math.log10(most))) >= 2


def test_pictures_are_the_same_twice(tmp_path: Path) -> None:
    def drawn(name: str, *suffixes: str) -> dict[str, bytes]:
        files = chart(TASK, chart=name, positions=24, lang="en").save(*(tmp_path / f"a-{name}{s}" for s in suffixes))
        return {path.name: path.read_bytes() for path in files}

    first = drawn("depth", ".pdf", ".png")
    svg = pictures("en")["a-stability.svg"]
    time.sleep(1.1)

    assert drawn("depth", ".pdf", ".png") == first
    assert drawn("stability", ".svg") == {"a-stability.svg": svg.encode("utf-8")}


def test_a_pdf_has_a_page_for_each_chart(tmp_path: Path) -> None:
    (path,) = chart(TASK, chart=BOTH, positions=12).save(tmp_path / "a.pdf")

    assert len(re.findall(rb"/Type /Page\b", path.read_bytes())) == 2


def test_a_picture_has_no_colour() -> None:
    colours = {colour for text in pictures("en").values() for colour in re.findall(r"#([0-9a-f]{6})\b", text)}

    assert colours > {"000000"}
    assert [colour for colour in colours if len({colour[:2], colour[2:4], colour[4:]}) > 1] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_csv_is_read_back(language: str, tmp_path: Path) -> None:
    found = chart(TASK, chart="stability", positions=12, quantities="V_B,M_bal", lang=language)
    (path,) = found.save(tmp_path / "a.csv")
    with path.open(encoding="utf-8-sig", newline="") as stream:
        head, *rows = csv.reader(stream, delimiter="," if language == "en" else ";")

    expected = found["stability"].found.conditions["V_B"]  # type: ignore[union-attr]
    column = head.index("K_V_B")
    assert len(rows) == 12
    assert [float(row[column].replace(",", ".")) for row in rows] == expected.tolist()


def test_json_names_every_special_place_once(all_three: Charts) -> None:
    found = all_three["stability"].found.spots  # type: ignore[attr-defined]

    spots = all_three["stability"].to_json()["spots"]

    assert len(found) > 1
    assert [(spot["kind"], spot["link"]) for spot in spots] == [(spot.kind, spot.link) for spot in found]


def test_all_rows_of_accuracy_are_in_the_csv(all_three: Charts, tmp_path: Path) -> None:
    path, *_ = all_three.save(tmp_path / "a.csv")
    with path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))

    entries = all_three["accuracy"].found.entries  # type: ignore[union-attr]
    assert path.name == "a-accuracy.csv"
    assert [(row["method"], row["kind"], float(row["error"])) for row in rows] == [
        (e.method, e.kind, e.error) for e in entries
    ]
    assert {row["method"] for row in rows} >= {"plan", "plan-single", "newton", "differences", "chords", "hand"}
    assert all(row["seconds [s]"] == "" for row in rows if row["method"] == "hand")


@pytest.mark.soak
def test_all_charts_are_measured_with_their_full_effort(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["-v", "3", "-o", str(tmp_path / "charts.pdf")], capsys)

    assert (status, out, err) == (0, f"{tmp_path / 'charts.pdf'}\n", "")
    assert len(re.findall(rb"/Type /Page\b", (tmp_path / "charts.pdf").read_bytes())) == 3


def test_json_holds_the_charts_in_si(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(["-v", "3", "--chart", "stability,depth", "--positions", "8", "--json"], capsys)

    data = json.loads(out)
    assert status == 0
    assert (data["task"], data["variant"]) == (TASK, "3")
    assert set(data) == {"task", "variant", "stability", "depth"}
    assert len(data["stability"]["quantities"]["V_B"]["condition"]) == 8
    assert data["stability"]["quantities"]["V_B"]["unit"] == "mm"
    assert data["depth"]["needed"] == ["F_i2", "M_i2", "F_i3"]
    assert {cost["without"] for cost in data["depth"]["costs"]} >= {"F_i2", "inertia"}


def test_places_have_units_in_csv_and_lie_within_a_turn_in_json(all_three: Charts) -> None:
    files = [one.data(all_three.words).csv() for one in all_three.charts.values()]
    heads = [file.split("\r\n")[0].split(",") for file in files]
    data = all_three.to_json()

    places = data["accuracy"]["places"] + data["stability"]["places"]
    places += [
        item["at"] for item in (*data["accuracy"]["entries"], *data["stability"]["spots"], *data["depth"]["costs"])
    ]
    assert all("place [deg]" in head for head in heads)
    assert "seconds [s]" in heads[0]
    assert "balance_max [%]" in heads[2]
    assert all(0.0 <= place < math.tau for place in places)


def test_a_chart_that_the_task_cannot_have_is_left_out_with_a_word(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--only", "velocity", "--positions", "6"]

    status, out, err = run([*arguments, "--chart", "depth"], capsys)
    assert (status, out) == (2, "")
    assert err == "the chart of the model's depth needs the plan of forces or the lever\n"


@pytest.mark.parametrize("plans", ["structure", "position", "velocity"])
def test_few_plans_have_their_stability(plans: str, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["--only", plans, "--chart", "stability", "--positions", "6"], capsys)

    assert (status, err) == (0, "")
    assert "worst intersection" in out


@pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(["--chart", "speed"], id="chart"),
        pytest.param(["--quantities", "V_X"], id="quantity"),
        pytest.param(["--quantities", "B"], id="point"),
        pytest.param(["--chart", "accuracy", "--quantities", "V_BA", "--positions", "4"], id="no rivals"),
        pytest.param(["--positions", "2"], id="two positions"),
        pytest.param(["--positions", "many"], id="no number"),
        pytest.param(["--tolerance", "little"], id="tolerance"),
        pytest.param(["--tolerance", "-1"], id="negative"),
        pytest.param(["--hand", "shaky"], id="hand"),
        pytest.param(["-o", "chart.doc"], id="suffix"),
        pytest.param(["-o", "missing/chart.svg"], id="folder"),
        pytest.param(["--set", "l_XY=5"], id="given"),
        pytest.param(["--lang", "de"], id="language"),
    ],
)
def test_wrong_arguments_are_answered_in_one_line(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    status, out, err = run(arguments, capsys)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "key"),
    [
        ({"chart": 3}, "argument-type"),
        ({"positions": "9"}, "argument-type"),
        ({"positions": 100_001}, "positions-number"),
        ({"tolerance": None}, "argument-type"),
        ({"tolerance": float("nan")}, "negative"),
        ({"hand": 1}, "argument-type"),
        ({"quantities": [1]}, "argument-type"),
    ],
)
def test_wrong_arguments_from_python_are_answered_in_one_line(arguments: dict[str, object], key: str) -> None:
    with pytest.raises(KulmanError) as problem:
        chart(TASK, **arguments)  # type: ignore[arg-type]

    assert problem.value.key == key


def test_a_mechanism_that_never_assembles_has_status_3(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["--set", "l_AB=9000"], capsys, "scheme-03-crank-rocker")

    assert (status, out, err.count("\n")) == (3, "", 1)
    assert "any position of the crank" in err


def test_a_crank_that_cannot_turn_round_has_its_charts(tmp_path: Path) -> None:
    found = chart(TASK, set={"l_AB": "20 mm"}, chart=BOTH, positions=24)

    assert "limit" in found.table()
    assert "cannot be assembled" in found.table()
    (svg, _) = found.save(tmp_path / "a.svg")
    assert "limit" in svg.read_text(encoding="utf-8")


def test_a_crank_that_hardly_moves_has_its_stability() -> None:
    task, moving, still = "scheme-03-crank-rocker", "10 mm", "0.2 mm"  # couplers: it moves by some degrees, by none

    found = chart(task, "0", set={"l_AB": moving}, chart=("stability",)).charts["stability"].to_json()

    assert 0 < found["statuses"].count("ok") < 60
    assert any(mm is not None for item in found["quantities"].values() for mm in item["miss"])
    with pytest.raises(PositionError, match="cannot be assembled"):
        chart(task, "0", set={"l_AB": still}, chart=("stability",))


def test_a_slider_that_drives_has_its_charts(tmp_path: Path) -> None:
    found = chart("scheme-18-hydraulic-drive", chart=BOTH, positions=24)

    assert all(path.stat().st_size > 10_000 for path in found.save(tmp_path / "a.svg"))
    assert "mm" in found.table().split("\n")[2]


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run_here(monkeypatch, capsys)
    blocks = refresh.BLOCK.findall((refresh.ROOT / "docs" / "accuracy.md").read_text(encoding="utf-8"))

    assert len(blocks) == 2
    for block in blocks:
        assert refresh.filled(block, str(tmp_path)) == block


def test_tables_need_no_picture() -> None:
    code = (
        "import sys\nfrom kulman.variants.charts.charts import chart\n"
        f"found = chart('{TASK}', chart='stability,depth', positions=6)\nfound.table(), found.to_json()\n"
        "print([name for name in ('matplotlib', 'mpmath', 'reportlab') if name in sys.modules])"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout == "[]\n"


def test_charts_show_themselves_in_a_notebook() -> None:
    found = chart(TASK, chart="depth", positions=12)

    assert found._repr_html_().startswith("<pre>Depth of the model")
    assert repr(found) == "<Charts nau-slider-crank 0: depth>"


def test_no_file_is_written_when_one_cannot_be(tmp_path: Path) -> None:
    found = chart(TASK, chart=BOTH, positions=12)
    (tmp_path / "b-depth.csv").mkdir()

    with pytest.raises(KulmanError):
        found.save(tmp_path / "a.csv", tmp_path / "b.csv")

    assert [path.name for path in tmp_path.iterdir()] == ["b-depth.csv"]


@pytest.mark.parametrize(
    ("asked", "unused"),
    [
        (["--chart", "depth", "--quantities", "V_B", "--hand", "cad"], ["quantities", "hand"]),
        (["--chart", "depth", "--tolerance", "5"], []),
        (["--chart", "stability", "--quantities", "V_B", "--tolerance", "5"], ["tolerance"]),
        (["--chart", "stability,depth", "--quantities", "V_B", "--tolerance", "5"], []),
    ],
)
def test_what_changes_nothing_on_a_chart_is_said(
    asked: list[str], unused: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    status, _, said = run([*asked, "--positions", "12", "--lang", "en"], capsys)

    assert status == 0
    assert [line.split("'")[1] for line in said.splitlines() if "changes nothing" in line] == unused
