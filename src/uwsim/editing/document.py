"""What a scene and a benchmark that a program changes have in common: `Document`."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeVar

from ..errors import BadSetting
from ..schema import Spec
from .element import Element
from .tree import copy_element, find_element, typed_element

S = TypeVar("S", bound=Spec)
T = TypeVar("T", bound=Spec)


class Document(Element[S]):
    """The root element of a file; ``document["a/b"]`` is the element at a path of names."""

    def __getitem__(self, path: str) -> Element[Any]:
        return find_element(self, path)

    def find(self, path: str, kind: type[T]) -> Element[T]:
        """Return the element at a path, whose spec is of a kind that type checkers know.

        Raises:
            UnknownName: there is no element at the path.
            BadSetting: the element is of another kind.
        """
        return typed_element(self, path, kind)

    def copy(self, path: str, new_name: str) -> Element[Any]:
        """Add a copy of the element at a path, and return it; interfaces to it are not copied."""
        return copy_element(self, path, new_name)

    def folders(self, data_path: Sequence[str | Path] = ()) -> tuple[Path, ...]:
        """Return the folders in which files are searched, if the file is written elsewhere."""
        from ..assets.find import parent_folders

        named_by = Path(self.path) if self.path else None
        return (*parent_folders(named_by), *(Path(folder) for folder in data_path))


def write_document(path: Path, text: str) -> None:
    """Write the text of a file.

    Raises:
        BadSetting: the folder does not exist, or the path is that of a folder.
    """
    from ..results.atomic_file import write_text

    if path.is_dir():
        raise BadSetting(f"{path} is a folder; expected the path of a file.")
    if not path.parent.is_dir():
        raise BadSetting(f"{path}: there is no folder {str(path.parent)!r}.")
    write_text(path, text)


def check_equal(spec: Spec, read_spec: Spec) -> None:
    """Raise BadSetting if the spec of a written text is another one."""
    for field in dataclasses.fields(spec):
        if field.compare and getattr(spec, field.name) != getattr(read_spec, field.name):
            raise BadSetting(f"{field.name} has a value that a file cannot contain.")
