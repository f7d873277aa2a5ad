"""``pi``: proportional and integral station keeping with an ESM tracker."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from .controller import ControllerNode


class PI(ControllerNode):
    """A proportional-integral controller with the ESM tracker: no offset in a steady current."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {**ControllerNode.PARAMETERS, "ki": 0.04}
