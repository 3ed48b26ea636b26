"""Drawings read back: the same lines whatever the format, and files that are broken, huge or hostile refused."""

from __future__ import annotations

import gzip
import io
import zlib
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from kulman import sheet
from kulman.plans.marking.lines import Drawn
from kulman.scales.errors import InputError
from kulman.tests.support.cases import some
from kulman.variants.drawings import marks
from kulman.variants.drawings.files import read_drawing

SAME = 1e-3  # mm
FORM = b"%d 0 obj << /Type /XObject /Subtype /Form /BBox [0 0 200 200] %s /Length %d >> stream\n%s\nendstream endobj\n"
LINES = '<line x1="10" y1="20" x2="60" y2="20" stroke="#000"/>'


@pytest.fixture(scope="module", params=some(["nau-slider-crank", "madi-four-bar"], 0))
def drawings(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Drawn]:
    """Our own sheet of a task, read back from each format."""
    folder = tmp_path_factory.mktemp("sheet")
    files = sheet(request.param, lang="en").save(*(folder / f"sheet{kind}" for kind in (".dxf", ".svg", ".pdf")))
    return {file.suffix: read_drawing(file) for file in files}


def far(drawn: Drawn, other: Drawn) -> np.ndarray:
    """How far each line is from the nearest one of another drawing, the ends in either order, mm."""
    ends = np.stack([other.tails, other.tips], axis=1)
    both = np.concatenate([ends, ends[:, ::-1]])
    own = np.stack([drawn.tails, drawn.tips], axis=1)
    return np.abs(own[:, None] - both[None]).max(axis=2).min(axis=1)


def of(folder: Path, name: str, data: str | bytes) -> Path:
    file = folder / name
    file.write_bytes(data if isinstance(data, bytes) else data.encode())
    return file


def svg(inside: str, looks: str = 'width="100mm" height="80mm" viewBox="0 0 100 80"') -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {looks}>{inside}</svg>'


def dxf(entities: str, blocks: str = "", header: str = "") -> str:
    parts = {"HEADER": header, "BLOCKS": blocks, "ENTITIES": entities}
    return "".join(f"0\nSECTION\n2\n{name}\n{text}0\nENDSEC\n" for name, text in parts.items()) + "0\nEOF\n"


def pdf(content: bytes, objects: bytes = b"", resources: bytes = b"", filters: bytes = b"") -> bytes:
    """A PDF of one page; objects from 5 on are as they are given. Readers mend the table that it lacks."""
    stream = b"<< /Length %d %s >> stream\n%s\nendstream" % (len(content), filters, content)
    page = b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 200 200] /Contents 4 0 R /Resources << %s >> >>" % resources
    parts = [b"<< /Type /Catalog /Pages 2 0 R >>", b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>", page, stream]
    body = b"".join(b"%d 0 obj %s endobj\n" % (number, part) for number, part in enumerate(parts, start=1))
    return b"%PDF-1.7\n" + body + objects + b"trailer << /Root 1 0 R >>\n%%EOF\n"


def line_of(drawn: Drawn) -> list[complex]:
    return [complex(round(z.real, 3), round(z.imag, 3)) for z in (drawn.tails[0], drawn.tips[0])]


def test_every_format_of_a_sheet_has_the_same_lines(drawings: dict[str, Drawn]) -> None:
    svg_, pdf_, dxf_ = drawings[".svg"], drawings[".pdf"], drawings[".dxf"]

    misses = {"svg in dxf": far(svg_, dxf_), "pdf in dxf": far(pdf_, dxf_), "pdf in svg": far(pdf_, svg_)}

    assert len(svg_.tails) > 200
    assert {name: float(off.max()) for name, off in misses.items() if off.max() > SAME} == {}
    assert (far(dxf_, svg_) > SAME).sum() <= 0.05 * len(dxf_.tails)  # letters that CAD lacks are lines there


def test_scale_factors_and_letters_of_plans_are_read_in_every_format(drawings: dict[str, Drawn]) -> None:
    texts = {kind: {one.text.replace(" ", "") for one in drawn.letters} for kind, drawn in drawings.items()}

    assert all(any(text.startswith("μV=") for text in found) for found in texts.values()), texts
    assert all({"p", "a", "b"} <= found for found in texts.values())


def test_lines_are_those_that_ezdxf_finds(tmp_path: Path) -> None:
    document = ezdxf.new("R2010", units=5)  # cm
    block = document.blocks.new("ARM", base_point=(1, 0))
    block.add_line((1, 0), (3, 1))
    block.add_lwpolyline([(0, 0), (1, 2), (4, 2)], close=True)
    outer = document.blocks.new("BOTH")
    outer.add_blockref("ARM", (2, 1), {"xscale": 2, "yscale": -1, "rotation": 30})
    space = document.modelspace()
    space.add_blockref("BOTH", (5, 5), {"rotation": 90, "xscale": 0.5, "yscale": 0.5})
    space.add_blockref("ARM", (9, 2), {"column_count": 2, "row_count": 3, "column_spacing": 4, "row_spacing": 5})
    space.add_polyline2d([(0, 0), (1, 0), (1, 1)])
    space.add_line((7, 7), (8, 8), {"layer": "OFF"})
    document.layers.add("OFF").off()
    file = tmp_path / "blocks.dxf"
    document.saveas(file)
    expected = [
        (complex(*line.dxf.start.vec2), complex(*line.dxf.end.vec2))
        for insert in space.query("INSERT")
        for each in (insert.multi_insert() if insert.mcount > 1 else [insert])
        for line in _exploded(each)
    ] + [(0j, 1 + 0j), (1 + 0j, 1 + 1j)]

    found = read_drawing(file)

    tails, tips = (np.array(side) * 10.0 for side in zip(*expected, strict=True))
    assert len(found.tails) == len(expected)
    assert far(found, Drawn(tails, tips)).max() < 1e-6


def test_multilines_are_read_through_their_vertices(tmp_path: Path) -> None:
    document, file = ezdxf.new("R2010", units=4), tmp_path / "m.dxf"
    document.modelspace().add_mline([(0, 0), (50, 0), (50, 30)], close=True)
    document.saveas(file)

    found = read_drawing(file)

    corners = np.array([0j, 50 + 0j, 50 + 30j])
    assert len(found.tails) == 3
    assert far(found, Drawn(corners, np.roll(corners, -1))).max() < 1e-6


def _exploded(insert):
    for part in insert.virtual_entities():
        kind = part.dxftype()
        if kind == "LINE":
            yield part
        elif kind == "INSERT":
            yield from _exploded(part)
        else:
            yield from (one for one in part.virtual_entities() if one.dxftype() == "LINE")


@pytest.mark.parametrize(
    ("inside", "ends"),
    [
        pytest.param(LINES, [10 + 60j, 60 + 60j], id="line"),
        pytest.param('<g transform="translate(5 5) scale(2)"><path d="m0 0h10" stroke="red"/></g>',
                     [5 + 75j, 25 + 75j], id="path in a group"),
        pytest.param('<g transform="rotate(90 10 10)"><polyline points="10,10 20,10" style="stroke:#111"/></g>',
                     [10 + 70j, 10 + 60j], id="turned"),
        pytest.param(f'<defs><g id="a">{LINES}</g></defs><use href="#a" x="1" y="2"/>', [11 + 58j, 61 + 58j], id="use"),
        pytest.param('<style>.k{stroke:#000;fill:none}</style><path class="k" d="M1,1C2 2 3 3 4 4L4 14"/>',
                     [4 + 76j, 4 + 66j], id="class, behind a curve"),
        pytest.param('<rect x="10" y="20" width="30" height="5" stroke="#000" fill="none"/>', [10 + 60j, 40 + 60j],
                     id="rectangle"),
        pytest.param('<line x1="0" y1="0" x2="8" y2="0" stroke="#000"/><polygon points="10,0 7,1 7,-1"/>',
                     [80j, 10 + 80j], id="as far as the point of its arrowhead"),
        pytest.param('<line x1="10" y1="0" x2="2" y2="0" stroke="#000"/><polygon points="0,0 3,1 3,-1"/>',
                     [10 + 80j, 80j], id="towards its arrowhead"),
    ],
)  # fmt: skip
def test_svg_is_read_as_browsers_draw_it(tmp_path: Path, inside: str, ends: list[complex]) -> None:
    drawn = read_drawing(of(tmp_path, "x.svg", svg(inside)))

    assert line_of(drawn) == ends


def test_pixels_are_those_of_96_to_an_inch(tmp_path: Path) -> None:
    drawn = read_drawing(of(tmp_path, "x.svg", svg('<path d="M0 0V96" stroke="#000"/>', "")))

    assert abs(drawn.tips[0] - drawn.tails[0]) == pytest.approx(25.4)


def test_a_packed_svg_is_read(tmp_path: Path) -> None:
    assert len(read_drawing(of(tmp_path, "x.svg", gzip.compress(svg(LINES).encode()))).tails) == 1


@pytest.mark.parametrize(("unit", "mm"), [("0", 1.0), ("1", 25.4), ("4", 1.0), ("5", 10.0), ("6", 1000.0)])
def test_units_of_dxf_are_those_of_its_header(tmp_path: Path, unit: str, mm: float) -> None:
    line = "0\nLINE\n10\n1\n20\n2\n11\n4\n21\n6\n"

    drawn = read_drawing(of(tmp_path, "x.dxf", dxf(line, header=f"9\n$INSUNITS\n70\n{unit}\n")))

    assert abs(drawn.tips[0] - drawn.tails[0]) == pytest.approx(5.0 * mm)


def test_cyrillic_and_lines_with_crlf_are_read_of_an_old_dxf(tmp_path: Path) -> None:
    text = dxf("0\nLINE\n10\n0\n20\n0\n11\n9\n21\n0\n0\nTEXT\n10\n0\n20\n0\n40\n3\n1\nПлан %%d\n")

    drawn = read_drawing(of(tmp_path, "x.dxf", text.replace("\n", "\r\n").encode("cp1251")))

    assert [letter.text for letter in drawn.letters] == ["План °"]


def test_forms_of_a_pdf_in_one_another_are_read(tmp_path: Path) -> None:
    inner = FORM % (5, b"/Matrix [2 0 0 2 10 10]", 14, b"0 0 m 72 0 l S")

    drawn = read_drawing(of(tmp_path, "x.pdf", pdf(b"q 1 0 0 1 5 5 cm /F Do Q", inner, b"/XObject << /F 5 0 R >>")))

    assert abs(drawn.tips[0] - drawn.tails[0]) == pytest.approx(2 * 25.4, abs=1e-4)


# Hostile files. Each is one line for the user; that it comes in time is a matter of the counts, which are tested here.


def block(name: str, entities: str) -> str:
    return f"0\nBLOCK\n2\n{name}\n10\n0\n20\n0\n{entities}0\nENDBLK\n"


def insert(name: str, more: str = "") -> str:
    return f"0\nINSERT\n2\n{name}\n10\n1\n20\n1\n{more}"


BOMB = block("A0", "0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n") + "".join(
    block(f"A{n}", insert(f"A{n - 1}") * 10) for n in range(1, 12)
)
LOOP = block("A", insert("A"))
USES = '<defs><g id="u0"><path d="M0 0h9" stroke="#000"/></g>' + "".join(
    f'<g id="u{n}">' + f'<use href="#u{n - 1}"/>' * 10 + "</g>" for n in range(1, 9)
)
ENTITIES = '<!DOCTYPE svg [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]>'
OUTSIDE = '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
LINE = "0\nLINE\n10\n{}\n20\n0\n11\n9\n21\n9\n"
HOSTILE = {
    "bomb.dxf": (lambda: dxf(insert("A11"), BOMB), "drawing-many"),
    "loop.dxf": (lambda: dxf(insert("A"), LOOP), "drawing-deep"),
    "rows.dxf": (lambda: dxf(insert("A", "70\n30000\n71\n30000\n"), block("A", "")), "drawing-many"),
    "million.dxf": (lambda: dxf(LINE.format(0) * 300_000), "drawing-many"),
    "cut.dxf": (lambda: dxf(LINE.format(0))[:-40], "drawing-broken"),
    "nan.dxf": (lambda: dxf(LINE.format("nan")), "drawing-far"),
    "inf.dxf": (lambda: dxf(LINE.format("1e999")), "drawing-far"),
    "words.dxf": (lambda: dxf(LINE.format("ten")), "drawing-broken"),
    "text.dxf": (lambda: "no drawing at all\n" * 99, "drawing-broken"),
    "dwg.dxf": (lambda: b"AC1032\0\0\0" + bytes(999), "drawing-binary"),
    "binary.dxf": (lambda: b"AutoCAD Binary DXF\r\n\x1a\0" + bytes(99), "drawing-binary"),
    "empty.dxf": (lambda: dxf(""), "drawing-empty"),
    "nothing.svg": (lambda: b"", "drawing-broken"),
    "uses.svg": (lambda: svg(f'{USES}</defs><use href="#u8"/>'), "drawing-many"),
    "round.svg": (lambda: svg('<g id="a"><use href="#a"/></g>'), "drawing-deep"),
    "deep.svg": (lambda: svg("<g>" * 5000 + "</g>" * 5000), "drawing-deep"),
    "million.svg": (lambda: svg('<path stroke="#000" d="' + "M0 0L9 9" * 200_000 + '"/>'), "drawing-many"),
    "tags.svg": (lambda: svg("<g/>" * 300_000), "drawing-many"),
    "entities.svg": (lambda: ENTITIES + svg("<text>&b;</text>"), "drawing-declared"),
    "outside.svg": (lambda: OUTSIDE + svg("<text>&x;</text>"), "drawing-declared"),
    "wide.svg": (lambda: svg(LINES).encode("utf-16"), "drawing-declared"),
    "bytes.svg": (lambda: b"\xff\xfe\xfa<svg", "drawing-broken"),
    "html.svg": (lambda: "<html><body/></html>", "drawing-broken"),
    "cut.svg": (lambda: svg(LINES)[:-3], "drawing-broken"),
    "nan.svg": (lambda: svg('<g transform="scale(1e300) scale(1e300)"><path d="M1 1L9 9" stroke="#000"/></g>'),
                "drawing-far"),
    "packed.svg": (lambda: gzip.compress(bytes(50_000_000)), "drawing-large"),
    "curves.svg": (lambda: svg('<path d="M1 1C2 2 3 3 4 4" stroke="#000"/>'), "drawing-empty"),
    "renamed.pdf": (lambda: svg(LINES), "drawing-broken"),
    "cut.pdf": (lambda: pdf(b"0 0 m 9 9 l S")[:40], "drawing-broken"),
    "million.pdf": (lambda: pdf(b"0 0 m 9 9 l S\n" * 200_000), ("drawing-many", "drawing-late")),
    "packed.pdf": (lambda: pdf(zlib.compress(b"0 0 m 9 9 l S\n" * 3_000_000, 9), filters=b"/Filter /FlateDecode"),
                   ("drawing-many", "drawing-late")),
    "blank.pdf": (lambda: pdf(b""), "drawing-empty"),
}  # fmt: skip


# what a process reads as long as it may is shown by forms that multiply, too
@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.soak] * (n in ("packed.pdf", "million.svg"))) for n in HOSTILE]
)
def test_a_hostile_drawing_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    make, keys = HOSTILE[name]
    file = of(tmp_path, name, make())

    with pytest.raises(InputError) as error:
        read_drawing(file)

    assert error.value.key in keys if isinstance(keys, tuple) else error.value.key == keys
    assert name in error.value.text("en")
    assert "\n" not in error.value.text("uk")


def test_forms_that_multiply_in_a_pdf_are_stopped(tmp_path: Path) -> None:
    ten, inner = b"/F Do " * 10, b"/Resources << /XObject << /F %d 0 R >> >>"
    forms = b"".join(FORM % (n, inner % (n + 1), len(ten), ten) for n in range(5, 16))
    forms += FORM % (16, b"", 13, b"0 0 m 9 9 l S")
    file = of(tmp_path, "forms.pdf", pdf(ten, forms, b"/XObject << /F 5 0 R >>"))

    with pytest.raises(InputError) as error:
        read_drawing(file)

    assert error.value.key in ("drawing-late", "drawing-many", "drawing-deep")


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "huge.dxf"
    with file.open("wb") as stream:
        stream.truncate(100_000_000)

    with pytest.raises(InputError) as error:
        read_drawing(file)

    assert error.value.key == "drawing-large"


@pytest.mark.parametrize(
    ("turn", "ends"),
    [
        (0, [10 + 10j, 50 + 10j]),
        (90, [10 + 190j, 10 + 150j]),
        (180, [190 + 90j, 150 + 90j]),
        (270, [90 + 10j, 90 + 50j]),
    ],
)
def test_a_page_that_is_shown_turned_is_read_so_from_its_own_corner(
    turn: int, ends: list[complex], tmp_path: Path
) -> None:
    looks = b"[10 20 210 120] /Rotate %d" % turn  # 200 by 100 points
    page = pdf(b"20 30 m 60 30 l S").replace(b"[0 0 200 200]", looks)

    found = line_of(read_drawing(of(tmp_path, "x.pdf", page)))

    assert found == pytest.approx([end * 25.4 / 72.0 for end in ends], abs=1e-3)


def test_a_scan_is_told_from_a_drawing(tmp_path: Path) -> None:
    import matplotlib.image
    from reportlab.lib.utils import ImageReader
    from reportlab.pdfgen.canvas import Canvas

    picture, stream = io.BytesIO(), io.BytesIO()
    matplotlib.image.imsave(picture, np.zeros((8, 8, 3), np.uint8), format="png")
    canvas = Canvas(stream)
    canvas.drawImage(ImageReader(picture), 0, 0, 500, 700)
    canvas.save()

    with pytest.raises(InputError) as error:
        read_drawing(of(tmp_path, "scan.pdf", stream.getvalue()))

    assert error.value.key == "drawing-picture"


def test_pages_stand_far_apart(tmp_path: Path) -> None:
    from reportlab.pdfgen.canvas import Canvas

    stream = io.BytesIO()
    canvas = Canvas(stream)
    for _ in range(2):
        canvas.line(0, 0, 72, 0)
        canvas.showPage()
    canvas.save()

    drawn = read_drawing(of(tmp_path, "two.pdf", stream.getvalue()))

    assert len(drawn.tails) == 2
    assert abs(drawn.tails[1] - drawn.tips[0]) >= marks.APART
