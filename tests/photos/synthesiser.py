"""Photographs of sheets drawn by hand, made with what is true of them: pencil, wobble, letters, lens, light, noise.

A student draws plans on the handout: points a little beside where they should be, strokes that wobble, arrowheads,
letters, construction lines that go on, a line that was rubbed out. A camera then sees the sheet: curled, tilted,
through a lens, in uneven light, blurred, noisy, compressed. What was drawn, in mm of the sheet, is the truth.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import cv2
import numpy as np

from kulman.drawing.page import Page
from kulman.drawing.shapes import Group, Line, Shape, Vector
from kulman.plans.board import POSITION
from kulman.plans.marking.ways import Shape as Way
from kulman.plans.marking.ways import shapes_of
from kulman.plans.names import LEVER, role
from kulman.variants.case import Case
from kulman.variants.marking.checks import check
from kulman.variants.marking.keyed import Keyed
from kulman.variants.marking.marked import Desk
from kulman.variants.photos.reading import rendered
from kulman.variants.reader import load_task
from kulman.variants.sheets import drawing_for_print, scannable_of_case

PX = 12.0  # pixels per mm of the sheet that is drawn on
SCANNER, PHONE, MESSENGER = QUALITIES = ("scanner", "phone", "messenger")
FAINT = 0.16  # of how dark other plans are
POINT = 0.15  # mm, standard error of a point on paper
Random = np.random.Generator


@dataclass(frozen=True)
class Truth:
    """A vector as it was drawn: on which page, where, on which plan."""

    plan: str
    page: int
    tail: complex
    tip: complex


@dataclass(eq=False)
class Sheet:
    """A handout to be photographed, and where its plans lie."""

    case: Case
    keyed: Keyed
    pages: tuple[Page, ...]
    whole: tuple[tuple[Group, ...], ...]
    mus: Mapping[str, float]
    poles: dict[str, tuple[int, complex]] = field(default_factory=dict)
    printed: dict[int, np.ndarray] = field(default_factory=dict)
    kept: dict[tuple[str, bool], tuple[Way, ...]] = field(default_factory=dict)

    def ways(self, plan: str, broken: bool) -> tuple[Way, ...]:
        if (plan, broken) not in self.kept:
            self.kept[plan, broken] = shapes_of(self.keyed.key, self.keyed.book if broken else None, plan)
        return self.kept[plan, broken]

    @property
    def plans(self) -> list[str]:
        return [*self.poles]


@cache
def sheet_for(task: str, variant: str | None = None, only: str | None = None) -> Sheet:
    """Make the handout of a variant; where its plans lie is read off the whole sheet."""
    variant = variant or next(iter(load_task(task).variants))
    ready = check(task, variant, lang="uk", only=only)
    case = replace(ready.request, variant=variant, format="A4", language="uk").case()
    drawing = drawing_for_print(case)
    pages = scannable_of_case(case, drawing).pages
    keyed = Desk(ready).keyed(variant, {})
    found = Sheet(case, keyed, pages, drawing.placed, {p: s.mu for p, s in drawing.scales.items()})
    for plan in keyed.key.paper.program.plans:
        if plan == POSITION or role(plan).kind == LEVER or plan not in found.mus:
            continue
        ways = found.ways(plan, False)
        if not ways or not ways[0].longest:
            continue
        way, mu = ways[0], found.mus[plan]
        for number, views in enumerate(found.whole):
            for vector in vectors_of(view for view in views if view.name == plan):
                if vector.quantity in way.names and abs(vector.mu / mu - 1) < 1e-6 and plan not in found.poles:
                    at = way.names.index(vector.quantity)
                    span = (way.places[way.tips[at]] - way.places[way.tails[at]]) / mu
                    if abs(span) > 3 and abs(vector.tip - vector.tail - span) < 0.05:
                        found.poles[plan] = number, vector.tail - way.places[way.tails[at]] / mu
    return found


def vectors_of(shapes: Any) -> Iterator[Vector]:
    for shape in shapes:
        if isinstance(shape, Vector):
            yield shape
        elif isinstance(shape, Group):
            yield from vectors_of(shape.shapes)


def printed(sheet: Sheet, number: int) -> np.ndarray:
    """The page as it is printed, PX pixels per mm, grey from 0 to 255."""
    if number not in sheet.printed:
        sheet.printed[number] = rendered(sheet.pages[number], PX, grayscale=True)[..., 0]
    return sheet.printed[number]


class Paper:
    """A sheet of paper that is drawn on with a pencil."""

    def __init__(self, ground: np.ndarray, random: Random) -> None:
        self.height = ground.shape[0] / PX
        self.ink = (255 - ground).astype(np.float32) / 255 * 0.88
        self.random = random
        self.grain = cv2.GaussianBlur(random.random(ground.shape, np.float32), (0, 0), 1.0)
        self.grain = np.clip((self.grain - self.grain.mean()) / self.grain.std() * 0.22 + 0.85, 0.2, 1.2)

    def stroke(self, a: complex, b: complex, dark: float, wide: float, wobble: float = 0.07) -> None:
        """Draw a line that wobbles."""
        size = abs(b - a)
        if size < 0.2:
            return
        way = (b - a) / size
        along = np.linspace(0.0, 1.0, max(2, int(size * 2)))
        off = sum(
            self.random.normal(0, wobble / (k + 1)) * np.sin(math.pi * (k + 1) * along) for k in range(4)
        ) + self.random.normal(0, 0.015, len(along)) * (along > 0) * (along < 1)
        points = a + way * (along * size + 1j * off)
        self.lines(points, dark, wide)

    def lines(self, points: np.ndarray, dark: float, wide: float) -> None:
        at = np.stack([points.real, self.height - points.imag], -1) * PX - 0.5
        low = np.maximum(at.min(axis=0).astype(int) - 20, 0)
        high = at.max(axis=0).astype(int) + 20
        window = self.ink[low[1] : high[1], low[0] : high[0]]
        if not window.size:
            return
        layer = np.zeros(window.shape, np.uint8)
        whole = np.round((at - low) * 16).astype(np.int32).reshape(-1, 1, 2)
        cv2.polylines(layer, [whole], False, 255, max(1, round(wide * PX)), cv2.LINE_AA, 4)
        mark = layer.astype(np.float32) / 255 * dark * self.grain[low[1] : high[1], low[0] : high[0]]
        np.maximum(window, mark, out=window)

    def letters(self, at: complex, text: str, dark: float, high: float) -> None:
        place = int(at.real * PX), int((self.height - at.imag) * PX)
        fonts = cv2.FONT_HERSHEY_SCRIPT_SIMPLEX, cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_ITALIC
        font, scale = int(self.random.choice(fonts)), high * PX / 22
        (wide, up), below = cv2.getTextSize(text, font, scale, 4)
        left, top = max(place[0] - 20, 0), max(place[1] - up - 20, 0)
        own = np.s_[top : max(place[1] + below + 20, 0), left : max(place[0] + wide + 20, 0)]
        layer = np.zeros_like(window := self.ink[own], np.uint8)
        if window.size:
            inside = place[0] - left, place[1] - top
            cv2.putText(layer, text, inside, font, scale, 255, 4, cv2.LINE_AA)
            np.maximum(window, layer.astype(np.float32) / 255 * dark * self.grain[own], out=window)


def drawn(
    sheet: Sheet, number: int, random: Random, chosen: Mapping[str, Way], faint: Collection[str] = ()
) -> tuple[np.ndarray, dict[str, Truth]]:
    """Draw the chosen plans of a page by hand, some faintly; return ink from 0 to 1, and the vectors by name."""
    paper, truth = Paper(printed(sheet, number), random), dict[str, Truth]()
    dark = random.uniform(0.45, 0.8)
    wide = random.uniform(0.3, 0.5)
    for plan, (page, pole) in sheet.poles.items():
        if page == number and plan in chosen:
            way, mu = chosen[plan], sheet.mus[plan]
            places = pole + way.places / mu
            places = places + random.normal(0, POINT, len(places)) + 1j * random.normal(0, POINT, len(places))
            spot = int(np.abs(way.places).argmin())
            if abs(way.places[spot]) < 1e-12:
                places[spot] = pole + complex(*random.normal(0, 0.06, 2))
            ends = own_lines(paper, way, places, dark * (FAINT if plan in faint else 1.0), wide)
            for name, tail, tip in zip(way.names, way.tails.tolist(), way.tips.tolist(), strict=True):
                if sheet.keyed.key.questions.get(name) is None or sheet.keyed.key.questions[name].plan == plan:
                    truth[name] = Truth(plan, number, ends[tail, tip], ends[tip, tail])
    for group in sheet.whole[number]:  # the mechanism to scale, as far as it is lines
        if group.name == POSITION:
            for line in links_of(group.shapes):
                paper.stroke(line.a, line.b, dark * 0.9, wide)
    return paper.ink, truth


def links_of(shapes: tuple[Shape, ...]) -> Iterator[Line]:
    for shape in shapes:
        if isinstance(shape, Group) and shape.role == "link":
            yield from (part for part in shape.shapes if isinstance(part, Line) and abs(part.a - part.b) > 8)


def own_lines(paper: Paper, way: Way, places: np.ndarray, dark: float, wide: float) -> dict[tuple[int, int], complex]:
    """Draw the lines of a plan; return where each begins on the paper, by its points from either side."""
    random, begins = paper.random, dict[tuple[int, int], complex]()
    letters = iter("abcdenstwk" * 9)
    for at in way.lines.tolist():
        ends = int(way.tails[at]), int(way.tips[at])
        a, b = (complex(places[end]) for end in ends)
        begins |= {ends: a, ends[::-1]: b}
        size = abs(b - a)
        if size < 0.5:
            continue
        unit = (b - a) / size
        if random.random() < 0.5 and size > 8:  # a construction line that goes on beyond
            more = random.uniform(5, 25), random.uniform(5, 25)
            paper.stroke(a - unit * more[0] * (random.random() < 0.4), b + unit * more[1], dark * 0.45, 0.2)
        miss = [complex(*random.normal(0, 0.07, 2)) for _ in range(2)]
        begins |= {ends: a + miss[0], ends[::-1]: b + miss[1]}
        paper.stroke(a + miss[0], b + miss[1], dark * random.uniform(0.85, 1.1), wide)
        if size > 5:
            for turn in (0.26, -0.26):
                paper.stroke(b, b - unit * np.exp(1j * turn) * min(3.5, size / 3), dark, wide * 0.9, 0.02)
        if size > 10 and random.random() < 0.4:
            paper.letters((a + b) / 2 + 1j * unit * random.uniform(2, 4), str(random.integers(10, 99)), dark * 0.9, 3.0)
    for place in places:
        paper.letters(complex(place) + np.exp(2j * math.pi * random.random()) * 4, next(letters), dark * 0.9, 3.5)
    if random.random() < 0.5:  # rubbed out
        middle = places.mean()
        a, b = (middle + 40 * complex(*random.uniform(-1, 1, 2)) for _ in range(2))
        paper.stroke(a, b, random.uniform(0.05, 0.11), 0.6)
    return begins


def photographed(ink: np.ndarray, random: Random, quality: str) -> bytes:
    """See a sheet as a scanner or a camera does; return JPEG."""
    height, width = ink.shape[0] / PX, ink.shape[1] / PX
    if quality == SCANNER:
        per = 300 / 25.4
        out = np.array([round(width * per), round(height * per)])
        turn, tilt, curl, lens, far = math.radians(random.uniform(-1.5, 1.5)), (0.0, 0.0), 0.0, 0.0, 1e6
        fill = 0.985
    else:
        out = np.array([2448, 3264]) if height > width else np.array([3264, 2448])
        turn = math.radians(random.uniform(-8, 8))
        tilt = tuple(math.radians(random.uniform(-13, 13)) for _ in range(2))
        curl, lens, far = random.uniform(0, 3), random.uniform(-0.08, 0.04), random.uniform(380, 520) * height / 297
        fill = random.uniform(0.8, 0.9)

    def seen(z: np.ndarray) -> np.ndarray:
        """Where points of the sheet, mm from its middle, y up, are seen; from the middle of the picture, y down."""
        u = (z.real * math.cos(axis) + z.imag * math.sin(axis)) / (0.5 * height)
        up = curl * (1 - u**2) + 0.3 * curl * u**3
        x, y = z.real, z.imag
        y, up = y * math.cos(tilt[0]) - up * math.sin(tilt[0]), y * math.sin(tilt[0]) + up * math.cos(tilt[0])
        x, up = x * math.cos(tilt[1]) - up * math.sin(tilt[1]), x * math.sin(tilt[1]) + up * math.cos(tilt[1])
        w = (x + 1j * y) * np.exp(1j * turn) / (1 - up / far)
        r = np.abs(w) / (0.5 * math.hypot(width, height))
        return np.conj(w * (1 + lens * r**2))

    axis = random.uniform(0, math.pi)
    corners = np.array([complex(x, y) for x in (-width / 2, width / 2) for y in (-height / 2, height / 2)])
    reach = seen(corners)
    wide, high = np.ptp(reach.real), np.ptp(reach.imag)
    zoom = fill * min(out[0] / wide, out[1] / high)
    if quality == SCANNER:
        zoom = 300 / 25.4
    shift = complex(out[0], out[1]) / 2 - zoom * (
        complex(reach.real.min() + reach.real.max(), reach.imag.min() + reach.imag.max()) / 2
    )
    coarse = 12
    gx, gy = np.meshgrid(np.arange(0, out[0] + coarse, coarse), np.arange(0, out[1] + coarse, coarse))
    target = gx + 1j * gy
    z = np.conj((target - complex(*out) / 2) / zoom) * np.exp(-1j * turn)
    for _ in range(25):
        z = z - np.conj((seen(z) * zoom + shift - target) / zoom) * np.exp(-1j * turn)
    mapx = ((z.real + width / 2) * PX - 0.5).astype(np.float32)
    mapy = ((height / 2 - z.imag) * PX - 0.5).astype(np.float32)
    # grid nodes stand at multiples of `coarse`: sample with a map that keeps them there
    fx, fy = np.meshgrid(np.arange(out[0], dtype=np.float32) / coarse, np.arange(out[1], dtype=np.float32) / coarse)
    mapx, mapy = (cv2.remap(m, fx, fy, cv2.INTER_LINEAR) for m in (mapx, mapy))
    light = (1 - ink) * 235
    if quality != SCANNER:
        light = cv2.GaussianBlur(light, (0, 0), 0.5 * PX / zoom)
    picture = cv2.remap(light, mapx, mapy, cv2.INTER_LINEAR, borderValue=95)
    x, y = np.meshgrid(np.linspace(-1, 1, out[0], dtype=np.float32), np.linspace(-1, 1, out[1], dtype=np.float32))
    if quality != SCANNER:
        way = random.uniform(0, math.tau)
        picture *= 0.84 + random.uniform(0.05, 0.16) * (x * math.cos(way) + y * math.sin(way))
        if random.random() < 0.5:
            edge = x * math.cos(way + 1) + y * math.sin(way + 1) - random.uniform(-0.3, 0.6)
            picture *= 1 - random.uniform(0.1, 0.25) / (1 + np.exp(-edge * 18))
    picture = cv2.GaussianBlur(picture, (0, 0), 0.6 if quality == SCANNER else random.uniform(0.7, 1.6))
    if quality != SCANNER and random.random() < 0.5:
        picture = moved(picture, random.uniform(1, 3.5), random.uniform(0, math.pi))
    if quality == MESSENGER:
        picture = cv2.resize(picture, None, fx=1280 / max(out), fy=1280 / max(out), interpolation=cv2.INTER_AREA)
    noise = {SCANNER: 2.0, PHONE: 4.0, MESSENGER: 2.0}[quality]
    picture += random.standard_normal(picture.shape, np.float32) * noise
    jpeg = {SCANNER: (88, 95), PHONE: (80, 93), MESSENGER: (70, 82)}[quality]
    done = np.clip(picture, 0, 255).astype(np.uint8)
    return bytes(cv2.imencode(".jpg", done, [cv2.IMWRITE_JPEG_QUALITY, int(random.integers(*jpeg))])[1].tobytes())


def moved(picture: np.ndarray, pixels: float, way: float) -> np.ndarray:
    """Blur by a camera that moves."""
    kernel = np.zeros((9, 9), np.float32)
    for part in np.linspace(-0.5, 0.5, 33):
        at = 4 + part * pixels * math.cos(way), 4 + part * pixels * math.sin(way)
        kernel[round(at[1]), round(at[0])] += 1
    return cv2.filter2D(picture, -1, kernel / kernel.sum())
