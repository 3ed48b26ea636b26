"""What is answered to addresses of questions about photographs: pages, pictures, answers, and at last marks."""

from __future__ import annotations

import secrets
from dataclasses import replace
from pathlib import Path

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.routing import Route

from ..photos.asking import OUT, EndAsk, PageAsk
from ..photos.pictures import PICTURES
from . import making, pages
from .asking import PASSED, Chosen, Sitting, overview, place_of, question
from .desk import Desk, Served
from .pages import Door
from .safety import STUDENT


async def marked_alone(desk: Desk, door: Door, sitting: Sitting) -> Response:
    """Mark what a student has handed in, with what has been answered, and lead to the report."""
    handed, asked = sitting.handed, sitting.handed.asked
    like = asked.task, asked.variant
    report, asking, returned = await desk.photos.do(making.answered_by_files, handed, sitting.told, like=like)
    if not sitting.asks:  # later there is nothing new to ask
        sitting.asking = asking
    links = [(sitting.back, f"← {door.said['form.again']}")]
    if sitting.asks:
        desk.sittings.keep(sitting.name, sitting)
        left = door.said["ask.left"].format(n=len(sitting.left))
        links.append((door.link(f"/asked/{sitting.name}"), left))
    for data in returned:
        kind = ".pdf" if data.startswith(b"%PDF") else ".zip" if data.startswith(b"PK") else ".png"
        address = secrets.token_hex(12)
        desk.made.keep(address, Served(f"marked{kind}", data))
        links.append((door.link(f"/result/{address}"), f"{door.said['form.returned']}, {kind[1:].upper()}"))
    name = secrets.token_hex(12)
    framed = pages.framed(report, *links)
    desk.made.keep(name, Served("report.html", framed.encode("utf-8", "replace")))
    return RedirectResponse(door.link(f"/result/{name}"), 303)


class Questions:
    """What is asked of photographs, for a server."""

    def __init__(self, desk: Desk) -> None:
        """Answer for a server."""
        self.desk = desk

    def routes(self) -> list[Route]:
        """Return which address is answered by what."""
        return [
            Route("/asked/{name}", self.overview, methods=["GET"]),
            Route("/asked/{name}", self.marked, methods=["POST"]),
            Route("/asked/{name}/plan/{picture}.png", self.plan),
            Route("/asked/{name}/sent/{number:int}", self.sent),
            Route("/asked/{name}/{number:int}", self.question, methods=["GET"]),
            Route("/asked/{name}/{number:int}", self.answered, methods=["POST"]),
            Route("/asked/{name}/{number:int}/{at:int}.png", self.page),
        ]

    def sitting(self, request: Request) -> tuple[Door, Sitting]:
        """Return what a page hangs on, and what has been handed in."""
        door, sitting = self.desk.door(request), self.desk.sittings.get(request.path_params["name"])
        if sitting is None:
            raise HTTPException(404)
        if door.role == STUDENT and not sitting.handed.alone:
            raise HTTPException(403)
        return door, sitting

    def asked(self, request: Request) -> tuple[Door, Sitting, PageAsk | EndAsk, int]:
        """Return also the question that an address means, and its number."""
        door, sitting = self.sitting(request)
        number = request.path_params["number"]
        if not 1 <= number <= len(sitting.asks):
            raise HTTPException(404)
        return door, sitting, sitting.asks[number - 1], number

    async def overview(self, request: Request) -> Response:
        """Show all questions."""
        return HTMLResponse(overview(*self.sitting(request)))

    async def marked(self, request: Request) -> Response:
        """Mark with what has been answered."""
        door, sitting = self.sitting(request)
        if sitting.handed.alone:
            return await marked_alone(self.desk, door, sitting)
        return self.begun(door, sitting)

    def begun(self, door: Door, sitting: Sitting, told: bool = True) -> Response:
        """Begin to mark a class, with what has been told, or to look for what is not sure; lead to how far it is."""
        said = sitting.told if told else None
        title, asked = door.said["marks.title"], sitting.name
        handed = sitting.handed
        job = self.desk.begin(title, making.marked_class, door.language, handed.sent, handed, said, asked)
        self.desk.sittings.keep(job.name, replace(sitting, name=job.name))
        return RedirectResponse(door.link(f"/job/{job.name}"), 303)

    async def question(self, request: Request) -> Response:
        """Show one question."""
        door, sitting, ask, number = self.asked(request)
        chosen = self.chosen(request, ask) if isinstance(ask, EndAsk) else Chosen()
        return HTMLResponse(question(door, sitting, number, await self.students(sitting), chosen))

    async def students(self, sitting: Sitting) -> list[str]:
        """Return the names of the students of the roster."""
        if sitting.handed.roster is None or not sitting.asking.pages:
            return []
        key = sitting.name, "students"
        found: list[str] = await self.desk.ask(key, making.students, sitting.handed)
        return found

    def chosen(self, request: Request, ask: EndAsk) -> Chosen:
        """Return what an address says of a vector."""
        query = request.query_params
        tail, tip = (place_of(query.get(end, ""), ask.box) for end in ("tail", "tip"))
        move = query.get("move", "") if query.get("move") in ("tail", "tip") else ""
        free = place_of(query.get("at", ""), (0.0, 0.0, ask.box[2] - ask.box[0], ask.box[3] - ask.box[1]))
        if free is not None:  # of the picture, y down
            spot = ask.snapped(complex(ask.box[0] + free.real, ask.box[3] - free.imag))
            tail, tip, move = (spot, tip, "") if move == "tail" else (tail, spot, "")
        return Chosen(tail, tip, move, query.get("whole") == "1")

    async def answered(self, request: Request) -> Response:
        """Note an answer, and lead to the next question that has none."""
        door, sitting, ask, number = self.asked(request)
        async with request.form(max_files=0, max_fields=10) as form:
            texts = {name: text.strip()[:200] for name, text in form.items() if isinstance(text, str)}
        said = texts.get("say", "") or texts.get("who", "")
        ends = None
        if isinstance(ask, EndAsk):
            tail, tip = (place_of(texts.get(end, ""), ask.box) for end in ("tail", "tip"))
            ends = None if tail is None or tip is None else (tail, tip)
            said = said if ends is not None or said == OUT else PASSED
        if said:
            sitting.answer(ask, said, ends)
        left = sitting.left
        after = next((n for n in left if n > number), left[0] if left else 0)
        path = f"/asked/{sitting.name}"
        return RedirectResponse(door.link(f"{path}/{after}") + "#main" if after else door.link(path) + "#done", 303)

    async def plan(self, request: Request) -> Response:
        """Return the picture of a plan."""
        _, sitting = self.sitting(request)
        return _picture(sitting.asking.pictures.get(request.path_params["picture"]))

    async def page(self, request: Request) -> Response:
        """Return the small picture of a page."""
        _, _, ask, _ = self.asked(request)
        pictures, at = ask.pictures if isinstance(ask, PageAsk) else (), request.path_params["at"]
        return _picture(pictures[at] if at < len(pictures) else None)

    async def sent(self, request: Request) -> Response:
        """Return a picture as it came: the browser tries to show what the program cannot read."""
        _, sitting = self.sitting(request)
        number, files = request.path_params["number"], sitting.handed.files
        suffix = Path(files[number].name).suffix.lower() if number < len(files) else ""
        if suffix not in PICTURES:
            raise HTTPException(404)
        kind = "image/png" if suffix == ".png" else "image/jpeg"
        return Response(files[number].data, media_type=kind, headers={"Content-Security-Policy": "sandbox"})


def _picture(data: bytes | None) -> Response:
    if data is None:
        raise HTTPException(404)
    return Response(data, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})
