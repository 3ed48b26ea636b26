"""Equations of random linkages: every printed calculation recomputes, every vector equation can be solved."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import pytest

from kulman import sheet
from kulman.drawing.formats import STYLES
from kulman.drawing.linkages.calculations.equations import Lines, drawn_on, kinematics_lines, printed_segment
from kulman.drawing.linkages.calculations.forces import force_lines, force_parts, lever_lines
from kulman.drawing.linkages.calculations.tables import ROWS, _links_of, formula, results_parts, results_table
from kulman.drawing.linkages.figures.group import zeros
from kulman.drawing.linkages.ladders import first_scales
from kulman.drawing.linkages.reading import lettered
from kulman.drawing.linkages.scene import Scene
from kulman.drawing.linkages.statement import statements
from kulman.drawing.shapes import Circle, Group
from kulman.drawing.words import Words, notations
from kulman.plans import names
from kulman.plans.linkages.chain import PLANS, construct
from kulman.plans.linkages.mechanism import Mechanism
from kulman.plans.linkages.solved import solve_linkage
from kulman.plans.names import role
from kulman.scales.errors import LANGUAGES
from kulman.scales.scale import Display
from kulman.tests.linkages.test_loads import VALUES as LOADED
from kulman.tests.linkages.test_loads import piston
from kulman.tests.support.cases import some
from kulman.tests.support.dyads import random_dyads, random_trains, random_triads
from kulman.tests.support.mechanisms import nau_slider_crank, nau_values, one_of, twin, twin_values
from kulman.tests.support.printed_numbers import (
    calculations,
    disagreements,
    equation_faults,
    evaluate,
    half_digit,
    reactions,
    recomputes,
    table,
    value,
)
from kulman.tests.support.printed_numbers import told as told_of
from kulman.tests.support.readback import read_back
from kulman.variants.reader import load_task
from kulman.variants.shelf import bundled as shelf

SLIDERS = ("nau-slider-crank", "bertyaev-six-bar", "scheme-04-v-engine", "scheme-09-shaper", "scheme-16-hay-baler")
SCHEMES = [task for task in shelf("mechanism") if task.startswith("scheme-")]
KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
CASES = [(kind, before, bent) for kind in KINDS for before, bent in (((2, 3), True), ((3, 0), False))]
TRAINS = [("RRR", "RPP"), ("RRP", "RPR"), ("RPR", "PRP"), ("PRP", "RRP"), ("RPP", "RRR")]


def scene_of(mechanism: Mechanism, values: dict[str, float], lang: str = "en", notation: str = "nau") -> Scene:
    solved = solve_linkage(mechanism, values)
    assert solved.trouble is None
    words = lettered(Words.of(lang, notation), solved)
    return Scene(solved, scales=first_scales(solved, {}, PLANS)[1], words=words, style=STYLES["A1"], givens={})


def bundled(task: str, lang: str = "en", notation: str = "nau") -> Scene:
    found = load_task(task)
    return scene_of(found.mechanism, found.values(), lang, notation)


@lru_cache(maxsize=64)
def random_scene(kind: str, before: tuple[int, int], bent: bool, number: int = 0) -> Scene:
    """A random linkage with a dyad of this kind, in one of the languages and notations."""
    seed = KINDS.index(kind) * 100 + number
    moving = 0 not in before
    carries = {"PRP": (False, moving), "RPP": (moving, False)}.get(kind, (moving and bool(seed % 2),))
    mechanism, values, _ = random_dyads(kind, before, carries, seed, 1, bent)
    lang, notation = LANGUAGES[seed % 3], notations()[seed % len(notations())]
    return scene_of(mechanism, one_of(values, 0), lang, notation)


def lines_of(scene: Scene) -> Lines:
    lines = [line for plan in ("velocity", "acceleration") for line in kinematics_lines(scene, plan)]
    return [*lines, *force_lines(scene), *lever_lines(scene)]


def text_faults(scene: Scene) -> Iterator[str]:
    """Calculations that do not recompute, equations with too many unknowns, texts that are not filled in."""
    count = 0
    for line in lines_of(scene):
        text = " ".join(line)
        if re.search(r"None|nan|inf\b|\{\}|_F_|_V_|_M_\w", text):
            yield f"unfilled: {text}"
        for expression, result in calculations(re.sub(r"\\\w+", "", text)):
            count += 1
            if not recomputes(evaluate(expression), result):
                yield f"{expression} = {evaluate(expression)}, printed {result}"
        yield from unknown_faults(text)
    if count < 15:
        yield f"only {count} calculations"


def unknown_faults(text: str) -> Iterator[str]:
    """A vector with one line under it has one unknown, one without a line has two; an equation solves two."""
    body = text.partition(",")[0]
    if "\\u{" not in body and "\\uu{" not in body:
        return
    single, bars, ruled = body.count("\\u{"), body.count("\\bar{"), body.count("\\u{") + body.count("\\uu{")
    if single + 2 * (bars - ruled) > 2 * body.count("="):
        yield f"too many unknowns: {body}"


@pytest.mark.parametrize(("kind", "before", "bent"), CASES)
def test_equations_of_a_random_dyad_recompute_can_be_solved_and_are_told_in_order(
    kind: str, before: tuple[int, int], bent: bool
) -> None:
    scene = random_scene(kind, before, bent)
    solved = scene.solved

    assert list(text_faults(scene)) == []
    for plan in ("velocity", "acceleration"):  # points of guides before what slides on them
        told_of = ""
        for line in map(plain, kinematics_lines(scene, plan)):
            guides = re.findall(r"\[\[([Va][A-Z]\d)\]\]", line)
            assert [name for name in guides if f"{name} =" not in told_of] == [], line
            told_of += re.sub(r"[\[\]]", "", line)
    shown = [name for part in results_parts(solved) for name in part.names]  # each result stands in one table
    wanted = {q.name for q in solved.quantities.values() if q.kind != "point" and "_couple_" not in q.name}
    assert sorted(shown) == sorted(wanted & {*solved.program.names})


@pytest.mark.soak
@pytest.mark.parametrize(("kind", "before", "bent"), CASES)
def test_equations_of_many_dyads(kind: str, before: tuple[int, int], bent: bool) -> None:
    for number in range(30):
        scene = random_scene(kind, before, bent, number)

        # near a singular position forces grow beyond the digits that a sheet prints
        assert scene.solved.worst_sine()[1] < 0.1 or (number, *text_faults(scene)) == (number,)


@pytest.mark.parametrize(("first", "second"), TRAINS)
def test_equations_of_two_dyads_in_series(first: str, second: str) -> None:
    mechanism, values, _ = random_trains((first, second), ((2, 3), (4, 5)), TRAINS.index((first, second)), 1)

    scene = scene_of(mechanism, one_of(values, 0))

    assert list(text_faults(scene)) == []
    assert all(len(part.names) <= ROWS for part in results_parts(scene.solved))


@pytest.mark.parametrize(("kinds", "before", "bent"), [("RRR", (2, 3, 0), False), ("PRG", (2, 3, 1), True)])
def test_equations_of_a_triad(kinds: str, before: tuple[int, int, int], bent: bool) -> None:
    mechanism, values, _ = random_triads(kinds, before, 3, 1, bent)

    scene = scene_of(mechanism, one_of(values, 0), notation="bauman")

    assert list(text_faults(scene)) == []
    parts = results_parts(scene.solved)
    assert len({part.name for part in parts}) == len(parts)
    assert all(len(part.names) <= ROWS for part in parts)
    assert told(scene, "X5 is Assur's special point:").count("∩") == 1
    assert told(scene, "aX5 =").count("[[an") >= 2


def plain(line: tuple[str, ...]) -> str:
    """The line without bars and scripts, double lines as [[ ]], single ones as [ ]."""
    text = re.sub(r"\\bar\{([^{}]*)\}", r"\1", " ".join(line))
    for _ in range(3):
        text = re.sub(r"[_^]\{([^{}]*)\}", r"\1", text)
    return re.sub(r"\\u\{([^{}]*)\}", r"[\1]", re.sub(r"\\uu\{([^{}]*)\}", r"[[\1]]", text))


def told(scene: Scene, beginning: str) -> str:
    """The one line that begins so."""
    (line,) = [text for text in map(plain, lines_of(scene)) if text.startswith(beginning)]
    return line


def test_ever_smaller_kinematic_schemes_fill_heights_of_100_80_and_60_mm_at_round_scale_factors() -> None:
    scene, heights = bundled("scheme-01-compressor"), []
    for scheme, *_ in statements(scene, ("velocity",), "0", width=120.0):
        places = {g.name: g.shapes[0] for g in scheme.shapes if isinstance(g, Group) and g.role == "pair"}
        assert isinstance(places["B"], Circle)
        heights.append(places["B"].centre.imag)

    assert heights == pytest.approx([scene.solved.point("B").imag / mu for mu in (0.005, 0.006, 0.008)])
    assert heights == pytest.approx([80.69, 67.24, 50.43], abs=0.01)


def test_the_opposite_of_a_length_is_written_as_that_length() -> None:
    for lang in LANGUAGES:
        scene = bundled("scheme-06-opposed-compressor", lang)
        assert re.fullmatch(r"pc = pa = \d+[.,]\d mm|pc = pa = \d+,\d мм", told(scene, "pc = "))


def test_dyad_between_moving_links_has_both_ways() -> None:
    scene = scene_of(*one("RRR"))

    assert told(scene, "VR =") == "VR = [[VP]] + [VRP] = [[VQ]] + [VRQ], VRP ⊥ PR, VRQ ⊥ QR"


def test_slotted_link_has_coincident_points_and_coriolis() -> None:
    scene = scene_of(*one("RPR"))

    assert told(scene, "VP5 =") == "VP5 = [[VQ]] + [VP5Q] = [[VP]] + [VP5P4], VP5Q ⊥ QP, VP5P4 ∥ x–x"
    acceleration = "aP5 = [[aQ]] + [[anP5Q]] + [atP5Q] = [[aP]] + [[akP5P4]] + [arP5P4], atP5Q ⊥ QP, arP5P4 ∥ x–x"
    assert told(scene, "aP5 =") == acceleration
    assert told(scene, "akP5P4 = 2·ω5·VP5P4 =").endswith("akP5P4: VP5P4 turned by 90° in the sense of ω5")
    assert told(scene, "ω4 = ω5 =")
    assert told(scene, "ΣMQ").startswith("ΣMQ(4, 5) = 0:")  # no moment about the pin of the lever


def one(kind: str) -> tuple[Mechanism, dict[str, float]]:
    mechanism, values, _ = random_dyads(kind, (2, 3), (False,), 7, 1)
    return mechanism, one_of(values, 0)


def test_groups_in_series_and_side_by_side_have_their_formula_and_blocks() -> None:
    series, parallel = (scene_of(twin(one_after_other), twin_values()) for one_after_other in (True, False))
    parts = force_parts(series.solved)

    assert " ".join(formula(series.solved.structure)) == "I(0, 1) → II_{2}(2, 3) → II_{2}(4, 5)"
    assert " ".join(formula(parallel.solved.structure)) == "I(0, 1) → II_{2}(2, 3) ∥ II_{2}(4, 5)"
    assert parts == ("loads", "45", "23", "1")
    blocks = [force_lines(series, part) for part in parts]
    whole = sorted(force_lines(series), key=lambda line: next(i for i, block in enumerate(blocks) if line in block))
    assert [line for block in blocks for line in block] == whole


@pytest.mark.parametrize("task", some(SCHEMES, *range(0, 99, 3)))
def test_reactions_are_printed_as_the_actions_are(task: str) -> None:
    scene = bundled(task, "en")
    scales = {}
    for number, (plan, scale) in enumerate(scene.scales.items()):  # every plan has its own
        scales[plan] = replace(scale, mu=scale.mu * (1.0, 1.25, 2.0, 0.8)[number % 4])
    scene = replace(scene, scales=scales)

    parts = [part for part in results_parts(scene.solved) if part.kind == "forces"]
    rows = [row for part in parts for row in results_table(scene, part).rows[1:]]

    pairs = reactions(rows)
    assert pairs
    assert [pair for pair in pairs if pair[0][1] != pair[1][1]] == []
    for symbol, mm, mu, printed, *_ in rows:
        assert mm == "–" or recomputes(value(mm) * value(mu), printed), symbol
    coarsest = max(scale.mu for plan, scale in scales.items() if plan.startswith("forces"))
    names = [name for part in parts for name in part.names]
    for q, row in ((scene.quantities[name], row) for name, row in zip(names, rows, strict=True)):
        near = max(0.05 * coarsest, half_digit(row[3]))
        assert q.unit != "N" or abs(value(row[3]) - (q.value or 0.0)) <= near, q.name


def test_results_of_equations_have_the_digits_of_their_rows_and_of_the_lever() -> None:
    alike, others, long, inputs = 0, list[str](), 0, 0
    for task in SCHEMES:
        scene = bundled(task, "en")
        tables = [(part.kind, results_table(scene, part).rows[1:]) for part in results_parts(scene.solved)]
        printed = {row[0]: row[1] for kind, rows in tables for row in rows if kind == "lever"}
        printed |= {row[0]: row[3] for kind, rows in tables for row in rows if kind != "lever"}
        for line in lines_of(scene):
            text = re.sub(r"\\bar|\\u+", "", " ".join(line))
            symbol, result = re.match(r"\S+(?= =)", text), list(calculations(text))
            long += sum(len(n.replace(".", "").lstrip("0")) > 5 for e, _ in result for n in re.findall(r"\d+\.\d+", e))
            inputs += len(result)
            if symbol is None or not result or symbol[0] not in printed:
                continue
            alike += printed[symbol[0]] == result[-1][1].lstrip("−")
            others += [task + ": " + text] * (printed[symbol[0]] != result[-1][1].lstrip("−"))

    assert alike > 250
    assert others == []
    assert long < 0.01 * inputs


def sheets() -> Iterator[tuple[str, str, str, str | None]]:
    """All linkages, all variants, as large as they are drawn by default in two languages, and on A4."""
    for task in shelf("mechanism"):
        for variant in load_task(task).variants:
            yield from ((task, variant, lang, paper) for lang, paper in (("uk", None), ("en", None), ("uk", "A4")))


@pytest.mark.parametrize(("task", "variant", "lang", "paper"), some(sheets(), 0, 4, 5, 130, 402, 522))
def test_a_quantity_has_one_number_wherever_it_is_printed(
    task: str, variant: str, lang: str, paper: str | None
) -> None:
    drawn = read_back(sheet(task, variant, lang=lang, format=paper))

    assert list(disagreements(drawn)) == []
    assert equation_faults(drawn)[1] == []
    assert len(told_of(drawn)) > 40


@pytest.mark.parametrize("variant", ["0", "7"])
@pytest.mark.parametrize("task", SCHEMES)
def test_a_drawn_vector_has_its_segment_and_vectors_between_the_same_ends_have_one_number(
    task: str, variant: str
) -> None:
    found = load_task(task)
    scene, alike = scene_of(found.mechanism, found.values(variant)), dict[object, set[tuple[str, ...]]]()

    drawn = [q for q in scene.quantities.values() if q.value and drawn_on(scene, q) in scene.scales]
    long = [q for q in drawn if abs(q.value or 0.0) >= scene.scales[drawn_on(scene, q)].mu]
    assert [q.name for q in long if printed_segment(scene, q)[0] == ""] == []
    for edge in (edge for plan in scene.scales for edge in scene.reading.on(plan)):
        ends = frozenset(complex(round(end.real, 6), round(end.imag, 6)) for end in scene.ends(edge))
        if edge.name in scene.quantities and len(ends) > 1:
            own = scene.quantities[edge.name]
            alike.setdefault((role(edge.tail).plan, ends), set()).add(printed_segment(scene, own))
    assert [numbers for numbers in alike.values() if len(numbers) > 1] == []


def test_two_forces_that_balance_a_driver_have_one_number() -> None:
    tasks = [load_task(task) for task in SCHEMES]
    scenes = [scene_of(task.mechanism, task.values(variant), "uk") for task in tasks for variant in ("1", "5")]

    pairs = [
        [printed_segment(scene, scene.quantities[name])[-1] for name in ("R_21", "R_01")]
        for scene in scenes
        if {edge.name for edge in scene.reading.on("forces_1")} == {"R_21", "R_01"}
    ]
    assert len(pairs) > 10
    assert not [pair for pair in pairs if pair[0] != pair[1]]


@pytest.mark.parametrize("task", some(SCHEMES, *range(0, 99, 3)))
def test_forces_moments_and_arms_that_are_zero_are_said_apart(task: str) -> None:
    scene = bundled(task, LANGUAGES[len(task) % 3])
    asked = [q for q in scene.quantities.values() if q.unit in ("N", "N*m") or role(q.name).kind == "h"]
    said = [(q.unit.removesuffix("/s"), role(q.name).shown) for q in asked]
    units = {scene.words.symbol(shown, bar): unit for unit, shown in said for bar in (False, True)}

    told = [part for line in zeros(scene, [q.name for q in asked]) for part in line.split("; ")]

    zero = {q.name for q in asked if scene.vanishes(q.name)}
    found = [[units[symbol] for symbol in part.split(" = ")[:-1]] for part in told]
    assert all(part.endswith(" = 0") for part in told)
    assert all(len({*chain}) == 1 for chain in found), told
    assert not zero or len(found) > 0


@pytest.mark.parametrize("task", some(SCHEMES, *range(1, 99, 7)))
def test_forces_that_are_calculated_keep_their_digits_though_their_segments_are_short(task: str) -> None:
    scene = bundled(task)
    forces = {name: q for name, q in scene.quantities.items() if name.startswith("F_i") and not scene.vanishes(name)}

    printed = {name: printed_segment(scene, q)[-1] for name, q in forces.items()}

    told = {name: text for name, text in printed.items() if text}
    few = {name for name, text in told.items() if len(re.sub(r"\D", "", text).lstrip("0")) <= 3}  # of few digits
    right = {name: pytest.approx(abs(forces[name].value or 0.0), rel=2e-2 if name in few else 5e-3) for name in told}
    assert {name: float(printed[name]) for name in right} == right
    assert right


@pytest.mark.parametrize("task", some(SLIDERS, 0, 3))
def test_moments_about_the_pin_of_every_slider_are_summed(task: str) -> None:
    scene = bundled(task)
    lines = [" ".join(line) for line in lines_of(scene)]
    names = [step.name for step in scene.program if step.law == "opposite" and role(step.name).kind == "M"]

    told = [
        any("ΣM" in line and scene.words.symbol(name).replace("M", "h") in line for line in lines) for name in names
    ]

    assert told
    assert all(told)


def test_a_centre_of_mass_on_a_joint_is_found_by_no_similarity() -> None:
    mechanism = nau_slider_crank()
    at_A = {**mechanism.link(2).points, "S2": mechanism.link(2).points["A"]}
    links = tuple(replace(link, points=at_A) if link.number == 2 else link for link in mechanism.links)

    apart, together = (
        " ".join(map(plain, lines_of(scene_of(one, nau_values()))))
        for one in (mechanism, replace(mechanism, links=links))
    )

    assert "as2" in apart
    assert "as2" not in together


def test_frame_is_the_last_link_where_the_notation_says_so() -> None:
    scene = scene_of(nau_slider_crank(), nau_values(), "ru", "artobolevsky")

    assert scene.words.frame == "4"
    assert "[[F21]] + F41 = 0" in map(plain, lines_of(scene))
    assert formula(scene.solved.structure, scene.words.frame)[0] == "I(4, 1)"


def test_sliding_driver_is_stated_along_its_guide_and_balanced_by_a_force() -> None:
    scene = scene_of(*piston(LOADED))

    assert told(scene, "VB = v =").endswith("VB ∥ x–x")
    assert told(scene, "[[R21]]") == "[[R21]] + [[Fi1]] + [Fbal] + [R01] = 0, Fbal ∥ x–x, R01 ⊥ x–x"
    assert re.search(r"= 0\.\d\d %$", told(scene, "ΔFbal = (FLbal − Fbal)/FLbal·100 % ="))
    assert told(scene, "ε3 = atA/lOA =").endswith("= 0 rad/s2")
    assert "ε3 = 0: in this position link 3 turns uniformly" in map(plain, lines_of(scene))
    assert told(bundled("scheme-19-scotch-yoke"), "R03 = 0") == "R03 = 0: the pair bears the moment M03 alone"


def test_crank_is_balanced_by_a_force_at_its_pin() -> None:
    scene = bundled("madi-four-bar", "ru", "madi")

    assert told(scene, "ΣMA(1)") == "ΣMA(1) = 0: −Pур·lAB + R21·h21·μl1 = 0"
    assert told(scene, "[[R21]]") == "[[R21]] + [[Pи1]] + [[Pур]] + R01 = 0"
    assert told(scene, "Mсумм =").startswith("Mсумм = Mи3 + M3 =")
    assert told(scene, "M3 =") == "M3 = 380,0 Н·м, против ω3"


def test_units_of_display_stand_in_equations() -> None:
    scene = scene_of(nau_slider_crank(), nau_values(), "uk")
    shown = replace(scene, words=scene.words.showing(Display("cm", "cm")))

    assert told(shown, "VA =") == "VA = ω1·lOA = 80,111·5 = 400,6 см/с"
    assert told(shown, "as2 =").endswith(" см")
    assert told(shown, "Mi2 =").endswith("Н·м")
    assert list(text_faults(shown)) == []


@pytest.mark.parametrize(
    ("notation", "paper", "head"),
    [("nau", "mm", "μ, од./мм"), ("nau", "cm", "μ, од./см"), ("bauman", "mm", "μ, мм/од.")],
)
def test_the_column_of_scale_factors_says_what_they_count(notation: str, paper: str, head: str) -> None:
    scene = scene_of(nau_slider_crank(), nau_values(), "uk", notation)
    shown = replace(scene, words=scene.words.showing(Display("m", paper)))

    heads = [[*results_table(shown, part).rows[0]] for part in results_parts(shown.solved) if part.kind != "lever"]

    assert len(heads) > 2
    assert {row[2] for row in heads} == {head}


def test_tables_take_a_point_to_its_own_link_whatever_other_mechanisms_called_so() -> None:
    mechanism = load_task("scheme-09-shaper").mechanism
    solved = solve_linkage(mechanism, load_task("scheme-09-shaper").values("0"))
    for maker in (names._vector, names.spelled):
        maker.cache_clear()  # type: ignore[attr-defined]
    for kind in ("V", "a"):  # point A of link 9, of a mechanism that was looked at before
        names.vector(kind, names.Name("A3", names.POINT, "A", links=(9,)))
    structure, program = construct(mechanism)
    made = {step.name: step.name for step in program}

    for kind in ("V", "a"):
        assert _links_of(replace(solved, structure=structure), made[f"{kind}_A3"]) == {3}
        assert _links_of(replace(solved, structure=structure), made[f"{kind}_A"]) == {1}


@pytest.mark.parametrize("task", some([*SCHEMES, "nau-slider-crank", "madi-four-bar"], *range(0, 99, 4)))
def test_the_opposite_of_a_reaction_that_is_read_off_has_its_segment(task: str) -> None:
    drawn = read_back(sheet(task, lang="en"))
    rows = {row[0]: row for view in drawn.views if view.name.startswith("results_forces") for row in table(view)}

    pairs = [(rows[one], rows[other]) for (one, _), (other, _) in reactions([*rows.values()])]

    assert pairs != []
    assert [pair for pair in pairs if (pair[0][1] == "–") != (pair[1][1] == "–")] == []
