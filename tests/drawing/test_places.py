"""Places: no label covers anything, views stay apart, areas are hatched; judged by what many places tell."""

import cmath
import itertools
import math
import random

import numpy as np
import pytest
import shapely

from kulman.drawing.areas import beside, clipped, coarser, hatched, strokes, thinned
from kulman.drawing.formats import STYLES
from kulman.drawing.labels import Labels, Request, place
from kulman.drawing.packing import Placement, order_kept, pack
from kulman.drawing.shapes import Circle, Group, Line, Pen, Polyline, Text
from kulman.drawing.spots import FINE, MAIN, Obstacles, Surroundings, first_clear
from kulman.drawing.view import Canvas

GAP = 0.6  # mm, of labels
APART = 8.0  # mm, of views
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
STAR = [cmath.rect(40.0, 2.0 * cmath.pi * 2 * k / 5) + 3 - 7j for k in range(5)]  # crosses itself: a hole in the middle
ALONG = cmath.rect(1.0, 0.7)
BOXES = [(-4.0, -3.0, 5.0, 2.0), (3.0, 0.0, 9.0, 6.0), (-20.0, 4.0, -10.0, 30.0)]
SIZE = 6.0, 4.0
CIRCLE = tuple(cmath.rect(40.0, math.radians(k)) for k in range(0, 271, 1))


def turned(length: float, degrees: float) -> complex:
    return length * complex(math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))


def random_scene(seed: int, labels: int, strokes: int) -> tuple[list[Request], Obstacles]:
    """A tangle of strokes, worse than any sheet: half of the labels name nodes, half of them vectors."""
    r = random.Random(seed)

    def point() -> complex:
        return complex(r.uniform(0, 160), r.uniform(0, 110))

    def stroke(length: float) -> tuple[complex, complex]:
        p = point()
        return p, p + turned(r.uniform(3, length), r.uniform(0, 360))

    nodes = [point() for _ in range((labels + 1) // 2)]
    vectors = [(p := r.choice(nodes), p + turned(r.uniform(10, 60), r.uniform(0, 360))) for _ in range(labels // 2)]
    requests = [
        Request(f"n{i}", r.uniform(3, 6), 4.5, p, 0.8, prefer=r.choice([0j, 1j, -1 + 0j])) for i, p in enumerate(nodes)
    ]
    requests += [Request(f"v{i}", r.uniform(5, 14), 6, v, 0.8) for i, v in enumerate(vectors)]
    tips = [(b.real - 1, b.imag - 1, b.real + 1, b.imag + 1) for _, b in vectors]
    main = vectors + [stroke(40) for _ in range(strokes // 2)]
    thin = [stroke(80) for _ in range(strokes // 2)]
    return requests, Obstacles(main, thin, [(p, 1.0) for p in nodes], tips)


def boxes_of(requests: list[Request], labels: Labels) -> np.ndarray:
    corners = np.array([labels.corners[r.name] for r in requests])
    sizes = np.array([complex(r.width, r.height) for r in requests])
    return shapely.box(corners.real, corners.imag, (corners + sizes).real, (corners + sizes).imag)


def strokes_of(strokes: object) -> np.ndarray:
    ends = np.asarray(strokes, dtype=complex).reshape(-1, 2)
    return shapely.linestrings(np.stack((ends.real, ends.imag), axis=-1))


def covered(requests: list[Request], obstacles: Obstacles, labels: Labels, gap: float = GAP - 1e-6) -> set[str]:
    """Names of the labels that come nearer than `gap` to anything."""
    boxes = boxes_of(requests, labels)
    rims = [shapely.Point(c.real, c.imag).buffer(r, quad_segs=64) for c, r in obstacles.circles]
    things = np.concatenate((strokes_of(obstacles.segments), rims, [shapely.box(*b) for b in obstacles.boxes]))
    apart = np.array(shapely.distance(boxes[:, None], boxes), dtype=float)
    np.fill_diagonal(apart, np.inf)
    good = np.array([r.name not in labels.failed for r in requests])
    near = (shapely.distance(boxes[:, None], things) < gap).any(axis=1) | (apart[:, good] < gap).any(axis=1)
    return {r.name for r, bad in zip(requests, near, strict=True) if bad}


def stand_clear(requests: list[Request], obstacles: Obstacles) -> Labels:
    """Place labels, all of which find a place where they cover nothing."""
    labels = place(requests, obstacles, GAP)
    assert not labels.failed
    assert not covered(requests, obstacles, labels)
    return labels


@pytest.mark.parametrize("block", [0, *(pytest.param(k, marks=pytest.mark.soak) for k in range(1, 10))])
def test_no_label_covers_anything_unless_reported(block: int) -> None:
    for seed in range(block * 200, block * 200 + (200 if block else 80)):
        stand_clear(*random_scene(seed, labels=1 + seed % 24, strokes=seed % 40))
    seen = covered([Request("A", 4, 4, 0j)], Obstacles(segments=[(-9 + 3j, 9 + 3j)]), Labels({"A": 1 + 1j}))
    assert seen == {"A"}  # the judge sees a covered label
    assert place(*random_scene(7, 30, 60)) == place(*random_scene(7, 30, 60))


@pytest.mark.parametrize("side", [1, 1j, -1, -1j])
def test_a_label_stands_where_it_is_preferred_beside_a_point_and_a_vector(side: complex) -> None:
    corner = place([Request("A", 4, 4, 10 + 10j, 1.0, prefer=side)], Obstacles()).corners["A"]
    vector = Request("V", 6, 4, (0j, 50 + 0j), 1.0, prefer=side)
    assert corner + 2 + 2j - (10 + 10j) == pytest.approx(3 * side)
    if side.imag:
        assert place([vector], Obstacles([(0j, 50 + 0j)])).corners["V"] + 3 + 2j == pytest.approx(25 + 3 * side)


def test_letters_at_one_point_and_of_zero_vectors_stand_side_by_side_without_leaders() -> None:
    four = [Request(name, 4, 4, 5 + 5j) for name in ("b", "s2", "c", "d")]
    zero = [Request("V_BA", 8, 5, (3j, 3j)), Request("b", 3, 4, 3j)]
    assert not stand_clear(four, Obstacles(segments=[(0j, 5 + 5j)], circles=[(5 + 5j, 1.0)])).leaders
    assert not stand_clear(zero, Obstacles(segments=[(3j, 3j), (3j, 40 + 3j)], thin=[(1j, 1j)])).leaders


def test_a_hemmed_in_node_gets_a_leader_and_a_label_without_any_place_is_reported() -> None:
    request, ends = [Request("A", 5, 5, 0j)], (-4, -2.5, 2.5, 4)
    walls = [(complex(x, -4), complex(x, 4)) for x in ends] + [(complex(-4, y), complex(4, y)) for y in ends]
    full = [(complex(-90, y), complex(90, y)) for y in range(-90, 91, 3)]
    nowhere = place(request, Obstacles(segments=full), GAP)
    assert list(stand_clear(request, Obstacles(segments=walls)).leaders) == ["A"]
    assert nowhere.failed == ("A",)
    assert "A" in nowhere.corners


@pytest.mark.parametrize("scenes", [30, pytest.param(300, marks=pytest.mark.soak)])
def test_leaders_cross_no_label_and_end_at_their_anchor(scenes):
    leaders = 0
    for seed in range(scenes):
        requests, obstacles = random_scene(seed, labels=30, strokes=60)

        labels = place(requests, obstacles, GAP)

        boxes = dict(zip((r.name for r in requests), boxes_of(requests, labels), strict=True))
        by_name = {r.name: r for r in requests}
        for name, (head, foot) in labels.leaders.items():
            line = shapely.LineString([(head.real, head.imag), (foot.real, foot.imag)])
            assert not [n for n, box in boxes.items() if n != name and n not in labels.failed and line.intersects(box)]
            anchor = by_name[name].anchor
            mark = strokes_of([anchor])[0] if isinstance(anchor, tuple) else shapely.Point(anchor.real, anchor.imag)
            assert mark.distance(shapely.Point(foot.real, foot.imag)) < 1.001
            assert 0 < boxes[name].distance(shapely.Point(head.real, head.imag)) < GAP / 2 + 1e-9
            assert 3 < line.length < 36
            leaders += 1
    assert leaders > scenes / 6


def velocity_plan(seed: int) -> tuple[list[Request], Obstacles]:
    """A pole, four absolute velocities and the relative ones between neighbours, as on a sheet."""
    r = random.Random(seed)
    start = r.uniform(0, 360)
    ends = [turned(r.uniform(50, 80), start + 55 * k + r.uniform(-8, 8)) for k in range(4)]
    vectors = [(0j, e) for e in ends] + list(itertools.pairwise(ends))
    requests = [Request("p", 3, 4, 0j)] + [Request(n, 3, 4, e) for n, e in zip("abcd", ends, strict=True)]
    requests += [Request(f"V_{k}", 7, 5.5, v) for k, v in enumerate(vectors)]
    tips = [(b.real - 1, b.imag - 1, b.real + 1, b.imag + 1) for _, b in vectors]
    return requests, Obstacles(segments=vectors, boxes=tips)


def test_letters_stand_nearer_to_their_own_than_to_any_other():
    for seed in range(80):
        requests, obstacles = velocity_plan(seed)

        labels = place(requests, obstacles, GAP)

        assert not labels.failed
        assert not labels.leaders
        boxes = boxes_of(requests, labels)
        strokes = strokes_of(obstacles.segments)
        for box, request in zip(boxes, requests, strict=True):
            if isinstance(request.anchor, tuple):
                own = box.distance(strokes_of([request.anchor])[0])
                others = [s for s, v in zip(strokes, obstacles.segments, strict=True) if v != request.anchor]
            else:
                own = box.distance(shapely.Point(request.anchor.real, request.anchor.imag))
                others = [s for s, v in zip(strokes, obstacles.segments, strict=True) if request.anchor not in v]
            assert own < min(s.distance(box) for s in others), (seed, request.name)


def test_thin_strokes_are_avoided_where_there_is_room():
    thin = [(complex(-30, y), complex(30, y)) for y in (2.0, 4.0)]
    corner = place([Request("A", 4, 3, 0j, 1.0)], Obstacles(thin=thin)).corners["A"]
    assert corner.imag + 3 < 2.0


def knot(seed: int, vectors: int) -> tuple[list[Request], Obstacles]:
    """Vectors from all sides that end within a few millimetres of each other, as on a plan with a crowded end."""
    r = random.Random(seed)
    tips = [complex(r.uniform(-5, 5), r.uniform(-5, 5)) for _ in range(vectors)]
    drawn = [(turned(40, 6 + 360 * k / vectors), tip) for k, tip in enumerate(tips)]
    requests = [Request(f"n{i}", 6, 5.5, tip, 1.0, prefer=tip, priority=1) for i, tip in enumerate(tips)]
    requests += [Request(f"v{i}", 12, 7, vector, 0.9, strict=True) for i, vector in enumerate(drawn)]
    heads = [(tip.real - 1, tip.imag - 1, tip.real + 1, tip.imag + 1) for tip in tips]
    return requests, Obstacles(drawn, boxes=heads)


@pytest.mark.parametrize("vectors", [6, 14, *(pytest.param(n, marks=pytest.mark.soak) for n in (8, 10, 12))])
def test_every_letter_of_a_knot_finds_a_place(vectors: int) -> None:
    """Such letters stood on vectors and on each other: the letters that had chosen before them barred every way out."""
    for seed in range(4):
        stand_clear(*knot(seed, vectors))


def test_labels_stay_inside_the_bounds_and_none_has_the_name_of_another() -> None:
    requests = [Request("A", 4, 4, 1 + 1j), Request("B", 4, 4, 29 + 19j), Request("V", 6, 4, (1j, 20j))]
    labels = place(requests, Obstacles(), GAP, bounds=(0, 0, 30, 20))
    assert not labels.failed
    assert all(shapely.box(0, 0, 30, 20).contains(boxes_of(requests, labels)))
    assert place([], Obstacles()) == Labels()
    with pytest.raises(ValueError, match="one name"):
        place([Request("A", 4, 4, 0j), Request("A", 4, 4, 9j)], Obstacles())


@pytest.mark.parametrize(("afield", "failed"), [(True, ()), (False, ("A",))])
def test_a_label_goes_far_afield_only_where_it_may(afield, failed):
    walls = [(complex(-50, y), complex(50, y)) for y in range(-50, 51, 3)]
    labels = place([Request("A", 5, 5, 0j, afield=afield)], Obstacles(segments=walls), GAP)
    assert labels.failed == failed
    assert ("A" in labels.leaders) is afield
    assert covered([Request("A", 5, 5, 0j)], Obstacles(segments=walls), labels) == set(failed)


@pytest.mark.parametrize(
    ("thin", "boxes", "thing"),
    [
        ([(-5 + 0j, 5 + 0j)], [], shapely.LineString([(-5, 0), (5, 0)])),
        ([], [(2.0, -0.4, 3.5, 0.4)], shapely.box(2.0, -0.4, 3.5, 0.4)),
    ],
    ids=["an axis", "a word"],
)
def test_a_leader_runs_neither_along_an_axis_nor_through_a_word(thin: list, boxes: list, thing: object) -> None:
    wall = list(itertools.pairwise(5 * turned(1, 22.5 * k) for k in range(17)))
    request = Request("0, 25", 9, 4, 0j)

    def leader(*things: list) -> shapely.LineString:
        head, foot = place([request], Obstacles(wall, things[0], [(0j, 0.6)], things[1]), GAP).leaders["0, 25"]
        return shapely.LineString([(head.real, head.imag), (foot.real, foot.imag)])

    assert leader([], []).intersection(thing).length > 1.0  # where nothing is in its way
    assert leader(thin, boxes).intersection(thing).length < 0.01


def corners_of(area, block=55):
    """Title block and turned designation, as on every sheet."""
    x0, y0, x1, y1 = area
    return [(x1 - 185, y0, x1, y0 + block), (x0, y1 - 14, x0 + 70, y1)]


def judge(views, layout, area, reserved, later=None, gap=APART):
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

        one = pack(views, area, reserved, gap=APART)
        many = pack(views, area, reserved, later=later, gap=APART, pages=None)

        judge(views, many, area, reserved, later)
        assert [p.page for p in many] == sorted(p.page for p in many)
        if one is not None:
            judge(views, one, area, reserved)
            assert one == many
            packed += 1
    assert packed > count * (2 if paper == "A4" else 4) / 15
    assert many == pack(views, area, reserved, later=later, gap=APART, pages=None)


def test_views_in_a_row_hang_from_one_line_and_slack_is_spread_evenly():
    row = pack([(250, 120), (115, 115), (230, 100)], (0, 0, 640, 200), gap=APART)
    six = pack([(100, 80)] * 6, (0, 0, 400, 300), gap=APART)
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
    layout = pack(views, (0, 0, 170, 208), gap=APART)
    judge(views, layout, (0, 0, 170, 208), [])
    assert read_pages(views, layout) != list(range(len(views)))
    assert pack(views, (0, 0, 170, 208), gap=APART, any_order=False) is None
    assert order_kept([(0, 50), (60, 50), (0, 0)], [(50, 40)] * 3) == 1.0
    assert order_kept([(60, 50), (0, 50), (0, 0)], [(50, 40)] * 3) == pytest.approx(2 / 3)


def test_pages_are_as_few_and_as_full_as_possible_and_what_fits_nowhere_has_no_place():
    views, area = [(100, 100)] * 8, (0, 0, 208, 316)
    layout = pack(views, area, gap=APART, pages=None)
    assert [p.page for p in layout] == [0, 0, 0, 0, 1, 1, 1, 1]
    assert pack(views, area, gap=APART) is None
    assert pack(views * 2, area, gap=APART, pages=2) is None
    assert pack([(50, 50), (300, 50)], (0, 0, 200, 200), gap=APART, pages=None) is None
    assert pack([], (0, 0, 200, 200)) == []
    assert pack([(200, 200)], (0, 0, 200, 200)) == [Placement(0, 0.0, 0.0)]


def places(a: complex, b: complex, count: int = 2000) -> np.ndarray:
    """Places along a line, none of them at its ends."""
    return a + (b - a) * (np.arange(count) + 0.5) / count


def surrounded(at: np.ndarray, outline: list[complex]) -> np.ndarray:
    """Whether an odd number of sides of a closed line is to the right of each place."""
    sides = np.zeros(at.shape, dtype=int)
    for p, q in zip(outline, outline[1:] + outline[:1], strict=True):
        level = (p.imag > at.imag) != (q.imag > at.imag)
        x = p.real + (q.real - p.real) * (at.imag - p.imag) / (q.imag - p.imag)
        sides += level & (x > at.real)
    return sides % 2 == 1


def within(at: np.ndarray, box: tuple[float, float, float, float]) -> np.ndarray:
    x0, y0, x1, y1 = box
    return (at.real > x0) & (at.real < x1) & (at.imag > y0) & (at.imag < y1)


def test_strokes_cover_what_an_odd_number_of_sides_surrounds() -> None:
    found = strokes(STAR, ALONG, 0.5)
    assert all(surrounded(places(line.a, line.b, 50), STAR).all() for line in found)
    assert all((line.b - line.a) / abs(line.b - line.a) == pytest.approx(ALONG) for line in found)
    corner = np.arange(-45.0, 45.0, 0.1)
    area = surrounded(np.add.outer(corner, 1j * corner) + 3 - 7j, STAR).sum() * 0.01
    assert sum(abs(line.b - line.a) for line in found) * 0.5 == pytest.approx(area, rel=0.01)
    levels = {round((line.a * ALONG.conjugate()).imag / 0.5, 6) for line in found}
    assert all(level == round(level) for level in levels)


@pytest.mark.parametrize("turn", [0.3, 2.0, 4.5])
def test_a_box_is_hatched_inside_of_all_sides_only(turn: float) -> None:
    box, sides = (-20.0, -12.0, 25.0, 9.0), [(cmath.rect(1.0, turn), -6.0), (cmath.rect(1.0, turn + 2.0), -8.0)]

    lines = [line for line in hatched(sides, box, 2.5, "centre").shapes if isinstance(line, Line)]

    def free(at: np.ndarray) -> np.ndarray:
        return np.logical_and.reduce([within(at, box), *((at * n.conjugate()).real > least for n, least in sides)])

    assert len(lines) > 4
    for line in lines:
        u = (line.b - line.a) / abs(line.b - line.a)
        assert u == pytest.approx((1 + 1j) / 2**0.5)
        assert free(places(line.a, line.b)).all()
        assert not free(np.array([line.a - 0.01 * u, line.b + 0.01 * u])).any()
    levels = sorted((line.a * (1 - 1j)).imag / 2**0.5 for line in lines)
    assert np.diff(levels) == pytest.approx(2.5)
    assert hatched([(1 + 0j, 5.0), (-1 + 0j, 5.0)], (-9.0, -9.0, 9.0, 9.0), 2.5, "centre").shapes == ()


def test_lines_are_clipped_and_broken_where_boxes_say() -> None:
    random = np.random.default_rng(3)
    for a, b in (random.uniform(-25, 25, (60, 2)) + 1j * random.uniform(-25, 25, (60, 2))).tolist():
        at = places(a, b)
        inside = within(at, BOXES[0])
        part, pieces = clipped(a, b, BOXES[0]), beside(a, b, BOXES)

        assert (part is None) == (not inside.any())
        if part is not None:
            assert part == pytest.approx((at[inside][0], at[inside][-1]), abs=0.05)
        hidden = np.logical_or.reduce([within(at, box) for box in BOXES])
        shown = np.zeros(len(at), dtype=bool)
        share = ((at - a) / (b - a)).real
        for first, last in pieces:
            low, high = (((end - a) / (b - a)).real for end in (first, last))
            assert low < high
            shown |= (share > low) & (share < high)
        assert np.count_nonzero(shown == hidden) <= 2 * len(BOXES)
    assert (clipped(1j, 1j, BOXES[0]), clipped(9 + 0j, 9 + 0j, BOXES[0])) == ((1j, 1j), None)  # a place as a line
    assert beside(-9 + 2j, 9 + 2j, BOXES[:1]) == [(-9 + 2j, 9 + 2j)]  # along the side of a box


def test_leaders_count_what_they_cross_and_thin_strokes_that_they_run_along() -> None:
    random = np.random.default_rng(5)
    main, thin = (random.uniform(-40, 40, (30, 2)) + 1j * random.uniform(-40, 40, (30, 2)) for _ in range(2))
    starts, heads = (random.uniform(-30, 30, 50) + 1j * random.uniform(-30, 30, 50) for _ in range(2))
    centres, boxes = [3 + 4j, -20 + 5j], [(10.0, 10.0, 16.0, 14.0)]
    around = Surroundings(Obstacles(main, thin, [(c, 4.0) for c in centres], boxes), 0.6)
    along = Surroundings(Obstacles(thin=[(0j, 20 + 0j)]), 0.6)

    found = around.crossed(heads, starts)

    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        return np.sign(((q - p).conj() * (r - p)).imag)

    a, b = main.T
    p, q = starts[:, np.newaxis], heads[:, np.newaxis]
    crossed = (side(a, b, p) != side(a, b, q)) & (side(p, q, a) != side(p, q, b))
    number = crossed.sum(axis=1)
    for k, (start, head) in enumerate(zip(starts.tolist(), heads.tolist(), strict=True)):
        at = places(start, head, 20000)
        number[k] += sum(bool((np.abs(at - centre) < 4.0).any()) for centre in centres)
        number[k] += bool(within(at, boxes[0]).any()) and not within(np.array([start]), boxes[0])[0]
    assert np.array_equal(found, number)
    assert {MAIN, FINE} <= {*around.kind.tolist()}
    assert along.crossed(np.array([12 + 0.1j, 12 + 3j]), np.array([5 + 0j, 5 + 0.1j])).tolist() == [5, 0]


def apart(place: complex, things: np.ndarray) -> float:
    """How far a box about a place is from the nearest of many places of what is drawn: by formula."""
    beyond_x = np.maximum(np.abs(things.real - place.real) - 3.0, 0.0)
    beyond_y = np.maximum(np.abs(things.imag - place.imag) - 2.0, 0.0)
    return float(np.min(np.hypot(beyond_x, beyond_y)))


@pytest.mark.parametrize("kind", ["segments", "thin", "circles", "boxes"])
def test_the_first_clear_place_is_clear_and_those_before_are_not(kind: str) -> None:
    random = np.random.default_rng(7)
    tried = (random.uniform(-30, 30, 200) + 1j * random.uniform(-30, 30, 200)).tolist()
    ends = random.uniform(-30, 30, (10, 4))
    discs = np.outer(np.linspace(0.0, 5.0, 40), np.exp(2j * np.pi * np.arange(200) / 200)).ravel()
    across, up = np.meshgrid(np.linspace(0.0, 9.0, 60), np.linspace(0.0, 7.0, 60))
    lines = np.concatenate([places(complex(a, b), complex(c, d), 400) for a, b, c, d in ends])
    firsts = ends[:, 0] + 1j * ends[:, 1]
    obstacles, things = {
        "circles": ([(at, 5.0) for at in firsts.tolist()], np.add.outer(firsts, discs).ravel()),
        "boxes": ([(a, b, a + 9.0, b + 7.0) for a, b, *_ in ends], np.add.outer(firsts, across + 1j * up).ravel()),
    }.get(kind, (ends[:, ::2] + 1j * ends[:, 1::2], lines))

    found = first_clear(tried, SIZE, Obstacles(**{kind: obstacles}), 1.0)

    assert found is not None
    first = next(place for place in tried if apart(place, things) > 1.2)
    assert apart(found, things) > 0.99
    assert tried.index(found) <= tried.index(first)
    assert first_clear([0j, 1 + 1j], SIZE, Obstacles(circles=[(0j, 50.0)]), 1.0) is None


def test_a_letter_is_written_once_and_keeps_others_away() -> None:
    canvas = Canvas(STYLES["A3"])
    canvas.add(Line(-9 + 0j, 9 + 0j, Pen.THIN), Circle(0j, 1.0, Pen.MAIN))
    written = [canvas.write("O", [0j, 4j, 9j, 10 + 10j], 3.5) for _ in range(4)]
    letters = [shape for shape in canvas.shapes if isinstance(shape, Text)]
    assert written == [True, True, True, False]
    assert len({letter.at for letter in letters}) == 3


@pytest.mark.parametrize("within", [0.02, 0.1, 1.0])
def test_a_thinned_curve_stays_near_all_its_points(within: float) -> None:
    found = thinned(CIRCLE, within)
    line = shapely.LineString([(p.real, p.imag) for p in found])
    assert max(line.distance(shapely.Point(p.real, p.imag)) for p in CIRCLE) <= within + 1e-12
    assert len(found) < 2.0 + math.radians(270) / math.acos(1.0 - within / 40.0)
    assert (found[0], found[-1]) == (CIRCLE[0], CIRCLE[-1])
    assert set(found) <= set(CIRCLE)
    assert thinned((1j,) * 9, within) == (1j, 1j)  # a closed curve of points in one place


def test_only_curves_of_many_points_are_changed() -> None:
    line, short = Line(0j, 1 + 0j, Pen.THIN), Polyline(CIRCLE[:5], Pen.MAIN)
    group = coarser(Group((line, short, Polyline(CIRCLE, Pen.MAIN)), "curve", "s"), 0.1)
    assert isinstance(group, Group)
    assert group.shapes == (line, short, Polyline(thinned(CIRCLE, 0.1), Pen.MAIN))
