"""One line about a thing that has a name: from its docstring, or the comment at its file's head."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType


def family(table: Mapping[str, type]) -> dict[str, str]:
    """Describe a family by the first line of each member's module: there it says what it is.

    A plugin may have several members in its one module, so they are described by their own.
    """
    return {
        name: first_line(spec.__doc__ if is_of_a_plugin(spec) else module_of(spec).__doc__)
        for name, spec in table.items()
    }


def is_of_a_plugin(spec: type) -> bool:
    """Tell whether a class came with ``--plugin``."""
    from ...benchmark.plugin import MODULE_PREFIX

    return spec.__module__.startswith(MODULE_PREFIX)


def module_of(spec: type) -> ModuleType:
    """Return the module of a class."""
    return sys.modules[spec.__module__]


def without_title(line: str) -> str:
    """``Distance: how far a body went.`` becomes ``How far a body went.``."""
    text = line.partition(": ")[2] or line
    return text[:1].upper() + text[1:]


def first_line(doc: str | None) -> str:
    """Return the first line of a docstring without its marks of code."""
    return (doc or "").strip().split("\n")[0].replace("``", "")


def head_comment(path: Path) -> str:
    """Return the first sentence of the comment at the head of an XML file."""
    text = path.read_text(encoding="utf-8")
    comment = re.search(r"<!--(.*?)-->", text, re.DOTALL)
    words = " ".join(comment[1].split()) if comment else ""
    return re.split(r"(?<=\.)\s", words)[0]
