"""Photographs and scans that are handed in: pages of handouts found on them by their markers, behind bounds.

JPEG, PNG and PDF of pictures are unpacked in a process of their own (`drawings/apart.py`). What comes back is grey, cut
to one page of a handout each: which page that is, where its markers are, what its QR code says.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...drawing.markers import EACH, FEWEST, FREE
from ...scales.errors import InputError
from ..drawings.apart import apart, handed_in
from ..drawings.marks import FaultError
from ..sheets import CODED

PICTURES = (".jpg", ".jpeg", ".png")
LARGEST = 120_000_000  # bytes of a file
PIXELS = 80_000_000  # of a picture: an A1 sheet at 300 dots an inch has 70 million
SECONDS, MORE = 1.0, 20.0  # of the processor, until something of a handout is seen, and from there to the next page
SHEETS = 200  # pages of a PDF
DOTS = 150.0, 300.0  # per inch at which pages of a PDF are looked at: for markers at all, and for what is drawn
LOOKED = 16_000_000  # pixels in which markers are looked for; on larger pictures their corners are then put right
QUALITY = 98  # of the JPEG of a page
CORNER = 5  # pixels round a corner that tell where it is
TINY = 0.4  # of the middle size of markers on a picture: what is smaller is a letter or a figure that looks like one
LEAST = 200  # pixels of a side of a picture
AROUND = 0.6  # of what markers span, kept round them: they may stand away from the edge
INCH = 72.0
LARGE = 1_500  # pixels of a side from which a picture needs not to be enlarged to find codes on it


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Photo:
    """A page of a handout on a picture, grey, as JPEG, which is half as large as PNG and differs by one in 255.

    `number` is that of the page, from 1; `markers` are the corners of each by its number, pixels of this picture, y
    down, `centre` where the axis of the lens goes through; `code` is what the QR code says, by parts.
    """

    source: str
    number: int
    markers: Mapping[int, tuple[complex, ...]]
    centre: complex
    code: tuple[str, ...]
    picture: bytes

    def __repr__(self) -> str:
        """Return where it comes from, and which page it is."""
        return f"<Photo {self.source}: {self.number}>"

    @property
    def sheet(self) -> str:
        """The id of the sheet, if its QR code was read."""
        return self.code[3] if self.code else ""


def read_photos(file: str | Path) -> list[Photo]:
    """Return the pages of handouts on a picture or in a PDF of pictures, in the order in which they are found.

    Raises
    ------
    InputError
        The file cannot be read, is too large, is not what its suffix says, or shows no page of a handout.
    """
    data, shown, suffix = handed_in(file, LARGEST, "drawing-not-file")
    try:
        if len(data) > LARGEST:
            raise FaultError("photo-large")
        parts = apart(_begun, _of_pdf if suffix == ".pdf" else _of_picture, data, SECONDS, MORE)
        found = [one for one in parts if one and len(one[1]) >= FEWEST]
        if not found:
            raise FaultError("photo-few" if any(parts) else "photo-no-markers")
    except InputError:  # of a package that is missing
        raise
    except FaultError as fault:
        key = str(fault)
    except ValueError:
        key = "photo-broken"
    else:
        return [Photo(str(file), *one) for one in found]
    key = {"drawing-late": "photo-late", "drawing-broken": "photo-broken"}.get(key, key)
    raise InputError(key, file=shown, n=PIXELS // 1_000_000, known=suffix[1:].upper())


def grey_of(photo: Photo) -> Any:
    """Return a photograph as a grey array."""
    import cv2
    import numpy as np

    return cv2.imdecode(np.frombuffer(photo.picture, np.uint8), cv2.IMREAD_GRAYSCALE)


def together(photos: Iterable[Photo]) -> list[list[Photo]]:
    """Return pages by students: of the same sheet id, no page twice; one without an id is the last student's."""
    found = list[list[Photo]]()
    for photo in photos:
        for group in reversed(found):
            known = next((one.sheet for one in group if one.sheet), "")
            like = not (known and photo.sheet) or known == photo.sheet
            if like and (photo.number == FREE or photo.number not in {one.number for one in group}):
                group.append(photo)
                break
        else:
            found.append([photo])
    return found


def _begun(advance: Any) -> None:
    """Load the libraries."""
    try:
        import cv2
        import pypdfium2
        import zxingcpp
        from PIL import Image  # noqa: F401
    except ImportError:
        raise InputError("scan-missing") from None
    del pypdfium2, zxingcpp
    cv2.setNumThreads(1)


Found = tuple[int, dict[int, tuple[complex, ...]], complex, tuple[str, ...], bytes]


def _of_picture(data: bytes) -> Iterator[Found | str | None]:
    """Go through the pages on a picture, nothing where they begin, or give the key of what is wrong with it."""
    import numpy as np
    from PIL import Image, ImageOps

    Image.MAX_IMAGE_PIXELS = None  # its size is looked at here
    try:
        with Image.open(io.BytesIO(data), formats=("JPEG", "PNG")) as picture:
            if picture.width * picture.height > PIXELS:
                raise FaultError("photo-pixels")
            if min(picture.size) < LEAST:
                raise FaultError("photo-small")
            picture.draft("L", picture.size)  # a JPEG is unpacked in grey at once
            grey = np.asarray(_grey(ImageOps.exif_transpose(picture)))
    except FaultError as fault:
        yield str(fault)
    except MemoryError:
        yield "photo-late"
    except Exception:  # whatever a decoder does not like
        yield "photo-broken"
    else:
        yield from _sheets(grey)


def _grey(picture: Any) -> Any:
    """Return a picture in grey of 8 bits, on white paper where it is transparent."""
    from PIL import Image

    if picture.mode.startswith("I"):  # 16 bits, which Pillow would cut off
        return picture.point(lambda light: light * (1.0 / 257.0)).convert("L")
    if "A" in picture.getbands() or "transparency" in picture.info:
        over = picture.convert("RGBA")
        return Image.alpha_composite(Image.new("RGBA", over.size, "white"), over).convert("L")
    return picture.convert("L")


def _of_pdf(data: bytes) -> Iterator[Found | str | None]:
    """Go through the pages of handouts in a PDF, nothing where they begin, or give the key of what is wrong with it."""
    import pypdfium2

    try:
        document = pypdfium2.PdfDocument(data)
        if len(document) > SHEETS:
            raise FaultError("photo-pages")
        for page in document:
            if len(_markers(_rendered(page, DOTS[0]))[0]):  # what shows none takes little time
                yield from _sheets(_rendered(page, DOTS[1]))
    except (pypdfium2.PdfiumError, ValueError, LookupError, ArithmeticError, OSError, MemoryError):
        yield "photo-broken"
    except FaultError as fault:
        yield str(fault)


def _rendered(page: Any, dots: float) -> Any:
    """Return a page of a PDF as a grey picture, so many dots an inch as long as it is not too large."""
    import numpy as np

    width, height = page.get_size()
    if min(width, height) <= 0.0:
        raise FaultError("photo-broken")
    bitmap = page.render(scale=min(dots / INCH, math.sqrt(PIXELS / 4.0 / (width * height))), grayscale=True)
    grey = np.array(bitmap.to_numpy().reshape(bitmap.height, bitmap.width))
    bitmap.close()
    return grey


def _markers(grey: Any) -> tuple[list[Any], list[int]]:
    """Return the corners of the markers on a grey picture, pixels, of shape (4, 2), and their numbers."""
    import cv2
    import numpy as np

    means = cv2.aruco.DetectorParameters()
    means.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    finder = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_250), means)
    times = math.ceil(math.sqrt(grey.size / LOOKED))
    small = grey if times == 1 else cv2.resize(grey, None, fx=1 / times, fy=1 / times, interpolation=cv2.INTER_AREA)
    corners, numbers, _ = finder.detectMarkers(small)
    found = [own.reshape(4, 2) for own in corners]
    if times > 1:
        near, until = (CORNER * times,) * 2, (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_COUNT, 30, 0.05)
        large: list[Any] = [((own + 0.5) * times - 0.5).astype(np.float32) for own in found]
        found = [cv2.cornerSubPix(grey, own, near, (-1, -1), until) for own in large]
    sizes = [cv2.arcLength(own, True) for own in found]
    real = [at for at, size in enumerate(sizes) if size >= TINY * np.median(sizes)]
    return [found[at] for at in real], [numbers.ravel().tolist()[at] for at in real]


def _sheets(grey: Any) -> Iterator[Found | str | None]:
    """Go through the pages of handouts on a grey picture, nothing first: the markers of each page, and its code."""
    import cv2

    try:
        found = _markers(grey)
        if found[0]:
            yield None
            yield from _pages(grey, *found)
    except FaultError as fault:
        yield str(fault)
    except (MemoryError, cv2.error):  # which is what it calls too little memory
        yield "photo-late"


def _pages(grey: Any, corners: list[Any], numbers: list[int]) -> Iterator[Found]:
    import cv2
    import numpy as np

    by_page: dict[int, dict[int, tuple[complex, ...]]] = {}
    for own, number in zip(corners, numbers, strict=True):
        same = by_page.setdefault(number // EACH + 1, {})
        if number in same:
            raise FaultError("photo-twice")
        same[number] = tuple(complex(x, y) for x, y in own.tolist())
    by_page = {page: own for page, own in by_page.items() if len(own) >= 2}
    codes = list(_codes(grey)) if by_page else []
    rows, columns = grey.shape
    for page, own in by_page.items():
        every = np.array([z for four in own.values() for z in four])
        low = complex(every.real.min(), every.imag.min())
        high = complex(every.real.max(), every.imag.max())
        more = AROUND * max((high - low).real, (high - low).imag)
        x0, y0 = (max(0, int(edge - more)) for edge in (low.real, low.imag))
        x1, y1 = min(columns, int(high.real + more) + 1), min(rows, int(high.imag + more) + 1)
        beside = [(abs(at - (low + high) / 2), text) for at, text in codes if text[4] == str(page)]
        _, jpeg = cv2.imencode(".jpg", grey[y0:y1, x0:x1], [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
        corner = complex(x0, y0)
        moved = {number: tuple(z - corner for z in four) for number, four in own.items()}
        code = min(beside)[1] if beside else ()
        yield page, moved, complex(columns, rows) / 2 - corner, code, jpeg.tobytes()


def _codes(grey: Any) -> Iterator[tuple[complex, tuple[str, ...]]]:
    """Go through the QR codes of handouts: where they are, what they say, by parts."""
    import cv2
    import zxingcpp

    seen = set[str]()
    for times in (1.0, 2.0) if max(grey.shape) < 2 * LARGE else (1.0, 0.5):
        how = cv2.INTER_CUBIC if times > 1.0 else cv2.INTER_AREA
        sized = grey if times == 1.0 else cv2.resize(grey, None, fx=times, fy=times, interpolation=how)
        for code in zxingcpp.read_barcodes(sized, formats=zxingcpp.barcode_formats_from_str("QRCode")):
            parts = tuple(code.text.split(":"))
            if parts[0] == CODED and len(parts) == 8 and code.text not in seen:
                seen.add(code.text)
                at = code.position
                places = (at.top_left, at.top_right, at.bottom_left, at.bottom_right)
                yield sum(complex(one.x, one.y) for one in places) / 4.0 / times, parts
        if seen:
            return
