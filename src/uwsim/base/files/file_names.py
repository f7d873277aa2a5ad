"""File names for names that a user chose, of cameras, measures or algorithms.

Such a name may contain any character. The files of a result get their names from here, so that two
names have two files on every system, also if it does not distinguish upper and lower case.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable

MAX_NAME_LENGTH = 80
"""The greatest length of a file name [characters]."""
RESERVED_NAMES = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
"""The file names that Windows does not allow."""
DIGEST_LENGTHS = (8, 16, 32, 64)
"""The possible numbers of digits of a hash; the first that distinguishes all names is used."""


def file_names(names: Iterable[str], *, existing_names: Iterable[str] = ()) -> dict[str, str]:
    """Return the file name, without suffix, of each name; different names have different files.

    A name that is a valid file name is not changed. In other names ``:`` becomes ``.``, and every
    character that is not an ASCII letter, digit, ``_``, ``.`` or ``-`` becomes ``_``. Names that
    are then equal or too long end in digits of their hash. The order of the names has no effect.

    Args:
        names: the names of all files of one folder.
        existing_names: the names of existing files.
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
    """Return the file name of a name, if no other name has a file in the same folder."""
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
