"""The rules for names."""

from __future__ import annotations

import re
from functools import cache

from .words import (
    BAD_PREFIXES,
    FORMATS,
    FUNCTION_TERMS,
    VERBS,
    WEAK_CONSTANTS,
    word_class,
)

HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


@cache
def split_words(name: str) -> tuple[str, ...]:
    """Split a name in snake case or camel case into lower-case words."""
    parts = HUMP.sub("_", name.strip("_")) if not name.isupper() else name.strip("_")
    words = (word.rstrip("0123456789") for word in parts.lower().split("_"))
    return tuple(word for word in words if word)


@cache
def name_fault(kind: str, name: str) -> str | None:
    """Return why a name violates the rule of its kind, or None.

    Args:
        kind: function, class, constant, variable or member (of an enumeration, never at fault).
        name: the name, without its scope.
    """
    words = split_words(name)
    is_symbol = len(name.strip("_0123456789")) < 2
    if (
        kind == "member"
        or not words
        or is_symbol
        or name in ("self", "cls")
        or name.startswith("__")
    ):
        return None
    if len(words) > 1:
        return _prefix_fault(words) if kind in ("function", "constant") else None
    (word,) = words
    if kind == "function" and (word in VERBS or word in FUNCTION_TERMS):
        return None
    if kind == "constant" and word in WEAK_CONSTANTS:
        return f"{word!r} does not state what the constant is"
    title = word_class(word)
    is_protocol = kind == "class" and word.endswith("able")  # Hashable, Iterable
    if title is None or is_protocol:
        return None
    article = "an" if title[0] in "aeiou" else "a"
    return f"{word!r} is {article} {title}; name what it is"


def _prefix_fault(words: tuple[str, ...]) -> str | None:
    """Return why the first of several words violates the rule, or None."""
    if words[0] in BAD_PREFIXES or (words[0] == "as" and words[-1] not in FORMATS):
        return f"begins with {words[0]!r}; begin with a verb or a noun"
    return None
