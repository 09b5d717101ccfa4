"""Web servers in a thread: they give recordings in all the ways that servers do, and note what is asked."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


@dataclass
class Web:
    """``files`` by name. ``ranges``: whether parts of a file are given.

    ``refuse``: the status of every answer. ``break_at``: from that octet on, so many answers break off.
    ``sized``: whether the length of an answer is told.
    """

    files: dict[str, bytes]
    ranges: bool = True
    refuse: int = 0
    break_at: int | None = None
    breaks: int = 1_000_000
    sized: bool = True
    asked: list[tuple[str, str, str | None]] = field(default_factory=list)
    host: str = ""

    def url(self, name: str) -> str:
        return f"http://{self.host}/{name}"

    def fetched(self) -> int:
        """The octets asked for by range."""
        spans = [re.findall(r"\d+", part) for _, _, part in self.asked if part]
        return sum(int(last) - int(first) + 1 for first, last in spans)


@contextmanager
def serving(web: Web) -> Iterator[Web]:
    answering = type("Answering", (_Answering,), {"web": web})
    server = ThreadingHTTPServer(("127.0.0.1", 0), answering)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    web.host = f"127.0.0.1:{server.server_port}"
    try:
        yield web
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


class _Answering(BaseHTTPRequestHandler):
    web: Web

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""

    def do_HEAD(self) -> None:
        self._answer(with_body=False)

    def do_GET(self) -> None:
        self._answer(with_body=True)

    def _answer(self, *, with_body: bool) -> None:
        name, part = self.path.partition("?")[0].lstrip("/"), self.headers.get("Range")
        self.web.asked.append((self.command, name, part))
        if self.web.refuse:
            return self.send_error(self.web.refuse)
        if name == "" or name.endswith("/"):
            return self._send(200, self._page(name), "text/html", with_body, 0)
        if any(each.startswith(f"{name}/") for each in self.web.files):
            return self._redirect(f"/{name}/")
        if name not in self.web.files:
            return self.send_error(404)
        body = self.web.files[name]
        if part and self.web.ranges:
            first, last = (int(number) for number in re.findall(r"\d+", part))
            return self._send(206, body[first : last + 1], "application/octet-stream", with_body, first)
        return self._send(200, body, "application/octet-stream", with_body, 0)

    def _redirect(self, place: str) -> None:
        self.send_response(301)
        self.send_header("Location", place)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def _page(self, folder: str) -> bytes:
        below = {name[len(folder) :] for name in self.web.files if name.startswith(folder)}
        names = sorted({re.sub(r"/.*", "/", name) for name in below})
        return "".join(f'<a href="{name}">{name}</a>\n' for name in names).encode()

    def _send(self, status: int, body: bytes, kind: str, with_body: bool, first: int) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        if self.web.sized:
            self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if not with_body:
            return
        breaks, end = self.web.break_at, first + len(body)
        if breaks is not None and breaks < end and self.web.breaks > 0:
            self.web.breaks -= 1
            body = body[: max(breaks - first, 0)]
        try:
            self.wfile.write(body)
        except OSError:
            return  # who asked has seen enough
