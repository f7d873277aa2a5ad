"""``p``: proportional station keeping with an ESM tracker."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from .controller import ControllerNode


class P(ControllerNode):
    """A proportional controller with ESM: a steady current c [m/s] leaves the offset c/kp [m]."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        name: value for name, value in ControllerNode.PARAMETERS.items() if name != "ki"
    } | {"kp": 0.4}

    def _number(self, name: str) -> float:
        return 0.0 if name == "ki" else super()._number(name)
