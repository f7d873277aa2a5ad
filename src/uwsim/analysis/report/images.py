"""The images of a report: their choice, captions and drawing."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from ...results.per_level import rows_by_level, seeds_of
from ...results.result import Result, SavedImage
from ..plots import choose_evenly, repeats_of
from ..templates import data_url
from .outcomes import result_level_text
from .overlay import overlay

MAX_IMAGES = 40
"""The greatest number of images of the first repeat; of more images, evenly chosen ones."""
MAX_OTHER_IMAGES = 8
"""The greatest number of images of the first failures of other repeats."""
PHASE_CAMERA_PREFIX = "phase "
"""The prefix of the camera name that is stored with the image of a task's phase."""
MAX_IMAGE_BYTES = 3_000_000
"""The greatest size of all images together [bytes]; of more images, evenly chosen ones."""


@dataclass(frozen=True, kw_only=True)
class ShownImage:
    """An image in the report."""

    caption: str
    """The level and status; with several repeats, the seed too."""
    data: str | None
    """The image as a data URL; None if its file cannot be read."""
    is_ok: bool
    """True if the level of the image ended ``ok``."""


def phase_images(result: Result, directory: Path) -> list[ShownImage]:
    """Return the images of the phases of a task in the first level that has any."""
    images = [image for image in result.images if image.camera.startswith(PHASE_CAMERA_PREFIX)]
    return [
        ShownImage(
            caption=image.camera.removeprefix(PHASE_CAMERA_PREFIX),
            data=_draw_image(image, directory),
            is_ok=True,
        )
        for image in images
        if image.row == images[0].row
    ]


def shown_images(result: Result, directory: Path) -> list[ShownImage]:
    """Return the images of the first repeat, and of the first failures of other repeats."""
    if not result.images:
        return []
    levels = {row: level for level, rows in rows_by_level(result).items() for row in rows}
    has_repeats = len(set(repeats_of(result))) > 1
    seeds, endings = seeds_of(result), _statuses(result)
    report_images: list[ShownImage] = []
    for image in _choose_images(result, endings):
        status = endings[image.row]
        caption = f"{result_level_text(result, levels[image.row])} · {status or image.camera}"
        if has_repeats:
            caption = f"seed {seeds[image.row]} · {caption}"
        data = _draw_image(image, directory)
        report_images.append(ShownImage(caption=caption, data=data, is_ok=status in ("ok", "")))
    n_bytes = sum(len(image.data or "") for image in report_images)
    max_images = len(report_images) * MAX_IMAGE_BYTES // max(n_bytes, MAX_IMAGE_BYTES)
    return choose_evenly(report_images, max(1, max_images))


def images_text(result: Result, n_shown: int) -> str:
    """Return a note on the choice of images; empty if all images are shown."""
    images = [image for image in result.images if not image.camera.startswith(PHASE_CAMERA_PREFIX)]
    if n_shown >= len(images):
        return ""
    repeats = repeats_of(result)
    n_first = sum(repeats[image.row] == repeats[0] for image in images)
    choice = "evenly chosen" if n_first > MAX_IMAGES or n_shown < n_first else "every level"
    if len(set(repeats)) > 1:
        choice += " of the first repeat, and the first failures of the others"
    return f"{n_shown} of {len(images)} images: {choice}. All are in the folder pictures."


def _choose_images(result: Result, statuses: Sequence[str]) -> list[SavedImage]:
    repeats = repeats_of(result)
    images = [image for image in result.images if not image.camera.startswith(PHASE_CAMERA_PREFIX)]
    first_images = [image for image in images if repeats[image.row] == repeats[0]]
    first_failures: dict[tuple[object, ...], int] = {}
    for row, (repeat, status) in enumerate(zip(repeats, statuses, strict=True)):
        if status not in ("ok", "") and repeat != repeats[0]:
            first_failures.setdefault(repeat, row)
    rows = set(first_failures.values())
    other_images = [image for image in images if image.row in rows][:MAX_OTHER_IMAGES]
    return choose_evenly(first_images, MAX_IMAGES) + other_images


def _statuses(result: Result) -> list[str]:
    status = result.columns_of_kind("status")
    if not status:
        return [""] * len(result.rows)
    return [str(cell) for cell in result.values(status[0].name)]


def _draw_image(saved_image: SavedImage, directory: Path) -> str | None:
    """Read an image inside the directory and draw its corners; None if it cannot be read."""
    file = (directory / saved_image.file).resolve()
    if not file.is_relative_to(directory.resolve()):
        return None
    try:
        with Image.open(file, formats=("PNG", "JPEG")) as image:
            pixels = np.asarray(image.convert("RGB"))
    except (OSError, ValueError, Image.DecompressionBombError, SyntaxError):
        return None
    scale = 2 if max(pixels.shape) <= 400 else 1
    drawing = overlay(pixels, truth=saved_image.truth, estimate=saved_image.estimate, scale=scale)
    stream = io.BytesIO()
    Image.fromarray(drawing).save(stream, format="JPEG", quality=80)
    return data_url(stream.getvalue(), "jpeg")
