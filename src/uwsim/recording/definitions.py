"""Definitions of the messages that are recorded: those of ROS 2 (Jazzy), and ours."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from .. import messages

TEXTS = Path(messages.__file__).parent / "msg"
"""Folder of the ``.msg`` files of types that ROS 2 does not ship."""


@functools.cache
def definitions() -> Any:
    """Return the type store of rosbags with all message types of `uwsim.messages`."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for path in sorted(TEXTS.glob("*.msg")):
        name = str(getattr(getattr(messages, path.stem), "__msgtype__", ""))
        if name not in store.types:
            store.register(get_types_from_msg(path.read_text(encoding="utf-8"), name))
    return store


def message_type_name(type: type) -> str | None:
    """Return ``package/msg/Name`` of a message class; None if it has no definition."""
    name = getattr(type, "__msgtype__", None)
    return name if name in definitions().types else None
