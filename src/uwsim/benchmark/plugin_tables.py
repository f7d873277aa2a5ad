"""Tables of the names that a benchmark can use, and what plugins add to them."""

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
from .plugin import Plugin, line_of_class, raised
from .triggers import TriggerSpec
from .updaters import SceneUpdaterSpec

PREFIX = "u:"
"""Stands in front of what a plugin adds to a file."""
WORD = re.compile(r"[A-Za-z][A-Za-z0-9]*")
"""Names of elements and of columns."""
ALGORITHM = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


@dataclass(frozen=True, kw_only=True)
class Tables:
    """The names that a benchmark can use: those bundled and those of plugins."""

    measures: Mapping[str, type[MeasureSpec]] = field(default_factory=dict)
    """Element -> spec."""
    triggers: Mapping[str, type[TriggerSpec]] = field(default_factory=dict)
    """Type -> spec."""
    updaters: Mapping[str, type[SceneUpdaterSpec]] = field(default_factory=dict)
    """Element -> spec."""
    algorithms: Mapping[str, type[Algorithm]] = field(default_factory=dict)
    """Name -> class."""


BASES = {"MEASURES": MeasureSpec, "TRIGGERS": TriggerSpec, "UPDATERS": SceneUpdaterSpec}
DECLARED = (*BASES, "ALGORITHMS")
RENAMED = {"faults": "errors", "reference": "parameter", "reference_unit": "parameter_unit"}
"""Methods and properties of specs that had another name: old name -> new name."""


def with_plugins(bundled: Tables, plugins: Sequence[Plugin]) -> Tables:
    """Return the bundled tables and what plugins add to them.

    Raises:
        PluginError: with everything that is wrong about what the plugins declare.
        BadSetting: a plugin is given twice.
    """
    diagnostics: list[Diagnostic] = []
    tables = {name: dict(getattr(bundled, name.lower())) for name in DECLARED}
    owners: dict[tuple[str, str], Plugin] = {}
    by_module: dict[str, Plugin] = {}
    for plugin in plugins:
        if (twin := by_module.setdefault(plugin.module_name, plugin)) is not plugin:
            raise BadSetting(f"--plugin {plugin.path}: is {twin.path} once more.")
        for table, key, value in _declared(plugin, diagnostics):
            name = key if table == "ALGORITHMS" else PREFIX + key
            if name in tables[table]:
                first = owners.get((table, name))
                whose = f"is in {first.path}, too" if first else "is a name of uwsim"
                message = f"{table}[{key!r}]: {name!r} {whose}; call it otherwise"
                diagnostics.append(
                    Diagnostic(file=plugin.path, line=line_of_class(value, plugin), message=message)
                )
                continue
            owners[table, name] = plugin
            tables[table][name] = value
    if diagnostics:
        raise PluginError(diagnostics)
    return Tables(**{name.lower(): table for name, table in tables.items()})


def _declared(plugin: Plugin, diagnostics: list[Diagnostic]) -> Iterator[tuple[str, str, type]]:
    """Yield table, key and class of what a plugin declares; errors go to ``diagnostics``."""
    module = plugin.module()

    def add(message: str, value: object = None) -> None:
        diagnostics.append(
            Diagnostic(file=plugin.path, line=line_of_class(value, plugin), message=message)
        )

    given = [name for name in DECLARED if hasattr(module, name)]
    if not given:
        nearest = [did_you_mean(name, DECLARED) for name in vars(module) if name.isupper()]
        near = next(filter(None, nearest), "")
        add(f"declares none of {', '.join(DECLARED)}: dicts of name -> class.{near}")
    for table in given:
        entries = getattr(module, table)
        if not isinstance(entries, Mapping):
            add(f"{table} is {type(entries).__name__}; expected a dict of name -> class")
            continue
        for key, value in entries.items():
            wrong = _wrong_key(table, key) or _wrong_class(table, value, module)
            if wrong:
                add(f"{table}[{key!r}]: {wrong}", value)
            else:
                yield table, key, value


def _wrong_key(table: str, key: object) -> str | None:
    if table == "ALGORITHMS":
        if isinstance(key, str) and ALGORITHM.fullmatch(key):
            return None
        return "the name of an algorithm has letters, digits, '_', '.' and '-' only"
    if isinstance(key, str) and WORD.fullmatch(key):
        return None
    if isinstance(key, str) and key.startswith(PREFIX):
        return f"the prefix is put in front by uwsim; write {key.removeprefix(PREFIX)!r}"
    return "the name of an element has letters and digits only, no digit first"


def _wrong_class(table: str, value: object, module: ModuleType) -> str | None:
    """Return why a value does not fit its table; None if it does."""
    if not isinstance(value, type):
        return f"is {type(value).__name__} {str(value)[:40]!r}; expected a class"
    name = value.__name__
    owner = sys.modules.get(value.__module__, module)
    if getattr(owner, value.__qualname__.split(".")[0], None) is None or "<" in value.__qualname__:
        return f"the class {name} must be defined at module level, for worker processes import it"
    if table == "ALGORITHMS":
        return None if callable(getattr(value, "start", None)) else f"{name} has no start(node)"
    base = BASES[table]
    if not issubclass(value, base):
        near = "; give its spec" if hasattr(value, "update") or hasattr(value, "apply") else ""
        return f"{name} is no {base.__name__}{near}"
    for old, new in RENAMED.items():
        if callable(given := getattr(value, old, None)) or isinstance(given, property):
            return f"{name}.{old} is never called: it is {new} now; rename it"
    if missing := sorted(getattr(value, "__abstractmethods__", ())):
        return f"{name} lacks {', '.join(missing)}"
    if "__dataclass_params__" not in vars(value):
        return f"{name} lacks @dataclass(frozen=True, kw_only=True)"
    try:
        fields_of(value)
    except Exception as error:
        return f"the fields of {name} cannot be read: {raised(error)}"
    if table == "UPDATERS":
        return _wrong_reference(value)
    return None


def _wrong_reference(value: type) -> str | None:
    """An updater names a column of the result."""
    name = getattr(value, "name", None)
    if not isinstance(name, str) or not WORD.fullmatch(name):
        message = "lacks name" if name is None else f"has the name {name!r}"
        return f"{value.__name__} {message}: that of its column, letters and digits"
    if not isinstance(value.unit, str):  # type: ignore[attr-defined]
        return f"{value.__name__} has the unit {value.unit!r}"  # type: ignore[attr-defined]
    return None
