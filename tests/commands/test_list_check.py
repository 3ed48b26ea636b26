"""`kulman list --check` solves every variant of a file: what is a fault of it, what a remark, what was not tried."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from kulman.scales.errors import LANGUAGES, messages
from kulman.tests.commands.test_cli import run
from kulman.variants.reader import check_text
from kulman.variants.shelf import bundled_text

CRANK_ROCKER = """
id = "own"
source = "own"
notation = "nau"
plans = ["position", "velocity"]
[title]
uk = "t"
ru = "t"
en = "t"
[givens]
phi = { unit = "deg" }
l_OA = { unit = "mm" }
l_AB = { unit = "mm" }
l_CB = { unit = "mm" }
l_OC = { unit = "mm" }
[mechanism]
link = [
  { number = 1, points = { O = ["0 mm", "0 mm"], A = ["l_OA", "0 mm"] } },
  { number = 2, points = { A = ["0 mm", "0 mm"], B = ["l_AB", "0 mm"] } },
  { number = 3, points = { C = ["0 mm", "0 mm"], B = ["l_CB", "0 mm"] } },
]
pair = [
  { kind = "revolute", point = "O", links = [1, 0], at = ["0 mm", "0 mm"] },
  { kind = "revolute", point = "A", links = [1, 2] },
  { kind = "revolute", point = "B", links = [2, 3], branch = 1 },
  { kind = "revolute", point = "C", links = [3, 0], at = ["l_OC", "0 mm"] },
]
driver = { link = 1, pivot = "O", point = "A", angle = "phi", speed = "10 rad/s", sense = 1 }
"""


@pytest.fixture(autouse=True)
def _patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let all variants be tried, however slow or busy the machine is."""
    monkeypatch.setattr("kulman.variants.reader.TRIED_FOR", math.inf)


def crank_rocker(*variants: tuple[float, ...]) -> str:
    """Return a file of variants: angle of the crank, degrees, lengths of crank, coupler, rocker, frame, mm."""
    names = ("phi", "l_OA", "l_AB", "l_CB", "l_OC")
    rows = (dict(zip(names, numbers, strict=True)) for numbers in variants)
    tables = (f'id = "v{k}"\n' + "\n".join(f"{name} = {x!r}" for name, x in row.items()) for k, row in enumerate(rows))
    return CRANK_ROCKER + "".join(f"[[variant]]\n{table}\n" for table in tables)


def test_a_check_tries_every_variant_over_the_cycle() -> None:
    random, kinds = np.random.default_rng(20261122), set[str]()
    lengths = random.uniform((0, 10, 10, 10, 10), (360, 60, 90, 90, 120), (24, 5))
    rows = [(45.0, 30.0, 21.0, 80.0, 100.0), *(tuple(row) for row in np.round(lengths, 3).tolist())]

    faults, remarks = check_text(crank_rocker(*rows), "own.toml")

    told = {one.place.split(": variant.")[1]: one.key for one in faults}
    arcs: dict[str, list[tuple[float, float]]] = {}
    for one in remarks:
        if one.key == "variant-apart":
            ends = float(one.data["low"]), float(one.data["high"])
            arcs.setdefault(one.place.split(": variant.")[1], []).append(ends)
    for k, (phi, a, b, c, d) in enumerate(rows):
        angles = np.radians(np.arange(0.0, 360.0, 0.25))
        across = np.sqrt(a * a + d * d - 2.0 * a * d * np.cos(np.append(angles, math.radians(phi))))
        *every, here = ((abs(b - c) <= across) & (across <= b + c)).tolist()
        kind = "" if here else "no-assembly-here" if any(every) else "no-assembly"
        kinds.add(kind)
        assert told.get(f"v{k}", "") == kind
        lost = sum(high - low for low, high in arcs.get(f"v{k}", ()))
        assert lost == pytest.approx(0.25 * every.count(False) if any(every) else 0.0, abs=1.0)
    assert kinds == {"", "no-assembly-here", "no-assembly"}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_check_tells_faults_from_remarks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    monkeypatch.setenv("LC_ALL", {"uk": "uk_UA", "ru": "ru_RU", "en": "en_GB"}[language] + ".UTF-8")
    words = messages(language)
    (file := tmp_path / "t.toml").write_text(
        crank_rocker((0.0, 50.0, 21.0, 80.0, 100.0), (90.0, 50.0, 120.0, 50.0, 120.0))
    )

    status, out, err = run(["list", "--check", str(file)], capsys)
    data = json.loads(run(["list", "--check", str(file), "--json"], capsys)[1])

    assert status == 2
    assert [one["key"] for one in data["errors"]] == ["no-assembly-here"]
    assert [one["key"] for one in data["remarks"]] == ["variant-apart", "variant-apart", "variant-change"]
    assert data["remarks"][-1]["message"].endswith(words["variant-change"].format(angles="0°, 180°"))
    assert out.splitlines()[0] == data["errors"][0]["message"]
    assert out.splitlines()[1:] == [words["check-remark"].format(text=one["message"]) for one in data["remarks"]]
    assert err == words["check-bad"].format(file=file, n=1) + "\n"


@pytest.mark.parametrize(
    ("task", "old", "new", "fault", "remarks"),
    [
        ("madi-cam", 'R_roller = "7 mm"', 'R_roller = "7 mm"\nr_0 = "40 mm"', "cam-no-offset", []),
        ("madi-cam", 'R_roller = "7 mm"', 'R_roller = "20 mm"', None, ["cam-rule-roller_of_radius"]),
        ("madi-gear", "", "", None, []),
        ("karpenko-hoist", "", "", None, ["hoist-rule-strength"]),
    ],
)
def test_variants_of_every_kind_are_tried(task: str, old: str, new: str, fault: str | None, remarks: list[str]) -> None:
    text = bundled_text(task)
    assert old in text

    faults, known = check_text(text.replace(old, new, 1), "own.toml")

    assert [one.key for one in faults] == [fault] * (fault is not None)
    assert {*remarks} <= {one.key for one in known}


def test_what_there_was_no_time_to_try_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kulman.variants.reader.TRIED_FOR", -1.0)

    faults, remarks = check_text(crank_rocker(*[(45.0, 30.0, 21.0, 80.0, 100.0)] * 3), "own.toml")

    assert faults == ()
    assert [one.text("en") for one in remarks] == [
        "own.toml:29:1: variant.v0: from here on variants were not tried: 3 of 3; "
        "kulman variants own.toml solves them all"
    ]
