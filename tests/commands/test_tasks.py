"""The twenty schemes: each has the structure of its kind of machine, and every variant has good plans everywhere."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import numpy as np
import pytest

from kulman import load_task
from kulman.plans.boards.batch import batch
from kulman.plans.boards.exact import STATUSES, run
from kulman.plans.linkages.chain import construct
from kulman.plans.linkages.mechanism import FRAME, Driver, Prismatic, Revolute
from kulman.plans.linkages.solved import board_givens, solve_linkage
from kulman.plans.linkages.structure import Group, analyse
from kulman.variants.shelf import bundled, bundled_text, summary

# The customary schemes of course projects: I is the driver, then the groups by class and kind (class III by order) with
# their links; -> on links of a group before, || on the driver alone.
FORMULAS = {
    "scheme-01-compressor": "I -> II2(2,3)",
    "scheme-02-forging-press": "I -> II2(2,3)",
    "scheme-03-crank-rocker": "I -> II1(2,3)",
    "scheme-04-v-engine": "I -> II2(2,3) || II2(4,5)",
    "scheme-05-articulated-rod": "I -> II2(2,3) -> II2(4,5)",
    "scheme-06-opposed-compressor": "I -> II2(2,3) || II2(4,5)",
    "scheme-07-two-stage-compressor": "I -> II2(2,3) -> II2(4,5)",
    "scheme-08-planer": "I -> II1(2,3) -> II2(4,5)",
    "scheme-09-shaper": "I -> II3(2,3) -> II2(4,5)",
    "scheme-10-shaper-two-blocks": "I -> II3(2,3) -> II4(4,5)",
    "scheme-11-slotter": "I -> II3(2,3) -> II2(4,5)",
    "scheme-12-shaking-conveyor": "I -> II1(2,3) -> II2(4,5)",
    "scheme-13-toggle-press": "I -> II1(2,3) -> II2(4,5)",
    "scheme-14-jaw-crusher": "I -> II1(2,3) -> II1(4,5)",
    "scheme-15-lever-shears": "I -> II1(2,3) -> II1(4,5)",
    "scheme-16-hay-baler": "I -> II1(2,3) -> II2(4,5)",
    "scheme-17-sewing-machine": "I -> II2(2,3) || II1(4,5)",
    "scheme-18-hydraulic-drive": "I -> II1(2,3)",
    "scheme-19-scotch-yoke": "I -> II5(2,3)",
    "scheme-20-press-automaton": "I -> III3(2,3,4,5)",
}
VARIANTS = [  # three of ten by default, others with each scheme
    pytest.param(scheme, str(variant), marks=[] if (number + variant) % 3 == 0 else pytest.mark.soak)
    for number, scheme in enumerate(FORMULAS)
    for variant in range(10)
]
POSITIONS = 360
TRAVEL = 0.15  # m, of the hydraulic cylinder
LEAST, FLAT = math.sin(math.radians(20.0)), math.sin(math.radians(15.0))


def formula(groups: tuple[Group, ...]) -> str:
    """Write the structure formula with ASCII letters."""
    text, before = "I", {FRAME}
    for group in groups:
        parallel = bool(before - {FRAME}) and before.isdisjoint({*group.before} - {FRAME})
        kind = f"II{group.view}" if group.group_class == 2 else f"III{group.order}"
        text += f" {'||' if parallel else '->'} {kind}({','.join(map(str, sorted(group.links)))})"
        before |= {*group.links}
    return text


@pytest.mark.parametrize("task", bundled())
def test_what_list_shows_is_what_the_file_holds(task: str) -> None:
    raw = tomllib.loads(bundled_text(task))

    shown = summary(task)

    heads = ("id", "title", "source", "note", "plans")
    assert {name: shown.get(name) for name in heads} == {name: raw.get(name) for name in heads}
    assert shown["variants"] == [row["id"] for row in raw["variant"]]
    assert shown["givens"] == {name: given.get("unit") or given["choices"] for name, given in raw["givens"].items()}


@pytest.mark.parametrize("scheme", FORMULAS)
def test_scheme_has_the_structure_of_its_machine(scheme: str) -> None:
    assert formula(analyse(load_task(scheme).mechanism).groups) == FORMULAS[scheme]


def test_schemes_have_all_dyads_bent_links_forked_joints_and_shafts_with_two_cranks() -> None:
    mechanisms = {scheme: load_task(scheme).mechanism for scheme in FORMULAS}
    kinds = {group.kind for mechanism in mechanisms.values() for group in analyse(mechanism).groups}

    assert kinds >= {"RRR", "RRP", "RPR", "PRP", "RPP"}
    for scheme in ("scheme-04-v-engine", "scheme-07-two-stage-compressor", "scheme-13-toggle-press"):
        joints = [pair.point for pair in mechanisms[scheme].pairs if isinstance(pair, Revolute)]
        assert len(joints) > len(set(joints)), scheme
    for scheme, link in (("scheme-05-articulated-rod", 2), ("scheme-08-planer", 3), ("scheme-16-hay-baler", 2)):
        assert len(mechanisms[scheme].link(link).points) >= 4
    assert {"O", "A", "C"} == set(mechanisms["scheme-06-opposed-compressor"].link(1).points)


@pytest.mark.parametrize(("scheme", "variant"), VARIANTS)
def test_variant_has_good_plans_in_every_position_of_the_driver(scheme: str, variant: str) -> None:
    task = load_task(scheme)
    driver = task.mechanism.driver
    places = np.arange(POSITIONS) * ((2.0 * math.pi if isinstance(driver, Driver) else TRAVEL) / POSITIONS)
    _, program = construct(task.mechanism, ["velocity"])
    wanted = [name for name in program.names if not name.startswith("_")]

    def givens(at: object) -> dict[str, Any]:
        values: dict[str, Any] = {**task.values(variant), driver.coordinate: at}
        return dict(board_givens(task.mechanism, values, program))

    solved = solve_linkage(task.mechanism, task.values(variant))
    _, codes = batch(program, givens(places), wanted)
    flattest = min(min(run(program, givens(float(at))).sines.values()) for at in places[:: POSITIONS // 18])

    mark, sine = solved.worst_sine()
    assert solved.status == "ok"
    assert sine > LEAST, mark
    assert {STATUSES[code] for code in codes} == {"ok"}
    assert flattest > FLAT


@pytest.mark.soak
@pytest.mark.parametrize("scheme", FORMULAS)
def test_most_variants_are_drawn_while_the_load_acts(scheme: str) -> None:
    task = load_task(scheme)
    names = [load.name for load in (*task.mechanism.loads, *task.mechanism.couples)]

    acting = [
        all(abs(solve_linkage(task.mechanism, task.values(variant), ["forces"]).values[name]) > 0.0 for name in names)
        for variant in task.variants
    ]

    assert sum(acting) >= 8


@pytest.mark.parametrize(
    ("scheme", "out"),
    [
        ("scheme-08-planer", -1.0),
        ("scheme-09-shaper", -1.0),
        ("scheme-10-shaper-two-blocks", -1.0),
        ("scheme-11-slotter", -1j),
    ],
)
def test_machine_tools_cut_slowly_and_return_fast(scheme: str, out: complex) -> None:
    task = load_task(scheme)
    assert isinstance(task.mechanism.driver, Driver)
    _, program = construct(task.mechanism, ["position"])
    (tool,) = (pair.point for pair in task.mechanism.pairs if isinstance(pair, Prismatic) and FRAME in pair.links)
    phi = np.arange(POSITIONS) * (2.0 * math.pi / POSITIONS)

    for variant in task.variants:
        values = task.values(variant)
        turned = phi * values[task.mechanism.driver.sense]
        places, _ = batch(program, board_givens(task.mechanism, {**values, "phi": turned}), [tool])
        way = np.diff((places[tool] * np.conj(out)).real, append=(places[tool][0] * np.conj(out)).real)
        assert np.count_nonzero(way > 0.0) >= POSITIONS / 2
