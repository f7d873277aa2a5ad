"""The ``inputs`` of a result: every file that it is made of, by role and name, with its hash.

``benchmark``, ``scene`` and ``plugins`` are name and hash; ``assets`` are what the scene and the
benchmark name: robots, vehicles' parts, models with their materials, buffers and images, data of
currents, the user's own functions, recordings; ``algorithm`` is the source of one's own
``module:Class`` and of what it imports.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

ASSETS = "assets"
"""The role of what scene and benchmark name."""
ALGORITHM = "algorithm"
"""The role of an algorithm's sources."""
SHORT = 12
"""Digits of a hash that are shown to people."""
NAMED = 6
"""So many differences are said one by one."""


def without_algorithm(inputs: Mapping[str, object]) -> dict[str, object]:
    """Return what two algorithms of one experiment have in common."""
    return {role: files for role, files in inputs.items() if role != ALGORITHM}


def files_by_role(inputs: Mapping[str, object]) -> Iterator[tuple[str, str, str]]:
    """Yield role, name and hash of every input, as a result or a unit's file has them."""
    for role, value in inputs.items():
        if isinstance(value, Mapping):
            yield from ((role, str(name), str(digest)) for name, digest in value.items())
        elif isinstance(value, Sequence) and not isinstance(value, str):
            pairs = value if all(_is_pair(each) for each in value) else [value]
            yield from ((role, str(pair[0]), str(pair[1])) for pair in pairs if _is_pair(pair))


def differing(before: Mapping[str, object], now: Mapping[str, object]) -> list[str]:
    """Say which inputs differ, a line each; nothing where all are the same."""
    then, today = ({(r, n): d for r, n, d in files_by_role(each)} for each in (before, now))
    messages = []
    for role, name in dict.fromkeys([*then, *today]):
        old, new = then.get((role, name)), today.get((role, name))
        file = name if role == ASSETS else f"{role} {name}"
        if old is None:
            messages.append(f"{file} was not used then")
        elif new is None:
            messages.append(f"{file} is not used any more")
        elif old != new:
            messages.append(
                f"{file} is another file now ({short_hash(old)} then, {short_hash(new)} now)"
            )
    return (
        messages if len(messages) <= NAMED else [*messages[:NAMED], f"{len(messages) - NAMED} more"]
    )


def short_hash(digest: object) -> str:
    """Return the first digits of a hash."""
    return str(digest).removeprefix("sha256:")[:SHORT]


def _is_pair(value: object) -> bool:
    """Whether it is a name and a hash."""
    return (
        isinstance(value, list | tuple)
        and len(value) == 2
        and all(isinstance(part, str) for part in value)
    )
