"""Formats: sizes, frames, and the places that views must leave free."""

import pytest

from kulman.drawing.formats import FORMATS, block_box, drawing_area, format_named, reserved_boxes
from kulman.scales.errors import InputError

SIZES = {"A4": (210, 297), "A3": (420, 297), "A3-portrait": (297, 420), "A2": (594, 420), "A1": (841, 594)}
GOST_FRAMES = {"A4": (185, 287), "A3": (395, 287), "A3-portrait": (272, 410), "A2": (569, 410), "A1": (816, 584)}
ISO_SPACES = {"A4": (180, 277), "A3": (390, 277), "A2": (564, 400), "A1": (811, 574)}  # ISO 5457


def size(box):
    return box[2] - box[0], box[3] - box[1]


def test_formats_are_the_trimmed_sheets():
    assert {name: (item.width, item.height) for name, item in FORMATS.items()} == SIZES


def test_formats_stand_from_the_smallest():
    areas = [item.width * item.height for item in FORMATS.values()]

    assert areas == sorted(areas)


@pytest.mark.parametrize(("norm", "frames"), [("gost", GOST_FRAMES), ("iso", ISO_SPACES)])
def test_frames_are_as_large_as_the_standard_says(norm, frames):
    found = {name: drawing_area(FORMATS[name], norm) for name in frames}

    assert {name: size(box) for name, box in found.items()} == frames
    assert {box[0] for box in found.values()} == {20}


@pytest.mark.parametrize("name", ["a3", " A3 ", "А3", "а3"])
def test_a_format_is_found_as_people_write_it(name):
    assert format_named(name) is FORMATS["A3"]


@pytest.mark.parametrize("name", ["", "A5", "Letter", "A3 landscape"])
def test_an_unknown_format_is_refused_and_the_known_are_named(name):
    with pytest.raises(InputError) as problem:
        format_named(name)

    for language in ("en", "uk", "ru"):
        assert "A4, A3, A3-portrait, A2, A1" in problem.value.text(language)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("norm", ["gost", "iso"])
@pytest.mark.parametrize("first", [True, False])
def test_reserved_boxes_lie_in_corners_of_the_frame_and_apart(name, norm, first):
    sheet = FORMATS[name]
    x0, y0, x1, y1 = drawing_area(sheet, norm)

    boxes = reserved_boxes(sheet, norm, first)

    assert boxes[0] == block_box(sheet, norm, first)
    assert (boxes[0][2], boxes[0][1]) == (x1, y0)
    for box in boxes:
        assert x0 <= box[0] < box[2] <= x1
        assert y0 <= box[1] < box[3] <= y1
        assert box[0] == x0 or box[2] == x1
        assert box[1] == y0 or box[3] == y1
    if len(boxes) == 2:
        assert boxes[1][1] > boxes[0][3]
