"""Who is let in, and how much: token or password, names of the server, origins, sizes and times of requests."""

from __future__ import annotations

import asyncio
import base64
import binascii
import ipaddress
import secrets
import socket
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from ...scales.errors import LANGUAGES, InputError
from ...scales.numbers import quote
from ...scales.packaged import packaged
from ..drawings.apart import handed_in

LARGEST_BODY = 50_000_000  # bytes: the forms of a class
READ_ON = 4 * LARGEST_BODY  # bytes of a body that are let go by before it is refused
PATIENCE = 60.0  # seconds in which a whole request must have come; its first lines in a quarter of them
WRONG = 0.5  # seconds that a wrong password costs, one after the other
TEACHER, STUDENT = "teacher", "student"
LARGEST_FILE = 10_000  # bytes of passwords
SHORTEST = 8  # characters of a password
ALLOWED = ("forms", "sheets", "answers")  # what students see, each with all before it
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "private, no-cache",
    "Content-Security-Policy": "default-src 'none'; style-src 'self'; script-src 'self'; img-src 'self'; "
    "connect-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'",
}


@dataclass(frozen=True)
class Doors:
    """How requests are let in: by a token in the address, or by the passwords of teachers and students."""

    names: frozenset[str]  # of the server, in small letters, without ports
    anywhere: bool = False  # whether it is also called by any address
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))
    passwords: Mapping[str, str] = field(default_factory=dict)

    @property
    def root(self) -> str:
        """What all addresses begin with."""
        return "" if self.passwords else f"/{self.token}"

    def host(self, said: str) -> bool:
        """Whether a request has called the server by a name of its own."""
        with suppress(ValueError):
            name = (urlsplit(f"//{said}").hostname or "").rstrip(".")
            if name in self.names:
                return True
            return self.anywhere and bool(ipaddress.ip_address(name))
        return False

    def own(self, headers: Headers) -> bool:
        """Whether a request comes from a page of the server, or from an address that somebody has opened."""
        site, origin = headers.get("sec-fetch-site", "none"), headers.get("origin")
        if origin is not None and urlsplit(origin).netloc.lower() != headers.get("host", "").lower():
            return False
        # a link to the server may stand anywhere, what a page loads must be a page of the server's
        return site in ("same-origin", "none") or headers.get("sec-fetch-mode") == "navigate"

    def role(self, headers: Headers) -> str | None:
        """Return who a request comes from by its password; None where there is none, or a wrong one."""
        if not self.passwords:
            return TEACHER
        scheme, _, coded = headers.get("authorization", "").partition(" ")
        user, password = "", ""
        with suppress(binascii.Error, UnicodeDecodeError):
            if scheme.lower() == "basic":
                user, _, password = base64.b64decode(coded, validate=True).decode("utf-8").partition(":")
        right = self.passwords.get(user, "")
        same = secrets.compare_digest(password.encode(), right.encode())
        return user if right and same else None


def read_passwords(file: str | Path) -> dict[str, str]:
    """Read a file of passwords: a line `teacher: ...`, a line `student: ...`, either alone, too; # begins a remark.

    Raises
    ------
    InputError
        The file cannot be read, or a line of it is none of these, or a password is short.
    """
    data, shown, _ = handed_in(file, LARGEST_FILE, "file-unreadable")
    try:
        text = data[:LARGEST_FILE].decode("utf-8-sig")
    except ValueError:
        raise InputError("file-unreadable", file=shown) from None
    found: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        user, password = (part.strip() for part in line.partition(":")[::2])
        if user not in (TEACHER, STUDENT) or user in found or len(password) < SHORTEST:
            raise InputError("serve-passwords", file=shown, line=number, n=SHORTEST)
        found[user] = password
    if TEACHER not in found:
        raise InputError("serve-passwords", file=shown, line=1, n=SHORTEST)
    return found


def doors_for(host: str, names: tuple[str, ...], passwords: Mapping[str, str] | None) -> Doors:
    """Return how requests to a host, also called by `names`, are let in; beyond this machine only by passwords."""
    local = {"127.0.0.1", "localhost", "::1"}
    address: ipaddress.IPv4Address | ipaddress.IPv6Address | None = None
    with suppress(ValueError):
        address = ipaddress.ip_address(host)
    loopback = host == "localhost" or (address is not None and address.is_loopback)
    if not (loopback and not names) and not passwords:
        raise InputError("serve-open", host=quote(names[0] if loopback else host))
    anywhere = address is not None and address.is_unspecified
    own = {socket.gethostname().lower(), socket.getfqdn().lower()} if anywhere else set[str]()
    return Doors(frozenset({*local, *own, host.lower(), *map(str.lower, names)}), anywhere, passwords=passwords or {})


class _Body:
    """The body of a request as it comes, neither too large nor too slow."""

    def __init__(self, receive: Receive, headers: Headers, most: int, patience: float) -> None:
        self._receive, self.most = receive, most
        self._until, self._came = asyncio.get_running_loop().time() + patience, 0
        self.whole = "content-length" not in headers and "transfer-encoding" not in headers

    async def __call__(self) -> Message:
        """Return the next piece."""
        if self.whole:  # what is waited for is that the client goes
            return await self._receive()
        try:
            async with asyncio.timeout_at(self._until):
                message = await self._receive()
        except TimeoutError:
            raise HTTPException(408) from None
        self._came += len(message.get("body", b""))
        if self._came > self.most:
            raise HTTPException(413)
        self.whole = not message.get("more_body", False)
        return message


class Gate:
    """Lets requests through to an application, or refuses them in a line; answers all have the headers of safety."""

    def __init__(self, app: ASGIApp, doors: Doors, largest: int = LARGEST_BODY, patience: float = PATIENCE) -> None:
        """Guard `app`."""
        self.app, self.doors, self.largest, self.patience = app, doors, largest, patience
        self._wrong = asyncio.Lock()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        body = _Body(receive, headers, self.largest, self.patience)
        begun = False

        async def sent(message: Message) -> None:
            nonlocal begun
            if message["type"] == "http.response.start":
                begun = True
                own = {name.lower() for name, _ in message["headers"]}
                # what is still on its way is not waited for
                usual = {**HEADERS, **({} if body.whole else {"Connection": "close"})}
                coded = ((name.lower().encode(), text.encode()) for name, text in usual.items())
                message["headers"] = [*message["headers"], *(pair for pair in coded if pair[0] not in own)]
            await send(message)

        refusal = self._refused(scope, headers) or await self._unknown(scope, headers)
        if refusal is None and await self._too_large(headers, body):
            refusal = PlainTextResponse("413 too large\n", 413)
        try:
            await (refusal or self.app)(scope, body, sent)
        except asyncio.CancelledError:  # the server ends before the answer is made
            if not begun:
                await PlainTextResponse("503 the server ends\n", 503, {"Retry-After": "10"})(scope, body, sent)

    def _refused(self, scope: Scope, headers: Headers) -> Response | None:
        """Return what a request is refused with that is not for this server, or not from its pages.

        Nothing of what it says comes back. The token goes off the path of one that is let through.
        """
        doors = self.doors
        if not doors.host(headers.get("host", "")):
            return PlainTextResponse("421 not a name of this server\n", 421)
        if not doors.own(headers):
            return _told("refused.site", 403)
        if not doors.passwords:
            begin, _, rest = scope["path"].removeprefix("/").partition("/")
            if not secrets.compare_digest(begin.encode("utf-8", "replace"), doors.token.encode()):
                return _told("refused.address", 403)
            scope["path"] = f"/{rest}"
        return None

    async def _unknown(self, scope: Scope, headers: Headers) -> Response | None:
        """Return the question for a password where there is none, or a wrong one; else note whose it is."""
        scope["role"] = self.doors.role(headers)
        if scope["role"] is not None:
            return None
        if "authorization" in headers:
            async with self._wrong:
                await asyncio.sleep(WRONG)
        asks = {"WWW-Authenticate": 'Basic realm="kulman: teacher, student", charset="UTF-8"'}
        return _told("refused.password", 401, asks)

    async def _too_large(self, headers: Headers, body: _Body) -> bool:
        """Whether a request says that it is too large; it is read on: a browser that is cut off shows no answer."""
        length = headers.get("content-length", "0")
        if length.isdigit() and int(length) <= self.largest:
            return False
        body.most = READ_ON
        with suppress(HTTPException):
            while length.isdigit() and int(length) <= READ_ON and (await body()).get("more_body"):
                pass
        return True


def _told(key: str, status: int, headers: Mapping[str, str] | None = None) -> Response:
    """Return a refusal in all languages: nothing of the request is believed, not even which one it wants."""
    lines = (packaged(__package__, "texts", language)[key] for language in LANGUAGES)
    return PlainTextResponse("\n".join((str(status), *lines, "")), status, headers)


class Patient(H11Protocol):
    """HTTP that hangs up where the first lines of a request do not come in time."""

    _waited: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait."""
        super().connection_made(transport)
        self._wait()

    def data_received(self, data: bytes) -> None:
        """Take what has come; go on waiting where it is not enough."""
        super().data_received(data)
        self._wait()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no longer."""
        super().connection_lost(exc)
        if self._waited is not None:
            self._waited.cancel()

    def _idle(self) -> bool:
        return self.cycle is None or self.cycle.response_complete

    def _wait(self) -> None:
        if not self._idle():
            if self._waited is not None:
                self._waited.cancel()
            self._waited = None
        elif self._waited is None:
            self._waited = self.loop.call_later(PATIENCE / 4, self._hang_up)

    def _hang_up(self) -> None:
        self._waited = None
        if self._idle() and not self.transport.is_closing():
            self.transport.close()
