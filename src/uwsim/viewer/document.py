"""The HTML of the page: template, style, script and data in one file that loads nothing else."""

from __future__ import annotations

import html
import re
from functools import cache
from pathlib import Path

from .pack import as_text

FOLDER = Path(__file__).parent / "page"
"""What the page is made of; ``scripts/page`` makes ``page.js`` from ``source``."""
NOWHERE, SOCKET = "'none'", "'self' ws: wss:"
"""Where a replay may connect to, and where a live view may."""


def document(title: str, pack: bytes | None) -> str:
    """Return the page.

    Args:
        title: of the page.
        pack: what a replay shows (`head`); None: it comes over the WebSocket that it opens.
    """
    data = ""
    if pack is not None:
        data = f'<script type="application/octet-stream" id="pack">{as_text(pack)}</script>'
    parts = {
        "title": html.escape(title),
        "connect": SOCKET if pack is None else NOWHERE,
        "style": _read("uplot.css") + _read("page.css"),
        "data": data,
        "script": re.sub(r"</(?=script)", r"<\\/", _read("page.js"), flags=re.IGNORECASE),
    }
    pattern = "|".join(parts)
    return re.sub(rf"\{{({pattern})\}}", lambda match: parts[match[1]], _read("index.html"))


@cache
def _read(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")
