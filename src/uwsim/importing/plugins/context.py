"""What the readers of plug-ins need: the robot, the errors of the file, the report."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import SceneError, did_you_mean
from ...schema import Diagnostics
from ..report import ImportReport, Status
from ..robot import Robot
from ..sdf.flat_model import FlatModel, FlatPlugin
from ..sdf.values import Source, text_of


@dataclass(frozen=True, eq=False)
class PluginContext:
    """The robot of a model with plug-ins."""

    model: FlatModel
    """The model."""
    robot: Robot
    """The robot."""
    report: ImportReport
    """The report."""

    def source(self, plugin: FlatPlugin) -> Source:
        """Return the file of a plug-in, for messages about its numbers."""
        file = plugin.plugin.place.file
        return Source(file, Diagnostics(file), self.report)

    def add(self, status: Status, plugin: FlatPlugin, reason: str) -> None:
        """Report what became of a plug-in."""
        self.report.add(status, label_of(plugin), plugin.plugin.place, reason)

    def find_link(self, name: str, plugin: FlatPlugin) -> str | None:
        """Return the path of a link of the robot; report it and return None if there is none.

        Names of UUV Simulator may begin with the name of the robot: ``rexrov/base_link``.
        """
        path = self.model.find_link(name, plugin.scope)
        if path is None:
            path = self.model.find_link(name.rpartition("/")[2], plugin.scope)
        if path is not None and path in self.robot.links:
            return path
        hint = did_you_mean(name, self.robot.links).rstrip()
        self.add("left out", plugin, f"the robot has no link {name[:60]!r}.{hint}".rstrip("."))
        return None


def label_of(plugin: FlatPlugin) -> str:
    """Return the name of a plug-in in the report, with its link or joint."""
    node = plugin.plugin.node
    names = ("link_name", "joint_name", "jointName", "linkName")
    target = next((text for name in names if (text := text_of(node, name))), "")
    return f"plugin {plugin.plugin.kind} {plugin.scope}{target}".strip()


def check(source: Source) -> None:
    """Raise the errors of a plug-in's numbers."""
    source.diagnostics.check(SceneError)
