"""The types of the attributes of `Scene` and `Benchmark`, for type checkers.

A class states an attribute by an annotation alone: ``vehicles: Parts[VehicleSpec]``. The value
comes from `Element`. An attribute is read as an element and set by a spec, too.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Generic, Protocol, TypeVar

from ..schema import Spec
from .element import Element, ElementList

S = TypeVar("S", bound=Spec)


class Part(Protocol, Generic[S]):
    """An element that is always there."""

    def __get__(self, owner: object, kind: type | None = None) -> Element[S]: ...

    def __set__(self, owner: object, value: S | Element[S]) -> None: ...


class OptionalPart(Protocol, Generic[S]):
    """An element, or None."""

    def __get__(self, owner: object, kind: type | None = None) -> Element[S] | None: ...

    def __set__(self, owner: object, value: S | Element[S] | None) -> None: ...


class Parts(Protocol, Generic[S]):
    """A list of elements."""

    def __get__(self, owner: object, kind: type | None = None) -> ElementList[S]: ...

    def __set__(self, owner: object, value: Iterable[S | Element[S]]) -> None: ...
