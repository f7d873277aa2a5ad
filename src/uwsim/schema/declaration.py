"""Declaration of the fields of a spec: `element` and its options."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import MISSING, dataclass
from typing import Any, Literal, TypedDict, Unpack, get_args

from ..base.deprecation import renamed_parameters


@dataclass(frozen=True)
class Original:
    """The way UWSim (C++), the original, reads an element, if name and type do not imply it."""

    aliases: tuple[str, ...] = ()
    """The old names of the element, which are read with a warning."""
    is_required: bool = False
    """True if the original's DTD requires the element although it has a default."""
    allows_trailing_text: bool = False
    """True if text after a number is a warning, not an error (the original uses ``atof``)."""
    invalid_flag_value: bool | None = None
    """The value of a flag whose text is neither 0 nor 1; None: the default of the field."""
    is_clamped: bool = False
    """True if a number beyond the limits is clamped with a warning. The original has no limits."""
    is_window_setting: bool = False
    """True if the element affects the original's window only; an error in it is a warning here."""
    used_by: str = ""
    """The qualified name of the sibling that uses a window setting; beside it errors are errors."""


CLAMPED_NUMBER = Original(is_clamped=True)
"""The option of an element whose number is clamped to its limits: a mass, a size."""
REQUIRED_BY_DTD = Original(is_required=True)
"""The option of an element that the original's DTD requires although it has a default."""


class Limits(TypedDict, total=False):
    """The limits of a number, or of numbers, as keyword arguments of `element`."""

    minimum: float
    """The smallest value allowed."""
    maximum: float
    """The largest value allowed."""
    exclusive_minimum: float
    """The limit that values must exceed."""
    exclusive_maximum: float
    """The limit that values must be less than."""
    max_count: int
    """The greatest count of numbers in one element, if it is not `uwsim.schema.values.MAX_NUMBERS`.
    """


ReferenceKind = Literal["actuators", "body", "camera", "contacts", "course", "joint", "vehicle"]
"""The kinds of parts of a scene that a field may name."""


@dataclass(frozen=True)
class XmlOptions:
    """The options of a field: the arguments of `element`, which describes them."""

    name: str | None = None
    attribute: bool = False
    text: bool = False
    namespaced: bool = False
    parts: str = "xyz"
    item: str | None = None
    choice: Mapping[str, type] | None = None
    original: Original = Original()
    refers_to: ReferenceKind | None = None
    limits: Limits = dataclasses.field(default_factory=Limits)


@renamed_parameters(above="exclusive_minimum", below="exclusive_maximum")
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
    original: Original = XmlOptions.original,
    refers_to: ReferenceKind | None = None,
    **limits: Unpack[Limits],
) -> Any:
    """Make a dataclass field whose XML form differs from what its name and type imply.

    Args:
        name: the name of the element or attribute; None: the name of the field in camelCase.
        default: the value when the element is absent or, for the original's elements, empty.
        attribute: the field is an attribute of the element that the spec is read from.
        text: the field is the text of the element that the spec is read from.
        namespaced: the element is an extension, ``u:name``.
        parts: the names of a triple's elements, one letter each.
        item: the name of the items of an element that is a list.
        choice: the spec of each child that the element may contain, in any number, by the child's
            name. If ``name`` is empty, the children are in the element that the spec is read from.
        original: how the original reads the element.
        refers_to: the kind of part of a scene that the field names, such as ``body``
            (`uwsim.benchmark.unknown_names.RESOLVERS`).
        limits: the limits of a number or of numbers, as in `Limits`.
    """
    if refers_to not in (None, *get_args(ReferenceKind)):
        raise ValueError(
            f"refers_to={refers_to!r}: expected one of {', '.join(get_args(ReferenceKind))}"
        )
    xml = XmlOptions(
        name, attribute, text, namespaced, parts, item, choice, original, refers_to, limits
    )
    return dataclasses.field(default=default, metadata={"xml": xml})
