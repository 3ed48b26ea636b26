"""Numbers that hardly any cam has: each is told, and none ends in a traceback, a hang or silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from kulman import load_task, sheet, solve
from kulman.scales.errors import LANGUAGES, InputError, messages
from kulman.variants.kinds.cam import LARGE, UNUSUAL

TASK = "madi-cam"
ROCKER = str(Path(__file__).parents[2] / "docs" / "examples" / "rocker-cam.toml")
TOLD = {
    "h=1e9": "h = 1e+09 mm is unusual: most cams have 0.1 to 500 mm; is the unit right?",
    "phi_rise=0.5": "phi_rise = 0.5° is unusual: most cams have 5 to 355°; is the unit right?",
    "omega=1e-5": "omega = 1e-05 rad/s is unusual: most cams have 0.01 to 3000 rad/s; is the unit right?",
    "u=0.999": "u = 0.999 is unusual: most cams have 0.05 to 0.95",
    "mu_phi=100": "mu_phi = 100°/mm is unusual: most cams have 0.25 to 10°/mm; is the unit right?",
    "rho_flat=1e6": "rho_flat = 1e+06 mm is unusual: most cams have at most 200 mm; is the unit right?",
    "R_roller=1e-6": "R_roller = 1e-06 mm is unusual: most cams have 1 to 100 mm; is the unit right?",
    "r_0=3000": "r_0 = 3000 mm is unusual: most cams have 2 to 1000 mm; is the unit right?",
    "omega=2500": "a_max = 4.116e+05 m/s² is unusual: most cams have at most 1e+05 m/s²; is the unit right?",
}


def set_by(text: str) -> dict[str, str]:
    name, _, value = text.partition("=")
    return {name: value}


@pytest.mark.parametrize("setting", TOLD)
def test_a_number_that_hardly_any_cam_has_is_told(setting: str) -> None:
    found = [warning.text("en") for warning in solve(TASK, set=set_by(setting), only="sizes").warnings]

    assert TOLD[setting] in found


def test_the_cams_of_books_are_usual() -> None:
    for task in (TASK, ROCKER):
        for variant in load_task(task).variants:
            assert solve(task, variant, only="sizes").warnings == ()


def test_what_follows_from_a_wrong_given_is_not_told_again() -> None:
    keys = [warning.key for warning in solve(TASK, set={"h": "1e9"}, only="sizes").warnings]

    assert keys == ["cam-unusual-length"]


def test_every_unusual_number_has_its_message() -> None:
    for language in LANGUAGES:
        keys = {key for key in messages(language) if key.startswith("cam-unusual-")}
        assert keys == {f"cam-unusual-{end}" for end in (*(end for end, _ in UNUSUAL.values()), *LARGE.values())}


@pytest.mark.parametrize("name", ["phi_rise", "phi_fall"])
def test_a_phase_that_nobody_can_draw_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=rf"{name} = 1e-06°: no phase of a cam is shorter than 0\.01°"):
        solve(TASK, set={name: "1e-6 deg"})


@pytest.mark.parametrize(
    "setting",
    [
        "u=0.999",
        pytest.param("l_A1=1e6", marks=pytest.mark.soak),
        pytest.param("H_a=1", marks=pytest.mark.soak),
        pytest.param("mu_phi=0.001", marks=pytest.mark.soak),
        pytest.param("margin=1e6", marks=pytest.mark.soak),
    ],
)
def test_a_drawing_for_which_no_paper_is_large_enough_is_refused(setting: str) -> None:
    with pytest.raises(InputError, match=r"no format has room for this sheet: a drawing of it is \d+ × \d+ mm") as told:
        sheet(TASK, set=set_by(setting), only="diagrams,profile" if "margin" in setting else "diagrams")
    assert told.value.key == "sheet-too-large"


@pytest.mark.soak
@pytest.mark.parametrize("setting", ["h=1e9", "phi_rise=0.02", "omega=1e9", "mu_phi=100", "l_A1=1", "rho_flat=1e6"])
def test_an_unusual_cam_is_drawn_with_a_warning(setting: str) -> None:
    drawn = sheet(TASK, set=set_by(setting))

    assert any(warning.key.startswith("cam-unusual-") for warning in drawn.warnings)
