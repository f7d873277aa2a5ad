"""The HTML of the page: template, style, script and data in one file that loads no other."""

from __future__ import annotations

import html
import re
from functools import cache
from pathlib import Path

from .pack import as_text

FOLDER = Path(__file__).parent / "page"
"""The folder with the parts of the page; ``scripts/page`` builds ``page.js`` from ``source``."""
NO_CONNECTION, WEBSOCKET_CONNECTION = "'none'", "'self' ws: wss:"
"""The values of ``connect-src`` in the page's content security policy, for a replay and for a live
view, respectively."""


def document(title: str, pack: bytes | None) -> str:
    """Return the page.

    Args:
        title: the title of the page.
        pack: the compressed data of a replay, in the format of `uwsim.viewer.head`; None: the page
            receives the data over a WebSocket.
    """
    data = ""
    if pack is not None:
        data = f'<script type="application/octet-stream" id="pack">{as_text(pack)}</script>'
    parts = {
        "title": html.escape(title),
        "connect": WEBSOCKET_CONNECTION if pack is None else NO_CONNECTION,
        "style": _read("uplot.css") + _read("page.css"),
        "data": data,
        "script": re.sub(r"</(?=script)", r"<\\/", _read("page.js"), flags=re.IGNORECASE),
    }
    pattern = "|".join(parts)
    return re.sub(rf"\{{({pattern})\}}", lambda match: parts[match[1]], _read("index.html"))


@cache
def _read(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")
