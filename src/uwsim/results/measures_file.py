"""``measures.json``: a description of each measure of a result.

.. code-block:: json

    {"corners": {"meaning": "distance between truth g and estimate e", "value": "mean"}}

``meaning`` is the first line of the measure's docstring, ``value`` the statistic that the benchmark
file sets (``u:value``). Reports use it for captions. Results of earlier versions have no such file.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from .atomic_file import write_text

FILE = "measures.json"
MAX_BYTES = 1_000_000
"""The greatest size of a file that is read [bytes]."""
MAX_MEANING = 300
"""The greatest number of characters of a meaning that are read."""


@dataclass(frozen=True, kw_only=True)
class MeasureNote:
    """The description of a measure."""

    meaning: str
    """A noun phrase without a full stop; empty if the measure has no docstring."""
    value: str
    """The statistic that is the value of the measure: ``last``, ``mean``, ``rms`` or ``max``."""


def save_measures(notes: Mapping[str, MeasureNote], directory: Path) -> None:
    """Write the file into a result directory."""
    texts = {name: asdict(note) for name, note in notes.items()}
    write_text(directory / FILE, json.dumps(texts, indent=2, ensure_ascii=False) + "\n")


def remove_meanings(text: str) -> str:
    """Return the text of a file without its meanings, whose words may change with the version."""
    try:
        notes = json.loads(text)
        return json.dumps({name: {**note, "meaning": ""} for name, note in notes.items()}, indent=2)
    except (ValueError, RecursionError, AttributeError, TypeError):
        return text


def load_measures(directory: Path) -> dict[str, MeasureNote]:
    """Read the file; return an empty dict if the file does not exist or is damaged."""
    try:
        if (directory / FILE).stat().st_size > MAX_BYTES:
            return {}
        texts = json.loads((directory / FILE).read_text(encoding="utf-8"))
        return {
            str(name): MeasureNote(
                meaning=str(note["meaning"])[:MAX_MEANING], value=str(note["value"])
            )
            for name, note in texts.items()
        }
    except (OSError, ValueError, RecursionError, AttributeError, KeyError, TypeError):
        return {}
