"""The plain format: one line of JSON for each image, and lists of the images of each split."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...results.atomic_file import write_text
from ..request import DatasetRequest
from ..scene_draw import record_line
from ..splits import SPLITS


def write_plain(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write ``labels.jsonl``, and the paths of the images of each split in a text file."""
    lines = [record_line(record) + "\n" for record in records]
    write_text(request.out / "labels.jsonl", "".join(lines))
    for split in SPLITS:
        paths = [f"./{r['files']['images']}\n" for r in records if r["split"] == split]
        write_text(request.out / f"{split}.txt", "".join(paths))
