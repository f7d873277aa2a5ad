"""The images of a report: which are shown, and how."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
from PIL import Image

from ...results.per_level import rows_by_level, seeds_of
from ...results.result import Result, SavedImage
from ..plots import repeats_of
from .outcomes import named_level
from .overlay import overlay

MAX_IMAGES = 40
"""Of the first repeat; more are thinned out evenly, with a note."""
MAX_OTHERS = 8
"""Of other repeats: where they first failed."""
PHASE = "phase "
"""How the name of the camera begins of an image of a task's phase."""
MAX_BYTES = 3_000_000
"""Of all images together; if they are more, they are thinned out further."""

T = TypeVar("T")


@dataclass(frozen=True, kw_only=True)
class Shown:
    """An image in the report."""

    caption: str
    """Level and status; of several repeats also the seed."""
    data: str | None
    """The image as a data URL; None when its file cannot be read."""
    ok: bool
    """Whether its level ended ``ok``."""


def phase_images(result: Result, directory: Path) -> list[Shown]:
    """Return the images of the phases of a task: the first level that has any."""
    found = [saved for saved in result.images if saved.camera.startswith(PHASE)]
    return [
        Shown(
            caption=saved.camera.removeprefix(PHASE),
            data=_drawn(saved, directory),
            ok=True,
        )
        for saved in found
        if saved.row == found[0].row
    ]


def shown_images(result: Result, directory: Path) -> list[Shown]:
    """Return the images of the first repeat, and of the others where they first failed."""
    if not result.images:
        return []
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    several = len(set(repeats_of(result))) > 1
    seeds, endings = seeds_of(result), _endings(result)
    shown: list[Shown] = []
    for saved in _chosen(result, endings):
        ended = endings[saved.row]
        caption = f"{named_level(result, levels[saved.row])} · {ended or saved.camera}"
        if several:
            caption = f"seed {seeds[saved.row]} · {caption}"
        data = _drawn(saved, directory)
        shown.append(Shown(caption=caption, data=data, ok=ended in ("ok", "")))
    n_bytes = sum(len(one.data or "") for one in shown)
    return evenly(shown, max(1, len(shown) * MAX_BYTES // max(n_bytes, MAX_BYTES)))


def evenly(items: Sequence[T], most: int) -> list[T]:
    """Return at most so many of the items, the first and the last among them."""
    if len(items) <= most:
        return list(items)
    return [items[i] for i in np.linspace(0, len(items) - 1, most).round().astype(int).tolist()]


def images_text(result: Result, n_shown: int) -> str:
    """Say which images are shown; empty when all are."""
    images = [saved for saved in result.images if not saved.camera.startswith(PHASE)]
    if n_shown >= len(images):
        return ""
    repeats = repeats_of(result)
    n_first = sum(repeats[saved.row] == repeats[0] for saved in images)
    which = "evenly chosen" if n_first > MAX_IMAGES or n_shown < n_first else "every level"
    if len(set(repeats)) > 1:
        which += " of the first repeat, and of the others where they first did not end ok"
    return f"{n_shown} of {len(images)} images: {which}. All are in the folder pictures."


def data_url(data: bytes, kind: str) -> str:
    """Return an image as a page holds it in itself."""
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"


def _chosen(result: Result, endings: Sequence[str]) -> list[SavedImage]:
    repeats = repeats_of(result)
    images = [saved for saved in result.images if not saved.camera.startswith(PHASE)]
    own = [saved for saved in images if repeats[saved.row] == repeats[0]]
    own = evenly(own, MAX_IMAGES)
    failed: dict[tuple[object, ...], int] = {}
    for row, (repeat, ended) in enumerate(zip(repeats, endings, strict=True)):
        if ended not in ("ok", "") and repeat != repeats[0]:
            failed.setdefault(repeat, row)
    rows = set(failed.values())
    return own + [saved for saved in images if saved.row in rows][:MAX_OTHERS]


def _endings(result: Result) -> list[str]:
    """The status of every row; empty texts where it is not recorded."""
    status = result.columns_of_kind("status")
    if not status:
        return [""] * len(result.rows)
    return [str(cell) for cell in result.values(status[0].name)]


def _drawn(saved: SavedImage, directory: Path) -> str | None:
    """Read an image from inside the directory, draw its quads; None when that fails."""
    file = (directory / saved.file).resolve()
    if not file.is_relative_to(directory.resolve()):
        return None
    try:
        with Image.open(file, formats=("PNG", "JPEG")) as image:
            pixels = np.asarray(image.convert("RGB"))
    except (OSError, ValueError, Image.DecompressionBombError, SyntaxError):
        return None
    scale = 2 if max(pixels.shape) <= 400 else 1
    drawn = overlay(pixels, truth=saved.truth, estimate=saved.estimate, scale=scale)
    stream = io.BytesIO()
    Image.fromarray(drawn).save(stream, format="JPEG", quality=80)
    return data_url(stream.getvalue(), "jpeg")
