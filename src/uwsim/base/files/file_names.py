"""Names of files made of names that a user gave: of cameras, measures, algorithms.

Such a name may hold anything. Every file of a result that is called after one gets its name here,
so that two names are two files on every system, also where upper and lower case are the same.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable

MAX_NAME_LENGTH = 80
"""So many letters of a name stand in that of a file."""
RESERVED_NAMES = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
"""Names that no file on Windows may have."""
DIGEST_LENGTHS = (8, 16, 32, 64)
"""Digits of a hash that tell two names apart: the first of these that is enough."""


def file_names(names: Iterable[str], *, existing_names: Iterable[str] = ()) -> dict[str, str]:
    """Return name -> name of its file, without suffix; different names have different files.

    A name that is fit for a file is its own. Of others, what is no letter of ASCII, digit, ``_``,
    ``.`` or ``-`` becomes ``_``, and ``:`` a ``.``; what is then not told apart, or was cut, ends
    in digits of its hash. The order of the names makes no difference.

    Args:
        names: All that are to be files of one folder.
        existing_names: Names of files that are there already.
    """
    clean_names = {name: _clean(name) for name in names}
    existing_lower = {name.casefold() for name in existing_names}
    counts = Counter(clean_name.casefold() for clean_name in clean_names.values())
    ambiguous_names = {
        name
        for name, clean_name in clean_names.items()
        if len(name) > MAX_NAME_LENGTH
        or counts[clean_name.casefold()] > 1
        or clean_name.casefold() in existing_lower
    }
    for digits in DIGEST_LENGTHS:
        files = {
            name: _with_hash(clean_name, name, digits) if name in ambiguous_names else clean_name
            for name, clean_name in clean_names.items()
        }
        if len({file.casefold() for file in files.values()} - existing_lower) == len(files):
            return files
    raise AssertionError("equal SHA-256 of different names")


def file_name(name: str) -> str:
    """Return the name of the file of a name that stands alone in its folder."""
    return file_names([name])[name]


def _clean(name: str) -> str:
    clean_name = re.sub(r"[^A-Za-z0-9_.-]", "_", name.replace(":", "."))[:MAX_NAME_LENGTH]
    clean_name = clean_name.lstrip(".-").rstrip(".") or "_"
    return (
        f"_{clean_name}"[:MAX_NAME_LENGTH] if RESERVED_NAMES.fullmatch(clean_name) else clean_name
    )


def _with_hash(clean_name: str, name: str, digits: int) -> str:
    digest = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()
    return f"{clean_name[: MAX_NAME_LENGTH - digits - 1]}-{digest[:digits]}"
