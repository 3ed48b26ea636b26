"""Guides are drawn as long as their sliders run: on the frame that is the stroke, found by zeros of the velocity."""

from __future__ import annotations

import pytest

from kulman.plans.linkages.cycles.cycle import cycle, slider_runs
from kulman.plans.linkages.solved import solve_linkage
from kulman.tests.support.linkages import RAM, RAM_VALUES
from kulman.variants.solution import solve


@pytest.mark.parametrize(
    "task",
    [
        "nau-slider-crank",
        "scheme-09-shaper",
        "scheme-13-toggle-press",
        "scheme-19-scotch-yoke",
        "scheme-20-press-automaton",
    ],
)
def test_sliders_on_the_frame_run_as_far_as_their_strokes(task: str) -> None:
    solved = solve(task).solved

    runs = slider_runs(solved)

    motions = cycle(solved.mechanism, solved.givens, ("velocity",)).motions
    strokes = {f"u_{m.output.link}0": m.travel.length for m in motions if m.output.slides and m.travel is not None}
    assert strokes
    for guide, length in strokes.items():
        low, high = runs[guide]
        assert high - low == pytest.approx(length, rel=2e-3)  # the ends lie between the 72 positions


def test_the_ram_of_a_group_of_class_iii_runs_on_its_own_branch() -> None:
    runs = [slider_runs(solve_linkage(RAM, {**RAM_VALUES, "phi": phi})) for phi in (0.2, 0.7)]

    (first,), (second,) = (run.values() for run in runs)
    assert first[1] - first[0] == pytest.approx(second[1] - second[0], rel=5e-3)
