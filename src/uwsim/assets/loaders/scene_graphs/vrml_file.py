"""The readers of VRML 97 and X3D files."""

from __future__ import annotations

from typing import Any

from ..references import References
from .surfaces import make_parts
from .vrml_shapes import read_surfaces
from .vrml_text import decode, parse_vrml
from .x3d_file import parse_x3d


def read_parts(
    data: bytes, suffix: str, references: References
) -> tuple[list[tuple[Any, Any]], tuple[str, ...]]:
    """Return the meshes of a file, each with its pose, and remarks on what is left out.

    Args:
        data: the file.
        suffix: its suffix, ``.wrl``, ``.x3d`` or ``.x3dv``.
        references: the reader of the images of the file.

    Raises:
        ValueError: the file is damaged; the message has the line.
    """
    is_xml = data.lstrip()[:1] == b"<"
    roots = parse_x3d(data) if suffix == ".x3d" or is_xml else parse_vrml(decode(data))
    surfaces, remarks = read_surfaces(roots)
    return make_parts(surfaces, references), remarks
