"""Mechanisms of ten and more links: every command takes them, and no name means two things.

The rule: where a link has a number of two digits, the numbers of two links are parted in every name, `R_12_10`,
`h_2_1`, `mu_F_2_3`; a number without an underline before the next one is that of one link.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from kulman import load_task, solve
from kulman.plans.linkages.mechanism import FRAME, Mechanism
from kulman.plans.linkages.solved import solve_linkage
from kulman.tests.support.cases import some
from kulman.tests.support.chains import chain
from kulman.tests.support.commands import Run
from kulman.tests.support.linkage_cases import Oracle
from kulman.tests.support.task_files import task_of
from kulman.variants.shelf import bundled
from kulman.variants.solution import Solution

DYADS = [4, 12, 19]  # 9, 25 and 39 links
OF_LINKS = re.compile(r"(?:R|M|h)_(\d+(?:_\d+)?)(?:_(?:[ntm]|[A-Z]\w*))?|mu_F_(\d+(?:_\d+)*)|(?:M_i|F_i|G_)(\d+)")


@cache
def solved(count: int) -> Solution:
    return solve(task_of(chain(count)))


def links_in(name: str, parted: bool) -> list[int]:
    """Return the links of a name by the rule that the documents state."""
    found = OF_LINKS.fullmatch(name)
    index = next(filter(None, found.groups()), "") if found else ""
    return [int(number) for number in (index.split("_") if parted else index) if number]


def pairs(solution: Solution) -> set[tuple[int, int]]:
    """Return all that touch one another, both ways."""
    touching = {(a, b) for pair in solution.solved.mechanism.pairs for a, b in (pair.links, pair.links[::-1])}
    groups = {(group.links[0], group.links[1]) for group in solution.solved.structure.groups}
    return touching | groups


@pytest.mark.parametrize("count", DYADS)
def test_every_name_says_which_links_it_means(count: int) -> None:
    solution = solved(count)
    numbers = {FRAME, *(link.number for link in solution.solved.mechanism.links)}
    touching, parted = pairs(solution), count > DYADS[0]

    named = {name: links_in(name, parted) for name in (*solution.solved.program.names, *solution.scales)}

    for name, links in named.items():
        assert set(links) <= numbers, name
        assert len(links) < 2 or tuple(links) in touching, name
    reactions = {tuple(links) for name, links in named.items() if name.startswith("R_")}
    assert {(a, b) for a, b in touching if (b != FRAME and (a, b) in reactions) or b == FRAME} >= touching - {(0, 1)}
    assert ("R_12_11" in named) == ("h_2_1" in named) == ("mu_F_2_3" in solution.scales) == parted
    assert ("h_21" in named) == (not parted or count > 10)  # the arm of R_21, or that of the link's own force


@pytest.mark.parametrize("count", DYADS)
def test_many_links_move_and_bear_as_their_constraints_say(count: int) -> None:
    solution = solved(count)
    known, values = Oracle(solution).known, solution.solved.values

    assert solution.status in ("ok", "ill-conditioned")
    for kind in ("V_", "a_", "omega_", "epsilon_", "R_", "M_bal"):
        names = [name for name in known if name.startswith(kind) and name in values]
        largest = max(abs(known[name]) for name in names)
        assert len(names) >= (1 if kind == "M_bal" else 2 * count - 1)
        for name in names:
            assert abs(values[name] - known[name]) <= 1e-9 * largest, name


@pytest.mark.parametrize("count", [6, pytest.param(12, marks=pytest.mark.soak)])
def test_commands_use_one_name_for_one_quantity(count: int, tmp_path: Path, run: Run) -> None:
    task, form, answers = tmp_path / "chain.toml", tmp_path / "form.csv", tmp_path / "answers.csv"
    task.write_text(chain(count), encoding="utf-8")
    options = [str(task), "--set", f"F_{2 * count + 1}=250"]

    found = json.loads(run("solve", *options, "--scale", "mu_F_10_11=5 N/mm", "--json", "--lang", "en")[1])
    run("check", *options, "--form", str(form), "--lang", "en")
    swept = json.loads(run("sweep", *options, "--positions", "4", "--json", "--lang", "en")[1])

    rows = [row.split(",")[0] for row in form.read_text(encoding="utf-8-sig").splitlines()]
    names = [name for name in rows if re.match(r"[A-Za-z]+_[\w]+$", name)]
    assert found["scales"]["mu_F_10_11"]["value"] == 5.0
    assert {name for name in names if not name.startswith("mu_")} <= found["quantities"].keys()
    assert {name for name in found["quantities"] if name.startswith(("R_", "M_", "h_"))} == {
        name for name in swept["quantities"] if name.startswith(("R_", "M_", "h_"))
    }
    said = (f"{n};{q['value']!r};{q['unit']}" for n, q in found["quantities"].items() if "value" in q)
    answers.write_text("quantity;value;unit\n" + "\n".join(said), encoding="utf-8")
    report = json.loads(run("check", *options, "-v", "1", str(answers), "--json", "--lang", "en")[1])
    assert {line["verdict"] for line in report["lines"]} == {"right"}
    assert {"R_12_11", "h_2_1", "h_12"} <= {line["quantity"] for line in report["lines"]}


def test_indices_of_many_links_are_printed_with_a_comma_and_headings_name_whole_links() -> None:
    solution = solved(12)
    kind, structure, plain = solution.kind, solution.solved.structure, solution.words
    words = kind.lettered(plain, solution.solved)
    groups = {f"forces_{group.name}": ", ".join(map(str, group.links)) for group in structure.groups}
    right = {plan: plain["heading.group_forces"].format(links=links) for plan, links in groups.items()}
    right["forces_24"] = plain["heading.link_forces"].format(link=24)

    printed = {"R_12_11": "R_{12,11}", "R_0_25": "R_{0,25}", "h_2_1": "h_{2,1}", "h_21": "h_{21}", "M_0_25": "M_{0,25}"}
    assert {name: words.symbol(name) for name in printed} == printed
    assert "{1,2}" in words.symbol("R_1_2_t") != words.symbol("R_12_11_t")
    assert "forces_10_11" in groups
    assert {plan: kind.plan_heading(solution.solved, plan, plain) for plan in right} == right


def renumbered(mechanism: Mechanism, by: int = 10) -> Mechanism:
    """Return a mechanism whose moving links have other numbers."""

    def number(link: int) -> int:
        return link + by if link else link

    def moved(one: Any) -> Any:
        return replace(one, link=number(one.link))

    def two(links: tuple[int, int] | None) -> Any:
        return links and tuple(map(number, links))

    return replace(
        mechanism,
        links=tuple(replace(link, number=number(link.number)) for link in mechanism.links),
        pairs=tuple(replace(pair, links=two(pair.links)) for pair in mechanism.pairs),
        driver=moved(mechanism.driver),
        stroke=mechanism.stroke and moved(mechanism.stroke),
        loads=tuple(map(moved, mechanism.loads)),
        couples=tuple(map(moved, mechanism.couples)),
        starts=tuple(replace(moved(start), legs=two(start.legs)) for start in mechanism.starts),
    )


@pytest.mark.parametrize("task", some(bundled("mechanism"), *range(0, 99, 3)))
def test_other_numbers_of_links_change_no_value(task: str) -> None:
    loaded = load_task(task)
    for mechanism in (loaded.mechanism, renumbered(loaded.mechanism)):
        assert mechanism.parted == (mechanism is not loaded.mechanism)
    values = loaded.values(next(iter(loaded.variants)))

    few, many = (solve_linkage(one, values) for one in (loaded.mechanism, renumbered(loaded.mechanism)))

    assert len(few.program.steps) == len(many.program.steps)
    for one, other in zip(few.program, many.program, strict=True):
        assert (one.verb, one.law) == (other.verb, other.law)
        assert few.values[one.name] == pytest.approx(many.values[other.name], rel=1e-12, nan_ok=True), other.name
    assert not any(re.fullmatch(r"R_\d+(_[ntm])?", name) for name in many.quantities)
    assert [name for name in few.program.names if re.fullmatch(r"_?[RMh]_\d+_\d.*", name)] == []
