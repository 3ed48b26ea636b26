"""Sheets of one's own with markers stuck on them, photographed: laid flat, plans found, nothing right is wrong."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from kulman import KulmanError
from kulman.drawing.markers import EACH, FREE, STUCK, fields, stickers
from kulman.drawing.writers import page_files
from kulman.plans.marking.answers import Verdict
from kulman.plans.marking.lines import Drawn, lines_of
from kulman.tests.photos.measure import chosen_ways
from kulman.tests.photos.synthesiser import PHONE, PX, SCANNER, Random, Sheet, Truth, drawn, photographed, sheet_for
from kulman.tests.support.cases import some
from kulman.tests.support.commands import Run
from kulman.variants.marking.checks import check
from kulman.variants.marking.marked import Desk, Marked
from kulman.variants.marking.reading import Answers
from kulman.variants.photos.asking import Told, ends_asked, gathered, page_of
from kulman.variants.photos.free import _beside
from kulman.variants.photos.pictures import Photo, read_photos
from kulman.variants.photos.straight import PER_MM, by_squares
from kulman.variants.roster import Who

CLEAR = 24.0  # mm between the middle of a marker and a line


def stuck_on(sheet: Sheet, number: int, lines: list[Truth], random: Random) -> np.ndarray:
    """A white page with eight markers, near corners and the middles of sides, on no line, a little turned."""
    height, width = sheet.printed[number].shape
    page = np.full((height, width), 255, np.uint8)
    wide, high = width / PX - STUCK - 6, height / PX - STUCK - 6
    drawn_there = np.concatenate([one.tail + (one.tip - one.tail) * np.linspace(0, 1, 60) for one in lines])
    corners = np.array([complex(x, y) for x in np.arange(6, wide, 5) for y in np.arange(6, high, 5)])
    middles = corners + STUCK / 2 * (1 + 1j)
    free = corners[np.abs(middles[:, None] - drawn_there[None, :]).min(axis=1) > CLEAR]
    for own, part in enumerate((0, 1, 1 + 1j, 1j, 0.5, 0.5 + 1j, 0.5j, 1 + 0.5j)):
        at = free[np.abs(free - complex(6 + part.real * wide, 6 + part.imag * high)).argmin()]
        free = free[np.abs(free - at) > 1.5 * STUCK]
        fine = np.kron(np.where(fields(EACH * (FREE - 1) + own), 0, 255).astype(np.uint8), np.ones((40, 40), np.uint8))
        fine = cv2.copyMakeBorder(fine, 20, 20, 20, 20, cv2.BORDER_CONSTANT, value=255)
        middle = len(fine) / 2 - 0.5
        way = cv2.getRotationMatrix2D((middle, middle), random.normal(0, 4), STUCK * PX / 240)
        place = at + STUCK / 2 * (1 + 1j)
        way[:, 2] += place.real * PX - 0.5 - middle, height - place.imag * PX - 0.5 - middle
        page = np.minimum(page, cv2.warpAffine(fine, way, (width, height), borderValue=255, flags=cv2.INTER_AREA))
    return page


def own_sheets(
    task: str, quality: str, turn: int, folder: Path, seed: int
) -> tuple[Sheet, list[Path], dict[str, Truth]]:
    """Photograph the plans of an honest student on white paper, turned by quarters; return also what was drawn."""
    sheet, files, truth = sheet_for(task), list[Path](), dict[str, Truth]()
    sheet = replace(sheet, printed={})
    for number in sorted({page for page, _ in sheet.poles.values()}):
        page = sheet.pages[number]
        sheet.printed[number] = np.full((round(page.height * PX), round(page.width * PX)), 255, np.uint8)
        where = list(drawn(sheet, number, np.random.default_rng(seed), chosen_ways(sheet, -1))[1].values())
        sheet.printed[number] = stuck_on(sheet, number, where, np.random.default_rng(seed))
        random = np.random.default_rng(seed)
        ink, own = drawn(sheet, number, random, chosen_ways(sheet, -1))
        truth |= own
        files.append(folder / f"own-{number}.jpg")
        files[-1].write_bytes(photographed(np.rot90(ink, turn).copy(), random, quality))
    return sheet, files, truth


def marked_of(sheet: Sheet, files: list[Path]) -> Marked:
    ready = check(sheet.case.task, sheet.case.variant, lang="en")
    (answers,) = ready.read(*map(str, files[:1]))
    photos = tuple(photo for file in files for photo in read_photos(file))
    return ready.mark(replace(answers, photos=photos)).marked


@pytest.mark.parametrize("seed", range(6))
def test_a_sheet_is_laid_flat_by_squares_that_lie_anywhere(seed: int) -> None:
    random = np.random.default_rng(seed)
    count, half = int(random.integers(5, 9)), 130.0
    middles = random.uniform(-half, half, count) + 1j * random.uniform(-half, half, count)
    square = STUCK / 2 * np.array([-1 + 1j, 1 + 1j, 1 - 1j, -1 - 1j])
    corners = middles[:, None] + square * np.exp(1j * random.uniform(0, math.tau, count))[:, None]
    tilt, lens = random.uniform(-0.25, 0.25, 2), random.uniform(-0.06, 0.03)

    def seen(z: np.ndarray) -> np.ndarray:
        w = np.conj(z) * 8.0 / (1.0 + (z.real * tilt[0] + z.imag * tilt[1]) / 450.0)
        return w * (1.0 + lens * np.abs(w / 2000.0) ** 2) + 1500 + 1000j

    way, laid = by_squares(dict(enumerate(map(tuple, seen(corners)))), STUCK, 1500 + 1000j)
    assert way.error < 0.01
    np.testing.assert_allclose(way.at(laid), seen(corners), atol=0.1)
    true = np.abs(corners.ravel()[:, None] - corners.ravel()[None, :])
    np.testing.assert_allclose(np.abs(laid.ravel()[:, None] - laid.ravel()[None, :]), true, atol=0.05)


def test_markers_on_their_page_are_found_as_squares(tmp_path: Path) -> None:
    import pypdfium2

    ((_, data),) = page_files([stickers("uk")], Path("page.pdf"))
    whole = pypdfium2.PdfDocument(data)[0].render(scale=300 / 72, grayscale=True).to_numpy()
    column = whole.reshape(whole.shape[:2])[:, : round(29 * 300 / 25.4)]
    file = tmp_path / "column.png"
    file.write_bytes(cv2.imencode(".png", column)[1].tobytes())
    (photo,) = read_photos(file)
    assert photo.number == FREE
    assert len(photo.markers) == EACH
    way, laid = by_squares(photo.markers, STUCK, photo.centre)
    assert way.error < 0.05
    np.testing.assert_allclose(np.abs(np.diff(laid, axis=1)), STUCK, atol=0.05)


def test_where_many_arrowheads_meet_is_no_table() -> None:
    page = np.full((100 * PER_MM, 100 * PER_MM), 230, np.uint8)
    page[:, : 15 * PER_MM] = 90  # a table beside the paper
    for turn in np.arange(0.0, math.tau, math.tau / 12):
        far = round(525 + 40 * math.cos(turn)), round(525 + 40 * math.sin(turn))
        cv2.line(page, (525, 525), far, 60, 5)
    beside = _beside(page)
    assert beside[:, : 15 * PER_MM].all()
    assert not beside[:, 25 * PER_MM :].any()


@pytest.mark.parametrize(("by_hand", "joined"), [(False, False), (True, True)])
def test_lines_drawn_by_hand_may_miss_a_point_by_more(by_hand: bool, joined: bool) -> None:
    ends = np.array([[-40, 8], [-40 - 9j, 8 + 1.8j], [-0.5 - 8j, -0.5 + 60j], [-0.5 + 50j, 30 + 40j]], complex)
    lines = lines_of(Drawn(*ends.T, by_hand=by_hand))  # the third misses by half a millimetre where the first two cross
    pole, end = lines.near(np.array([0j, -0.5 + 50j]))
    assert lines.joined(np.array([pole]), np.array([end]))[0] == joined


@pytest.mark.parametrize("other", ["--key", "--format=A3"])
def test_markers_are_printed_alone_on_a4(other: str, tmp_path: Path, run: Run) -> None:
    status, _, err = run("handout", "--markers", other, "--lang", "en", "-o", tmp_path / "markers.pdf")
    assert status == 2
    assert f"expected --markers without {other.replace('=', ' ')}" in err
    assert not [*tmp_path.iterdir()]
    assert run("handout", "--markers", "--lang", "en", "-o", tmp_path / "markers.pdf")[0] == 0


def test_two_sheets_of_ones_own_are_no_page_that_comes_twice() -> None:
    photos = [Photo(f"koval-{number}.jpg", FREE, {}, 0j, (), bytes([number])) for number in (1, 2)]
    own = [Answers(one.source, Who(student="Коваль"), {}, {}, {}, photos=(one,)) for one in photos]
    found, asks = gathered(own, None, Told(), alone=True)
    assert asks == []
    assert [one.photos for one in found] == [tuple(photos)]


@pytest.mark.parametrize(
    ("task", "quality", "turn"),
    some(
        [
            ("madi-four-bar", SCANNER, 0),
            ("nau-slider-crank", PHONE, 1),
            ("scheme-09-shaper", PHONE, 2),
        ]
    ),
)
def test_plans_on_a_sheet_of_ones_own_are_read(task: str, quality: str, turn: int, tmp_path: Path) -> None:
    counts, elsewhere = Counter[str](), set[tuple[int, str]]()
    for seed in (3, 4):
        sheet, files, truth = own_sheets(task, quality, turn, tmp_path, seed)
        marked = marked_of(sheet, files)
        assert marked.seen is not None
        read = marked.seen.recognised.vectors
        long = [n for n, one in truth.items() if abs(one.tip - one.tail) >= 5 and n in sheet.keyed.key.questions]
        counts += Counter(read=len([name for name in long if name in read]), drawn=len(long))
        for line in marked.lines:
            assert line.verdict is not Verdict.WRONG, line.name
        assert {note.key for note in marked.notes if isinstance(note, KulmanError)} >= {"photo-own"}
        desk = Desk(check(sheet.case.task, sheet.case.variant, lang="en"))
        asks, pictures = ends_asked(desk, marked.answers)
        digests = {page_of(photo): photo.source for photo in marked.answers.photos}
        plans = Counter(one.plan for one in truth.values() if abs(one.tip - one.tail) >= 5)
        for ask in asks:
            assert ask.name not in read
            assert ask.picture in pictures
            (drawn,) = [one for name, one in truth.items() if name == ask.name]
            # two long vectors may lie so elsewhere, too
            if not (digests[ask.page].endswith(f"own-{drawn.page}.jpg") or plans[drawn.plan] <= 2):
                elsewhere.add((seed, drawn.plan))
        told = {ask.name: None for ask in asks[:1]}
        settled = desk.mark(replace(marked.answers, told=told))
        assert settled.seen is not None
        assert not settled.seen.written
    assert counts["read"] >= 0.5 * counts["drawn"]
    assert len(elsewhere) <= 1  # a plan that is asked for on another picture
