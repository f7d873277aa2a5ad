"""The tables of the measures, triggers, updaters and algorithms that a benchmark can name."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import ModuleType

from ..bus import Algorithm
from ..errors import BadSetting, Diagnostic, PluginError, did_you_mean
from ..schema import fields_of
from .measures import MeasureSpec
from .plugin import Plugin, format_exception, line_of_class
from .triggers import TriggerSpec
from .updaters import SceneUpdaterSpec

PREFIX = "u:"
"""The prefix of the names of a plugin's elements in a benchmark file."""
ELEMENT_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*")
"""The pattern of valid names of elements and columns."""
ALGORITHM_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")
"""The pattern of valid names of algorithms."""


@dataclass(frozen=True, kw_only=True)
class Tables:
    """The classes that a benchmark can name, those of plugins included."""

    measures: Mapping[str, type[MeasureSpec]] = field(default_factory=dict)
    """The specs of measures by the names of their elements."""
    triggers: Mapping[str, type[TriggerSpec]] = field(default_factory=dict)
    """The specs of triggers by the names of their types."""
    updaters: Mapping[str, type[SceneUpdaterSpec]] = field(default_factory=dict)
    """The specs of scene updaters by the names of their elements."""
    algorithms: Mapping[str, type[Algorithm]] = field(default_factory=dict)
    """The classes of algorithms by name."""


BASE_CLASSES = {"MEASURES": MeasureSpec, "TRIGGERS": TriggerSpec, "UPDATERS": SceneUpdaterSpec}
"""The base class of the specs in each dict of a plugin."""
TABLE_NAMES = (*BASE_CLASSES, "ALGORITHMS")
"""The names of the dicts that a plugin may define."""
NEW_NAMES = {"faults": "errors", "reference": "parameter", "reference_unit": "parameter_unit"}
"""The renamed methods and properties of specs: old name -> new name."""


def extend_tables(package_tables: Tables, plugins: Sequence[Plugin]) -> Tables:
    """Return the tables of the package with the entries of plugins added.

    Raises:
        PluginError: entries of plugins are invalid; the error lists all of them.
        BadSetting: a plugin is named twice.
    """
    diagnostics: list[Diagnostic] = []
    tables = {name: dict(getattr(package_tables, name.lower())) for name in TABLE_NAMES}
    owners: dict[tuple[str, str], Plugin] = {}
    by_module: dict[str, Plugin] = {}
    for plugin in plugins:
        if (same_plugin := by_module.setdefault(plugin.module_name, plugin)) is not plugin:
            raise BadSetting(f"--plugin {plugin.path}: is the same plugin as {same_plugin.path}.")
        for table, key, value in _read_entries(plugin, diagnostics):
            name = key if table == "ALGORITHMS" else PREFIX + key
            if name in tables[table]:
                owner = owners.get((table, name))
                error = f"is in {owner.path}, too" if owner else "is a name of uwsim"
                message = f"{table}[{key!r}]: {name!r} {error}; choose another name"
                diagnostics.append(
                    Diagnostic(file=plugin.path, line=line_of_class(value, plugin), message=message)
                )
                continue
            owners[table, name] = plugin
            tables[table][name] = value
    if diagnostics:
        raise PluginError(diagnostics)
    return Tables(**{name.lower(): table for name, table in tables.items()})


def _read_entries(plugin: Plugin, diagnostics: list[Diagnostic]) -> Iterator[tuple[str, str, type]]:
    """Yield the table, key and class of each valid entry of a plugin; report invalid ones."""
    module = plugin.module()

    def add(message: str, value: object = None) -> None:
        diagnostics.append(
            Diagnostic(file=plugin.path, line=line_of_class(value, plugin), message=message)
        )

    table_names = [name for name in TABLE_NAMES if hasattr(module, name)]
    if not table_names:
        suggestions = [did_you_mean(name, TABLE_NAMES) for name in vars(module) if name.isupper()]
        suggestion = next(filter(None, suggestions), "")
        add(f"declares none of {', '.join(TABLE_NAMES)}: dicts of name -> class.{suggestion}")
    for table in table_names:
        entries = getattr(module, table)
        if not isinstance(entries, Mapping):
            add(f"{table} is {type(entries).__name__}; expected a dict of name -> class")
            continue
        for key, value in entries.items():
            error = _key_error(table, key) or _class_error(table, value, module)
            if error:
                add(f"{table}[{key!r}]: {error}", value)
            else:
                yield table, key, value


def _key_error(table: str, key: object) -> str | None:
    if table == "ALGORITHMS":
        if isinstance(key, str) and ALGORITHM_NAME.fullmatch(key):
            return None
        return "the name of an algorithm has letters, digits, '_', '.' and '-' only"
    if isinstance(key, str) and ELEMENT_NAME.fullmatch(key):
        return None
    if isinstance(key, str) and key.startswith(PREFIX):
        return f"uwsim adds the prefix; write {key.removeprefix(PREFIX)!r}"
    return "the name of an element has letters and digits only, no digit first"


def _class_error(table: str, value: object, module: ModuleType) -> str | None:
    if not isinstance(value, type):
        return f"is {type(value).__name__} {str(value)[:40]!r}; expected a class"
    name = value.__name__
    owner = sys.modules.get(value.__module__, module)
    if getattr(owner, value.__qualname__.split(".")[0], None) is None or "<" in value.__qualname__:
        return f"the class {name} must be at module level, because worker processes import it"
    if table == "ALGORITHMS":
        return None if callable(getattr(value, "start", None)) else f"{name} has no start(node)"
    base = BASE_CLASSES[table]
    if not issubclass(value, base):
        hint = "; declare its spec" if hasattr(value, "update") or hasattr(value, "apply") else ""
        return f"{name} is no {base.__name__}{hint}"
    for old_name, new_name in NEW_NAMES.items():
        if callable(attribute := getattr(value, old_name, None)) or isinstance(attribute, property):
            return f"{name}.{old_name} is not used; rename it to {new_name}"
    if missing_methods := sorted(getattr(value, "__abstractmethods__", ())):
        return f"{name} lacks {', '.join(missing_methods)}"
    if "__dataclass_params__" not in vars(value):
        return f"{name} lacks @dataclass(frozen=True, kw_only=True)"
    try:
        fields_of(value)
    except Exception as error:
        return f"the fields of {name} cannot be read: {format_exception(error)}"
    if table == "UPDATERS":
        return _column_error(value)
    return None


def _column_error(value: type) -> str | None:
    name = getattr(value, "name", None)
    if not isinstance(name, str) or not ELEMENT_NAME.fullmatch(name):
        message = "lacks name" if name is None else f"has the name {name!r}"
        return f"{value.__name__} {message}: that of its column, letters and digits"
    if not isinstance(value.unit, str):  # type: ignore[attr-defined]
        return f"{value.__name__} has the unit {value.unit!r}"  # type: ignore[attr-defined]
    return None
