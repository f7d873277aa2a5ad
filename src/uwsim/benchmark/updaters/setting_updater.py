"""u:settingUpdater: a number of the scene file that increases from level to level.

.. code-block:: xml

    <u:settingUpdater>
      <path>object[pipe].course.buriedShare</path>
      <initialValue>0</initialValue> <finalValue>0.4</finalValue> <step>0.1</step>
      <interval>90</interval>
    </u:settingUpdater>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...world import Stage
from .sweep import Setter, SweepSpec, step_values


@dataclass(frozen=True, kw_only=True)
class SettingUpdaterSpec(SweepSpec):
    """A ``<u:settingUpdater>`` element.

    Each level opens the scene with its own value at a path, as ``--set`` would, so that the levels
    must be independent (``u:mode="independent"``). A prelude has the value of its level, too. The
    value must not be drawn by ``<u:vary>`` of the scene.
    """

    name: ClassVar[str] = "setting"

    path: str
    """The path of the number, as in ``--set``: ``object[pipe].course.buriedShare``."""
    column: str | None = element(default=None, attribute=True, namespaced=True)
    """The name of the column (``u:column``); without it the last name of the path."""
    column_unit: str = element("unit", default="1", attribute=True, namespaced=True)
    """The unit of the column (``u:unit``)."""

    @property
    def parameter(self) -> str:
        """The name of the column."""
        return self.column or column_of(self.path)

    @property
    def parameter_unit(self) -> str:
        """The unit of the column."""
        return self.column_unit

    def values(self) -> tuple[float, ...]:
        """Return the value of each level; the final value is one if whole steps lead to it."""
        return step_values(self.initial_value, self.final_value, self.step)

    def bind(self, stage: Stage) -> Setter:
        """Return an updater that changes nothing: the scene was opened with the value."""
        return Setter(lambda value: None)


def column_of(path: str) -> str:
    """Return the name of the column of a path without ``u:column``: its last name."""
    return path.rpartition(".")[2].partition("[")[0]
