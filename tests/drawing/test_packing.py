"""Views stay in the area, apart from each other and from the reserved corners; shapely is the judge."""

import random

import pytest
import shapely

from kulman.drawing.packing import Placement, order_kept, pack

GAP = 8.0
AREAS = {"A1": (20, 5, 836, 589), "A2": (20, 5, 589, 415), "A3": (20, 5, 415, 292), "A4": (20, 5, 205, 292)}
# Givens, structure, position, velocity, acceleration, equations, two tables; group, its forces, forces of the link,
# slider, driver, its forces, equations; lever, its equations, two tables.
COURSEWORK = {
    "two tables in a column": [
        (111, 95), (132, 43), (173, 110), (82, 77), (75, 110), (172, 90), (148, 60), (148, 67), (183, 127), (192, 119),
        (179, 108), (70, 67), (98, 97), (114, 76), (225, 84), (170, 134), (222, 53), (148, 130), (148, 80)],
    "wide group": [
        (111, 95), (132, 43), (281, 88), (76, 106), (89, 82), (176, 90), (148, 60), (148, 67), (311, 109), (240, 79),
        (233, 68), (98, 64), (120, 76), (147, 50), (235, 84), (170, 107), (234, 47), (148, 130), (148, 80)],
    "wide force plans": [
        (111, 95), (132, 43), (358, 96), (76, 105), (104, 81), (175, 90), (148, 60), (148, 67), (301, 108), (416, 102),
        (283, 95), (98, 64), (98, 86), (98, 65), (174, 90), (170, 116), (234, 47), (148, 130), (148, 80)],
}  # fmt: skip


def corners_of(area, block=55):
    """Title block and turned designation, as on every sheet."""
    x0, y0, x1, y1 = area
    return [(x1 - 185, y0, x1, y0 + block), (x0, y1 - 14, x0 + 70, y1)]


def judge(views, layout, area, reserved, later=None, gap=GAP):
    assert len(layout) == len(views)
    boxes: dict[int, list[shapely.Geometry]] = {}
    for (w, h), p in zip(views, layout, strict=True):
        boxes.setdefault(p.page, []).append(shapely.box(p.x, p.y, p.x + w, p.y + h))
    assert sorted(boxes) == list(range(len(boxes)))
    for page, on_page in boxes.items():
        taken = [shapely.box(*b) for b in (reserved if page == 0 or later is None else later)]
        assert shapely.box(*area).buffer(1e-6, join_style="mitre").covers(shapely.union_all(on_page))
        for n, box in enumerate(on_page):
            assert all(box.distance(other) > gap - 1e-6 for other in on_page[n + 1 :] + taken)


def read(boxes):
    """The order in which a reader meets boxes that straight cuts part, across first, then down."""
    if len(boxes) < 2:
        return list(boxes)
    for low, high in ((lambda b: -b[3], lambda b: -b[1]), (lambda b: b[0], lambda b: b[2])):
        parts, end = [], float("-inf")
        for n in sorted(boxes, key=lambda n: low(boxes[n])):
            if low(boxes[n]) >= end - 1e-6:
                parts.append({})
            parts[-1][n] = boxes[n]
            end = max(end, high(boxes[n]))
        if len(parts) > 1:
            return [n for part in parts for n in read(part)]
    return sorted(boxes, key=lambda n: (-boxes[n][3], boxes[n][0]))


def read_pages(views, layout):
    boxes: dict[int, dict] = {}
    for n, ((w, h), p) in enumerate(zip(views, layout, strict=True)):
        boxes.setdefault(p.page, {})[n] = (p.x, p.y, p.x + w, p.y + h)
    return [n for page in sorted(boxes) for n in read(boxes[page])]


def random_views(seed):
    r = random.Random(seed)
    return [(r.uniform(30, 180), r.uniform(20, 150)) for _ in range(r.randint(1, 16))]


@pytest.mark.parametrize("count", [30, pytest.param(150, marks=pytest.mark.soak)])
@pytest.mark.parametrize("paper", AREAS)
def test_random_views_fit_their_pages(paper, count):
    area = AREAS[paper]
    reserved, later = corners_of(area), corners_of(area, block=15)
    packed = 0
    for seed in range(count):
        views = random_views(seed)

        one = pack(views, area, reserved, gap=GAP)
        many = pack(views, area, reserved, later=later, gap=GAP, pages=None)

        judge(views, many, area, reserved, later)
        assert [p.page for p in many] == sorted(p.page for p in many)
        if one is not None:
            judge(views, one, area, reserved)
            assert one == many
            packed += 1
    assert packed > count * (2 if paper == "A4" else 4) / 15
    assert many == pack(views, area, reserved, later=later, gap=GAP, pages=None)


def test_views_in_a_row_hang_from_one_line_and_slack_is_spread_evenly():
    row = pack([(250, 120), (115, 115), (230, 100)], (0, 0, 640, 200), gap=GAP)
    six = pack([(100, 80)] * 6, (0, 0, 400, 300), gap=GAP)

    assert len({p.y + h for p, h in zip(row, (120, 115, 100), strict=True)}) == 1
    assert sorted({p.x for p in six}) == pytest.approx([21, 150, 279])
    assert sorted({p.y for p in six}) == pytest.approx([44, 176], abs=1)


@pytest.mark.parametrize("name", COURSEWORK)
def test_a_sheet_reads_from_left_to_right_and_down(name):
    views = COURSEWORK[name]

    layout = pack(views, AREAS["A1"], corners_of(AREAS["A1"]), gap=7.0)

    judge(views, layout, AREAS["A1"], corners_of(AREAS["A1"]), gap=7.0)
    assert read_pages(views, layout) == list(range(len(views)))


@pytest.mark.parametrize(("paper", "most"), [("A2", 3), ("A3", 4)])
def test_several_pages_read_in_order_and_none_is_nearly_empty(paper, most):
    area = AREAS[paper]
    views = COURSEWORK["two tables in a column"]

    layout = pack(views, area, corners_of(area), later=corners_of(area, block=15), gap=7.0, pages=None)

    judge(views, layout, area, corners_of(area), corners_of(area, block=15), gap=7.0)
    for n, (q, (_, h)) in enumerate(zip(layout, views, strict=True)):
        for p, (w, _) in zip(layout[:n], views[:n], strict=True):
            assert p.page < q.page or p.x + w <= q.x or p.y >= q.y + h
    count = max(p.page for p in layout) + 1
    assert count <= most
    full = [0.0] * count
    for (w, h), p in zip(views, layout, strict=True):
        full[p.page] += w * h / (area[2] - area[0]) / (area[3] - area[1])
    assert min(full[:-1]) > 0.3


def test_order_gives_way_only_to_a_fit():
    views = [(60, 40), (100, 100), (60, 40), (100, 100), (60, 10)]

    layout = pack(views, (0, 0, 170, 208), gap=GAP)

    judge(views, layout, (0, 0, 170, 208), [])
    assert read_pages(views, layout) != list(range(len(views)))
    assert pack(views, (0, 0, 170, 208), gap=GAP, any_order=False) is None
    assert order_kept([(0, 50), (60, 50), (0, 0)], [(50, 40)] * 3) == 1.0
    assert order_kept([(60, 50), (0, 50), (0, 0)], [(50, 40)] * 3) == pytest.approx(2 / 3)


def test_pages_are_as_few_and_as_full_as_possible_and_what_fits_nowhere_has_no_place():
    views, area = [(100, 100)] * 8, (0, 0, 208, 316)

    layout = pack(views, area, gap=GAP, pages=None)

    assert [p.page for p in layout] == [0, 0, 0, 0, 1, 1, 1, 1]
    assert pack(views, area, gap=GAP) is None
    assert pack(views * 2, area, gap=GAP, pages=2) is None
    assert pack([(50, 50), (300, 50)], (0, 0, 200, 200), gap=GAP, pages=None) is None
    assert pack([], (0, 0, 200, 200)) == []
    assert pack([(200, 200)], (0, 0, 200, 200)) == [Placement(0, 0.0, 0.0)]
