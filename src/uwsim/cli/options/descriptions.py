"""One-line descriptions of elements and files, from docstrings and head comments."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType


def describe_family(table: Mapping[str, type]) -> dict[str, str]:
    """Return a description of each element: the first line of the docstring of its module.

    A plugin may define several elements in one module, so it is the docstring of the class.
    """
    return {
        name: first_line(spec.__doc__ if is_plugin_class(spec) else find_module(spec).__doc__)
        for name, spec in table.items()
    }


def is_plugin_class(spec: type) -> bool:
    """Return whether a class comes from ``--plugin``."""
    from ...benchmark.plugin import MODULE_PREFIX

    return spec.__module__.startswith(MODULE_PREFIX)


def find_module(spec: type) -> ModuleType:
    """Return the module of a class."""
    return sys.modules[spec.__module__]


def remove_title(line: str) -> str:
    """Convert ``Distance: the path of a body.`` to ``The path of a body.``."""
    text = line.partition(": ")[2] or line
    return text[:1].upper() + text[1:]


def first_line(doc: str | None) -> str:
    """Return the first line of a docstring, without the marks of code."""
    return (doc or "").strip().split("\n")[0].replace("``", "")


def head_comment(path: Path) -> str:
    """Return the first sentence of the comment at the head of an XML file."""
    text = path.read_text(encoding="utf-8")
    comment = re.search(r"<!--(.*?)-->", text, re.DOTALL)
    words = " ".join(comment[1].split()) if comment else ""
    return re.split(r"(?<=\.)\s", words)[0]
