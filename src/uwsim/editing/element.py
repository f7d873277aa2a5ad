"""Elements of a scene or benchmark that a program changes: `Element` and `ElementList`.

.. code-block:: python

    camera = scene["girona500/bowtech1"]
    camera.resw = 640  # checked like the text of a file
    camera.position = (0.2, 0, 0)
    print(camera.spec)  # the frozen spec, from which the scene is compiled

An element keeps its values. Its spec is made of them when it is read, so that a compiled scene and
a spec never change. Elements stay valid when others are added, removed or renamed.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import MISSING
from typing import Any, Generic, TypeVar, cast, overload

from ..benchmark.plugin_tables import Tables
from ..benchmark.updaters import NoneSpec, SceneUpdaterSpec
from ..errors import BadSetting, UnknownName, did_you_mean, short_repr
from ..schema import Spec, fields_of
from ..topics import InterfaceSpec
from .grammar import Place, default_tables, places_of, value_fields
from .values import check_value

S = TypeVar("S", bound=Spec)
T = TypeVar("T", bound=Spec)


class UnknownField(BadSetting, AttributeError):  # type: ignore[misc]  # both have a `name`
    """An attribute that an element does not have."""


class Element(Generic[S]):
    """An element of a scene or benchmark, with the fields of its spec as attributes.

    A value is checked when it is set: its kind, its limits, its words. `uwsim.schema.fields_of`
    and the reference of the file format describe the fields.
    """

    def __init__(
        self, spec: S, parent: Element[Any] | None = None, tables: Tables | None = None
    ) -> None:
        self._kind = type(spec)
        self._parent = parent
        self._tables = tables or default_tables()
        self._places = places_of(self._kind, self._tables)
        self._fields = value_fields(self._kind, self._tables)
        self._values: dict[str, Any] = {}
        self._take(spec)

    @property
    def spec(self) -> S:
        """The frozen spec with the present values."""
        values = {name: self._frozen_value(name, value) for name, value in self._values.items()}
        return self._kind(**values)

    @spec.setter
    def spec(self, spec: S) -> None:
        if type(spec) is not self._kind:
            raise BadSetting(
                f"{self.label}: spec is {short_repr(spec)}; expected a {self._kind.__name__}."
            )
        self._take(spec)

    def set(self, **values: Any) -> Element[S]:
        """Set several values; none is set if one is invalid.

        Raises:
            BadSetting: a name or a value is invalid.
        """
        self._check_attached()
        checked_values = {name: self._checked_value(name, value) for name, value in values.items()}
        for name, value in checked_values.items():
            self._values[name] = self._wrap(name, value)
        return self

    @overload
    def add(self, kind: T) -> Element[T]: ...

    @overload
    def add(self, kind: str, **values: Any) -> Element[Any]: ...

    def add(self, kind: Spec | str, **values: Any) -> Element[Any]:
        """Add an element, and return it.

        Args:
            kind: the name of the element in a file, as ``virtualCamera``, or a spec.
            values: the values of the new element, by name, if ``kind`` is a name.

        Raises:
            UnknownName: there is no such element here.
            BadSetting: a value is invalid or missing, or there is such an element already.
        """
        place, spec_kind = self._find_place(kind)
        if isinstance(kind, str):
            spec: Spec = make_spec(spec_kind, values, self._tables, f"{self._prefix}{kind}")
        else:
            spec = kind
        if place.is_list:
            return cast(ElementList[Any], self._values[place.name]).append(spec)
        current = self._values[place.name]
        is_updater = current is not None and issubclass(current._kind, SceneUpdaterSpec)
        if is_updater and current._kind is not NoneSpec:  # the new one is nested in the innermost
            return cast(Element[Any], current.add(spec))
        if current is not None and not is_updater:
            raise BadSetting(f"{self._prefix}{place.name} exists already; change its values.")
        self._values[place.name] = new_element = Element(spec, self, self._tables)
        return new_element

    @property
    def label(self) -> str:
        """The path of the element in messages, such as ``girona500/bowtech1``."""
        parent = self._parent
        if parent is None:
            return f"the {self._kind.__name__.removesuffix('Spec').lower()}"
        return parent._prefix + parent._key_of(self)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._values:
            return self._values[name]
        raise self._unknown_field(name)

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_") or name == "spec":
            object.__setattr__(self, name, value)
        else:
            self.set(**{name: value})

    def __delattr__(self, name: str) -> None:
        if name.startswith("_"):
            object.__delattr__(self, name)
            return
        if name not in self._values:
            raise self._unknown_field(name)
        raise BadSetting(f"{self.label}: {name} cannot be deleted; set another value.")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._fields, *self._places})

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Element):
            return NotImplemented
        return bool(self.spec == other.spec)

    __hash__ = None  # type: ignore[assignment]  # an element changes

    def __repr__(self) -> str:
        return f"<{self._kind.__name__.removesuffix('Spec')} {self.label}>"

    @property
    def _prefix(self) -> str:
        return "" if self._parent is None else f"{self.label}/"

    def _children(self) -> Iterator[Element[Any]]:
        """Yield the elements in this one."""
        for value in self._values.values():
            if isinstance(value, Element):
                yield value
            elif isinstance(value, ElementList):
                yield from value

    def _check_attached(self) -> None:
        """Raise BadSetting if the element, or one that contains it, was removed."""
        parent = self._parent
        if parent is None:
            return
        if not any(child is self for child in parent._children()):
            raise BadSetting(
                f"The {self._kind.__name__.removesuffix('Spec')} {name_of(self) or 'element'!r} "
                f"was removed from {parent.label}; its values cannot be set."
            )
        parent._check_attached()

    def _take(self, spec: S) -> None:
        """Take all values of a spec."""
        for field in dataclasses.fields(spec):
            if field.init:
                self._values[field.name] = self._wrap(field.name, getattr(spec, field.name))

    def _wrap(self, name: str, value: Any) -> Any:
        """Return specs as elements; other values as they are."""
        place = self._places.get(name)
        if place is None or value is None:
            return value
        if place.is_list:
            return ElementList(value, self, place)
        return Element(value, self, self._tables)

    def _frozen_value(self, name: str, value: Any) -> Any:
        if isinstance(value, ElementList):
            return self._places[name].sort(tuple(element.spec for element in value))
        return value.spec if isinstance(value, Element) else value

    def _checked_value(self, name: str, value: Any) -> Any:
        """Return a value, or specs, for a field; raise BadSetting if it is invalid."""
        if name in self._places:
            return _checked_specs(self._places[name], value, f"{self._prefix}{name}")
        if name not in self._fields:
            raise self._unknown_field(name)
        try:
            return check_value(self._kind, self._fields[name], value)
        except BadSetting as error:
            raise BadSetting(f"{self.label}: {error}") from None

    def _find_place(self, kind: Spec | str) -> tuple[Place, type]:
        """Return the field that contains elements of a kind, and the class of their specs."""
        matches = []
        for place in self._places.values():
            for tag, spec_kind in place.kinds.items():
                name = kind.removeprefix("u:") if isinstance(kind, str) else None
                if tag == name or (name is None and spec_kind is type(kind)):
                    matches.append((place, spec_kind))
        if len(matches) == 1:
            return matches[0]
        name = kind if isinstance(kind, str) else type(kind).__name__
        if matches:
            names = " or ".join(place.name for place, _ in matches)
            raise BadSetting(f"{self.label}: {name} may be {names}; set that attribute.")
        tags = [tag for place in self._places.values() for tag in place.kinds]
        raise UnknownName(f"element of {self.label}", name, tags)

    def _key_of(self, child: Element[Any]) -> str:
        """Return the last part of the path of a child: its name, or its field."""
        for name, value in self._values.items():
            if value is child:
                return name
            if isinstance(value, ElementList):
                for index, element in enumerate(value, start=1):
                    if element is child:
                        return name_of(child) or f"{name}[{index}]"
        return name_of(child) or "(removed)"

    def _unknown_field(self, name: str) -> UnknownField:
        names = [*self._fields, *self._places]
        by_label = {field.label.removeprefix("u:"): field.name for field in self._fields.values()}
        near = f" Did you mean {by_label[name]!r}?" if name in by_label else ""
        return UnknownField(
            f"{self.label} has no {name!r}.{near or did_you_mean(name, names)} "
            f"There are: {', '.join(names)}."
        )


class ElementList(Sequence[Element[S]]):
    """The elements of a list, such as the vehicles of a scene: by index, or by name."""

    def __init__(self, specs: Iterable[S], owner: Element[Any], place: Place) -> None:
        self._owner, self._place = owner, place
        self._elements = [Element(spec, owner, owner._tables) for spec in specs]

    def append(self, spec: S) -> Element[S]:
        """Add a spec at the end, and return its element.

        Raises:
            BadSetting: there is an element of that name already.
        """
        (new_spec,) = _checked_specs(
            self._place, (spec,), f"{self._owner._prefix}{self._place.name}"
        )
        element = Element(cast(S, new_spec), self._owner, self._owner._tables)
        names = [name_of(other) for other in self._owner._children()]
        if (name := name_of(element)) and name in names:
            raise BadSetting(f"{self._owner.label} has {name!r} already; names are unique.")
        self._elements.append(element)
        return element

    def remove(self, element: Element[S] | str) -> None:
        """Remove an element, or the element of that name."""
        target = self[element] if isinstance(element, str) else element
        self._elements = [other for other in self._elements if other is not target]

    @property
    def names(self) -> list[str]:
        """The names of the elements that have one."""
        return [name for name in map(name_of, self._elements) if name]

    @overload
    def __getitem__(self, key: int | str) -> Element[S]: ...

    @overload
    def __getitem__(self, key: slice) -> list[Element[S]]: ...

    def __getitem__(self, key: int | str | slice) -> Element[S] | list[Element[S]]:
        if not isinstance(key, str):
            return self._elements[key]
        for element in self._elements:
            if name_of(element) == key:
                return element
        raise UnknownName(f"element of {self._place.name}", key, self.names)

    def __len__(self) -> int:
        return len(self._elements)

    def __iter__(self) -> Iterator[Element[S]]:
        return iter(self._elements)

    def __contains__(self, element: object) -> bool:
        if isinstance(element, str):
            return element in self.names
        return any(other is element for other in self._elements)

    def __repr__(self) -> str:
        return repr(self._elements)


def name_of(element: Element[Any]) -> str:
    """Return the name of an element; empty if it has none, as an interface, which names others."""
    name = element._values.get("name")
    return name if isinstance(name, str) and not issubclass(element._kind, InterfaceSpec) else ""


def make_spec(kind: type[Spec], values: dict[str, Any], tables: Tables, label: str) -> Spec:
    """Make a spec from values; raise BadSetting for an invalid, unknown or missing value."""
    places, fields = places_of(kind, tables), value_fields(kind, tables)
    checked_values: dict[str, Any] = {}
    for name, value in values.items():
        if name in places:
            checked_values[name] = _checked_specs(places[name], value, f"{label}/{name}")
        elif name in fields:
            try:
                checked_values[name] = check_value(kind, fields[name], value)
            except BadSetting as error:
                raise BadSetting(f"{label}: {error}") from None
        else:
            raise BadSetting(
                f"{label} has no {name!r}.{did_you_mean(name, [*fields, *places])} "
                f"There are: {', '.join([*fields, *places])}."
            )
    missing_names = [
        field.name
        for field in fields_of(kind)
        if field.default is MISSING and field.name not in checked_values
    ]
    if missing_names:
        raise BadSetting(f"{label} lacks {', '.join(missing_names)}.")
    return kind(**checked_values)


def _checked_specs(place: Place, value: Any, label: str) -> Any:
    """Return specs for a field that contains specs; raise BadSetting for anything else."""
    if value is None and place.is_optional:
        return None
    if not place.is_list:
        return _checked_spec(place, value, label)
    if isinstance(value, str | bytes) or not isinstance(value, Iterable):
        raise BadSetting(f"{label} is {short_repr(value)}; expected a list of specs.")
    return tuple(_checked_spec(place, item, label) for item in value)


def _checked_spec(place: Place, value: Any, label: str) -> Spec:
    spec = value.spec if isinstance(value, Element) else value
    if type(spec) not in place.kinds.values():
        names = list(dict.fromkeys(kind.__name__ for kind in place.kinds.values()))
        near = did_you_mean(type(spec).__name__, names)
        expected = f"one of {len(names)} kinds of specs" if len(names) > 5 else " or ".join(names)
        text_fields = [f for kind in place.kinds.values() for f in fields_of(kind) if f.xml.text]
        if isinstance(value, str) and len(names) == len(text_fields) == 1:
            near = f" A text is set as {label}.{text_fields[0].name}."
        raise BadSetting(f"{label} is {short_repr(value)}; expected {expected}.{near}")
    return cast(Spec, spec)
