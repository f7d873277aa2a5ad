"""The templates of HTML pages: reports and comparisons."""

from __future__ import annotations

import base64
from pathlib import Path

import jinja2


def template(name: str) -> jinja2.Template:
    """Return the template of a page, which escapes the texts of a result."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(name)


def data_url(data: bytes, kind: str) -> str:
    """Return an image as a data URL."""
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"
