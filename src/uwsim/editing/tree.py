"""The tree of elements: search by path, references between elements, renaming."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from ..benchmark.measures import MeasureSpec
from ..errors import BadSetting, UnknownName
from ..schema import Field, Spec
from ..topics import InterfaceSpec
from .element import Element, ElementList, name_of

T = TypeVar("T", bound=Spec)
MAX_NAMED = 5
"""The greatest number of references that an error names."""
REFERENCE_FIELDS = frozenset(
    {
        *("body", "camera", "camera_name", "from_", "ground", "jaw", "object_to_track"),
        *("target", "to", "vehicle", "vehicle_name"),
    }
)
"""The fields whose text may be the name of another element, besides those with ``refers_to``."""
EXPRESSION_FIELDS = frozenset({"reference", "reward", "success", "text"})
"""The fields whose text has names of measures."""


@dataclass(frozen=True)
class Reference:
    """A text of an element that names another element."""

    element: Element[Any]
    """The element with the reference."""
    field: str
    """The name of the field."""
    new_text: str
    """The text after the renaming."""

    def __str__(self) -> str:
        return f"{self.element.label}: {self.field}"


def walk(element: Element[Any]) -> Iterator[Element[Any]]:
    """Yield an element and all elements in it, in the order of a file."""
    yield element
    for value in element._values.values():
        if isinstance(value, Element):
            yield from walk(value)
        elif isinstance(value, ElementList):
            for child in value:
                yield from walk(child)


def find_element(root: Element[Any], path: str) -> Element[Any]:
    """Return the element at a path of names and fields, as ``girona500/bowtech1``.

    Raises:
        UnknownName: there is no such element; the error lists valid names.
    """
    element = root
    for key in path.split("/"):
        children = child_elements(element)
        if key not in children:
            raise UnknownName(f"element of {element.label}", key, children)
        element = children[key]
    return element


def child_elements(element: Element[Any]) -> dict[str, Element[Any]]:
    """Return the children of an element by their keys in a path; names take precedence."""
    by_name: dict[str, Element[Any]] = {}
    fields: dict[str, Element[Any]] = {}
    for name, value in element._values.items():
        if isinstance(value, Element):
            fields[name] = value
        elif isinstance(value, ElementList):
            for index, child in enumerate(value, start=1):
                if key := name_of(child):
                    by_name.setdefault(key, child)
                else:
                    fields[f"{name}[{index}]"] = child
    return {**fields, **by_name}


def references_to(
    root: Element[Any], path: str, new_name: str, scene: Element[Any] | None = None
) -> list[Reference]:
    """Return the references to the named element at a path, with their text for a new name.

    A reference is the name itself, the path, or a path that begins with either. The name of a part
    that another vehicle has, too, is no reference unless the vehicle precedes it.

    Args:
        root: the scene or benchmark that is searched.
        path: the path of the named element.
        new_name: the new name.
        scene: the scene or benchmark with the named element; None: ``root``.
    """
    home = root if scene is None else scene
    old_name = path.rpartition("/")[2]
    names = {path: path.removesuffix(old_name) + new_name}
    if issubclass(find_element(home, path)._kind, MeasureSpec):
        return [
            Reference(element, field, new_text)
            for element, field, text in _texts(root)
            if field in EXPRESSION_FIELDS
            if (new_text := re.sub(rf"\b{re.escape(old_name)}\b", new_name, text)) != text
        ]
    if sum(name_of(element) == old_name for element in walk(home)) <= 1:
        names[old_name] = new_name
    return [
        Reference(element, field, new_text)
        for element, field, text in _texts(root)
        if _may_refer(element, element._fields[field])
        if (new_text := (_rename_in_path if field == "path" else _rename_in_text)(text, names))
        != text
    ]


def _texts(root: Element[Any]) -> Iterator[tuple[Element[Any], str, str]]:
    """Yield every text in a tree with its element and the name of its field."""
    for element in walk(root):
        for name in element._fields:
            if isinstance(text := element._values[name], str):
                yield element, name, text


def _may_refer(element: Element[Any], field: Field) -> bool:
    """Return whether the text of a field may be the name of another element."""
    if field.name == "name":
        return issubclass(element._kind, InterfaceSpec)
    is_variation = field.name == "path" and "low" in element._fields
    return field.name in REFERENCE_FIELDS or field.xml.refers_to is not None or is_variation


def _rename_in_text(text: str, names: dict[str, str]) -> str:
    for old_name, new_name in names.items():
        if text == old_name or text.startswith((f"{old_name}/", f"{old_name}@")):
            return new_name + text[len(old_name) :]
    return text


def _rename_in_path(text: str, names: dict[str, str]) -> str:
    """Return the path of a variation, ``vehicle[old].virtualCamera[old].std``, with new names."""
    for old_name, new_name in names.items():
        vehicle, _, old_key = old_name.rpartition("/")
        old_text, new_text = f"[{old_key}]", f"[{new_name.rpartition('/')[2]}]"
        head, dot, rest = text.partition(".")
        if not vehicle:
            text = head.replace(old_text, new_text) + dot + rest
        elif head in ("vehicle", f"vehicle[{vehicle}]"):
            text = head + dot + rest.replace(old_text, new_text, 1)
    return text


def check_name(root: Element[Any], path: str, new_name: str) -> Element[Any]:
    """Return the element to rename; raise BadSetting if it has no name, or the name is taken."""
    element = find_element(root, path)
    if not name_of(element):
        raise BadSetting(f"{element.label} has no name to change.")
    parent = element._parent
    assert parent is not None
    if new_name in child_elements(parent) and new_name != name_of(element):
        raise BadSetting(f"{parent.label} has {new_name!r} already; names are unique.")
    return element


def rename_element(element: Element[Any], new_name: str, references: Sequence[Reference]) -> None:
    """Set the name of an element, and the text of all references to it."""
    element.set(name=new_name)
    for reference in references:
        reference.element.set(**{reference.field: reference.new_text})


def remove_element(element: Element[Any]) -> None:
    """Remove an element from its list, or set the field that may be absent to None."""
    parent = element._parent
    if parent is None:
        raise BadSetting(f"{element.label} cannot be removed.")
    for name, value in parent._values.items():
        if isinstance(value, ElementList) and element in value:
            value.remove(element)
            return
        if value is element:
            parent.set(**{name: None})
            return


def typed_element(root: Element[Any], path: str, kind: type[T]) -> Element[T]:
    """Return the element at a path; raise BadSetting if its spec is of another kind."""
    element = find_element(root, path)
    if element._kind is not kind:
        raise BadSetting(f"{element.label} is a {element._kind.__name__}, not a {kind.__name__}.")
    return cast(Element[T], element)


def copy_element(root: Element[Any], path: str, new_name: str) -> Element[Any]:
    """Add a copy with another name to the list that contains the element, and return it."""
    element = check_name(root, path, new_name)
    assert element._parent is not None
    new_spec = element.spec
    checked_name = element._checked_value("name", new_name)
    return element._parent.add(dataclasses.replace(new_spec, name=checked_name))


def remove_with_references(root: Element[Any], path: str, *, with_references: bool) -> None:
    """Remove the element at a path, and those that name it if ``with_references``.

    Raises:
        UnknownName: there is no such element.
        BadSetting: other elements name it; the error lists them.
    """
    element = find_element(root, path)
    inner_ids = {id(part) for part in walk(element)}
    references: list[Reference] = []
    for part in walk(element):
        if name_of(part):
            references += references_to(root, part.label, f"{name_of(part)}~")
    outer_references = {
        id(reference.element): reference
        for reference in references
        if id(reference.element) not in inner_ids
    }
    unresolved_references = [
        entry for entry in outer_references.values() if not with_references or not _is_listed(entry)
    ]
    if unresolved_references:
        names = ", ".join(map(str, unresolved_references[:MAX_NAMED]))
        hint = "" if with_references else " Change them first, or use with_references=True."
        raise BadSetting(f"{element.label} is named by {names}.{hint}")
    for reference in outer_references.values():
        remove_element(reference.element)
    remove_element(element)


def _is_listed(reference: Reference) -> bool:
    """Return whether the element of a reference is in a list, so that it can be removed."""
    parent = reference.element._parent
    lists = [] if parent is None else parent._values.values()
    return any(isinstance(value, ElementList) and reference.element in value for value in lists)
