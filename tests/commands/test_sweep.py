"""The command `sweep` and the same from Python: table, CSV, JSON, statuses, wrong arguments."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman import KulmanError, solve_many, sweep
from kulman.scales import series
from kulman.scales.errors import LANGUAGES
from kulman.tests.support.commands import Run
from kulman.variants import tables
from kulman.variants.sweeps import linkage

TASK = "nau-slider-crank"
SHORT_ROD = ["--set", "l_AB=20"]  # cannot reach the guide all round


@pytest.fixture
def swept(run: Run) -> Run:
    """Runs `kulman sweep` with the arguments behind the task."""

    def sweeping(*arguments: str) -> tuple[int, str, str]:
        return run("sweep", TASK, *arguments)

    return sweeping


def test_the_table_shows_positions_and_the_whole_cycle(swept: Run) -> None:
    status, out, err = swept("-v", "3", "--positions", "8")

    rows, slider, extremes = out.split("\n\n")
    assert (status, err) == (0, "")
    assert [line.split()[0] for line in rows.splitlines()[1:]] == list("01234567")
    assert rows.splitlines()[0].split()[0] == "phi,"
    assert "stroke 0.08 m" in slider
    assert "phi = 0° (s_3 = −0.15 m); phi = 180° (s_3 = −0.23 m)" in slider
    assert "V_B, m/s" in extremes
    assert "phi = 101.4157°" in extremes


def test_a_velocity_at_a_dead_position_is_shown_as_zero() -> None:
    swept = kulman.sweep("madi-four-bar", only="velocity", positions=6)  # begins where the working stroke begins

    assert swept.table().splitlines()[1].split() == ["0", "38.9871", "0", "96.5926", "0"]


def test_arcs_that_cannot_be_reached_are_said_and_no_error(swept: Run) -> None:
    status, out, err = swept(*SHORT_ROD, "--only", "velocity")

    assert (status, err) == (0, "")
    assert "stroke 0.05 m" in swept("--only", "structure")[1]  # the cycle has positions whatever plans are wanted
    low = math.degrees(math.asin(20 / 25))
    assert f"cannot be assembled from phi = {low:.7f}° to phi = {180 - low:.7f}°" in out


def test_a_mechanism_that_never_assembles_has_status_3(run: Run) -> None:
    status, out, err = run("sweep", "scheme-03-crank-rocker", "--set", "l_AB=9000", "--json")

    assert status == 3
    assert json.loads(out)["status"] == "no-assembly"
    assert "any position of the crank" in err


def test_json_holds_the_cycle_in_si(swept: Run) -> None:
    status, out, _ = swept("-v", "example", "--json", "--positions", "24")

    data = json.loads(out)
    assert status == 0
    assert out.isascii()
    assert (data["task"], data["variant"], data["status"]) == (TASK, "example", "ok")
    assert len(data["places"]) == len(data["times"]) == len(data["statuses"]) == 24
    one = kulman.solve(TASK, "example", set={"phi": "60 deg"})
    k = next(k for k, place in enumerate(data["places"]) if abs(place % (2 * math.pi) - math.pi / 3) < 1e-9)
    for name, quantity in one.quantities.items():
        if quantity.kind != "point" and name in data["quantities"]:
            all_round = data["quantities"][name]
            assert all_round["unit"] == quantity.unit
            assert all_round["value"][k] == pytest.approx(quantity.value, rel=1e-9, abs=1e-9), name
    turned = json.loads(swept("--from", "90 deg", "--json", "--only", "position")[1])
    assert turned["places"][0] == pytest.approx(math.pi / 2)
    output = data["outputs"][0]
    assert (output["link"], output["kind"], output["stroke"]) == (3, "slider", pytest.approx(0.1))
    assert [spot["end"] for spot in output["dead"]] == ["high", "low"]
    assert data["extremes"]["V_B"]["max"]["value"] == pytest.approx(max(data["quantities"]["V_B"]["value"]), rel=0.01)


def test_json_has_null_where_a_position_fails(swept: Run) -> None:
    data = json.loads(swept(*SHORT_ROD, "--json", "--only", "velocity")[1])

    failed = [k for k, status in enumerate(data["statuses"]) if status == "no-assembly"]
    assert failed
    assert all(data["quantities"]["V_B"]["value"][k] is None for k in failed)
    assert data["extremes"]["V_B"]["max"]["value"] is None  # it grows without bound
    assert data["outputs"][0]["time_ratio"] is None


def test_only_chosen_points_and_links_are_shown(swept: Run) -> None:
    out = swept("--points", "S2,3", "--points", "2", "--only", "velocity")[1]

    assert {"S2.x,", "V_S2,", "s_3,", "omega_2,"} <= set(out.splitlines()[0].split())
    assert "V_B," not in out


def test_chords_stand_beside_plans(swept: Run) -> None:
    out = swept("--chords", "B", "--positions", "24", "--lang", "en")[1]

    velocity, acceleration = out.split("\n\n")
    assert len(velocity.splitlines()) == len(acceleration.splitlines()) == 25
    assert all(float(line.split()[-1]) < 2.0 for line in velocity.splitlines()[1:])


WRONG = {
    "no cycle": (["--positions", "2"], "3 to 100000"),
    "unknown point": (["--points", "Q"], "neither a point nor a link"),
    "unknown point of chords": (["--chords", "Q"], "neither a point nor a link"),
    "unknown suffix": (["-o", "cycle.xyz"], ".csv"),
    "a crank that stops": (["--to", "90"], "sliding drivers"),
    "a place of another kind": (["--from", "3 mm"], "--from: "),
    "no place": (["--from", "x"], "--from: "),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_arguments_are_answered_in_one_line(name: str, swept: Run) -> None:
    arguments, said = WRONG[name]

    status, out, err = swept(*arguments)

    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert said in err


@pytest.mark.parametrize(
    ("arguments", "key"),
    [
        ({"positions": "12"}, "argument-type"),
        ({"positions": 10**9}, "positions-number"),
        ({"points": 3}, "argument-type"),
        ({"points": ["B", None]}, "argument-type"),
        ({"start": [3]}, "argument-type"),
        ({"start": math.nan}, "number-bad"),
    ],
)
def test_wrong_arguments_from_python_are_answered_in_one_line(arguments: dict[str, object], key: str) -> None:
    with pytest.raises(KulmanError) as caught:
        kulman.sweep(TASK, **arguments)  # type: ignore[arg-type]

    assert caught.value.key == key
    assert all(caught.value.text(language).isprintable() for language in LANGUAGES)


def test_a_sweep_can_be_asked_from_python(tmp_path: Path) -> None:
    swept = kulman.sweep(TASK, "example", only="acceleration", positions=36)

    assert repr(swept) == "<Sweep nau-slider-crank example: 36 positions, 36 with a plan>"
    assert swept.diagrams("B").unit == "m"
    assert swept.save(tmp_path / "a.csv") == [tmp_path / "a.csv"]
    assert swept.cycle.extremes(["V_B"])["V_B"][1].value == 0.0
    assert swept.reason is None


def test_a_sweep_of_which_most_positions_have_no_plan_says_so_on_a_prompt() -> None:
    swept = kulman.sweep(TASK, "3", set={"l_OA": 500}, only="velocity")

    assert repr(swept) == "<Sweep nau-slider-crank 3: 12 positions, 2 with a plan>"
    assert np.isfinite(swept["V_B"]).sum() == 2
    assert swept.status == "ok"


def test_no_file_of_a_sweep_is_written_when_one_cannot_be(tmp_path: Path) -> None:
    swept = kulman.sweep(TASK, "example", only="acceleration", positions=4)
    too_long = "a" * 250 + ".csv"  # a name that the system lets pass, but not with what it is called while written

    with pytest.raises(KulmanError) as caught:
        swept.save(tmp_path / "cycle.svg", tmp_path / "cycle.csv", tmp_path / too_long)

    assert caught.value.key == "output-refused"
    assert list(tmp_path.iterdir()) == []


def test_the_drawing_of_a_cycle_has_a_title_block(folder: Path, run: Run) -> None:
    said = ("--student", "О. Бойко", "--group", "АТ-301", "--teacher", "І. Коваль")

    assert run("sweep", TASK, *said, "--positions", "6", "--only", "acceleration", "-o", "cycle.svg")[0] == 0
    text = min(Path().glob("cycle*.svg")).read_text(encoding="utf-8")  # the first page, or the only one
    assert all(word in text for word in said[1::2])


def test_a_drawing_of_very_many_positions_shows_some_of_them_and_says_so(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(linkage, "DRAWN", 4)

    status, _, err = run(
        "sweep", TASK, "--positions", "8", "--only", "acceleration", "-o", "x.svg", "-o", "x.csv", "--lang", "en"
    )

    drawing = "".join(path.read_text(encoding="utf-8") for path in folder.glob("x*.svg"))
    assert (status, err) == (0, "the drawing shows 4 of the 8 positions, spread evenly; tables and .csv have all\n")
    assert {int(name) for name in re.findall("position_([0-9]+)", drawing)} == {*range(4)}
    assert len(Path("x.csv").read_text(encoding="utf-8").splitlines()) == 9


def test_of_many_states_no_more_is_told_to_be_written_than_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written, told, dumps = [0], [0], series.orjson.dumps
    monkeypatch.setattr(series.orjson, "dumps", lambda part, **how: (written.append(part.size), dumps(part, **how))[1])
    states = solve_many(TASK, phi=np.linspace(0.0, 6.0, 2 * tables.MANY), names="V_B,omega_2")
    ahead = [0]
    token = tables.watching.set(lambda done, whole: (told.append(done), ahead.append(sum(told) - sum(written)))[0])
    try:
        states.save(tmp_path / "x.csv")
    finally:
        tables.watching.reset(token)
    assert sum(told) == len(states) * len(states.columns)
    assert max(ahead) <= 2 * len(states)  # numbers of states, and statuses
    assert len(told) > 5


def test_writing_a_long_table_is_told_of_part_by_part_and_a_short_one_is_not(tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    token = tables.watching.set(lambda done, whole: told.append((done, whole)))
    try:
        sweep(TASK, positions=360).save(tmp_path / "short.csv")
        assert told == []
        for name in ("long.csv", "long.xlsx"):
            sweep(TASK, positions=tables.MANY, only="position").save(tmp_path / name)
            assert sum(done for done, _ in told) == told[-1][1] > 3
            told.clear()
    finally:
        tables.watching.reset(token)


def test_of_parts_that_cannot_be_reached_from_one_another_it_is_told_whose_the_stroke_is(run: Run) -> None:
    told = "stroke in the part with the position of the task"
    _, parted, _ = run("sweep", TASK, "--set", "l_OA=130", "--only", "velocity")
    _, whole, _ = run("sweep", TASK, "--only", "velocity")

    assert f"slider 3: {told} 0.0307071 m" in parted
    assert "dead positions: phi = 0° (s_3 = 0.005 m); phi = 180° (s_3 = −0.255 m)" in parted
    assert told not in whole
