"""Constructions for GeoGebra: evaluated as its manual says, at any place of the slider, they are what `solve` finds."""

import math
import random
import re
import zipfile
from collections.abc import Mapping
from functools import cache
from io import BytesIO
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from lxml import etree

import kulman
from kulman.drawing.linkages.geogebra import Construction
from kulman.drawing.linkages.steps import drawn_views, told_of
from kulman.plans.boards.exact import run
from kulman.plans.linkages.cycle import cycle
from kulman.plans.names import ORIGIN, role
from kulman.scales.errors import LANGUAGES, InputError
from kulman.tests.support.cases import some
from kulman.tests.support.chains import chain
from kulman.tests.support.geogebra import Evaluator, is_near
from kulman.variants.case import Request
from kulman.variants.kinds.linkage import placed
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled

FEW = ("madi-four-bar",)
# of them a slotted link, a piston that drives, a group of class III
KINDS = ("nau-slider-crank", "scheme-08-planer", "scheme-18-hydraulic-drive", "scheme-20-press-automaton")
TASKS = bundled("mechanism")
EXACT = 1e-9  # part of the largest value of its kind on its plan
NEAR_LIMIT = 0.02  # part of the range of a sliding driver at its ends, where the least rounding moves links far


@cache
def construction(task: str, language: str = "uk") -> tuple[Construction, Evaluator]:
    case = Request(load_task(task), language=language).case()
    solved = placed(case)
    turn = cycle(case.task.mechanism, case.values, case.plans)
    scales = case.kind.first_scales(solved, case.choosers, case.plans)[1]
    written = Construction(case.kind.scene(case, scales, case.words()), turn)
    return written, Evaluator(written.packed(("title", "variant")))


def solved_with(task: str, **settings: float | str) -> Mapping[str, Any]:
    return placed(Request(load_task(task), settings={k: str(v) for k, v in settings.items()}).case()).values


def kinds_of(written: Construction) -> dict[str, tuple[str, str]]:
    """Return for all that the program makes what is as large as it: marks of a plan, quantities of a kind."""
    items = [(item, role(item.name)) for item in written.board.items if item.name]
    return {name: (name.plan, "" if item.kind == "point" else name.kind) for item, name in items}


def sizes_of(written: Construction, *positions: Mapping[str, Any]) -> dict[tuple[str, str], float]:
    """Return the largest of each kind; of differences in per cent the whole."""
    sizes = {kind: 100.0 if kind[1] == "delta" else 0.0 for kind in kinds_of(written).values()}
    for values in positions:
        for name, kind in kinds_of(written).items():
            size = abs(values[name])
            sizes[kind] = max(sizes[kind], size if math.isfinite(size) else 0.0)
    return sizes


def compare(
    written: Construction,
    found: Mapping[str, Any],
    values: Mapping[str, Any],
    sizes: Mapping[tuple[str, str], float] | None = None,
) -> int:
    """Compare all that the program makes with the values of `solve`; return how many."""
    sizes, kinds = sizes or sizes_of(written, values), kinds_of(written)
    for item in (item for item in written.board.items if item.name):
        name, value, step = role(item.name), found[item.label], written.program.by_name[item.name]
        if item.kind == "point" and (name.kind == ORIGIN or not name.hidden or step.verb != "place"):
            value = (value - found[written.board.origin(name.plan)]) * found[written.scales[name.plan]]
        elif written.board.drawn(name):
            value *= found[written.scales[step.plan]]
        assert is_near(value, values[name], sizes[kinds[name]], EXACT), (name, value, values[name])
    return len(kinds)


def driver(written: Construction, evaluator: Evaluator) -> tuple[str, str, list[float]]:
    """Return the name of the driver's given, the slider's label, the ends of the slider."""
    label = evaluator.free[0]
    slider = evaluator.elements[label].find("slider")
    return written.cycle.drive.variable, label, [float(slider.get(end)) for end in ("min", "max")]


def places_of(written: Construction, low: float, high: float, count: int, seed: str) -> list[float]:
    """Return random places of the slider; a travel stays a little off its ends, where rounding moves links far."""
    chance, margin = random.Random(seed), NEAR_LIMIT * (high - low) * (not written.cycle.drive.turns)
    return [chance.uniform(low + margin, high - margin) for _ in range(count)]


def settings(name: str, place: float, turns: bool) -> dict[str, str]:
    return {name: f"{math.degrees(place)!r} deg" if turns else f"{place!r} mm"}


@pytest.mark.parametrize("task", some(TASKS, *map(TASKS.index, (*FEW, *KINDS))))
def test_points_and_vectors_are_those_of_solve_wherever_the_slider_stands(task: str) -> None:
    written, evaluator = construction(task)
    name, slider, ends = driver(written, evaluator)

    assert compare(written, evaluator.at({}), solved_with(task)) > 50
    for flipped, place in enumerate(places_of(written, *ends, 2, task)):
        values = solved_with(task, **settings(name, place, written.cycle.drive.turns))
        compare(written, evaluator.at({slider: place}, flipped=bool(flipped)), values)


@pytest.mark.parametrize("task", some(TASKS, *map(TASKS.index, FEW)))
def test_no_branch_flips_over_the_turn_however_crossings_are_numbered(task: str) -> None:
    written, evaluator = construction(task)
    _, slider, (low, high) = driver(written, evaluator)
    chance, turns = random.Random(task), written.cycle.drive.turns
    margin = NEAR_LIMIT * (high - low) * (not turns)

    # not where lines stand upright or level: a force that vanishes there has no arm
    places = low + margin + (high - low - 2 * margin) * (np.arange(360) + 0.37) / 360
    rows = written.cycle.each(places if turns else places / 1000)
    positions = [run(written.program, {**written.cycle.givens, **row}).values for row in rows]
    sizes = sizes_of(written, *positions)

    for place, values in zip(places, positions, strict=True):
        compare(written, evaluator.at({slider: float(place)}, flipped=chance.random() < 0.5), values, sizes)


@pytest.mark.parametrize(
    "task", some(["madi-four-bar", "nau-slider-crank", "scheme-05-articulated-rod", "bertyaev-six-bar"], 0, 3)
)
def test_a_size_that_is_changed_moves_all_that_hangs_on_it(task: str) -> None:
    written, evaluator = construction(task)
    case = Request(load_task(task)).case()
    sizes = {name: given.value * 1.03 for name, given in case.givens.items() if name.startswith("l_A")}
    changed = {written.board.labels[name]: value for name, value in sizes.items()}

    values = solved_with(task, **{name: f"{value!r} {case.givens[name].unit}" for name, value in sizes.items()})

    assert changed
    compare(written, evaluator.at(changed), values)


def test_mechanisms_of_ones_own_are_written_with_two_digits_and_bent_links(tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text(chain(5), encoding="utf-8")
    written, evaluator = construction(str(path))

    assert compare(written, evaluator.at({}, flipped=True), solved_with(str(path))) > 400


def test_poles_are_points_to_drag_and_leave_all_values_as_they_are() -> None:
    written, evaluator = construction("scheme-09-shaper")
    poles = [item.label for item in written.board.items if item.kind == "point" and item.label in evaluator.free]

    moved = evaluator.at({label: complex(7.0 * at, -11.0) for at, label in enumerate(poles)})

    assert len(poles) == len(written.program.plans)
    compare(written, moved, solved_with("scheme-09-shaper"))


@pytest.mark.parametrize("task", [*FEW, *KINDS])
def test_plans_stand_apart_and_together_as_on_a_drawing(task: str) -> None:
    written, evaluator = construction(task)
    found, places = evaluator.at({}), dict[str, list[complex]]()
    for item in written.board.items:
        if item.kind == "point" and item.name and not role(item.name).hidden:
            places.setdefault(role(item.name).plan, []).append(found[item.label])

    drawn = [shapely.MultiPoint([(p.real, p.imag) for p in points]).envelope for points in places.values()]
    assert len(drawn) > 3
    assert not [(one, other) for one, other in combinations(drawn, 2) if one.intersects(other)]
    assert max(np.ptp(shapely.bounds(drawn).reshape(-1, 2, 2), axis=(0, 1))) < 4000.0  # mm


@pytest.mark.parametrize("language", some(LANGUAGES, 2))
def test_the_bar_stops_at_every_step_that_the_note_tells_in_its_words(language: str) -> None:
    written, evaluator = construction("scheme-09-shaper", language)
    teller = written.teller
    told = [one.text for view in drawn_views(teller) for one in told_of(teller, view)]
    stops = [entry for entry in evaluator.elements.values() if entry.find("breakpoint") is not None]
    captions = [entry.find("caption").get("val") for entry in stops]

    assert len(captions) == len(told)
    plain = [re.sub("⟦.*⟧", "", text) for text in told]
    plain = [text for text in plain if not re.search(r"[\\_^]", text)]  # scripts are written otherwise there
    assert len(plain) > 3
    assert {*plain} <= {*captions}
    assert evaluator.root.find("gui/consProtNavigationBar").get("show") == "true"
    assert evaluator.root.find("gui/consProtocol").get("showOnlyBreakpoints") == "true"


@pytest.mark.parametrize("task", some(TASKS, 0, 19))
@pytest.mark.parametrize("language", ["uk", "ru"])
def test_no_object_is_called_by_an_english_word(task: str, language: str) -> None:
    _, evaluator = construction(task, language)
    own = {re.sub(r"\W|_", "", name) for name in load_task(task).givens}  # as the author of a task calls them

    labels = {label: re.sub(r"\W|_", "", label) for label in evaluator.elements}
    assert len(labels) > 100
    assert [label for label, plain in labels.items() if re.search("[a-z]{4}", plain) and plain not in own] == []
    assert not any("bar" in label for label in labels)


def test_letters_are_those_of_the_sheet() -> None:
    _, evaluator = construction("scheme-09-shaper")
    seen = {label for label, entry in evaluator.elements.items() if entry.find("show").get("label") == "true"}
    values = evaluator.at({})
    texts = [values[label] for label, entry in evaluator.elements.items() if entry.get("type") == "text"]

    assert seen >= {
        "O",
        "A",
        "C",
        "D",
        "E",
        "S_{3}",
        "p",
        "a",
        "a_{3}",
        "d",
        "p'",
        "a'",
        "V_{A}",
        "V_{ED}",
        "a_{E}",
        "R_{05}",
    }
    assert "e" in texts  # no label of GeoGebra
    assert r"a^{n}_{ED}" in texts
    assert any(text.startswith("План швидкостей\nμ_{V} = 0.004") for text in texts)
    speeds = next(text for text in texts if text.startswith("V_{A} = ")).splitlines()
    (speed,) = (float(line.split()[2]) for line in speeds if line.startswith("V_{E} "))
    assert speed == pytest.approx(abs(solved_with("scheme-09-shaper")["V_E"]))


def test_numbers_and_directions_that_others_are_made_of_are_not_seen() -> None:
    _, evaluator = construction("madi-four-bar")
    seen = {
        shown: {entry.get("type") for entry in evaluator.elements.values() if entry.find("show").get("object") == shown}
        for shown in ("true", "false")
    }

    assert seen["true"] >= {"point", "vector", "segment", "text", "conic"}
    assert seen["false"] >= {"numeric", "line", "vector"}
    assert not seen["true"] & {"numeric", "line"}


def test_a_label_that_is_shown_is_the_letter_and_another_letter_is_a_text() -> None:
    written, _ = construction("nau-slider-crank")
    raised = {item.label for item in written.board.items if "^" in written.words.symbol(role(item.name).shown)}

    with zipfile.ZipFile(BytesIO(written.packed(("title", "variant")))) as packed:
        root = etree.fromstring(packed.read("geogebra.xml"))
    shown = {found.getparent().get("label") for found in root.iter("show") if found.get("label") == "true"}

    assert {"A", "V_{BA}", "F_{i2}"} <= shown
    assert {"a_{nBA}", "R_{t12}"} <= raised
    assert not raised & shown


def test_files_are_the_same_again_and_others_are_refused(tmp_path: Path) -> None:
    sheet = kulman.sheet("nau-slider-crank", lang="en")
    (first,), (second,) = sheet.save(tmp_path / "a.ggb"), sheet.save(tmp_path / "b.ggb")
    assert first.read_bytes() == second.read_bytes()
    assert len(first.read_bytes()) < 20_000
    assert not sheet.warnings_of("a.ggb")
    for task, options, key in (
        ("madi-cam", {"only": "diagrams"}, "construction-kinds"),
        ("nau-slider-crank", {"positions": 3}, "handout-apart"),
    ):
        with pytest.raises(InputError) as refused:
            kulman.sheet(task, **options).save(tmp_path / "c.ggb")
        assert refused.value.key == key
    assert not (tmp_path / "c.ggb").exists()
