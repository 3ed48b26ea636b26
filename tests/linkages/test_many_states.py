"""Many states at once: each is what `solve` says of it alone; units are never others; what is wrong is said."""

from __future__ import annotations

import csv
import io
import json
import math
import pickle
import re
import sys
import warnings
from collections.abc import Callable
from copy import copy, deepcopy
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import kulman
from kulman import KulmanError, Quantity, Series, Status, load_task, solve, solve_many, sweep
from kulman.plans.boards.exact import STATUSES
from kulman.plans.linkages import loads, strokes
from kulman.scales.kept import Kept
from kulman.scales.series import rows_of
from kulman.tests.support.cases import some
from kulman.variants.shelf import bundled
from kulman.variants.tables import Table, _harmless

LINKAGES = bundled("mechanism")
TASK = "nau-slider-crank"


def part_of(quantity: Quantity, part: str) -> float | None:
    return {"": quantity.value, "x": quantity.x, "y": quantity.y}[part]


def assert_alone(task: str, states: kulman.ManyStates, at: tuple[int, ...], **others: str) -> None:
    """Assert that one of many states is what `solve` says of it."""
    given = {name: states[name] for name in states.given}
    one = solve(task, set={name: f"{float(array[at])!r} {array.unit}" for name, array in given.items()} | others)
    assert states.statuses[at] == one.status
    for name in (name for name in states if name not in given):
        column, (base, _, part) = states[name], name.partition(".")
        expected = part_of(one[base], part)
        assert column.unit == one[base].unit
        if expected is None:
            assert np.isnan(column[at]), name
        else:
            size = max(abs(own) for own in (one[base].value, one[base].x, one[base].y, 1e-9) if own is not None)
            assert float(column[at]) == pytest.approx(expected, rel=0.0, abs=1e-9 * size), name


@pytest.mark.parametrize("task", some(LINKAGES, *range(0, 99, 3)))
def test_each_of_many_states_is_what_it_is_alone(task: str) -> None:
    rng, driver = np.random.default_rng(LINKAGES.index(task)), load_task(task).mechanism.driver.coordinate
    places = load_task(task).values()[driver] * (1.0 + 0.02 * rng.random((2, 3)))
    states = solve_many(task, **{driver: places})

    assert states.shape == (2, 3)
    assert states.ok.all()
    for at in ((0, 1), (1, 2)):
        assert_alone(task, states, at)


@pytest.mark.parametrize("task", ["scheme-01-compressor", "scheme-13-toggle-press", "scheme-20-press-automaton"])
def test_strokes_are_found_once_for_the_same_lengths_if_at_all(task: str, monkeypatch: pytest.MonkeyPatch) -> None:
    usual, found, stroke_of = load_task(task).values(), list[Any](), strokes.stroke_of
    monkeypatch.setattr(strokes, "_STROKES", Kept[Any](64))
    monkeypatch.setattr(strokes, "stroke_of", lambda *asked: found.append(asked) or stroke_of(*asked))
    length = next(name for name, value in usual.items() if name.startswith("l_A") and value)
    speed = load_task(task).mechanism.driver.speed
    over = any(diagram.over == "stroke" for diagram in load_task(task).mechanism.diagrams)
    lengths = usual[length] * np.array([1.0, 1.003, 1.0])
    speeds = usual[speed] * np.array([1.0, 1.1, 1.2, 1.3])
    solve_many(task, **{length: lengths, speed: usual[speed]}, names="omega_1")
    assert len(found) <= 1  # of the first one, which is solved alone

    states = solve_many(task, **{length: lengths[:, None], speed: speeds}, names="M_bal")

    assert len(found) == (2 if over else 1)
    for at in np.ndindex(states.shape):
        alone = solve_many(task, **{length: lengths[at[0]], speed: speeds[at[1]]}, names="M_bal")
        assert states["M_bal"][at].tobytes() == alone["M_bal"].tobytes()


STROKES = ("scheme-01-compressor", "scheme-02-forging-press", "scheme-08-planer", "scheme-13-toggle-press")


@pytest.mark.parametrize("spread", [0.1, 0.9])
@pytest.mark.parametrize("task", some((*STROKES, "scheme-16-hay-baler"), 0, 2, 4))
def test_strokes_found_together_are_those_found_one_by_one(task: str, spread: float) -> None:
    mechanism, usual = load_task(task).mechanism, load_task(task).values()
    random = np.random.default_rng(len(task)).uniform(1.0 - 0.5 * spread, 1.0 + 0.5 * spread, (60, len(usual)))
    lengths = {name: usual[name] * random[:, k] for k, name in enumerate(usual) if name[:2] in ("l_", "x_", "y_")}

    found = strokes.stroke_ends(mechanism, {**usual, **lengths})

    together = np.isfinite(strokes._plain_strokes(mechanism, {**usual, **lengths}, 60)[0])
    assert together.sum() > 20  # else nothing is shown
    for k in range(60):
        one = {name: float(column[k]) for name, column in lengths.items()}
        travel = strokes.stroke_of(mechanism, {**usual, **one, "phi": 0.0})
        ends = sorted(float(found[name][k]) for name in (loads.BEGIN, loads.END))
        assert np.array_equal(ends, [travel.low, travel.high], equal_nan=True)


def test_givens_broadcast_and_each_state_has_its_status() -> None:
    lengths = np.array([130.0, 20.0, 50.0])
    states = solve_many(TASK, phi=np.radians([0.0, 40.0, 90.0, 250.0]), l_AB=(lengths[:, None], "mm"), l_OA="50 mm")

    assert states.shape == states["V_B"].shape == states.statuses.shape == (3, 4)
    assert states["l_AB"].unit == "m"
    assert states["l_AB"][2].tolist() == [0.05] * 4
    assert states.statuses[1].tolist() == [Status.OK, Status.NO_ASSEMBLY, Status.NO_ASSEMBLY, Status.NO_ASSEMBLY]
    assert np.isnan(states["V_B"][1, 1:]).all()
    assert (states.ok == ((states.statuses == Status.OK) | (states.statuses == Status.ILL_CONDITIONED))).all()
    for at in np.ndindex(states.shape):
        if states.ok[at]:
            assert_alone(TASK, states, at, l_OA="50 mm")


def test_one_state_without_arrays_has_no_axes() -> None:
    states = solve_many(TASK, phi="40 deg", names=["V_B", "B"])

    assert states.shape == ()
    assert [*states] == ["V_B", "V_B.x", "V_B.y", "B.x", "B.y"]
    assert float(states["V_B"]) == pytest.approx(solve(TASK, set={"phi": "40 deg"})["V_B"].value)


def test_a_component_is_wanted_with_its_vector_or_point() -> None:
    states = solve_many(TASK, phi="40 deg", names="B.x,V_B.y,V_B")

    assert [*states] == ["B.x", "B.y", "V_B", "V_B.x", "V_B.y"]
    with pytest.raises(KulmanError, match=r"'omega_2\.x'"):
        solve_many(TASK, phi="40 deg", names="omega_2.x")


def test_units_are_as_they_are_written_and_numbers_in_si() -> None:
    ways: list[Any] = ["190 mm", 0.19, np.float64(0.19), (190, "mm"), ([19.0], "см"), Series([190.0], "l", "mm")]
    found = [np.ravel(solve_many(TASK, l_AB=way, names="V_B")["V_B"])[0] for way in ways]
    assert found == pytest.approx([found[0]] * len(ways), rel=1e-14)
    speed = solve_many(TASK, n_1=[10.0, 20.0], names="V_A")
    assert speed["n_1"].unit == "rad/s"
    crank = load_task(TASK).values()["l_OA"]
    assert speed["V_A"].tolist() == pytest.approx([10.0 * crank, 20.0 * crank])


def test_words_are_chosen_and_settings_hold_for_all_states() -> None:
    left, right = (solve_many(TASK, side=side, phi=[0.3], names="B")["B.x"][0] for side in ("left", "right"))
    assert left * right < 0.0
    assert solve_many(TASK, set={"l_OA": "30 mm"}, phi=[0.3], names="V_A")["V_A"] == pytest.approx(
        solve(TASK, set={"l_OA": "30 mm"})["V_A"].value
    )


@pytest.mark.parametrize(
    ("givens", "key"),
    [
        ({"phy": [1.0]}, "given-unknown-like"),
        ({"phi": "30"}, "unit-missing"),
        ({"phi": ([1.0], "mm")}, "unit-wrong"),
        ({"phi": [0.0, float("nan")]}, "number-bad"),
        ({"phi": [float("inf")]}, "number-infinite"),
        ({"phi": "wide"}, "number-bad"),
        ({"phi": {"deg": 30}}, "type-quantity-array"),
        ({"phi": ["a", "b"]}, "type-quantity-array"),
        ({"phi": ["1 deg", "2 deg"]}, "type-quantity-array"),
        ({"phi": np.array([1 + 1j])}, "type-quantity-array"),
        ({"phi": np.array([True])}, "type-quantity-array"),
        ({"phi": True}, "type-quantity-array"),
        ({"l_AB": [0.1, -0.1]}, "not-positive"),
        ({"l_AB": [0.1, 0.0, 0.2]}, "not-positive"),
        ({"phi": []}, "array-empty"),
        ({"phi": [1.0, 2.0], "l_AB": [0.1, 0.2, 0.3]}, "arrays-shapes"),
        ({"side": "up"}, "choice-unknown"),
        ({"phi": [1.0], "names": "jerk"}, "quantity-unknown"),
    ],
    ids=str,
)
def test_what_is_wrong_with_an_array_is_said(givens: dict[str, Any], key: str) -> None:
    with pytest.raises(KulmanError) as error:
        solve_many(TASK, **givens)
    assert error.value.key == key
    assert next(iter(givens)) in error.value.text("en") or key == "quantity-unknown"


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (([50, 40, -3], "mm"), "l_OA: [2]: '-3 mm': must be greater than zero"),
        ([[0.05, 0.04], [float("nan"), 0.03]], "l_OA: [1, 0]: 'nan m'"),
    ],
)
def test_a_bad_value_of_an_array_is_named_with_its_index_and_unit(value: Any, said: str) -> None:
    with pytest.raises(KulmanError) as error:
        solve_many(TASK, l_OA=value)
    assert said in str(error.value)


def test_numbers_in_set_say_their_unit_where_others_are_in_si() -> None:
    with pytest.raises(KulmanError, match='phi: 75 is without its unit; write "75 deg"'):
        solve_many(TASK, set={"phi": 75})
    with pytest.raises(KulmanError, match=r'phi: \[0, 75\] is without its unit; write \(\.\.\., "deg"\)'):
        solve_many(TASK, set={"phi": [0, 75]})


def test_one_and_many_are_set_in_the_same_way() -> None:
    given: dict[str, Any] = {"l_OA": "30 mm", "phi": (75, "deg"), "n_1": (np.float64(20.0), "1/s")}

    many, one = solve_many(TASK, set=given, names="V_B"), solve(TASK, set=given)
    several = solve_many(TASK, set={**given, "phi": ([0, 75], "deg")}, names="V_B")
    named = solve_many(TASK, set=given, phi=([0, 75], "deg"), names="V_B")  # a keyword goes before

    assert float(many["V_B"]) == pytest.approx(one["V_B"].value)
    assert one["V_B"].value == solve(TASK, set={"l_OA": "30 mm", "phi": "75 deg", "n_1": "20 1/s"})["V_B"].value
    assert several["V_B"].tolist() == named["V_B"].tolist() == [pytest.approx(0.0, abs=1e-9), float(many["V_B"])]
    with pytest.raises(KulmanError, match="unit"):
        solve(TASK, set={"phi": (75, "mm")})
    for several in ([0, 75], ([0, 75], "deg"), np.zeros(3)):
        with pytest.raises(KulmanError, match="phi: for several values at once there is"):
            solve(TASK, set={"phi": several})  # type: ignore[dict-item]
    for nothing in (solve(TASK)["A"], ("75", "deg"), (75,), {}, (True, "deg")):
        with pytest.raises(KulmanError, match="phi: a quantity was expected"):
            solve(TASK, set={"phi": nothing})  # type: ignore[dict-item]


def test_givens_say_what_they_are() -> None:
    givens = load_task(TASK).givens

    assert [repr(givens[name]) for name in ("phi", "rotation")] == ["<Given phi: deg>", "<Given rotation: cw | ccw>"]


def test_what_has_been_found_may_be_set() -> None:
    found = solve(TASK, "3")["l_OA"]

    assert solve(TASK, set={"l_OA": found})["l_OA"].value == found.value
    assert float(solve_many(TASK, set={"l_OA": found}, names="V_A", phi=1.0)["V_A"]) == pytest.approx(
        solve(TASK, set={"l_OA": "40 mm", "phi": (1.0, "rad")})["V_A"].value
    )


@pytest.mark.parametrize(
    ("givens", "meant"),
    [
        pytest.param({"l_OA": 55}, "55 mm", id="a length"),
        pytest.param({"l_OA": np.array([0.055, 55.0])}, "55 mm", id="one of several"),
        pytest.param({"phi": np.arange(0, 360, 10)}, "350 deg", id="an angle"),
        pytest.param({"n_1": 1400}, "1400 rpm", id="a speed"),
        pytest.param({"l_OA": 0.055, "phi": np.linspace(0.0, 6.28, 9), "n_1": 146}, "", id="SI"),
        pytest.param(
            {"l_OA": "55 mm", "phi": ([0, 350], "deg"), "n_1": Series([146.0], "n_1", "rad/s")}, "", id="with units"
        ),
    ],
)
def test_a_number_that_is_usual_in_the_unit_of_the_task_alone_is_warned_of(givens: dict[str, Any], meant: str) -> None:
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        solve_many(TASK, "3", names="V_B", **givens)

    assert [one.filename for one in said] == [__file__] * bool(meant)  # who calls
    assert all(f'"{meant}"' in str(one.message) for one in said)


def test_many_states_show_their_ranges_in_a_notebook() -> None:
    states = solve_many(TASK, l_AB=([10, 110], "mm"), phi="90 deg", names="V_B", lang="en")

    shown = re.sub("<[^>]*>", " ", states._repr_html_()).split()

    assert len(states) == 2
    assert " ".join(shown).startswith(f"Unit min max l_AB m 0.01 0.11 V_B m/s {states['V_B'][1]:.6g}")
    assert " ".join(shown).endswith("ok: 1 cannot be assembled: 1")


@pytest.mark.parametrize("task", ["madi-gear", "madi-cam", "karpenko-hoist"])
def test_what_is_no_linkage_is_refused_as_that_whatever_is_given(task: str) -> None:
    with pytest.raises(KulmanError, match=f"'{task}' is not a linkage"):
        solve_many(task, phi=[0.1])


def test_a_given_is_found_by_its_name_in_a_solution() -> None:
    for task in ("scheme-09-shaper", "madi-cam", "karpenko-hoist"):
        solution, read = solve(task), load_task(task)
        for name, given in ((name, given) for name, given in read.givens.items() if name in read.values()):
            if given.unit is not None and name not in solution.quantities:
                found = solution[name]
                assert (found.name, found.value, found.unit) == (name, read.values()[name], given.unit.si.name)


def test_what_is_said_of_rows_is_in_frames_and_under_its_name() -> None:
    pandas = pytest.importorskip("pandas")
    apart = solve_many(TASK, phi=[[0.1], [0.7]], l_AB=([130.0, 20.0], "mm"), names="V_B")
    for states in (apart, *map(sweep, (TASK, "madi-cam", "karpenko-hoist"))):
        said = states.columns[-1]
        assert said in ("status", "bears")
        assert states[said].ravel().tolist() == [row[-1] for row in states.rows]
        assert states.to_dataframe()[said].tolist() == [row[-1] for row in states.rows]
    assert apart["status"].shape == (2, 2)
    solution = solve(TASK)
    frame = solution.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert tuple(frame.columns) == solution.columns
    assert frame["name"].tolist() == [row[0] for row in solution.rows]


@pytest.mark.parametrize("task", [TASK, "scheme-18-hydraulic-drive", "madi-cam", "madi-gear", "karpenko-hoist"])
def test_a_sweep_gives_its_columns_as_arrays(task: str) -> None:
    swept = sweep(task)
    columns = swept.to_dict()

    assert [*swept] == [*columns]
    assert len(swept) == swept.statuses.size == len(next(iter(columns.values())))
    data = swept.to_json()
    for name, found in data.get("columns", {}).items():
        assert columns[name].unit == found["unit"]
        assert np.allclose(columns[name], np.array(found["value"], float), equal_nan=True)
    for name, found in data.get("quantities", {}).items():
        for part, values in found.items():
            if part != "unit":
                own = swept[name if part == "value" else f"{name}.{part}"]
                assert np.allclose(own, np.array(values, float), equal_nan=True)
                assert own.unit == found["unit"]
    with pytest.raises(KulmanError, match="quantity"):
        swept["V_nothing"]


def test_a_series_that_is_copied_or_sent_to_another_process_keeps_name_and_unit() -> None:
    speed = solve_many(TASK, phi=[0.1, 0.2], names="V_B")["V_B"]
    sent = [pickle.loads(pickle.dumps(speed, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]

    for same in (*sent, copy(speed), deepcopy(speed), speed[::-1][::-1], pickle.loads(pickle.dumps(speed[:1]))):
        assert isinstance(same, Series)
        assert (same.name, same.unit, same[0]) == ("V_B", "m/s", speed[0])


def test_a_series_keeps_its_unit_where_it_is_still_the_same_quantity() -> None:
    speeds = sweep(TASK)["V_B"]

    assert (speeds.name, speeds.unit, speeds[2:5].unit) == ("V_B", "m/s", "m/s")
    assert type(speeds * speeds) is np.ndarray
    assert type(speeds.max()) is not Series or speeds.max().unit == "m/s"
    assert speeds.to("мм/с").tolist() == pytest.approx([1000.0 * v for v in speeds])
    assert speeds.to("mm/s").unit == "mm/s"
    assert repr(speeds).startswith("V_B, m/s: [")
    assert len(repr(np.resize(speeds, 10_000).view(Series))) < 200
    with pytest.raises(KulmanError, match="unit N does not fit"):
        speeds.to("N")


def test_states_tell_the_givens_that_are_the_same_for_all_of_them() -> None:
    states = solve_many(TASK, "3", phi=[[0.1], [0.2]], l_AB=([180, 190, 200], "mm"), l_OA="55 mm", names="V_B")
    alone = solve_many(TASK, "3", phi="75 deg", names="V_B")

    for name in ("l_OA", "m_2", "n_1", "l_AB"):
        found = states[name]
        assert (found.shape, found.name, found.unit) == ((2, 3), name, solve(TASK)[name].unit)
    assert np.all(states["l_OA"] == 0.055)
    assert np.all(states["m_2"] == solve(TASK, "3")["m_2"].value)
    assert float(alone["phi"]) == pytest.approx(math.radians(75.0))
    assert "m_2" in states
    assert "m_2" not in [*states]  # as of one solution
    assert ("V_B.x" in states, "B" in states, 3 in states, "" in states) == (True, False, False, False)
    idle = solve_many("scheme-09-shaper", phi=np.linspace(0.0, 6.0, 9), only="forces")
    assert {0.0, float(idle["F_5"].max())} == {*idle["F_5"].tolist()}  # the force that acts, not the given
    with pytest.raises(KulmanError, match="there is no quantity 'rotation'"):
        states["rotation"]


def test_the_coordinates_of_a_point_are_named_where_it_is_asked_for_as_a_whole() -> None:
    for states in (solve_many(TASK, phi=[0.1], names="B"), sweep(TASK)):
        with pytest.raises(KulmanError, match=r"'B' is a point: its coordinates are 'B\.x' and 'B\.y'"):
            states["B"]


def test_what_numpy_makes_of_a_series_has_neither_its_name_nor_its_unit() -> None:
    speeds = sweep(TASK)["V_B"]
    plain, before = np.array(speeds), speeds.copy()
    functions: tuple[Callable[[Any], Any], ...] = (
        np.gradient,
        np.argsort,
        np.zeros_like,
        np.nan_to_num,
        lambda array: array.argsort(),
        lambda array: array.argpartition(3),
        lambda array: array.searchsorted(array),
        lambda array: array.nonzero()[0],
        lambda array: array.reshape(3, 4).argmax(axis=0),
        lambda array: np.meshgrid(array, array)[0],
        lambda array: np.interp(array, np.sort(array), np.arange(array.size)),
        lambda array: np.concatenate([array, array]),
    )

    for function in functions:
        assert type(function(speeds)) is np.ndarray
        assert np.array_equal(function(speeds), function(plain))
    assert np.array_equal(speeds, before)


def test_a_series_is_calculated_with_in_place_as_an_array_is() -> None:
    speeds = sweep(TASK)["V_B"]
    plain, out = np.array(speeds), speeds.copy()

    np.multiply(speeds, 3.0, out=out)
    own = speeds.copy()
    own += 1.0
    own /= 2.0

    assert np.array_equal(out, plain * 3.0)
    assert np.array_equal(own, (plain + 1.0) / 2.0)
    assert type(own) is np.ndarray


class Frame:
    """What is asked of a data frame, and the one that shares its columns."""

    def __init__(self, columns: dict[str, NDArray[Any]], copy: bool, base: Frame | None = None) -> None:
        self.columns = {name: np.array(column) if copy else column for name, column in columns.items()}
        self.base, self.attrs = base, dict[str, Any]() if base is None else dict(base.attrs)

    def copy(self, deep: bool) -> Frame:
        return Frame(self.columns, deep, self)


@pytest.mark.parametrize(("version", "sharing"), [("2.3.1", False), ("3.0.0", True)])
def test_states_become_a_data_frame_where_pandas_is(
    version: str, sharing: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    states = solve_many(TASK, phi=[0.1, 0.2], names="V_B")

    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=Frame, __version__=version))
    frame, other = states.to_dataframe(), states.to_dataframe()
    assert frame.attrs["units"] == {"phi": "rad", "V_B": "m/s", "V_B.x": "m/s", "V_B.y": "m/s"}
    assert frame.columns["phi"].tolist() == [0.1, 0.2]
    assert all(frame.columns[name].tolist() == states[name].tolist() for name in states)
    # who changes the frame changes no states: it has its own, or shares those of a frame that is kept
    assert np.shares_memory(frame.columns["V_B.x"], states.values["V_B"]) == sharing
    assert (frame.base is not None and frame.base is other.base) == sharing
    assert all(column.flags.writeable for column in frame.columns.values())

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(KulmanError, match="pandas"):
        states.to_dataframe()


def test_who_changes_a_data_frame_changes_neither_states_nor_other_frames() -> None:
    pytest.importorskip("pandas")
    states = solve_many(TASK, phi=[[0.1, 0.2], [0.3, 0.4]], names="V_B")
    before = {name: states[name].copy() for name in states}

    frame, other = states.to_dataframe(), states.to_dataframe()
    for name in states:
        frame.loc[0, name] = 7.0

    assert all(states[name].tolist() == before[name].tolist() for name in states)
    assert all(other[name].tolist() == before[name].ravel().tolist() for name in states)
    assert all(frame[name].tolist()[0] == 7.0 for name in states)


@pytest.mark.parametrize("language", ["en", "uk"])
def test_a_row_of_csv_is_read_back_as_it_was_written(language: str) -> None:
    said = ["a", "б; в", 'x, "y"', "two\r\nlines", "\n"]
    rows = [(k, 0.1 * k, -0.0, math.nan, said[k], None if k else 1.5) for k in range(5)]

    head, *read = csv.reader(
        io.StringIO(Table(tuple("abcdef"), rows, language).csv()), delimiter=",;"[language == "uk"]
    )

    assert head == [*"abcdef"]
    numbers = [text.replace(",", ".") for row in read for text in (row[1], row[2])]
    assert [float(text) for text in numbers] == [number for row in rows for number in row[1:3]]
    assert {str(row[2]) for row in read} <= {"0.0", "0,0"}
    assert [row[4].lstrip("'") for row in read] == [said[0], *(_harmless(text).lstrip("'") for text in said[1:])]
    assert [(row[0], row[3], row[5].replace(",", ".")) for row in read[:2]] == [("0", "", "1.5"), ("1", "", "")]


def digits(text: str) -> str:
    """What is left of a number without its sign, point and exponent."""
    return text.split("e")[0].lstrip("-").replace(".", "").strip("0")


def test_many_numbers_read_back_from_as_few_digits_as_repr_has() -> None:
    random, tens = np.random.default_rng(5), 10.0 ** np.arange(-7, 19)
    sizes = random.normal(size=40_000) * random.choice(tens, 40_000)
    beside = [np.nextafter(size, to) for size in (*tens, *(0.5 * tens), *(0.7 * tens)) for to in (0.0, math.inf)]
    short = [np.round(sizes, decimals) for decimals in range(-2, 9)]
    odd = [0.0, -0.0, math.nan, math.inf, -math.inf, sys.float_info.max, -sys.float_info.min, 5e-324, *beside]
    odd += [*(2.0 ** np.arange(-60, 80)), *(2.0**53 + np.arange(-9, 9)), *(np.arange(5000) / 8), 123456789012345.6]
    numbers = np.concatenate([sizes, *short, odd])

    rows = [row for part in rows_of([numbers, numbers[::-1]], ";", comma=False) for row in part]

    told = [row.split(";") for row in rows]
    assert [one for one, _ in told] == [other for _, other in reversed(told)]
    for (text, _), number in zip(told, numbers.tolist(), strict=True):
        if not math.isfinite(number):
            assert text == ""
            continue
        assert (float(text), math.copysign(1.0, float(text))) == (number, math.copysign(1.0, number + 0.0))
        assert digits(text) == digits(repr(number))


def test_states_are_saved_as_tables_and_as_json(tmp_path: Any) -> None:
    states = solve_many(TASK, phi=[[0.1, 0.2], [0.3, 0.4]], names="V_B")
    states.save(tmp_path / "states.csv", tmp_path / "states.json")

    head, *rows = (tmp_path / "states.csv").read_text().splitlines()
    assert head == "k,phi [rad],V_B [m/s],V_B.x [m/s],V_B.y [m/s],status"
    assert [float(row.split(",")[2]) for row in rows] == states["V_B"].ravel().tolist()
    assert states.csv("uk").splitlines()[1].split(";")[:3] == [
        "0",
        "0,1",
        repr(float(states["V_B"][0, 0])).replace(".", ","),
    ]
    broken = solve_many(TASK, l_AB=([140.0, 20.0, 140.0], "mm"), phi=[1.5, 1.5, 0.0], names="V_B,M_bal")  # NaN, -0.0
    assert [broken.csv(language) for language in ("en", "uk")] == [broken.data(of).csv() for of in ("en", "uk")]
    apart = solve_many(TASK, l_AB=([140.0, 20.0], "mm"), phi=1.5, names="V_B").csv().splitlines()
    assert apart[2] == "1,0.02,,,,no-assembly"
    data = json.loads((tmp_path / "states.json").read_text())
    assert data["columns"]["V_B"]["value"] == states["V_B"].tolist()
    assert states.table() == "ok: 4"
    assert "(2, 2)" in repr(states)


def test_statuses_are_those_of_the_board() -> None:
    assert [*Status] == [*STATUSES]


def test_a_quantity_is_a_number_for_powers_and_for_numpy() -> None:
    speed = Quantity("V_B", 4.0, "m/s")

    assert (speed**2, speed**0.5, 2**speed) == (16.0, 2.0, 16.0)
    assert np.sqrt(speed) == np.hypot(speed, 0.0) - 2.0 == 2.0
    assert np.array([speed, speed]).dtype == float
    assert (np.float64(2.0) * speed, np.float64(2.0) + speed, np.array([1.0]) * speed) == (8.0, 6.0, 4.0)
    with pytest.raises(TypeError, match="is a point"):
        np.sqrt(Quantity("B", None, "m", 1.0, 2.0, kind="point"))


def test_a_quantity_prints_and_converts() -> None:
    found = solve(TASK, "example")

    assert repr(found["V_B"]) == "V_B = 2.7614 (2.7614, 0) m/s"
    assert repr(found["B"]) == f"B = ({found['B'].x:.6g}, 0) m"
    assert float(found["V_B"]) == found["V_B"].value
    assert found["V_B"].to("мм/с").value == pytest.approx(2761.396, abs=1e-3)
    assert found["omega_1"].to("rpm").value == pytest.approx(found["omega_1"].to("1/min").value)
    assert found["omega_1"].to("rpm").value == pytest.approx(-765.0)
    with pytest.raises(TypeError, match="point"):
        float(found["B"])
    with pytest.raises(KulmanError, match="unit"):
        found["V_B"].to("kg")


def test_tasks_are_listed() -> None:
    assert TASK in kulman.tasks()
    assert kulman.tasks() == bundled()
