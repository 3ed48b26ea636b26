"""The command `sweep` of a hoist: its table, forces over time as CSV and JSON, what is refused."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest

import kulman
from kulman import cli
from kulman.scales.errors import LANGUAGES, InputError
from kulman.variants.sweeps.swept import CourseSweep

TASK = "karpenko-hoist"
PUSHING = {"I_0": 1e-6, "V_0": 0.5}  # so soft a support that the rope of V10 goes slack


def swept(variant: str | None = None, **asked: object) -> CourseSweep:
    found = kulman.sweep(TASK, variant, lang="en", **asked)  # type: ignore[arg-type]
    assert isinstance(found, CourseSweep)
    return found


def column(text: str, name: str) -> np.ndarray:
    rows = list(csv.DictReader(io.StringIO(text)))
    return np.array([float(row[name]) for row in rows])


def test_csv_begins_at_rest_and_ends_a_period_after_the_lift_off() -> None:
    found = swept("V01", positions=73)
    text = found.csv()
    solved = kulman.solve(TASK, "V01")

    force, pressed, t = (column(text, name) for name in ("F_12 [N]", "F_01 [N]", "t [s]"))

    assert pressed[0] == pytest.approx(-solved["P_st"].value, rel=1e-14)
    assert force[0] == 0.0
    assert len(t) == 73
    assert t[-1] == pytest.approx(solved["t_1"].value + 2.0 * np.pi / solved["k_1"].value, rel=1e-14)
    assert force[-1] == pytest.approx(solved["F_12_t1"].value, rel=1e-12)
    assert np.all(pressed[t > solved["t_1"].value] == 0.0)
    assert force.max() <= solved["F_max"].value
    assert column(text, "sigma [MPa]") == pytest.approx(force / 234e-6 * 1e-6, rel=1e-12)


def test_table_names_its_marks() -> None:
    table = swept("V03").table()

    for name in ("t_1", "P_12_max", "P_12_min"):
        assert name in table
    assert "40978.5" in table  # P_12_max


def test_json_is_in_si_and_says_what_bears() -> None:
    data = json.loads(json.dumps(swept("V10", set=PUSHING).to_json(), allow_nan=False))

    assert not data["valid"]
    assert {"both", "support", "rope"} <= set(data["bears"])
    force = np.array(data["columns"]["F_12"]["value"])
    assert data["columns"]["F_12"]["unit"] == "N"
    assert np.all(force >= 0.0)
    assert np.all(force[np.array(data["bears"]) == "support"] == 0.0)
    assert data["marks"]["t_1"] > 0.0


@pytest.mark.parametrize("language", LANGUAGES)
def test_table_and_csv_speak_every_language(language: str) -> None:
    found = swept("V10", set=PUSHING, positions=5)

    units = ["t, s", "F_12, N", "sigma, MPa"] if language == "en" else ["t, с", "F_12, Н", "sigma, МПа"]
    assert [unit for unit in units if unit in found.table(language).splitlines()[0]] == units
    assert (";" in found.csv(language).splitlines()[0]) == (language != "en")


def test_files_are_csv_only(tmp_path: Path) -> None:
    swept("V01").save(tmp_path / "forces.csv")

    assert len((tmp_path / "forces.csv").read_text(encoding="utf-8").splitlines()) == 362
    with pytest.raises(InputError) as refused:
        swept("V01").save(tmp_path / "forces.svg")
    assert refused.value.key == "hoist-sweep-drawing"
    assert not (tmp_path / "forces.svg").exists()


@pytest.mark.parametrize("option", [["--points", "A"], ["--from", "1"], ["--to", "2"], ["--chords", "A"]])
def test_what_a_hoist_does_not_have_is_refused(option: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        cli.main(["sweep", TASK, *option])

    assert stopped.value.code == 2
    assert option[0] in capsys.readouterr().err
