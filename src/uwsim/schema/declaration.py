"""Declaration of the fields of a spec: `element` and its options."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import MISSING, dataclass
from typing import Any, Literal, TypedDict, Unpack, get_args


@dataclass(frozen=True)
class Original:
    """How the original reads an element, where that differs from its name and type."""

    aliases: tuple[str, ...] = ()
    """Old names, read with a warning."""
    required: bool = False
    """Its DTD requires the element although it has a default."""
    lenient: bool = False
    """Junk behind a number is a warning, not an error (the original uses atof)."""
    invalid: bool | None = None
    """What a flag that is neither 0 nor 1 is read as; the default when None."""
    clamped: bool = False
    """A number beyond the limits is clamped with a warning: the original has no limits."""
    of_window: bool = False
    """The element concerns the original's window alone: an error in it is a warning here."""


CLAMPED = Original(clamped=True)
"""An element whose number is clamped to its limits: a mass, a size."""
REQUIRED = Original(required=True)
"""An element that the original's DTD requires although it has a default."""


class Limits(TypedDict, total=False):
    """The limits of a number, as `element` takes them."""

    minimum: float
    """Smallest value allowed."""
    maximum: float
    """Largest value allowed."""
    above: float
    """Values must be greater."""
    below: float
    """Values must be less."""


Named = Literal["actuators", "body", "camera", "contacts", "vehicle"]
"""What of a scene a field may name."""


@dataclass(frozen=True)
class Xml:
    """What `element` keeps about a field."""

    name: str | None = None
    attribute: bool = False
    text: bool = False
    namespaced: bool = False
    parts: str = "xyz"
    item: str | None = None
    choice: Mapping[str, type] | None = None
    original: Original = Original()
    refers_to: Named | None = None
    limits: Limits = dataclasses.field(default_factory=Limits)


def element(
    name: str | None = None,
    *,
    default: Any = MISSING,
    attribute: bool = False,
    text: bool = False,
    namespaced: bool = False,
    parts: str = "xyz",
    item: str | None = None,
    choice: Mapping[str, type] | None = None,
    original: Original = Xml.original,
    refers_to: Named | None = None,
    **limits: Unpack[Limits],
) -> Any:
    """Make a dataclass field whose XML form differs from what its name and type imply.

    Args:
        name: of the element or attribute; the field's in camelCase when absent.
        default: when the element is absent or, of the original's, empty.
        attribute: it is an attribute of the element that the spec is read from.
        text: it is the text of the element that the spec is read from.
        namespaced: it is an extension, ``u:name``.
        parts: names of a triple's elements, one letter each.
        item: the element is a list; this is the name of its items.
        choice: name -> spec of the children that the element may contain, in any number; with the
            name "" the element that the spec is read from contains them, each as a field.
        original: how the original reads it.
        refers_to: what of a scene it names (`uwsim.benchmark.unknown_names.LOOK_UP`): a ``body``.
        limits: ``minimum``, ``maximum``, ``above`` and ``below`` of a number.
    """
    if refers_to not in (None, *get_args(Named)):
        raise ValueError(f"refers_to={refers_to!r}: expected one of {', '.join(get_args(Named))}")
    xml = Xml(name, attribute, text, namespaced, parts, item, choice, original, refers_to, limits)
    return dataclasses.field(default=default, metadata={"xml": xml})
