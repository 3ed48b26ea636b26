"""Views on pages: they stay apart, stand in reading order, fill their pages and take no more than they need."""

import itertools
import math
import random
from dataclasses import replace

import pytest
import shapely

from kulman.drawing.compose import (
    FIGURE,
    FULL,
    HALF,
    MANY,
    TOLD,
    Pages,
    _climbs,
    arrange,
    compose,
    in_any_order,
    last,
    on_a_page,
    on_one_page,
)
from kulman.drawing.extents import EMPTY, FILL, OVER, Extent, Extents, Ladder, _area, _begun, _page, ways
from kulman.drawing.formats import FORMATS, MARGINS, STYLES, drawing_area, reserved_boxes
from kulman.drawing.packing import LEAST, STEPS, UNDER, Placement, Slicing, _size_of, bare, spread
from kulman.drawing.page import extent
from kulman.drawing.shapes import Line
from kulman.drawing.tables import part_of, table, text_block
from kulman.drawing.view import View
from kulman.tests.support.cases import some

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


def in_order(boxes):
    """Whether every view of a page stands on the left of, or above, all that come after it."""
    return all(
        a[2] <= b[0] + 1e-6 or a[1] >= b[3] - 1e-6
        for (_, a), (_, b) in itertools.combinations(sorted(boxes.items()), 2)
    )


def judge(views, layout, paper, norm="gost"):
    """Hold that views stand inside the frame, clear of each other and of the title block of their page."""
    assert len(layout) == len(views)
    boxes: dict[int, dict[int, tuple]] = {}
    for n, ((w, h), p) in enumerate(zip(views, layout, strict=True)):
        boxes.setdefault(p.page, {})[n] = (p.x, p.y, p.x + w, p.y + h)
    assert sorted(boxes) == list(range(len(boxes)))
    frame = shapely.box(*drawing_area(FORMATS[paper], norm))
    for page, own in boxes.items():
        shapes = [shapely.box(*box) for box in own.values()]
        taken = [shapely.box(*box) for box in reserved_boxes(FORMATS[paper], norm, first=page == 0)]
        assert frame.buffer(1e-6, join_style="mitre").covers(shapely.union_all(shapes))
        for n, box in enumerate(shapes):
            assert all(box.distance(other) > LEAST - 1e-6 for other in shapes[n + 1 :])
            assert all(box.distance(other) > min(LEAST, MARGINS[paper[:2]]) - 1e-6 for other in taken)
    return [boxes[page] for page in sorted(boxes)]


def random_views(seed):
    r = random.Random(seed)
    return [(r.uniform(30, 165), r.uniform(20, 150)) for _ in range(r.randint(1, 16))]


def straight(sizes, room):
    """Whether any straight cuts part a room among views in this order: all of them are looked at."""
    if len(sizes) == 1:
        return sizes[0][0] <= room[0] and sizes[0][1] <= room[1]

    def shapes(own):
        if len(own) == 1:
            return {own[0]}
        found = set()
        for k in range(1, len(own)):
            for (a, b), (c, d) in itertools.product(shapes(own[:k]), shapes(own[k:])):
                found |= {(a + c + LEAST, max(b, d)), (max(a, c), b + d + LEAST)}
        return found

    return any(w <= room[0] and h <= room[1] for w, h in shapes(tuple(sizes)))


@pytest.mark.parametrize("count", [15, pytest.param(150, marks=pytest.mark.soak)])
@pytest.mark.parametrize("norm", ["gost", "iso"])
@pytest.mark.parametrize("paper", FORMATS)
def test_random_views_stand_clear_in_reading_order(paper, norm, count):
    placed = 0
    for seed in range(count):
        views = random_views(seed)
        one, many = on_a_page(views, FORMATS[paper], norm), arrange(views, FORMATS[paper], norm)
        pages = judge(views, many, paper, norm)
        assert all(map(in_order, pages))
        loose = on_a_page(views, FORMATS[paper], norm, loose=True)
        assert (loose is None) is (one is None)
        if one is not None and loose is not None:
            assert one == many
            assert all(map(in_order, judge(views, loose, paper, norm)))
            placed += 1
    assert placed > count / 10
    assert many == arrange(views, FORMATS[paper], norm)


@pytest.mark.parametrize("count", [60, pytest.param(600, marks=pytest.mark.soak)])
def test_what_straight_cuts_part_in_order_is_found_and_nothing_else(count):
    r, both = random.Random(5), [0, 0]
    for _ in range(count):
        views = [(r.uniform(20, 90), r.uniform(20, 90)) for _ in range(r.randint(1, 6))]
        side = math.sqrt(sum(w * h for w, h in views) * r.uniform(1.1, 2.2))
        room = side * r.uniform(0.8, 1.2), side
        page = Slicing(views, room)
        if page.fits:
            assert straight(views, room)
            wide, high = _size_of(page.cut(), views)
            assert wide <= room[0] + 1e-9
            assert high <= room[1] + 1e-9
        else:  # the grid may take a step of each view
            step = max(room) / STEPS
            assert not straight([(w + step, h + step) for w, h in views], room)
        both[page.fits] += 1
    assert min(both) > count / 6


def test_views_in_a_row_hang_from_one_line_and_slack_is_spread_evenly():
    row = Slicing([(250, 120), (115, 115), (230, 100)], (640, 200))
    places = {i: (x, y) for i, x, y in spread(row.cut(), row.sizes, (0.0, 200.0), row.room)}
    assert {y + row.sizes[i][1] for i, (_, y) in places.items()} == {200.0}
    assert [places[i][0] for i in range(3)] == pytest.approx([0.0, 272.5, 410.0])


def test_in_a_loose_layout_views_hang_in_the_middle_of_equal_parts_of_what_is_left():
    row = Slicing([(250, 120), (115, 100), (230, 200)], (640, 200))

    places = {i: (x, y) for i, x, y in spread(row.cut(), row.sizes, (0.0, 200.0), row.room, loose=True)}

    more = (640 - 595 - 2 * LEAST) / 3
    assert [places[i][1] for i in range(3)] == pytest.approx([40.0, 50.0, 0.0])
    assert [places[i][0] for i in range(3)] == pytest.approx([more / 2, 250 + LEAST + 1.5 * more, 410.0 - more / 2])


@pytest.mark.parametrize("seed", range(20))
def test_the_largest_bare_rectangle_touches_no_box(seed):
    r = random.Random(seed)
    cells = [(x, y) for x in range(6) for y in range(5) if r.random() < 0.3]  # boxes of a grid

    area = bare((0.0, 0.0, 6.0, 5.0), [(float(x), float(y), x + 1.0, y + 1.0) for x, y in cells])

    free = [
        (c - a) * (d - b)
        for a, c in itertools.combinations(range(7), 2)
        for b, d in itertools.combinations(range(6), 2)
        if not any(a <= x < c and b <= y < d for x, y in cells)
    ]
    assert area == max(free)


def test_what_alone_stands_under_the_corner_hangs_close_to_it():
    column = Slicing([(70, 14), (60, 70)], (75, 300))
    places = {i: y for i, _, y in spread(column.cut(), column.sizes, (0.0, 300.0), column.room, first=0)}
    assert places[1] + 70 == pytest.approx(300 - 14 - UNDER)


def test_what_belongs_together_is_not_parted_first():
    pairs = Slicing([(100, 60)] * 4, (210, 130), [0, 1, 0, 1]).cut()
    ends = [Slicing([(100, 60)] * 3, (210, 130), bonds).cut().parts for bonds in ([0, 0, 1], [0, 1, 0])]
    assert [part.parts for part in pairs.parts] == [(0, 1), (2, 3)]
    assert (ends[0][0], ends[0][1].parts, ends[1][0].parts, ends[1][1]) == (0, (1, 2), (0, 1), 2)


@pytest.mark.parametrize("views", [[(250, 200), (200, 60)], [(180, 220), (230, 70)]])
def test_equations_stand_nearest_to_the_figure_that_they_explain(views):
    placed = on_a_page(3 * views, FORMATS["A1"], "gost", 3 * [FIGURE, TOLD])
    boxes = [shapely.box(p.x, p.y, p.x + w, p.y + h) for p, (w, h) in zip(placed, 3 * views, strict=True)]
    nearest = [min((0, 2, 4), key=lambda k: boxes[k].distance(boxes[i])) for i in (1, 3, 5)]
    assert nearest == [0, 2, 4]


@pytest.mark.parametrize("name", COURSEWORK)
def test_a_sheet_reads_from_left_to_right_and_down(name):
    views = COURSEWORK[name]
    layout = on_a_page(views, FORMATS["A1"], "gost")
    (boxes,) = judge(views, layout, "A1")
    assert in_order(boxes)


@pytest.mark.parametrize(("paper", "most"), [("A2", 2), ("A3", 4)])
def test_several_pages_are_full(paper, most):
    views = COURSEWORK["two tables in a column"]
    pages = judge(views, arrange(views, FORMATS[paper], "gost"), paper)
    assert len(pages) <= most
    x0, y0, x1, y1 = drawing_area(FORMATS[paper])
    filled = [sum((c - a) * (d - b) for a, b, c, d in page.values()) / (x1 - x0) / (y1 - y0) for page in pages]
    assert min(filled[:-1]) > 0.45


@pytest.mark.parametrize(
    ("begins", "ends"),
    [((), 8), ((0,) * 8 + (1,) + (0,) * 4, 8), ((0,) * 5 + (2, 0, 1) + (0,) * 5, 7), ((0,) * 5 + (2,) + (0,) * 7, 7)],
    ids=["as full as it can be", "before a group", "no half empty page", "not even before a part"],
)
def test_a_page_ends_where_something_begins_that_leaves_it_full(begins, ends):
    views = [(260, 180)] * 13
    pages = [place.page for place in arrange(views, FORMATS["A1"], "gost", begins)]
    assert pages == [0] * ends + [1] * (13 - ends)


@pytest.mark.parametrize("count", [20, pytest.param(100, marks=pytest.mark.soak)])
def test_runs_of_views_take_no_more_pages_than_the_fullest_ones(count):
    several = 0
    for seed in range(count):
        views = random_views(seed) * 2
        begins = [random.Random(seed).randrange(3) for _ in views]
        plain, parted = (arrange(views, FORMATS["A2"], "gost", own) for own in ((), begins))
        assert last(parted) == last(plain)
        for places in (plain, parted):
            judge(views, places, "A2")
        several += 0 < last(plain) < MANY
    assert several > count / 4


def test_pages_stay_in_reading_order_where_larger_letters_fill_them():
    high, texts = (132, 302), [(86, 52), (140, 67), (160, 119), (153, 142), (133, 100), (160, 119)]
    before = [(62, 133), (125, 53), (354, 275), (216, 189), (191, 301), (147, 75), (149, 100), (156, 91), (156, 112)]
    views = [*before, texts[0], high, (118, 133), (275, 155), (227, 158), (143, 76), (197, 285), *texts[1:]]
    begins = [-1, -1, 0, 0, 0, -1, -1, -1, -1, 2, 1, 0, 1, 0, 0, 1, *[-1] * 5]
    strict, loose = (Pages(views, FORMATS["A1"], "gost", begins, loose=loose) for loose in (False, True))

    places = arrange(views, FORMATS["A1"], "gost", begins, count=2)

    assert all(map(in_order, judge(views, places, "A1")))
    assert HALF <= strict.least(places) < FULL <= strict.least(loose.runs(0, 0, 1))  # in another order they are fuller


@pytest.mark.parametrize("high", [192, 200, 440])
def test_views_of_the_only_page_stand_in_any_order_where_no_usual_one_has_room(high):
    drawn = [(62, 148), (135, 47), (179, high), (90, 76), (195, 100), (158, 148), (160, 238), (92, 304), (225, 174)]
    views = [*drawn, (71, 102), (101, 127), (141, 261), (228, 59), (153, 78), (153, 106), (158, 226), (139, 93)]
    begins = [-1, -1, 0, 0, 0, -2, 0, 0, -2, 0, 0, 0, -2, -1, -1, -1, -1]
    page = views, FORMATS["A1"], "gost", begins

    places = in_any_order(*page)

    assert on_one_page(*page) is None
    assert (places is not None) is (high < 400)  # more than the page holds
    if places:
        judge(views, places, "A1")
        beside = [place.x + wide for place, (wide, _) in zip(places, views, strict=True)]
        assert all(places[0].x < right for right in beside)  # nothing stands left of what is given


@pytest.mark.parametrize("count", [20, pytest.param(200, marks=pytest.mark.soak)])
def test_figures_come_down_one_column_after_the_other_where_they_can(count):
    r, room, found = random.Random(4), (800.0, 560.0), 0
    for _ in range(count):
        views = [(r.uniform(40, 200), r.uniform(40, 200)) for _ in range(r.randint(8, 26))]

        columns = Slicing(views, room, figures=[True] * len(views))

        if columns.fits:
            assert Slicing(views, room).fits
            at = {i: Placement(0, x, y) for i, x, y in spread(columns.cut(), views, (0.0, room[1]), room)}
            page = [(View("", (), (0.0, 0.0, *size)), at[i]) for i, size in enumerate(views)]
            assert in_order({i: (at[i].x, at[i].y, at[i].x + w, at[i].y + h) for i, (w, h) in enumerate(views)})
            assert _climbs(page) == 0
            found += 1
    assert count / 4 < found < count


@pytest.mark.parametrize(
    ("places", "climbs"),
    [
        ([(0, 200), (0, 0), (200, 200), (200, 0)], 0),  # two columns
        ([(0, 200), (200, 200), (0, 0), (200, 0)], 0),  # two rows
        ([(0, 300), (0, 0), (200, 300), (400, 300), (200, 0), (400, 0)], 1),  # rows beside a column
        ([(0, 0), (0, 200)], 1),
        ([], 0),
    ],
)
def test_figures_climb_in_columns_or_from_the_right_to_the_left_of_one_row(places, climbs):
    size = 90.0
    page = [(View(str(k), (), (0.0, 0.0, size, size)), Placement(0, x, y)) for k, (x, y) in enumerate(places)]

    assert _climbs(page) == climbs


def test_texts_alone_and_nothing_have_an_order_too():
    assert in_any_order([], FORMATS["A1"], "gost") == []
    assert in_any_order([(100, 50)], FORMATS["A1"], "gost", [-1]) is not None


def test_plans_are_in_proportion_and_no_two_of_them_nearer_to_their_goals_have_room():
    ladder = Ladder((1.0, 1.25, 2.0, 2.5, 4.0, 5.0))
    figures = [
        Extent("mu_l", (300.0, 250.0), (40.0, 40.0), goal=250.0),
        Extent("mu_V", (300.0, 300.0), (40.0, 40.0), goal=150.0),
        Extent("mu_a", (60.0, 190.0), (40.0, 40.0), goal=150.0),
    ]
    parts = {"A1": ((0.25, 1.5), (0.25, 1.5))}
    taken = set()
    for area in range(150_000, 290_000, 10_000):
        own = Extents(figures, area, dict.fromkeys(("mu_l", "mu_V", "mu_a"), ladder))

        sheet, rungs, count = next(ways(own, parts, [FORMATS["A1"]]))

        def off(rungs, own=own):
            return sum(f**2 * (OVER if f > 0 else 1.0) for s, rung in rungs.items() for f in own.off_goals(s, rung))

        assert count == 1
        left = FILL * _page(sheet) - area
        assert _area(own, figures, rungs, sheet) <= left
        begun = _begun(own, sheet, 1.5)
        for steps in itertools.product((-1, 0, 1), repeat=3):
            other = {s: rung + step for (s, rung), step in zip(rungs.items(), steps, strict=True)}
            if steps.count(-1) < 2 and steps.count(1) < 2 and all(begun[s] <= other[s] < 6 for s in other):
                assert off(other) >= off(rungs) - 1e-9 or _area(own, figures, other, sheet) > left
        taken.add(tuple(rungs.values()))
    assert len(taken) > 2


def test_what_the_task_has_chosen_becomes_smaller_after_the_others():
    figures = [Extent(symbol, (300.0, 200.0), (40.0, 40.0), goal=300.0) for symbol in ("mu_l", "mu_V")]
    ladder = Ladder((1.0, 1.25, 2.0, 2.5, 4.0))

    for area in range(200_000, 340_000, 20_000):
        own = Extents(figures, area, {"mu_l": replace(ladder, chosen=True), "mu_V": ladder})
        sheet, rungs, _ = next(ways(own, {"A1": ((0.2, 1.5), (0.2, 1.5))}, [FORMATS["A1"]]))

        finer = {"mu_l": rungs["mu_l"] - 1, "mu_V": 4}  # without room, however small the other one is
        assert not rungs["mu_l"] or _area(own, figures, finer, sheet) > FILL * _page(sheet) - area


def test_what_one_plan_gives_up_below_its_least_others_have():
    figures = [Extent("mu_l", (150.0, 150.0), (50.0, 70.0), goal=270.0)] * 3
    figures += [Extent("mu_V", (200.0, 100.0), (40.0, 50.0), goal=200.0)] * 2
    own = Extents(figures, 200_000.0, {"mu_l": Ladder((1.0, 1.6, 2.0)), "mu_V": Ladder((1.0, 1.25, 2.0, 2.5, 4.0))})
    parts = {"A1": ((0.45, 1.5), (0.4, 1.5))}

    tried = [rungs for _, rungs, count in ways(own, parts, [FORMATS["A1"]]) if count == 1]

    before, smaller = next((a, b) for a, b in itertools.pairwise(tried) if b["mu_l"] > a["mu_l"])
    assert smaller["mu_V"] < before["mu_V"]
    assert all(tried.count(rungs) == 1 for rungs in tried)


@pytest.mark.parametrize("chosen", [False, True])
def test_plans_of_two_pages_are_finer_where_the_second_would_be_half_empty(chosen):
    sheet, goals = FORMATS["A1"], [200.0, 200.0, 180.0, 160.0]
    ladder = Ladder((0.8, 1.0, 1.25, 2.0, 2.5), begin=1, chosen=chosen)
    figures = [Extent(f"mu_{k}", (goal, goal), (60.0, 90.0), goal=goal) for k, goal in enumerate(goals)] * 2
    ladders = {figure.symbol: ladder for figure in figures}
    finer = 0
    for area in range(50_000, 250_000, 10_000):
        own = Extents(figures, area, ladders, 3.0)
        _, rungs, count = next(ways(own, {"A1": ((0.6, 1.6), (0.6, 1.6))}, [sheet]))

        taken = (_area(own, figures, rungs, sheet) + area) / _page(sheet)
        usual = (_area(own, figures, dict.fromkeys(ladders, 1), sheet) + area) / _page(sheet)
        if count == 2:
            assert chosen or not EMPTY[0] < taken < EMPTY[1]
            finer += taken > usual
    assert (finer > 1) is not chosen


@pytest.mark.parametrize(("alone", "pages"), [(1.0, 1), (1.8, 2)])
def test_crowded_plans_are_larger_on_two_pages(alone, pages):
    figures = [Extent("mu_V", (150.0, 150.0), (60.0, 90.0), goal=180.0)] * 10
    own = Extents(figures, 150_000.0, {"mu_V": Ladder((0.5, 1.0, 1.5, 2.5, 4.0))}, alone)

    _, rungs, count = next(ways(own, {"A1": ((0.23, 1.5), (0.2, 1.5))}, [FORMATS["A1"]]))

    assert count == pages
    assert own.part("mu_V", rungs["mu_V"]) >= 0.23 * alone


@pytest.mark.parametrize("count", [1, 2, 3])
def test_views_stand_on_as_many_pages_as_are_wanted_or_on_more(count):
    views = COURSEWORK["wide group"]
    least = last(arrange(views, FORMATS["A1"], "gost")) + 1

    places = arrange(views, FORMATS["A1"], "gost", count=count)

    assert least == 1
    assert judge(views, places, "A1")
    assert [place.page for place in places] == sorted(place.page for place in places)
    assert last(places) + 1 == count
    assert last(arrange(3 * views, FORMATS["A1"], "gost", count=1)) + 1 > 1


def test_what_fits_nowhere_has_no_place():
    assert arrange([(50, 50), (900, 50)], FORMATS["A1"], "gost") is None
    assert on_a_page([(400, 300)] * 4, FORMATS["A1"], "gost") is None
    assert arrange([], FORMATS["A1"], "gost") == []


def test_edges_of_a_page_share_in_what_is_left_between_few_columns():
    columns = [(250, 500), (200, 500), (185, 480)]  # the title block stands below the last one

    apart = [place.x for place in on_a_page(columns, FORMATS["A1"], "gost")]

    (left, _, right, _), wide = drawing_area(FORMATS["A1"]), [w for w, _ in columns]
    gaps = [b - a - w for a, b, w in zip(apart, apart[1:], wide, strict=False)]
    edges = apart[0] - left - MARGINS["A1"], right - MARGINS["A1"] - apart[-1] - wide[-1]
    assert gaps == pytest.approx([2.0 * edges[0]] * 2)
    assert edges[0] == pytest.approx(edges[1])
    assert gaps[0] > 50.0


def test_letters_are_larger_where_figures_leave_a_page_too_empty():
    style, paper = STYLES["A1"], FORMATS["A1"]
    cells = [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(12))]
    told = text_block("sums", "Sums", [["ω = " + " + ".join(f"a_{{{k}}}" for k in range(20))]] * 9, style, 235.0)
    texts = table("values", "Values", cells, style), told

    def letters(*figures: tuple[float, float]) -> dict[str, float]:
        plans = [View(f"plan {k}", (Line(0j, complex(*size)),), (0.0, 0.0, *size)) for k, size in enumerate(figures)]
        views = (*plans, *texts)
        places = on_one_page([view.size for view in views], paper, "gost", [*len(plans) * [FIGURE], TOLD, TOLD])
        drawn = compose(views, places, {}, paper, "gost", "{heading} (continued)")
        judge(
            [view.size for view in drawn.views], [Placement(0, *extent_of(drawn, view)) for view in drawn.views], "A1"
        )
        return {view.name: view.style.text for view in drawn.views if view.style}

    def extent_of(drawn, view):
        [group] = [group for group in drawn.placed[0] if group.name == view.name]
        x0, y0, _, _ = extent(group.shapes)
        own = extent(view.shapes)
        return x0 - own[0] + view.box[0], y0 - own[1] + view.box[1]

    assert letters((300, 200)) == {"values": 5.0, "sums": 5.0}
    assert letters((560, 330), (200, 330), (400, 120)) == {"values": 3.5, "sums": 3.5}


def test_the_rest_of_a_table_has_no_page_of_its_own_where_one_has_room_for_it():
    style, paper = STYLES["A4"], FORMATS["A4"]
    long = table("values", "Values", [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(34))], style)
    figures = [View(name, (), (0.0, 0.0, 170.0, high)) for name, high in (("plan", 80.0), ("lever", 150.0))]
    alone = Placement(0, 25.0, 150.0), Placement(1, 25.0, 30.0), Placement(2, 25.0, 30.0)

    drawn = compose((*figures, long), alone, {}, paper, "gost", "{heading} (continued)")

    assert [[group.name for group in page] for page in drawn.placed] == [
        ["plan", "values"],
        ["lever", "values_continued"],
    ]
    first, rest = (part for part in drawn.views if part.of)
    assert (*first.rows, *rest.rows[1:]) == long.rows


def test_a_table_goes_on_after_it_has_begun_where_a_page_before_has_room_for_its_rest():
    style, paper = STYLES["A4"], FORMATS["A4"]
    long = table("values", "Values", [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(30))], style)
    begun, rest = (part_of(long, *rows, said) for rows, said in (((0, 20), "Values"), ((20, 30), "Values (continued)")))
    figures = [View(name, (), (0.0, 0.0, 170.0, high)) for name, high in (("plan", 125.0), ("lever", 130.0))]
    places = [Placement(page, 25.0, y) for page, y in ((0, 130.0), (1, 150.0), (1, 20.0), (2, 20.0))]

    drawn = compose((*figures, begun, rest), places, {}, paper, "gost", "{heading} (continued)")

    pages = [[group.name for group in page] for page in drawn.placed]
    assert pages == [["plan", "values"], ["lever", "values_continued"]]
    parts = [part for part in drawn.views if part.of]
    assert [part.heading for part in parts] == [("Values",), ("Values (continued)",)]
    assert (*parts[0].rows, *parts[1].rows[1:]) == long.rows


def test_rows_and_columns_of_tables_take_what_figures_leave_of_a_page():
    style, paper = STYLES["A4"], FORMATS["A4"]
    small = table("values", "Values", [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(12))], style)
    sizes = ("plan", (110.0, 80.0)), ("lever", (170.0, 240.0))
    figures = [View(name, (Line(0j, complex(*size)),), (0.0, 0.0, *size)) for name, size in sizes]
    places = Placement(0, 25.0, 150.0), Placement(0, 25.0, 70.0), Placement(1, 25.0, 30.0)

    drawn = compose((figures[0], small, figures[1]), places, {}, paper, "gost", "{heading} (continued)")

    (found,) = (view for view in drawn.views if view.rows)
    assert found.rows == small.rows
    assert found.size[0] > 1.5 * small.size[0]
    room = x0, y0, x1, y1 = drawing_area(paper)
    boxes = [*(extent(group.shapes) for group in drawn.placed[0]), *reserved_boxes(paper)]
    assert all(x0 < box[0] and box[2] < x1 for box in boxes[:2])
    assert bare(room, boxes) < 0.12 * (x1 - x0) * (y1 - y0)


def test_a_table_has_no_page_of_its_own_where_a_full_one_has_room_for_it():
    style, paper = STYLES["A4"], FORMATS["A4"]
    small = table("values", "Values", [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(4))], style)
    figures = [View(name, (), (0.0, 0.0, 170.0, high)) for name, high in (("plan", 130.0), ("lever", 230.0))]
    alone = Placement(0, 25.0, 100.0), Placement(1, 25.0, 30.0), Placement(2, 25.0, 30.0)

    drawn = compose((*figures, small), alone, {}, paper, "gost", "{heading} (continued)")

    assert [[group.name for group in page] for page in drawn.placed] == [["plan", "values"], ["lever"]]


def test_tables_and_texts_break_for_a_page_that_were_too_empty() -> None:
    style, paper = STYLES["A4"], FORMATS["A4"]
    cells = [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(36))]
    long = (
        table("values", "Values", cells, style),
        text_block("sums", "Sums", [[f"a + {k}"] for k in range(36)], style, 60),
    )
    for view in long:
        figure = View("plan", (), (0.0, 0.0, 170.0, 80.0))
        alone = Placement(0, 25.0, 150.0), Placement(1, 25.0, 30.0)

        drawn = compose((figure, view), alone, {}, paper, "gost", "{heading} (continued)")

        assert [[group.name for group in page] for page in drawn.placed] == [
            ["plan", view.name],
            [f"{view.name}_continued"],
        ]
        first, rest = (part for part in drawn.views if part.of == view.name)
        assert (first.heading, rest.heading) == (view.heading, (f"{view.heading[0]} (continued)",))
        assert first.rows[:1] == rest.rows[:1] == view.rows[:1]
        assert (*first.rows, *rest.rows[1:], *first.lines, *rest.lines) == (*view.rows, *view.lines)
        full = compose((replace(figure, box=(0.0, 0.0, 170.0, 120.0)), view), alone, {}, paper, "gost", "{heading}")
        assert [part for part in full.views if part.of] == []


@pytest.mark.parametrize("seed", some(range(60), 0, 7))
def test_no_part_of_a_table_has_fewer_than_three_rows(seed: int) -> None:
    rng, style, paper = random.Random(seed), STYLES["A4"], FORMATS["A4"]
    parted = 0
    for _ in range(4):
        highs = [rng.uniform(60.0, 150.0) for _ in range(rng.randint(2, 4))]
        figures = [View(f"plan {k}", (), (0.0, 0.0, rng.uniform(120.0, 170.0), high)) for k, high in enumerate(highs)]
        cells = [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(rng.randint(8, 30)))]
        places = [Placement(k, 25.0, 120.0) for k in range(len(figures))]
        last_page = Placement(len(figures) - 1, 25.0, 30.0)

        drawn = compose(
            (*figures, table("values", "Values", cells, style)), [*places, last_page], {}, paper, "gost", "{heading} …"
        )

        parts = [part for part in drawn.views if part.of]
        parted += bool(parts)
        assert all(part.pieces >= 3 for part in parts)
    assert seed or parted


def test_a_table_over_many_pages_is_continued_once_on_each():
    style, paper = STYLES["A4"], FORMATS["A4"]
    long = table("values", "Values", [["quantity", "value"], *([f"V_{{{k}}}", f"{k}"] for k in range(60))], style)
    begun, rest = part_of(long, 0, 30, "Values"), part_of(long, 30, 60, "Values (continued)")
    figures = [View(f"plan {k}", (), (0.0, 0.0, 130.0, 80.0 + 70.0 * (k > 0))) for k in range(3)]
    alone = [*(Placement(k, 70.0, 120.0) for k in range(3)), Placement(1, 25.0, 30.0), Placement(2, 25.0, 30.0)]

    drawn = compose((*figures, begun, rest), alone, {}, paper, "gost", "{heading} (continued)")

    headings = [part.heading for part in drawn.views if part.of]
    assert headings == [("Values",), ("Values (continued)",), ("Values (continued)",)]
    assert max(sum(group.name.startswith("values") for group in page) for page in drawn.placed) == 1


def test_a_text_whose_longer_heading_is_wider_covers_nothing():
    style, paper = STYLES["A4"], FORMATS["A4"]
    text = text_block("sums", "Velocities of the transport", [[f"a + {k}"] for k in range(40)], style, 60)
    wide = 172.0 - text.size[0]
    figure, high = (
        View(name, (Line(0j, complex(*size)),), (0.0, 0.0, *size))
        for name, size in (("plan", (170.0, 80.0)), ("high", (wide, 240.0)))
    )
    places = Placement(0, 25.0, 150.0), Placement(1, 25.0, 30.0), Placement(1, 29.0 + text.size[0], 30.0)

    drawn = compose((figure, text, high), places, {}, paper, "gost", "{heading} (continued)")

    for page in drawn.placed:
        boxes = [shapely.box(*extent(group.shapes)) for group in page]
        assert all(a.intersection(b).area == 0.0 for a, b in itertools.combinations(boxes, 2))
        assert all(corners[2] <= paper.width - 5.0 for corners in (one.bounds for one in boxes))


@pytest.mark.parametrize("longest", [0.05, 0.3, 0.301, 0.9, 1.5, 1.6, 40.0])
def test_a_plan_begins_on_the_first_rung_that_is_short_enough_or_else_on_its_last(longest: float) -> None:
    mus, most = (1e-3, 2e-3, 5e-3), 300.0  # m/mm, mm
    figures = [Extent("mu_l", (longest, 0.0), (0.0, 0.0), goal=0.5 * most)]

    rungs = _begun(Extents(figures, 0.0, {"mu_l": Ladder(mus), "mu_V": Ladder((1e-3,))}), FORMATS["A1"], 2.0)

    short = [rung for rung, mu in enumerate(mus) if longest / mu <= 1.0001 * most]
    assert rungs == {"mu_l": next(iter(short), len(mus) - 1), "mu_V": 0}
