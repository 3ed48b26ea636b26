"""The charts of cams: orders of chords, hands, lines beside jumps, closing, rivals; tables, pictures, arguments."""

from __future__ import annotations

import csv
import json
import re
import time
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman import cli
from kulman.plans import contest as contests
from kulman.plans.cams import rivals as races
from kulman.plans.cams.closing import BOTH, drift, stroke_closed
from kulman.plans.cams.convergence import BETWEEN, CLOSED, NODES, Convergence, convergence
from kulman.plans.cams.division import Division
from kulman.plans.cams.motion import Motion
from kulman.plans.cams.rivals import errors, in_extended, midpoint, on_lines, rivals, simpson
from kulman.plans.cams.robustness import late, robustness
from kulman.plans.cams.sectioned import R_0, S_MAX, V_MAX, drawn_on, exact_values
from kulman.plans.cams.solve import SolvedCam
from kulman.plans.contest import Contest, Effort
from kulman.plans.hands.hand import PRESETS, Hand, preset
from kulman.plans.hands.shaky import draw
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.charts import cam as charts
from kulman.variants.charts import cam_stability, sections
from kulman.variants.charts.charts import Charts, chart

TASK = "madi-cam"
STEADY = Hand(0.0, 0.0, 0.0)
FEW = (12, 24, 48, 96)


@pytest.fixture(autouse=True)
def english(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "en_GB.UTF-8")


@cache
def cam(law: str = "sawtooth", **settings: str) -> SolvedCam:
    solved = kulman.solve(TASK, set={"law": law, **settings}, only="sizes").solved
    assert isinstance(solved, SolvedCam)
    return solved


@cache
def chords(law: str, u: str = "1/3") -> Convergence:
    return convergence(cam(law, u=u), {}, sections=(24, 48, 96, 192), drawn=())


@cache
def race() -> Contest:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contests, "ROUNDS", 1)
        patch.setattr(races, "BY_HAND", (12,))
        patch.setattr(races, "AT_ONCE", (12,))
        return rivals(cam(), time.process_time, preset("normal").hand, Effort((1, 10), 20))


# Error against the number of sections


@pytest.mark.parametrize(("law", "u"), [("sawtooth", "1/3"), ("constant", "0.4"), ("sawtooth", "0.37")])
def test_chords_are_of_second_order_with_jumps_on_lines_and_of_first_between(law: str, u: str) -> None:
    found = chords(law, u)

    for quantity in (S_MAX, R_0):
        second, first = (found.order(where, quantity) for where in (NODES, BETWEEN))
        if law == "constant":  # its velocity is straight: chords find the stroke exactly
            assert second is None
        else:
            assert second == pytest.approx(2.0, abs=0.1)
        assert first == pytest.approx(1.0, abs=0.15)
    assert found.order(BETWEEN, V_MAX) == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("law", ["cosine", "sine", "modified-trapezoid", "polynomial-345"])
def test_laws_that_jump_at_the_ends_of_a_phase_only_are_of_second_order(law: str) -> None:
    found = chords(law)

    assert [*found.sections] == [NODES]
    for quantity in (V_MAX, S_MAX, R_0):
        assert found.order(NODES, quantity) == pytest.approx(2.0, abs=0.1)
    assert found.order(NODES, CLOSED) is None or found.order(NODES, CLOSED) > 1.9


def test_straight_accelerations_give_the_velocity_without_error() -> None:
    assert np.abs(chords("sawtooth").errors[NODES, V_MAX]).max() < 1e-14
    assert chords("sawtooth").order(NODES, V_MAX) is None


def test_a_hand_without_errors_draws_the_chords() -> None:
    found = convergence(cam(), {"steady": STEADY}, sections=(12, 24), drawn=(12, 24))

    for quantity in found.quantities:
        assert found.hands["steady", quantity] == pytest.approx(np.abs(found.errors[NODES, quantity]), abs=1e-12)


def test_a_better_hand_errs_less_and_takes_more_sections() -> None:
    found = convergence(cam(), {name: preset(name).hand for name in ("cad", "lenient")}, (S_MAX,), (12,), (6, 18, 72))

    closed = convergence(cam(), {"cad": preset("cad").hand}, (CLOSED,), (12,), (6, 18, 72))
    assert (closed.hands["cad", CLOSED] < 0.5 * found.hands["cad", S_MAX]).all()
    cad, lenient = (found.hands[name, S_MAX] for name in ("cad", "lenient"))
    assert (cad < 0.3 * lenient).all()
    assert cad[1] < 0.5 * cad[0]
    assert cad[1] < cad[2]
    assert lenient[2] > 1.2 * lenient.min()
    assert found.best("cad", S_MAX) == (18, cad[1])


def test_chords_of_a_constant_velocity_have_no_error() -> None:
    with pytest.raises(InputError) as problem:
        convergence(cam("uniform"), {})

    assert problem.value.key == "chart-exact-chords"


def test_a_drafting_machine_draws_along_the_edges_without_an_error_of_direction() -> None:
    solved = cam()
    angles, division = solved.motion.division(12)
    names = ("diagram_s.f12", "diagram_v.p1", "diagram_v.1")
    paper = drawn_on(solved, angles, division, names)

    machine, free = (
        draw(one, Hand(0.0, 1.0, 0.0), np.random.default_rng(1), 50).values for one in (paper, replace(paper, edges=()))
    )

    assert np.ptp(np.imag(machine["diagram_s.f12"])) == 0.0
    assert np.ptp(np.imag(free["diagram_s.f12"])) > 1e-4
    assert np.ptp(np.real(machine["diagram_v.1"])) < 1e-15  # on its section line
    assert np.ptp(np.imag(machine["diagram_v.1"])) > 1e-5  # at the end of a chord


def test_errors_that_cancel_in_a_ratio_are_none() -> None:
    drawing = kulman.solve(TASK, only="diagrams", hand="normal").drawing
    assert drawing is not None

    assert drawing.expected["mu_s_chord"].errs
    assert not drawing.expected["nu_chord"].errs
    assert drawing.expected["nu_chord"].step is None


# Lines beside jumps, drawings that do not close


def test_a_line_beside_a_jump_errs_as_far_as_it_is_late() -> None:
    found = robustness(cam(), {}, (12, 24))
    middle = found.beside.index(0.0)

    assert found.missed[12, S_MAX][middle] == pytest.approx(1.0 / 64.0, rel=1e-9)
    for n in (12, 24):
        far, near = found.missed[n, V_MAX][-1], found.missed[n, V_MAX][(middle + len(found.beside)) // 2]
        assert far == pytest.approx(2.0 * near, rel=0.05)
    assert found.missed[12, S_MAX][-1] == pytest.approx(2.0 * found.missed[24, S_MAX][-1], rel=0.05)


def test_only_lines_at_jumps_are_late() -> None:
    solved = cam()
    angles, division = solved.motion.division(12)

    moved = late(solved, angles, 0.25) - angles

    assert [*np.flatnonzero(moved)] == [*division.jumps]
    assert np.degrees(moved[list(division.jumps)]) == pytest.approx([2.25, 2.25])


def test_closing_takes_out_a_drift_of_the_velocity_exactly() -> None:
    """A velocity that is off by straight lines: so much is its integral off."""
    division, x = Division(12, 13, 25), np.concatenate((np.linspace(0.0, 0.1, 13), np.linspace(0.12, 0.2, 13)))
    off = np.interp(x, [0.0, 0.1, 0.12, 0.2], [0.0, 0.004, 0.004, -0.002])
    speed = off + np.sin(2.0 * np.pi * x / 0.1) * np.where(x <= 0.1, 1.0, 0.0)
    fine = np.linspace(0.0, 0.2, 200_001)
    offs = np.interp(fine, [0.0, 0.1, 0.12, 0.2], [0.0, 0.004, 0.004, -0.002])
    areas = np.concatenate(([0.0], np.cumsum(0.5 * (offs[1:] + offs[:-1]) * np.diff(fine))))

    found = drift(speed, x, division, 0.03)

    assert found == pytest.approx(np.interp(x, fine, areas) / 0.03, abs=1e-9)
    assert stroke_closed(np.outer(x, [1.0, 2.0]) + 0.0, x) == pytest.approx(np.zeros((26, 2)), abs=1e-15)


def test_closing_brings_more_than_care() -> None:
    found = robustness(cam(), {name: preset(name).hand for name in ("careful", "normal")}, (12,))

    normal, careful = (found.closings[name].errors for name in ("normal", "careful"))
    assert normal[BOTH] < 0.2 * normal["drawn"]
    assert normal[BOTH] < normal["speed"] < normal["drawn"]
    assert normal[BOTH] < careful["drawn"]


def test_cams_without_inner_jumps_have_no_line_to_miss() -> None:
    found = robustness(cam("sine"), {"cad": preset("cad").hand})

    assert found.beside == ()
    assert found.missed == {}
    assert found.closings["cad"].errors[BOTH] < 0.05


# Rivals


def motion_errors(motion: Motion, way: object, sections: int) -> dict[str, float]:
    cut = on_lines(motion, sections)
    course = way(motion, "diagram_a", cut)  # type: ignore[operator]
    return {
        kind: float(e.max())
        for kind, e in errors(motion, cut.division, course, in_extended(motion, cut.angles)).items()
    }


def test_sums_of_mean_ordinates_are_the_chords_of_the_board() -> None:
    board = {(e.kind, e.setting): e.error for e in race().entries if e.method == races.BOARD}
    sums = {(e.kind, e.setting): e.error for e in race().entries if e.method == races.MIDPOINT}

    assert len(board) == 2 * len(races.ON_BOARD)
    assert {key: sums[key] for key in board} == pytest.approx(board, rel=1e-9)


def test_many_boards_at_once_err_as_one() -> None:
    (many,) = [e for e in race().of("travel") if e.method == races.BOARDS]
    (alone,) = [e for e in race().of("travel") if e.method == races.BOARD and e.setting == 12]

    assert many.at_once == races.CAMS
    assert many.error == alone.error
    assert many.seconds is not None


@pytest.mark.parametrize(("way", "order"), [(midpoint, 2.0), (simpson, 4.0)])
def test_sums_have_their_orders_where_the_law_bends(way: object, order: float) -> None:
    motion = cam("polynomial-345", u="1/2").motion

    coarse, fine = (motion_errors(motion, way, n) for n in (12, 24))

    for kind in coarse:
        assert np.log2(coarse[kind] / fine[kind]) == pytest.approx(order, abs=0.2)


def test_parabolas_are_exact_for_straight_accelerations_and_closed_forms_for_all() -> None:
    found = {(e.method, e.kind): e.error for e in race().entries if e.setting in (12, 10)}

    assert found["simpson", "travel"] < 1e-13  # type: ignore[operator]
    assert found["closed", "travel"] < 1e-15  # type: ignore[operator]
    assert found["closed", "speed"] < 1e-15  # type: ignore[operator]


def test_jumps_between_lines_make_sums_of_first_order() -> None:
    found = {e.setting: e.error for e in race().of("speed") if e.method == races.MISSED}

    assert found[3073] / found[12289] == pytest.approx(4.0, rel=0.02)  # type: ignore[operator]


def test_a_hand_stands_beside_the_others() -> None:
    (entry,) = [e for e in race().of("travel") if e.method == races.HAND]

    assert entry.seconds is None
    assert entry.setting == "n = 12"
    assert 0.1 < entry.error < 1.0  # type: ignore[operator]


def test_construction_of_some_values_needs_few_steps() -> None:
    solved = cam()
    angles, division = solved.motion.division(12)

    whole, part = (
        drawn_on(solved, angles, division, names).program for names in (tuple(exact_values(solved)), (V_MAX,))
    )

    assert len(part.names) < 0.5 * len(whole.names)


# The command


@pytest.fixture(scope="module")
def made() -> Charts:
    with pytest.MonkeyPatch.context() as patch:
        quickened(patch)
        return chart(TASK, lang="en")


def quickened(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(contests, "ROUNDS", 1)
    patch.setattr(races, "BY_HAND", (12,))
    patch.setattr(races, "AT_ONCE", ())
    patch.setattr(charts, "cam_accuracy_chart", partial(charts.cam_accuracy_chart, effort=Effort((1, 10), 20)))
    patch.setattr(cam_stability, "robustness", partial(robustness, sections=(12,)))
    patch.setattr(sections, "convergence", partial(convergence, sections=FEW, drawn=(6, 18)))


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


@pytest.mark.parametrize("language", LANGUAGES)
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
    time.sleep(1.1)
    (second,) = one.save(tmp_path / "b.svg")

    text = first.read_text(encoding="utf-8")
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

    status, out, err = run(arguments, capsys)

    assert (status, out, err.count("\n")) == (2, "", 1)
    assert [*tmp_path.iterdir()] == []


def test_what_changes_nothing_is_said(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    quickened(monkeypatch)
    status, _, said = run(["--chart", "sections", "--positions", "12", "--tolerance", "5"], capsys)

    assert status == 0
    assert sorted(line.split("'")[1] for line in said.splitlines()) == ["positions", "tolerance"]


@pytest.mark.soak
def test_all_charts_are_made_with_their_full_effort(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(["-o", str(tmp_path / "charts.pdf")], capsys)

    assert (status, out, err) == (0, f"{tmp_path / 'charts.pdf'}\n", "")
    assert len(re.findall(rb"/Type /Page\b", (tmp_path / "charts.pdf").read_bytes())) == 3
