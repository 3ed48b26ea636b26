"""The command `chart` and the same from Python, of every subject: tables, pictures, CSV, JSON, wrong arguments."""

import csv
import json
import math
import re
import subprocess
import sys
import time
from dataclasses import replace
from functools import cache, partial
from itertools import combinations, pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text

from kulman import KulmanError, solve
from kulman.docs import refresh
from kulman.drawing.charts.cycle import Abscissa
from kulman.drawing.charts.paper import Label, put
from kulman.plans.cams.chords import NODES, S_MAX, convergence, robustness
from kulman.plans.gears.solve import RATIOS, USUAL, ScaleErrors, SolvedGear, compared, scale_errors
from kulman.plans.hands.shaky import PRESETS, Hand
from kulman.plans.hoist.forces import choose
from kulman.plans.lab.hoists import step_limits
from kulman.plans.lab.integrators import STEPPERS
from kulman.plans.lab.race import Effort
from kulman.plans.lab.ropes import depth
from kulman.plans.linkages.limits import Arc
from kulman.scales.errors import LANGUAGES, PositionError
from kulman.tests.support.commands import Run
from kulman.tests.support.documents import run_here
from kulman.variants.charts.charts import Charts, chart

TASK, CAM, GEAR, HOIST = "nau-slider-crank", "madi-cam", "madi-gear", "karpenko-hoist"
BOTH = ("stability", "depth")
# times measured on little work, drawn by hand on one format only, few places looked at
LITTLE = {
    "kulman.variants.charts.charts.EFFORT": Effort((1, 10), 20),
    "kulman.plans.lab.race.ROUNDS": 1,
    "kulman.variants.charts.linkage.SIZES": ("A4",),
    "kulman.plans.lab.cams.BY_HAND": (12,),
    "kulman.plans.lab.cams.AT_ONCE": (),
    "kulman.variants.charts.cam.robustness": partial(robustness, sections=(12,)),
    "kulman.variants.charts.cam.convergence": partial(convergence, sections=(12, 24, 48, 96), drawn=(6, 18)),
    "kulman.plans.lab.hoists.STEPS": (0.4, 0.2),
    "kulman.plans.lab.hoists.TINY": (),
    "kulman.variants.charts.hoist.step_limits": partial(
        step_limits, steps=(4.0, 2.4, 0.32, 0.16, 0.08), tiny=(0.01, 0.005)
    ),
    "kulman.variants.charts.hoist.depth": partial(depth, masses=(1, 4), ratios=(1e-3, 1e-2, 1e-1)),
    "kulman.variants.charts.hoist.choose": partial(choose, places=16),
}


@pytest.fixture(autouse=True)
def little(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Work in an empty folder, with little effort."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")
    for place, value in LITTLE.items():
        monkeypatch.setattr(place, value)


@cache
def made(task: str) -> Charts:
    return chart(task, "V03" if task == HOIST else None, positions=6 if task == TASK else None, lang="en")


def only(task: str, *names: str) -> Charts:
    return replace(made(task), charts={name: made(task)[name] for name in names})


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


TOLD = {  # in the tables
    TASK: r"^Speed against accuracy|^Stability over the cycle|^Depth of the model|plans, float32 +20|Python 3"
    r"|^hand +A4 |without F_i2 +\d|needed at 1 %: F_i2, M_i2, F_i3",
    CAM: "^Error against the number of sections|^Stability of the diagrams|on section lines|both closed",
    HOIST: "orders and limits of stability|0: always grows|Nearly triple root|rigid bridge|loop tries",
}
SAID = {
    (TASK, "en"): ("condition K", "without $F", "tolerance 1 %", "dead position of link 3", "0.01", "Velocities"),
    (TASK, "uk"): ("обумовленість K", "без $F", "допуск 1 %", "мертве положення ланки 3", "0,01", "розширена"),
    (TASK, "ru"): ("обусловленность K", "без $F", "допуск 1 %", "мёртвое положение звена 3", "0,01"),
    (CAM, "en"): ("order", "on section lines", "both closed", "mean ordinates", "careful"),
    (CAM, "uk"): ("порядок", "на лініях поділу", "замкнено обидва", "похибка, частин ходу", "ретельна"),
    (CAM, "ru"): ("порядок", "на линиях деления", "замкнуты оба", "средние ординаты", "тщательная"),
    (HOIST, "en"): ("relative error of t₁", "RK4: order", "Illinois", "at the drum", "place of the drum"),
    (HOIST, "uk"): ("відносна похибка t₁", "РК4: порядок", "Іллінойс", "біля барабана", "місце барабана"),
    (HOIST, "ru"): ("относительная погрешность t₁", "РК4: порядок", "Иллинойс", "у барабана", "место барабана"),
}
DEFAULT = ((TASK, "uk"),)


@pytest.mark.parametrize(
    ("task", "language"), [pytest.param(*key, marks=() if key in DEFAULT else pytest.mark.soak) for key in SAID]
)
def test_pictures_and_tables_speak_every_language(task: str, language: str) -> None:
    spoken = made(task).words.speaking(language)
    figures = [one.figure(spoken) for one in made(task).charts.values()]
    for figure in figures:
        figure.draw_without_rendering()  # now axes have their numbers
    said = " ".join(text.get_text() for figure in figures for text in figure.findobj(match=Text))
    assert [word for word in SAID[task, language] if word not in said + made(task).table(language)] == []
    assert [words for words in TOLD[task].split("|") if not re.search(words, made(task).table(), re.MULTILINE)] == []
    assert "normal" not in said or language == "en"


@pytest.mark.parametrize("task", [TASK, *(pytest.param(task, marks=pytest.mark.soak) for task in (CAM, HOIST))])
def test_pictures_name_what_they_show_and_headings_have_their_place(task: str) -> None:
    words = made(task).words.speaking("en")
    for name, one in made(task).charts.items():
        figure = one.figure(words)
        figure.draw_without_rendering()
        inside = [text for axes in figure.axes for text in axes.get_children() if isinstance(text, Text)]
        above, boxes = ([t.get_window_extent() for t in texts if t.get_text()] for texts in (figure.texts, inside))
        scales = {axes: [label.get_text() for label in axes.get_yticklabels()] for axes in figure.axes}
        left = min(filter(scales.get, scales), key=lambda axes: (axes.get_position().x0, -axes.get_position().y0))
        named = left.get_ylabel() or re.search("[A-Za-z]", "".join(scales[left]))

        assert not [name for first, second in product(above, boxes) if first.overlaps(second)]
        assert all(box.y0 >= 0.0 and box.y1 <= figure.bbox.height for box in (*above, *boxes)), name
        assert named or (task, name) == (TASK, "stability"), name
    if task == HOIST:
        assert f"{made(task).to_json()['roots']['own']['root']:.7g}" in made(task).table()


def test_data_mark_what_no_other_beats_in_both_speed_and_accuracy() -> None:
    entries = [one for one in made(TASK).to_json()["accuracy"]["entries"] if None not in (one["seconds"], one["error"])]

    def beaten(one: dict[str, Any]) -> bool:
        like = [other for other in entries if other["kind"] == one["kind"]]
        return any(other["seconds"] < one["seconds"] and other["error"] < one["error"] for other in like)

    front = [one for one in entries if one["front"]]
    assert {one["kind"] for one in front} == {one["kind"] for one in entries}
    assert not any(map(beaten, front))


def test_a_hand_stands_above_the_times_of_the_others() -> None:
    accuracy = made(TASK)["accuracy"]
    axes = accuracy.figure(made(TASK).words.speaking("uk")).axes
    bands = [one for one in axes if [text for text in one.texts if text.get_text() == "рука: A4"]]
    times = [one for one in axes if one.get_ylabel() == "час на положення, с"]
    assert len(bands) == len(times) == len({entry.kind for entry in accuracy.found.entries})
    for band, field in zip(bands, times, strict=True):
        assert not [*band.get_yticks()]
        assert band.get_position().y0 == pytest.approx(field.get_position().y1)
        assert band.get_xlim() == field.get_xlim()
        assert [text for text in field.texts if text.get_text()]  # points say what they are
    assert any("«звичайна»" in text.get_text().replace("\n", " ") for one in axes for text in one.texts)


@pytest.mark.soak
@pytest.mark.parametrize(
    ("task", "name"),
    [
        (HOIST, "choice"),
        *((task, "stability") for task in (TASK, CAM)),
        (TASK, "depth"),
        (GEAR, "scale"),
    ],
)
def test_pictures_are_the_same_twice_and_have_no_colour(task: str, name: str, tmp_path: Path) -> None:
    one, suffixes = only(task, name), (".svg", ".pdf", ".png") if name == "depth" else (".svg",)

    first = one.save(*(tmp_path / f"a{suffix}" for suffix in suffixes))
    if name == "depth":
        time.sleep(1.1)
    second = one.save(*(tmp_path / f"b{suffix}" for suffix in suffixes))

    assert [path.read_bytes() for path in second] == [path.read_bytes() for path in first]
    text = first[0].read_text(encoding="utf-8")
    assert "<dc:date>" not in text  # by which pictures of another second would differ
    colours = set(re.findall(r"#([0-9a-f]{6})\b", text))
    assert colours > {"000000"}
    assert [colour for colour in colours if len({colour[:2], colour[2:4], colour[4:]}) > 1] == []


@pytest.mark.soak
@pytest.mark.parametrize("task", ["few", TASK, CAM])
def test_a_pdf_has_a_page_for_each_chart(task: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, run: Run) -> None:
    path, pages = tmp_path / "a.pdf", 2 if task == "few" else 3
    if task == "few":
        only(TASK, *BOTH).save(path)
    else:  # with their full effort
        monkeypatch.undo()
        assert run("chart", task, "--lang", "en", "-o", str(path)) == (0, f"{path}\n", "")
    assert len(re.findall(rb"/Type /Page\b", path.read_bytes())) == pages


def test_rows_are_written_for_every_chart_and_read_back(tmp_path: Path) -> None:
    for task in (TASK, CAM, HOIST):
        written = made(task).save(tmp_path / f"{task}.csv")
        assert [path.name for path in written] == [f"{task}-{name}.csv" for name in made(task).charts]
    rows = {path.stem.rpartition("-")[::2]: rows_of(path) for path in tmp_path.iterdir()}

    accuracy = rows[TASK, "accuracy"]
    entries = made(TASK)["accuracy"].found.entries
    assert [(row["method"], row["kind"], float(row["error"])) for row in accuracy] == [
        (entry.method, entry.kind, entry.error) for entry in entries
    ]
    assert {row["method"] for row in accuracy} >= {"plan", "plan-single", "newton", "differences", "chords", "hand"}
    assert all(row["seconds [s]"] == "" for row in accuracy if row["method"] == "hand")
    assert all("place [°]" in rows[TASK, name][0] for name in made(TASK).charts)
    assert "balance_max [%]" in rows[TASK, "depth"][0]
    sections = rows[CAM, "sections"]
    chosen = [row for row in sections if (row["drawn_by"], row["jumps"], row["quantity"]) == ("exact", NODES, S_MAX)]
    errors = made(CAM)["sections"].found.errors[NODES, S_MAX]
    assert [float(row["error [%]"]) for row in chosen] == pytest.approx(100.0 * errors)
    assert {row["drawn_by"] for row in sections} == {"exact", *PRESETS}
    told = re.findall(r"^(\d+) +(\w+), % +(.*)$", only(CAM, "stability").table(), re.MULTILINE)
    late = [row for row in rows[CAM, "stability"] if row["kind"] == "jump"]
    for n, name, numbers in told:  # five of the parts of a section
        of_line = [float(row["error [%]"]) for row in late if (row["sections"], row["quantity"]) == (n, name)]
        assert [float(part) for part in numbers.replace("−", "-").split()] == pytest.approx(of_line[::5], rel=5e-3)
    assert {(n, name) for n, name, _ in told} == {(row["sections"], row["quantity"]) for row in late}
    for language in ("uk", "en"):
        (path,) = replace(only(TASK, "stability"), words=made(TASK).words.speaking(language)).save(tmp_path / "a.csv")
        with path.open(encoding="utf-8-sig", newline="") as stream:
            head, *lines = csv.reader(stream, delimiter="," if language == "en" else ";")
        expected = made(TASK)["stability"].found.conditions["V_B"].tolist()
        assert [float(line[head.index("K_V_B")].replace(",", ".")) for line in lines] == expected
    refused = [row for row in rows[HOIST, "stability"] if row["refused"] == "1"]
    assert {float(row["step [rad]"]) for row in refused if row["method"] == "verlet"} == {4.0, 2.4}
    assert all(row["error"] == "" for row in refused)
    assert all(float(row["t [s]"]) > 0.0 for row in rows[HOIST, "accuracy"])
    assert len(rows[HOIST, "choice"]) == 16 * 16
    assert {row["kind"] for row in rows[HOIST, "depth"]} == {"simpler", "rope", "one_mass"}


def test_json_holds_everything_in_si(run: Run) -> None:
    status, out, _ = run("chart", TASK, "--chart", "stability,depth", "--positions", "8", "--json")
    printed = json.loads(out)
    linkage, cam, hoist = (json.loads(json.dumps(made(task).to_json(), allow_nan=False)) for task in (TASK, CAM, HOIST))

    assert (status, list(printed), printed["task"]) == (0, ["task", "variant", "stability", "depth"], TASK)
    velocity = printed["stability"]["quantities"]["V_B"]
    assert (len(velocity["condition"]), velocity["unit"]) == (8, "mm")
    assert printed["depth"]["needed"] == ["F_i2", "M_i2", "F_i3"]
    assert {cost["without"] for cost in printed["depth"]["costs"]} >= {"F_i2", "inertia"}
    spots = made(TASK)["stability"].found.spots
    assert len(spots) > 1
    told = [(spot["kind"], spot["link"]) for spot in linkage["stability"]["spots"]]
    assert told == [(spot.kind, spot.link) for spot in spots]  # each once
    places = linkage["accuracy"]["places"] + linkage["stability"]["places"]
    items = (*linkage["accuracy"]["entries"], *linkage["stability"]["spots"], *linkage["depth"]["costs"])
    assert all(0.0 <= place < math.tau for place in (*places, *(item["at"] for item in items)))
    assert cam["sections"]["orders"][NODES][S_MAX] == pytest.approx(2.0, abs=0.01)
    assert cam["stability"]["hands"]["normal"]["travel_error"]["both"] < 0.1
    assert {entry["kind"] for entry in cam["accuracy"]["entries"]} == {"travel", "speed"}
    methods = hoist["stability"]["methods"]
    orders = {"rk4": 4, "verlet": 2, "trapezoid": 2, "symplectic": 2, "euler": 1}
    assert {name: round(methods[name]["order"]) for name in STEPPERS} == orders
    assert hoist["roots"]["triple"]["methods"]["secant"]["error"] is None
    assert hoist["depth"]["enough_to"] > hoist["depth"]["ratio"]
    assert hoist["choice"]["trials"][-1]["safety"] >= hoist["choice"]["safety_required"]
    assert {entry["kind"] for entry in hoist["accuracy"]["entries"]} == {"lift_off", "course", "peak"}


def test_a_chart_that_the_task_cannot_have_is_left_out_with_a_word(run: Run) -> None:
    said = "the chart of the model's depth needs the plan of forces or the lever\n"
    assert run("chart", TASK, "--only", "velocity", "--positions", "6", "--chart", "depth") == (2, "", said)
    rigid = chart(HOIST, set={"I_0": "inf"}, lang="en")  # without phase 1
    assert [*rigid.charts] == ["depth", "choice"]
    assert {warning.key for warning in rigid.warnings} == {"chart-hoist-rigid"}


@pytest.mark.parametrize("plans", ["structure", "position", "velocity"])
def test_few_plans_have_their_stability(plans: str, run: Run) -> None:
    status, out, err = run("chart", TASK, "--only", plans, "--chart", "stability", "--positions", "6")
    assert (status, err) == (0, "")
    assert "worst intersection" in out


@pytest.mark.parametrize(
    ("task", "arguments", "told"),
    [
        pytest.param(TASK, ["--chart", "speed"], "accuracy", id="chart"),
        pytest.param(CAM, ["--chart", "depth"], "sections", id="chart of another subject"),
        pytest.param(TASK, ["--quantities", "V_X"], "V_X", id="quantity"),
        pytest.param(TASK, ["--quantities", "B"], "B", id="point"),
        pytest.param(CAM, ["--chart", "sections", "--quantities", "V_B"], "V_B", id="quantity of a cam"),
        pytest.param(CAM, ["--set", "law=uniform", "--chart", "sections"], "", id="exact chords"),
        pytest.param(TASK, ["--chart", "accuracy", "--quantities", "V_BA", "--positions", "4"], "none", id="no rivals"),
        pytest.param(TASK, ["--positions", "2"], "2", id="two positions"),
        pytest.param(TASK, ["--positions", "many"], "many", id="no number"),
        pytest.param(TASK, ["--tolerance", "little"], "little", id="tolerance"),
        pytest.param(TASK, ["--tolerance", "-1"], "-1", id="negative"),
        pytest.param(TASK, ["--hand", "shaky"], "careful", id="hand"),
        pytest.param(TASK, ["-o", "chart.doc"], ".svg", id="suffix"),
        pytest.param(TASK, ["-o", "missing/chart.svg"], "missing", id="folder"),
        pytest.param(TASK, ["--set", "l_XY=5"], "l_XY", id="given"),
        pytest.param(TASK, ["--lang", "de"], "de", id="language"),
    ],
)
def test_wrong_arguments_are_answered_in_one_line(task: str, arguments: list[str], told: str, run: Run) -> None:
    status, out, err = run("chart", task, *arguments)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert told in err
    assert list(Path().iterdir()) == []


@pytest.mark.parametrize(
    ("task", "arguments", "key"),
    [
        (TASK, {"chart": 3}, "argument-type"),
        (TASK, {"positions": "9"}, "argument-type"),
        (TASK, {"positions": 100_001}, "positions-number"),
        (TASK, {"tolerance": None}, "argument-type"),
        (TASK, {"tolerance": float("nan")}, "negative"),
        (TASK, {"hand": 1}, "argument-type"),
        (TASK, {"quantities": [1]}, "argument-type"),
        (GEAR, {"quantities": "g_alpha"}, "quantity-unknown-like"),  # calculated, not drawn
        (GEAR, {"only": "sliding"}, "chart-no-meshing"),
        (HOIST, {"set": {"I_0": "inf"}, "chart": "stability"}, "chart-hoist-rigid"),
        (HOIST, {"variant": "V10", "set": {"I_0": 1e-6, "V_0": 0.5}, "chart": "accuracy"}, "chart-hoist-one-sided"),
    ],
)
def test_what_python_asks_for_in_vain_is_refused(task: str, arguments: dict[str, object], key: str) -> None:
    with pytest.raises(KulmanError) as problem:
        chart(task, **arguments)  # type: ignore[arg-type]
    assert problem.value.key == key


def test_a_mechanism_that_never_assembles_has_status_3(run: Run) -> None:
    status, out, err = run("chart", "scheme-03-crank-rocker", "--set", "l_AB=9000")
    assert (status, out, err.count("\n")) == (3, "", 1)
    assert "any position of the crank" in err


def test_a_crank_that_cannot_turn_round_or_hardly_moves_has_its_charts() -> None:
    bound = chart(TASK, set={"l_AB": "20 mm"}, chart=BOTH, positions=24, lang="en")
    texts = [text.get_text() for text in bound["stability"].figure(bound.words).findobj(match=Text)]
    task, moving, still = "scheme-03-crank-rocker", "10 mm", "0.2 mm"  # couplers: it moves by some degrees, by none
    hardly = chart(task, "0", set={"l_AB": moving}, chart=("stability",)).charts["stability"].to_json()

    assert "limit" in bound.table()
    assert "cannot be assembled" in bound.table()
    assert any("limit" in text for text in texts)
    assert 0 < hardly["statuses"].count("ok") < 60
    assert any(mm is not None for item in hardly["quantities"].values() for mm in item["miss"])
    with pytest.raises(PositionError, match="cannot be assembled"):
        chart(task, "0", set={"l_AB": still}, chart=("stability",))


def test_what_the_document_shows_is_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
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
    found = only(TASK, "depth")
    assert found._repr_html_().count("<table") == 1
    assert found._repr_html_().startswith('<img src="data:image/svg+xml;base64,')
    assert repr(found) == f"<Charts {TASK} {made(TASK).case.variant}: depth>"


def test_no_file_is_written_when_one_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "b-depth.csv").mkdir()
    with pytest.raises(KulmanError):
        only(TASK, *BOTH).save(tmp_path / "a.csv", tmp_path / "b.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["b-depth.csv"]


@pytest.mark.parametrize(
    ("task", "asked", "unused"),
    [
        (TASK, ["--chart", "depth", "--quantities", "V_B", "--hand", "cad"], ["quantities", "hand"]),
        (TASK, ["--chart", "depth", "--tolerance", "5"], []),
        (TASK, ["--chart", "stability", "--quantities", "V_B", "--tolerance", "5"], ["tolerance"]),
        (TASK, ["--chart", "stability,depth", "--quantities", "V_B", "--tolerance", "5"], []),
        (CAM, ["--chart", "stability", "--tolerance", "5"], ["tolerance", "positions"]),
    ],
)
def test_what_changes_nothing_on_a_chart_is_said(task: str, asked: list[str], unused: list[str], run: Run) -> None:
    status, _, said = run("chart", task, *asked, "--positions", "12", "--lang", "en")
    assert status == 0
    named = [line.partition(" changes nothing")[0] for line in said.splitlines() if "changes nothing" in line]
    assert named == [f"--{name}" for name in unused]


@pytest.fixture(scope="module")
def gear() -> SolvedGear:
    return SolvedGear.of(solve(GEAR).solved)


@pytest.fixture(scope="module")
def errors(gear: SolvedGear) -> ScaleErrors:
    return scale_errors(gear, {name: preset.hand for name, preset in PRESETS.items()})


def test_errors_of_marks_fall_as_the_drawing_grows_and_those_of_directions_stay(gear: SolvedGear) -> None:
    hands, names = (
        {"marks": Hand(0.2, 0.0, 0.2), "directions": Hand(0.0, 0.5, 0.0)},
        ("g_alpha_drawn", "phi_alpha1_drawn"),
    )

    found = scale_errors(gear, hands, names).errors

    for name in names:
        # the same errors at every scale: in millimetres of paper they are worth less the larger the drawing
        assert np.allclose(found["marks", name] * RATIOS, found["marks", name][-1] * RATIOS[-1], rtol=0.06)
        assert np.allclose(found["directions", name], found["directions", name][0], rtol=1e-9)
    assert "g_alpha_drawn" in compared(gear)
    assert "g_alpha" not in compared(gear)


def test_better_hands_err_less_at_every_scale_and_the_smallest_that_is_enough_is_named(errors: ScaleErrors) -> None:
    name = "epsilon_alpha_drawn"
    enough = errors.enough("normal", name, 0.05)
    assert errors.quantities == USUAL
    for quantity in USUAL:
        columns = [errors.errors[hand, quantity] for hand in ("cad", "careful", "normal", "lenient")]
        assert all(np.all(a < b) for a, b in pairwise(columns))
        assert all(np.all(np.diff(column) < 0.0) for column in columns)
    kept = [ratio for ratio, error in zip(RATIOS, errors.errors["normal", name].tolist(), strict=True) if error <= 0.05]
    assert enough == kept[0]
    assert errors.enough("normal", name, 0.0) is None


def test_letters_of_curves_stand_clear_of_one_another_within_the_chart_of_choice() -> None:
    for language in LANGUAGES:
        figure = made(HOIST)["choice"].figure(made(HOIST).words.speaking(language))
        figure.draw_without_rendering()
        _, curves = (axes for axes in figure.axes if len(axes.lines))
        boxes = [text.get_window_extent() for text in curves.texts]

        assert len(boxes) >= 6
        assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
        assert all(box.x1 < curves.get_window_extent().x1 for box in boxes)
        assert [text.get_text() for text in curves.get_legend().get_texts()]


def test_labels_stand_at_their_points_with_room_between_them() -> None:
    accuracy = made(TASK)["accuracy"]
    places = {(entry.error, entry.seconds) for entry in accuracy.found.entries}
    figure = Figure(figsize=(8.0, 4.0))
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(xlim=(0.0, 10.0), ylim=(0.0, 10.0))

    put(axes, [Label(x, 5.0, "label", (0, 1)) for x in (4.0, 4.6, 4.7)], [(x, 5.0) for x in (4.0, 4.6, 4.7)])

    boxes = [text.get_window_extent() for text in axes.texts]
    assert [text.get_position()[0] for text in axes.texts[:2]] == pytest.approx(
        [0.0, 0.0]
    )  # each right above its point
    assert len(boxes) == 3
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    for field in accuracy.figure(made(TASK).words).axes:
        assert {text.xy for text in field.texts if isinstance(text, Annotation)} <= places


@pytest.mark.parametrize(
    ("turns", "arc", "shown"),
    [
        *((True, (100.0, 200.0), [(100.0, 200.0)]), (True, (300.0, 420.0), [(300.0, 360.0), (0.0, 60.0)])),
        *((True, (90.0, 450.0), [(0.0, 360.0)]), (False, (2.0, 5.0), [(2.0, 5.0)])),
    ],
)
def test_where_a_driver_cannot_go_is_cut_at_the_end_of_a_turn_only(
    turns: bool, arc: tuple[float, float], shown: list[tuple[float, float]]
) -> None:
    low, high = (math.radians(end) if turns else end / 1e3 for end in arc)

    stretches = [*Abscissa("", turns, (Arc(low, high),)).stretches()]

    assert stretches == [pytest.approx(ends) for ends in shown]


@pytest.mark.parametrize(("turns", "ends"), [(True, (0.0, 360.0)), (False, (20.0, 75.0))])
def test_a_field_shows_a_turn_or_all_travels(turns: bool, ends: tuple[float, float]) -> None:
    axes = Figure().add_subplot()

    Abscissa("", turns, ()).limit(axes, np.array([50.0, 20.0, 75.0]))

    assert axes.get_xlim() == ends
