"""The tables of names that benchmarks can use: bundled names, and names from plugins."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ErrorCollector

if TYPE_CHECKING:
    from ..benchmark.plugin import Plugin
    from ..benchmark.plugin_tables import Tables


def bundled_tables() -> Tables:
    """Return the tables of the bundled measures, triggers, updaters and algorithms."""
    from ..algorithms import ALGORITHMS
    from ..benchmark.measures import MEASURES
    from ..benchmark.plugin_tables import Tables
    from ..benchmark.triggers import TRIGGERS
    from ..benchmark.updaters import UPDATERS

    return Tables(measures=MEASURES, triggers=TRIGGERS, updaters=UPDATERS, algorithms=ALGORITHMS)


def read_plugins(files: Sequence[Path] | None) -> tuple[tuple[Plugin, ...], Tables]:
    """Read plugins; return the plugins, and the tables that contain their additions.

    Raises:
        PluginError: a plugin is invalid; with all errors.
        BadSetting: a plugin is given twice.
    """
    from ..benchmark.plugin import read_plugin
    from ..benchmark.plugin_tables import extend_tables

    errors, plugins = ErrorCollector(), []
    for file in files or ():
        with errors.collect():
            plugins.append(read_plugin(file))
    errors.raise_errors()
    return tuple(plugins), extend_tables(bundled_tables(), plugins)
