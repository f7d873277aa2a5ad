"""What a room's ``__init__`` lists is what it has."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "src" / "uwsim"
ROOMS = sorted(
    ".".join(["uwsim", *init.parent.relative_to(PACKAGE).parts])
    for init in PACKAGE.rglob("__init__.py")
)


@pytest.mark.parametrize("room", ROOMS)
def test_every_name_a_room_lists_is_there(room: str) -> None:
    module = importlib.import_module(room)
    missing = [name for name in getattr(module, "__all__", []) if not hasattr(module, name)]
    assert missing == []


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_says_what_it_is_for(room: str) -> None:
    doc = importlib.import_module(room).__doc__
    assert doc is not None
    assert doc.splitlines()[0].endswith(".")
