"""Places of letters: no label covers anything, each stands nearest to its own; judged by what many places tell."""

import cmath
import itertools
import math
import random
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
import shapely
import shapely.affinity

from kulman.drawing.formats import STYLES
from kulman.drawing.labels import Labels, Request, Scene, place
from kulman.drawing.page import extent
from kulman.drawing.raster import CELL, Cells, Convex
from kulman.drawing.shapes import Arc, Circle, Group, Line, Pen, Text, Vector
from kulman.drawing.spots import AWAY, FINE, LONE, MAIN, Obstacles, Surroundings, first_clear
from kulman.drawing.text import lay_out
from kulman.drawing.view import DOT, ELSEWHERE, Canvas, _obstacles
from kulman.tests.support.cases import some
from kulman.tests.support.shapes import places, within

GAP = 0.6  # mm, of labels
SIZE = 6.0, 4.0


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
    turns = np.exp(1j * np.array([labels.angles.get(r.name, 0.0) for r in requests]))
    around = [(0, r.width, r.width + 1j * r.height, 1j * r.height) for r in requests]
    outlines = corners[:, None] + turns[:, None] * np.array(around, dtype=complex)
    return shapely.polygons(np.stack((outlines.real, outlines.imag), axis=-1))


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


@pytest.mark.parametrize("seed", range(30))
def test_labels_left_out_have_no_place_and_the_others_stand_clear(seed: int) -> None:
    requests, obstacles = random_scene(seed, labels=2 + seed % 24, strokes=seed)
    scene, r = Scene(requests, obstacles, GAP), random.Random(seed)
    whole = scene.place()
    for _ in range(3):
        out = {request.name for request in requests if r.random() < 0.4}
        labels, kept = scene.place(out), [request for request in requests if request.name not in out]

        assert labels.corners.keys() == {request.name for request in kept}
        assert not labels.failed
        assert not kept or not covered(kept, obstacles, labels)
    assert scene.place() == whole == place(requests, obstacles, GAP)


@pytest.mark.parametrize("buried", [False, True])
def test_letters_left_out_in_vain_come_back(buried: bool) -> None:
    """All gave way, one after another, to a letter that has no place wherever they stand."""
    canvas = Canvas(STYLES["A1"])
    if buried:  # no leader is so long
        canvas.add(*(Line(end, end.conjugate(), Pen.MAIN) for end in (complex(3 * k, 150) for k in range(-50, 51))))
    canvas.label("O", 0j)
    for k in range(20):
        canvas.label(f"h_{k}", (300 + 30j * k, 320 + 30j * k), spare=f"h_{k} = 1")

    view = canvas.finish("crowded")

    assert {text.markup for text in view.shapes if isinstance(text, Text)} == {"O", *(f"h_{k}" for k in range(20))}
    assert not view.notes


@pytest.mark.parametrize("side", [1, 1j, -1, -1j])
def test_a_label_stands_where_it_is_preferred_beside_a_point_and_a_vector(side: complex) -> None:
    corner = place([Request("A", 4, 4, 10 + 10j, 1.0, prefer=side)], Obstacles()).corners["A"]
    vector = Request("V", 6, 4, (0j, 50 + 0j), 1.0, prefer=side)
    assert corner + 2 + 2j - (10 + 10j) == pytest.approx(3 * side)
    if side.imag:  # a little off its vector, but for want of room
        walls = [(0j, 50 + 0j), (6j - 50, 6j + 100), (-6j - 50, -6j + 100)]
        for drawn, off in ((walls[:1], 3.8), (walls, 3.0)):
            assert place([vector], Obstacles(drawn)).corners["V"] + 3 + 2j == pytest.approx(25 + off * side)


@pytest.mark.parametrize("turn", range(0, 360, 15))
def test_a_letter_stays_beside_its_node_however_many_lines_end_there(turn: int) -> None:
    """Lines of its own drive no letter away; a level one keeps it off, under which it would look barred."""
    node = 20 + 20j
    ends = [node + turned(60.0, turn + degrees) for degrees in (0, 25, 50)]
    thin = [(node - turned(10.0, turn + degrees), node) for degrees in (0, 50)]
    request = Request("b", 3.0, 4.0, node, 1.0)

    labels = stand_clear([request], Obstacles([(node, end) for end in ends], thin))

    box = boxes_of([request], labels)[0]
    level = [line for line in thin if abs((line[1] - line[0]).imag) < 2.0]
    assert box.distance(anchored(node)) < (4.0 if level else 2.5)
    assert all(box.distance(anchored(line)) > 2.0 for line in level)


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


def anchored(anchor: complex | tuple[complex, complex]) -> shapely.Geometry:
    return strokes_of([anchor])[0] if isinstance(anchor, tuple) else shapely.Point(anchor.real, anchor.imag)


def one_line(first: complex | tuple[complex, complex], second: complex | tuple[complex, complex]) -> bool:
    """Whether two vectors, not the same one, are one line on paper: hardly inclined, the middle of one on the other."""
    if not isinstance(first, tuple) or not isinstance(second, tuple) or first == second:
        return False
    (a, b), (c, d) = first, second
    sine = abs(((b - a) * (d - c).conjugate()).imag) / abs(b - a) / abs(d - c)
    apart = min(anchored((a + b) / 2).distance(anchored(second)), anchored((c + d) / 2).distance(anchored(first)))
    return sine < 0.05 and apart < 0.3


@pytest.mark.parametrize("block", [0, pytest.param(1, marks=pytest.mark.soak)])
def test_no_letter_is_nearer_to_another_node_or_vector_than_to_its_own(block: int) -> None:
    turned = 0
    for seed in range(block * 200, block * 200 + (200 if block else 40)):
        requests, obstacles = random_scene(seed, labels=20, strokes=24)
        labels = place(requests, obstacles, GAP)
        turned += len(labels.angles)
        for box, request in zip(boxes_of(requests, labels), requests, strict=True):
            if request.name not in labels.leaders and request.name not in labels.failed:
                kind = [r.anchor for r in requests if isinstance(r.anchor, tuple) is isinstance(request.anchor, tuple)]
                own = box.distance(anchored(request.anchor))
                rivals = [anchor for anchor in kind if not one_line(anchor, request.anchor)]
                assert own < min(box.distance(anchored(anchor)) for anchor in rivals) + 0.3, (seed, request.name)
    assert turned > 1


@pytest.mark.parametrize("seed", some(range(20), *range(8)))
def test_letters_of_two_things_nearly_in_one_place_stand_on_the_sides_of_their_own(seed: int) -> None:
    r, aside = random.Random(seed), 0
    for _ in range(10):
        start, e = complex(r.uniform(0, 9), r.uniform(0, 9)), turned(1.0, r.uniform(0, 360))
        first, second = start + e * r.uniform(20, 60), start + e * r.uniform(20, 60) * turned(1.0, r.uniform(-1.5, 1.5))
        near = second + turned(r.uniform(0.2, 0.6), r.uniform(0, 360))
        anchors = [(start, first), (start, second), second, near]
        requests = [Request(f"{k}", 5.0, 4.5, anchor, 0.8) for k, anchor in enumerate(anchors)]
        labels = stand_clear(requests, Obstacles([(start, first), (start, second)], (), [(second, 0.3), (near, 0.3)]))
        for box, request in zip(boxes_of(requests, labels), requests, strict=True):
            kind = [a for a in anchors if isinstance(a, tuple) is isinstance(request.anchor, tuple)]
            far = [box.distance(anchored(anchor)) for anchor in kind]
            own = 0.0 if request.name in labels.leaders else box.distance(anchored(request.anchor))
            assert own < min(far) + 0.1, request.name
            aside += own > min(far)
    assert aside < 10


@pytest.mark.parametrize("block", [0, pytest.param(1, marks=pytest.mark.soak)])
def test_a_leader_crosses_no_main_line_where_there_is_another_way(block: int) -> None:
    leaders, reported = 0, 0
    for seed in range(block * 200, block * 200 + (200 if block else 60)):
        requests, obstacles = random_scene(seed, labels=12, strokes=30)
        labels = place(requests, obstacles, GAP)
        walls, leaders = strokes_of(obstacles.segments), leaders + len(labels.leaders)
        for name, (head, knee, *bent) in labels.leaders.items():
            reported += name in labels.crossed
            *way, after, start = head, knee, *bent
            way += [after, start + 0.3 * (after - start) / abs(after - start)]  # from its own line
            crosses = shapely.crosses(strokes_of([*itertools.pairwise(way)])[:, None], walls)
            assert name in labels.crossed or not crosses.any(), seed
            assert abs((head - knee).imag) > 0.49 * abs(head - knee)  # neither a bar nor a dash
    assert leaders > 10
    assert reported <= leaders / 10


@pytest.mark.parametrize("degrees", [-80, -30, 30, 80, 90, 100, 150, 215, 270])
def test_a_label_that_finds_no_room_beside_its_vector_runs_along_it_and_is_read_from_below_or_from_the_right(degrees):
    way = turned(60.0, degrees)
    walls = [(s * 8.0j * way / 60.0, s * 8.0j * way / 60.0 + way) for s in (-1, 1)]
    request = Request("V_BA", 14, 6, (0j, way), 0.8)
    labels = place([request], Obstacles([(0j, way), *walls]), GAP)
    (angle,) = labels.angles.values()
    assert math.sin(angle - math.radians(degrees)) == pytest.approx(0.0, abs=1e-9)
    assert -75.0 < math.degrees(angle) < 105.0
    assert not labels.leaders
    assert not covered([request], Obstacles([(0j, way), *walls]), labels)


@pytest.mark.parametrize("seed", range(6))
def test_optional_labels_run_along_their_lines_give_way_to_all_others_and_are_left_out_without_room(seed: int) -> None:
    requests, obstacles = random_scene(seed, labels=16, strokes=30)
    r = random.Random(seed)
    ways = [(p := complex(r.uniform(0, 160), r.uniform(0, 110)), p + turned(12.0, r.uniform(0, 360))) for _ in range(9)]
    more = [Request(f"o{i}", 9, 3.5, way, 0.6, optional=True) for i, way in enumerate(ways)]
    obstacles = replace(obstacles, thin=[*obstacles.thin, *ways])
    alone, labels = place(requests, obstacles, GAP), place([*requests, *more], obstacles, GAP)
    kept = [r for r in more if r.name in labels.corners]
    assert not {r.name for r in more} & {*labels.leaders, *labels.failed}
    assert {r.name for r in kept} & {*labels.angles}
    assert covered(requests + kept, obstacles, labels) == covered(requests, obstacles, alone) == set()
    wall, line = [(complex(-50, y), complex(50, y)) for y in range(-50, 51, 3)], (0j, 12 + 0j)
    assert place([Request("x", 9, 5, line, optional=True)], Obstacles(wall)).corners == {}
    aside = place([Request("x", 9, 5, line, optional=True, other=(70 + 0j, 110 + 0j))], Obstacles(wall))
    assert aside.corners["x"].real > 60
    gate = [(a, b) for a, b in wall if a.imag < 0] + [
        (complex(x, y), complex(x + 46, y)) for x in (-42, 8) for y in (2, 4)
    ]
    led = place([Request("x", 9, 5, line, optional=True, other=(line[0] - 9, line[0]))], Obstacles(gate))
    assert {*led.leaders} == {"x"}


@pytest.mark.parametrize("scenes", [30, pytest.param(120, marks=pytest.mark.soak)])
def test_leaders_cross_no_label_and_end_at_their_anchor(scenes):
    leaders = 0
    for seed in range(scenes):
        requests, obstacles = random_scene(seed, labels=30, strokes=60)

        labels = place(requests, obstacles, GAP)

        boxes = dict(zip((r.name for r in requests), boxes_of(requests, labels), strict=True))
        by_name = {r.name: r for r in requests}
        for name, (head, *bent, foot) in labels.leaders.items():
            line = shapely.LineString([(p.real, p.imag) for p in (head, *bent, foot)])
            assert not [n for n, box in boxes.items() if n != name and n not in labels.failed and line.intersects(box)]
            assert anchored(by_name[name].anchor).distance(shapely.Point(foot.real, foot.imag)) < 1.001
            assert 0 < boxes[name].distance(shapely.Point(head.real, head.imag)) < GAP / 2 + 1e-9
            assert 3 < line.length < 76
            leaders += 1
    assert leaders > scenes / 6


def test_a_label_on_a_leader_does_not_read_as_one_word_with_another() -> None:
    leads, close = 0, 0
    for seed in range(40):
        requests, obstacles = random_scene(seed, labels=30, strokes=30)
        labels = place(requests, obstacles, GAP)
        boxes = dict(zip((r.name for r in requests), shapely.bounds(boxes_of(requests, labels)), strict=True))
        for name in labels.leaders:
            (x0, y0, x1, y1), leads = boxes[name], leads + 1
            others = (box for other, box in boxes.items() if other != name and other not in labels.angles)
            close += any(min(b[2], x1) - max(b[0], x0) > -1.9 and b[1] < y1 and y0 < b[3] for b in others)
    assert leads > 50
    assert close <= leads / 20


def upright_pairs(labels: int, strokes: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Sizes of the upright letters of scenes, shape (N, 2), and what each two share across and up; less is a gap."""
    for seed in range(40):
        requests, obstacles = random_scene(seed, labels=labels, strokes=strokes)
        placed = place(requests, obstacles, GAP)
        boxes = shapely.bounds(boxes_of([r for r in requests if r.name not in placed.angles], placed))
        low, high = boxes[:, :2], boxes[:, 2:]
        yield high - low, np.minimum(high[:, None], high) - np.maximum(low[:, None], low)


def test_letters_read_neither_as_one_word_nor_as_a_fraction() -> None:
    letters, close = 0, 0
    for size, shared in upright_pairs(labels=30, strokes=30):
        along = shared > 0.5 * np.minimum(size[:, None], size)
        letters, close = (
            letters + len(size),
            close + int(np.triu((along & (shared[..., ::-1] > -1.5)).any(-1), 1).sum()),
        )
    assert letters > 1000
    assert close <= letters / 200


def test_letters_on_one_line_leave_room_for_another_one_between_them() -> None:
    letters, near = 0, 0
    for size, shared in upright_pairs(labels=20, strokes=12):
        low = np.minimum(size[:, None, 1], size[:, 1])
        row = (shared[..., 1] > 0.5 * low) & (shared[..., 0] > -1.2 * low)
        letters, near = letters + len(size), near + int(np.triu(row, 1).sum())
    assert letters > 700
    assert near <= letters / 50


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


@pytest.mark.parametrize("vectors", some([6, 14, *(pytest.param(n, marks=pytest.mark.soak) for n in (8, 10, 12))], 0))
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


@pytest.mark.parametrize("seed", range(12))
def test_a_leader_bends_where_a_passage_between_lines_bends(seed: int) -> None:
    r = random.Random(seed)
    half, long, turn = r.uniform(2.0, 2.4), r.uniform(8.0, 13.0), r.choice([1, -1])
    e = turned(1.0, 90 * r.randrange(4) + r.uniform(34, 56))  # not level

    def at(x: float, y: float) -> complex:
        return e * complex(x, turn * y)

    # a passage from the node round a corner into the open, between walls that are thick
    walls = []
    for thick in (0.0, 1.5, 3.0, 4.5, 6.0, 7.5):
        low, left, right = half + thick, long - half - thick, long + half + thick
        walls += itertools.pairwise([at(-low, 10.0), at(-low, -low), at(right, -low), at(right, 40.0)])
        walls += itertools.pairwise([at(-half, low), at(left, low), at(left, 10.0)])
    request = Request("A", 6.0, 5.0, 0j, 0.8)

    labels = place([request], Obstacles(walls, (), [(0j, 0.3)]), GAP)

    head, knee, start = labels.leaders["A"]
    assert (labels.failed, labels.crossed) == ((), ())
    assert abs(start) < 0.31
    legs = strokes_of([(head, knee), (knee, start)])
    assert not shapely.crosses(legs[:, None], strokes_of(walls)).any()
    assert not shapely.intersects(boxes_of([request], labels), strokes_of(walls)).any()
    assert abs(cmath.phase((knee - start) / (head - knee))) < 0.61 * math.pi  # no sharp bend


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
        ([(-5 - 5j, 5 + 5j)], [], shapely.LineString([(-5, -5), (5, 5)]).buffer(0.001)),
        ([], [(2.0, 2.0, 3.5, 3.5)], shapely.box(2.0, 2.0, 3.5, 3.5)),
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


@pytest.mark.parametrize("angle", [20.0, 45.0, 160.0, 290.0])
def test_beside_an_arrowhead_there_is_room_and_upon_it_none(angle: float) -> None:
    tip = turned(6.0, angle)
    head, small = Obstacles(heads=[(0j, tip)]), (0.4, 0.4)
    beside = [tip * complex(share, side * 0.35) for share in (0.2, 0.5, 0.8) for side in (-1, 1)]
    upon = [tip * complex(share, side * 0.1) for share in (0.1, 0.3) for side in (-1, 0, 1)]

    assert [first_clear([at], small, head, 0.5) for at in beside] == beside
    assert [first_clear([at], small, head, 0.5) for at in upon] == [None] * len(upon)
    places = np.array(beside + upon)
    assert Surroundings(head, 0.6).cells.at(places.real, places.imag).tolist() == [False] * 6 + [True] * 6


def test_a_leader_leaves_the_tip_of_its_own_arrow_and_crosses_no_other() -> None:
    around = Surroundings(Obstacles(heads=[(-6 + 0j, 0j), (4 - 3j, 4 + 3j)]), 0.6)
    starts = np.zeros(3, dtype=complex)
    heads = np.array([0 + 9j, 9 + 0j, 3 + 9j])
    assert around.crossed(heads, starts).tolist() == [0, 1, 0]
    assert around.barring.barred(starts, heads).tolist() == [False, True, False]


@pytest.mark.parametrize("length", [4.0, 6.0, 9.0, 14.0])
@pytest.mark.parametrize("place", ["tip", "middle"])
def test_leaders_start_on_the_head_of_their_own_arrow_rather_than_where_others_begin(
    length: float, place: Literal["tip", "middle"]
) -> None:
    tip = turned(length, 20.0)
    own = Vector(0j, tip, "R", 1.0, "N", 1.0, head=place)
    others = [Vector(tip, tip + turned(60.0, turn), "F", 1.0, "N", 1.0) for turn in (100.0, 140.0)]
    around = Surroundings(_obstacles([own, *others], [], STYLES["A1"]), GAP)
    alone = around.alone(np.array([0.3 * tip, 0.5 * tip, tip - turned(0.5, 20.0), tip]), 0j, tip)
    assert alone[:2].tolist() == [LONE, LONE]
    assert alone[3] < alone[2] < LONE


@pytest.mark.parametrize("turn", range(0, 360, 15))
def test_a_letter_on_a_leader_stands_plainly_away_from_the_vector_of_another_name(turn: int) -> None:
    tip = turned(60.0, turn)
    requests = [Request("B", 4.0, 5.0, 0j, prefer=turned(1.0, turn + 12.0)), Request("R", 8.0, 6.0, (0j, tip))]
    labels = place(requests, Obstacles(segments=[(0j, tip)], kept=[(-9.0, -9.0, 9.0, 9.0)]), GAP)
    assert list(labels.leaders) == ["B"]
    assert boxes_of(requests, labels)[0].distance(shapely.LineString([(0, 0), (tip.real, tip.imag)])) > AWAY


def test_leaders_run_through_what_is_kept_clear_of_letters() -> None:
    support = [(-8.0, -8.0, 8.0, 8.0)]
    request = Request("A", 4.0, 4.0, 0j)
    labels = place([request], Obstacles(kept=support), GAP)

    assert (labels.failed, labels.crossed, list(labels.leaders)) == ((), (), ["A"])
    assert not shapely.intersects(boxes_of([request], labels), shapely.box(*support[0])).any()
    way = np.array([0j]), np.array([20 + 5j])
    assert Surroundings(Obstacles(boxes=support), GAP).barring.barred(*way)
    assert not Surroundings(Obstacles(kept=support), GAP).barring.barred(*way)


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

    a, b = np.concatenate((main, thin)).T
    p, q = starts[:, np.newaxis], heads[:, np.newaxis]
    crossed = (side(a, b, p) != side(a, b, q)) & (side(p, q, a) != side(p, q, b))
    crossed[:, len(main) :] = False
    # nearly parallel to a line that it touches, and be it thin, it would be taken for a part of it
    touching = shapely.distance(
        strokes_of(np.stack((starts, heads), axis=1))[:, np.newaxis], strokes_of([*main, *thin])
    )
    slope = abs(((q - p) * (b - a).conj()).imag) / abs((q - p) * (b - a))
    number = (crossed | ((touching < 0.3) & (slope < 0.2))).sum(axis=1)
    for k, (start, head) in enumerate(zip(starts.tolist(), heads.tolist(), strict=True)):
        at = places(start, head, 20000)
        on = at[np.abs(at - start) >= 0.5]  # it may leave one on its rim
        for centre in centres:
            number[k] += float(np.abs(on - centre).min()) < 4.45
        number[k] += bool(within(at, boxes[0]).any()) and not within(np.array([start]), boxes[0])[0]
    assert np.array_equal(found, number)
    assert {MAIN, FINE} <= {*around.kind.tolist()}
    assert along.crossed(np.array([12 + 0.1j, 12 + 3j]), np.array([5 + 0j, 5 + 0.1j])).tolist() == [1, 0]


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


def crowded_canvas(seed: int) -> Canvas:
    """Letters of nodes in a thicket of thin lines, arcs and dimensions, so dense that some are struck."""
    r, canvas = random.Random(seed), Canvas(STYLES["A1"])

    def ends() -> tuple[complex, complex]:
        middle, half = complex(r.uniform(0, 60), r.uniform(0, 60)), turned(r.uniform(5, 30), r.uniform(0, 360))
        return middle - half, middle + half

    for number in range(40):
        a, b = ends()
        canvas.thin("construction", f"c{number}", a, b)
        canvas.group("dimension", f"d{number}", Line(*ends(), Pen.THIN))
        canvas.add(Arc(a, r.uniform(5, 30), r.uniform(0, 6), r.uniform(-6, 6), Pen.THIN, role="arc", name=f"a{number}"))
    for number in range(12):
        canvas.label(f"A_{{{number}}}", complex(r.uniform(0, 60), r.uniform(0, 60)))
    canvas.thin("shelf", "whole", 0j, 60 + 60j)
    return canvas


@pytest.mark.parametrize("crowd", some([0, pytest.param(8, marks=pytest.mark.soak), 20], 0))
def test_all_letters_of_a_view_are_as_small_as_texts_where_they_have_no_room_else(crowd: int) -> None:
    small = 0
    for seed in range(6):
        r, canvas, style = random.Random(seed), Canvas(STYLES["A1"]), STYLES["A1"]
        ends = [complex(r.uniform(0, 50), r.uniform(0, 50)) for _ in range(crowd + 3)]
        canvas.add(*(Line(r.choice(ends), end) for end in ends))
        for number, end in enumerate(ends):
            canvas.label(f"A_{{{number}}}", end)
        canvas.small("= 1,5", 25 + 25j)
        letters = [text for text in canvas.finish("crowd").shapes if isinstance(text, Text)]
        heights = {text.height for text in letters if text.markup != "= 1,5"}
        assert len(letters) == len(ends) + 1
        assert heights in ({style.label}, {style.text})
        assert {text.height for text in letters} - heights <= {style.text}
        small += heights == {style.text}
    assert small == 0 if crowd == 0 else small < 6 if crowd == 8 else small > 0


@pytest.mark.parametrize("seed", [1, *(pytest.param(k, marks=pytest.mark.soak) for k in (0, 2, 3))])
def test_a_letter_that_stays_is_left_out_only_for_a_leader_through_lines_and_is_said_in_the_notes(seed: int) -> None:
    def crowd(said: str) -> tuple[set[str], set[str], int]:
        r, canvas = random.Random(seed), Canvas(STYLES["A1"])
        ends = [complex(r.uniform(0, 40), r.uniform(0, 40)) for _ in range(12)]
        canvas.add(*(Line(r.choice(ends), end) for end in ends))
        for number, end in enumerate(ends):
            last = {"elsewhere": ELSEWHERE, "": ""}.get(said, f"= A_{number}")
            bare = f"{last} = {number}" if said == "bare" else ""
            canvas.label(f"A_{number}", end, last=last)
            canvas.label(f"V_{number}", (end, ends[number - 1]), spare=last, bare=bare)
        view = canvas.finish("crowd")
        crossed = [line for line in view.shapes if isinstance(line, Line) and line.role == "leader"]
        walls = strokes_of([(line.a, line.b) for line in view.shapes if isinstance(line, Line) and not line.role])
        count = 0
        for line in crossed:
            e = 0.5 * (line.b - line.a) / abs(line.b - line.a)
            count += bool(shapely.crosses(strokes_of([(line.a + e, line.b - e)])[0], walls).any())
        return (
            {text.markup for text in view.shapes if isinstance(text, Text)},
            {*"; ".join(view.notes).split("; ")},
            count,
        )

    every = {f"{letter}_{number}" for number in range(12) for letter in "AV"}
    whole, notes, crossed = crowd("")
    assert every <= whole
    assert notes == {""}
    drawn, notes, fewer = crowd("notes")
    assert fewer <= crossed
    gone = every - drawn
    numbers = [letter[2:] for letter in gone]
    assert len(numbers) == len({*numbers})  # of two with one text one stays
    assert notes - {""} == {f"= A_{number}" for number in numbers}
    assert bool([letter for letter in gone if letter[0] == "A"]) <= bool(crossed)
    drawn, notes, _ = crowd("elsewhere")
    assert notes == {""}
    drawn, notes, crossed = crowd("bare")
    assert crossed == 0  # both of a pair may go: the notes tell what no letter shows
    gone = every - drawn
    both = {letter[2:] for letter in gone if letter[0] == "A" and f"V_{letter[2:]}" in gone}
    each = {letter[2:] for letter in gone}
    assert notes - {""} == {f"= A_{number}" + f" = {number}" * (number in both) for number in each}


def chords(shapes: object) -> list[tuple[str, shapely.Geometry]]:
    """Lines and arcs, by their names; those of groups by the names of these."""
    found = []
    for shape in shapes:
        if isinstance(shape, Group):
            found += [(shape.name, line) for _, line in chords(shape.shapes)]
        elif isinstance(shape, Line):
            found.append((shape.name, shapely.LineString([(p.real, p.imag) for p in (shape.a, shape.b)])))
        elif isinstance(shape, Arc):
            turns = np.exp(1j * (shape.start + shape.sweep * np.linspace(0, 1, 300))) * shape.radius + shape.centre
            found.append((shape.name, shapely.LineString(np.stack((turns.real, turns.imag), axis=-1))))
    return found


def inked(text: Text) -> shapely.Geometry:
    (x0, y0, x1, y1), layout = extent((text,)), lay_out(text.markup, text.height)
    return shapely.box(x0 + layout.left, y0, x1 + layout.right - layout.width, y1)


@pytest.mark.parametrize("seed", some(range(6), 0, 1, 2))
def test_thin_lines_break_off_at_letters_that_they_would_strike_and_nowhere_else(seed: int) -> None:
    canvas = crowded_canvas(seed)
    before, drawn = chords(canvas.shapes), canvas.finish("thicket").shapes
    after = chords([shape for shape in drawn if getattr(shape, "role", "") != "leader"])
    boxes = shapely.union_all([inked(text) for text in drawn if isinstance(text, Text)])
    near = boxes.buffer(1.3)  # half a millimetre beside a letter, at a corner more, of an arc a quarter more
    gone = 0
    for name, line in before:
        left = shapely.union_all([piece for own, piece in after if own == name])
        assert left.difference(line.buffer(0.01)).length < 1e-6
        lost = shapely.get_parts(line.difference(near).difference(left.buffer(0.3)))
        assert all(part.length < DOT for part in lost)  # what is left beside a letter would read as a prime
        if name == "whole":
            assert left.length == pytest.approx(line.length)
        elif line.difference(near).length > 0.5:
            assert left.intersection(boxes).length < 1e-6, name
        gone += line.length - left.length > 1.0
    assert gone


@pytest.mark.parametrize("between", [9.0, 11.0, 13.0, 15.0])
def test_letters_under_a_bar_are_nearest_to_their_own_vectors_without_the_bar_too(between: float) -> None:
    for turn in range(0, 360, 9):
        canvas = Canvas(STYLES["A1"])
        ends = [turned(90, turn), turned(70, turn + between)]
        for end, other, markup in zip(ends, ends[::-1], (r"\bar{V}_{A}", r"\bar{V}_{S4}"), strict=True):
            canvas.add(Vector(0j, end, "V", 1.0, "m/s", 1.0))
            canvas.label(markup, (0j, end), prefer=other - end, clear=0.9, strict=True)
        view = canvas.finish("plan")
        led = any(getattr(shape, "role", "") == "leader" for shape in view.shapes)
        for text, end in zip((s for s in view.shapes if isinstance(s, Text)), ends, strict=True):
            layout = lay_out(text.markup, text.height)
            x0, y0, x1, y1 = layout.bare
            assert layout.size[1] - y1 > 0.8  # the bar
            box = shapely.affinity.rotate(shapely.box(x0, y0, x1, y1), math.degrees(text.angle), origin=(0, 0))
            at = text.at + complex(layout.left, layout.bottom) * cmath.rect(1.0, text.angle)
            letters = shapely.affinity.translate(box, at.real, at.imag)
            lines = [shapely.LineString([(0, 0), (p.real, p.imag)]) for p in (end, *(set(ends) - {end}))]
            far = [letters.distance(line) for line in lines]
            assert led or far[0] < far[1], (turn, text.markup, far)


@pytest.mark.parametrize("seed", range(6))
def test_cells_hold_all_of_boxes_and_circles_and_little_that_is_not_drawn(seed: int) -> None:
    rng = np.random.default_rng(seed)
    starts = rng.uniform(0.0, 150.0, (45, 2)) @ [1.0, 1j]
    ends = starts + rng.uniform(-9.0, 9.0, (45, 2)) @ [1.0, 1j]
    ends[:15] = starts[:15]
    things = Convex.of(starts, ends, np.arange(45) >= 30)  # circles, strokes, boxes
    things = things._replace(radius=np.where(np.arange(45) < 15, rng.uniform(0.3, 6.0, 45), 0.0))
    cells = Cells.of(*things)

    turns, out = rng.uniform(0.0, 2.0 * np.pi, (45, 400)), np.sqrt(rng.uniform(0.0, 1.0, (45, 400)))
    out[:, :100] = 1.0  # on the edge, too
    along, up = rng.uniform(-1.0, 1.0, (2, 45, 400))
    along[:, :40], up[:, 40:80], up[:, 80:90] = 1.0, 1.0, -1.0
    inside = things.middle[:, None] + things.radius[:, None] * out * np.exp(1j * turns)
    inside += things.hx[:, None] * along + 1j * things.hy[:, None] * up
    inside = inside[things.along == 0]  # of strokes cells may lack a corner
    places = rng.uniform(-10.0, 160.0, (20_000, 2)) @ [1.0, 1j]
    x, y = places.real[:, None], places.imag[:, None]
    gaps = things.distance(x, y, np.zeros(1), np.zeros(1)).min(axis=1)

    assert cells.at(inside.real.ravel(), inside.imag.ravel()).all()
    assert not cells.at(places.real, places.imag)[gaps > 3.0 * CELL].any()


@pytest.mark.parametrize("radius", [9.0, 9.5, 9.9])
def test_the_circle_of_a_detail_is_wider_where_its_leader_begins_outside_of_a_closed_figure_so(radius: float) -> None:
    canvas, corners = Canvas(STYLES["A3"]), [14.0 * turned(1.0, 52.0) * 1j**k for k in range(5)]
    sides = [Line(a, b, Pen.MAIN) for a, b in itertools.pairwise(corners)]
    canvas.add(*sides)

    canvas.detail("I", 0j, radius, "detail")

    (ring,) = (shape for shape in canvas.shapes if isinstance(shape, Arc))
    (leader,) = (shape for shape in canvas.shapes if isinstance(shape, Line) and shape.role == "leader")
    assert 1.0 <= ring.radius / radius < 1.5
    assert abs(leader.b) == pytest.approx(ring.radius)
    way = shapely.LineString([(leader.a.real, leader.a.imag), (leader.b.real, leader.b.imag)])
    square = shapely.LinearRing([(z.real, z.imag) for z in corners])
    assert not way.crosses(square)
