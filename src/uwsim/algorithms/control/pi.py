"""``pi``: proportional and integral station keeping over an ESM tracker."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from .controller import ControllerNode


class PI(ControllerNode):
    """Proportional and integral control over the ESM tracker: a steady current leaves no offset."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**ControllerNode.PARAMETERS, "ki": 0.04}
