"""The names available to benchmarks: those bundled and those of ``--plugin``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ErrorCollector

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin
    from ..benchmark.plugin_tables import Tables


def bundled_tables() -> Tables:
    """Return everything that comes with uwsim."""
    from ..algorithms import ALGORITHMS
    from ..benchmark.measures import MEASURES
    from ..benchmark.plugin_tables import Tables
    from ..benchmark.triggers import TRIGGERS
    from ..benchmark.updaters import UPDATERS

    return Tables(measures=MEASURES, triggers=TRIGGERS, updaters=UPDATERS, algorithms=ALGORITHMS)


def read_plugins(files: Sequence[Path] | None) -> tuple[tuple[Plugin, ...], Tables]:
    """Read the plugins; returns them and the tables with what they add.

    Raises:
        PluginError: a plugin is wrong; with everything that is.
        BadSetting: a plugin is given twice.
    """
    from ..benchmark.plugin import read_plugin
    from ..benchmark.plugin_tables import with_plugins

    wrong, plugins = ErrorCollector(), []
    for file in files or ():
        with wrong.collect():
            plugins.append(read_plugin(file))
    wrong.raise_errors()
    return tuple(plugins), with_plugins(bundled_tables(), plugins)
