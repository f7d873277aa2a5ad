"""The algorithm of a request whose class only its own process imports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...benchmark.plugin import Plugin, read_isolated
from ..own_process.description import describe_program
from ..own_process.facts import Description
from .plan_request import PlanRequest


@dataclass(frozen=True, kw_only=True)
class IsolatedAlgorithm:
    """An algorithm that its own process has described."""

    description: Description
    """The answer of the process about the class."""
    plugins: tuple[Plugin, ...]
    """The file of ``FILE.py:Class``; empty for ``module:Class``."""
    folder: Path
    """The working directory of its process."""


def isolated_algorithm(
    request: PlanRequest, name: str, parameters: Mapping[str, float | str]
) -> IsolatedAlgorithm | None:
    """Describe the algorithm of a request by a process of its own.

    Args:
        request: the request.
        name: the name of the algorithm.
        parameters: its parameters.

    Returns:
        The algorithm; None if the request permits other processes to import the class, or if the
        name has no class.

    Raises:
        BadSetting: there is no such class.
        PluginError: its file cannot be read or imported.
    """
    file, colon, _ = name.partition(":")
    is_file = file.endswith(".py")
    if not request.is_isolated or request.client is not None or not (colon or is_file):
        return None
    folder = Path.cwd() if request.folder is None else request.folder
    plugin = read_isolated(folder / file, file) if is_file else None
    return IsolatedAlgorithm(
        description=describe_program(name, plugin, folder, parameters),
        plugins=() if plugin is None else (plugin,),
        folder=folder,
    )
