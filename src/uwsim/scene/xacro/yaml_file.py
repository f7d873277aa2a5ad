"""YAML files of properties, read by ``xacro.load_yaml``."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...base.files.input_files import read_bytes
from ...errors import AssetError
from .expression import CONSTANTS, evaluate
from .value import ExpressionError, Value, checked

MAX_BYTES = 1 << 20
"""Largest file that is read."""
UNITS: dict[str, float] = {
    "!radians": 1.0,
    "!degrees": math.pi / 180.0,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}
"""Tag of a number -> its unit [rad or m]."""


def read_yaml(path: Path, *, name: str) -> Value:
    """Return the lists, dictionaries, numbers and texts in a YAML file.

    Args:
        path: the file.
        name: what it is called by the file that names it.

    Raises:
        ExpressionError: it cannot be read, is no YAML, or has aliases, which can make a small file
            large.
    """
    from ruamel.yaml import YAML
    from ruamel.yaml.constructor import SafeConstructor
    from ruamel.yaml.error import YAMLError
    from ruamel.yaml.events import AliasEvent

    class Constructor(SafeConstructor):
        """Reads numbers with units, too."""

    for tag, unit in UNITS.items():
        Constructor.add_constructor(tag, _number_with_unit(unit))
    try:
        data = read_bytes(path, name=name, at_most=MAX_BYTES)
        yaml = YAML(typ="safe", pure=True)
        if any(isinstance(event, AliasEvent) for event in yaml.parse(data)):
            raise ExpressionError(f"{path}: an alias (*name) is not read")
        yaml = YAML(typ="safe", pure=True)
        yaml.Constructor = Constructor
        return checked(yaml.load(data))
    except (OSError, AssetError) as error:
        raise ExpressionError(f"{path}: cannot be read: {str(error)[:200]}") from None
    except (YAMLError, ValueError, RecursionError) as error:
        lines = [line.strip() for line in str(error).splitlines() if line.strip()]
        raise ExpressionError(f"{path}: not YAML: {'; '.join(lines[:3])[:200]}") from None


def _number_with_unit(unit: float) -> Callable[[Any, Any], float]:
    def number(_constructor: Any, node: Any) -> float:
        value = evaluate(str(node.value), lambda name: CONSTANTS[name])
        if not isinstance(value, int | float):
            raise ExpressionError(f"{node.tag} {str(node.value)[:40]!r} is no number")
        return float(value) * unit

    return number
