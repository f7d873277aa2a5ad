"""Plugins: Python files with a user's own measures, triggers, updaters and algorithms.

.. code-block:: python

    MEASURES = {"topSpeed": TopSpeedSpec}       # <u:topSpeed> in a benchmark file
    TRIGGERS = {"arrived": ArrivedSpec}         # <type>u:arrived</type>
    UPDATERS = {"turbidity": TurbiditySpec}     # <u:turbidity>
    ALGORITHMS = {"brightest": Brightest}       # --algorithm brightest

Any of the four may be left out. Names without a prefix are the original's, so what a plugin adds to
a file lives in the namespace ``urn:uwsim:1``; should uwsim or another plugin have the name already,
that is an error.

A plugin is one file and travels as its source: a worker, here or on another machine, runs the very
bytes whose hash stands in the result. What it imports must be installed. Its module is called after
that hash, so nothing global changes and two plugins cannot disturb each other.
"""

from __future__ import annotations

import hashlib
import inspect
import re
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType, ModuleType

from ..base.files.input_files import read_bytes
from ..base.files.source_module import source_module
from ..base.interrupts import is_user_interrupt
from ..errors import (
    AssetError,
    Diagnostic,
    PluginError,
    RunFailed,
    UwsimError,
    type_and_text,
)
from ..world import Stage
from .bind_part import Part, bind_part
from .measures import Measure, MeasureSpec
from .plugin_checks import ContractViolation
from .triggers import Trigger, TriggerSpec
from .updaters import SceneUpdater, SceneUpdaterSpec

MODULE = "uwsim_plugin_"
"""How the name of a plugin's module begins."""
MAX_BYTES = 10_000_000


LIVE = ((MeasureSpec, Measure), (TriggerSpec, Trigger), (SceneUpdaterSpec, SceneUpdater))


@dataclass(frozen=True)
class Plugin:
    """One plugin file, with the source that was read."""

    path: str
    """The file as the user named it."""
    source: bytes = field(repr=False)
    """Its content."""

    def __reduce__(self) -> tuple[Callable[[str, bytes], Plugin], tuple[str, bytes]]:
        """Pickle the source; unpickling imports the module, and with it the classes."""
        return _imported, (self.path, self.source)

    @property
    def name(self) -> str:
        """Name of the file, without its folders."""
        return Path(self.path).name

    @property
    def sha256(self) -> str:
        """Hash of the source."""
        return "sha256:" + hashlib.sha256(self.source).hexdigest()

    @property
    def module_name(self) -> str:
        """Name of its module: equal sources are one module."""
        stem = re.sub(r"\W", "_", Path(self.path).stem, flags=re.ASCII)
        return f"{MODULE}{stem}_{hashlib.sha256(self.source).hexdigest()[:16]}"

    def module(self) -> ModuleType:
        """Return its module, importing it unless that was done.

        Raises:
            PluginError: it cannot be imported.
        """
        try:
            return source_module(self.module_name, self.path, self.source)
        except SyntaxError as error:
            line = error.lineno if error.filename == self.path else None
            raise self.diagnostic(f"not Python: {error.msg}", line) from error
        except BaseException as error:
            if is_user_interrupt(error):
                raise
            message = f"cannot be imported: {raised(error)}"
            if isinstance(error, ModuleNotFoundError):
                message += " (a plugin is one file; what it imports must be installed)"
            raise self.diagnostic(message, self.line_of(error)) from error

    def diagnostic(self, message: str, line: int | None = None) -> PluginError:
        """Return a `PluginError` for this file."""
        return PluginError([Diagnostic(file=self.path, line=line, message=message)])

    def line_of(self, error: BaseException) -> int | None:
        """Return the line of this file in which an error arose; None if it was elsewhere."""
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == self.path]
        return lines[-1] if lines else None


def _imported(path: str, source: bytes) -> Plugin:
    plugin = Plugin(path, source)
    plugin.module()
    return plugin


def read_plugin(path: Path) -> Plugin:
    """Read and import a plugin.

    Raises:
        PluginError: it cannot be read or imported.
    """
    try:
        source = read_bytes(path, at_most=MAX_BYTES)
    except AssetError as error:
        message = str(error).removeprefix(f"{path}: ").removesuffix(".")
        raise Plugin(str(path), b"").diagnostic(f"{message}: not a plugin") from None
    except OSError as error:
        raise Plugin(str(path), b"").diagnostic(f"cannot be read: {error.strerror}") from None
    return _imported(str(path), source)


def line_of_class(value: object, plugin: Plugin) -> int | None:
    """Line of a class of the plugin."""
    if not isinstance(value, type) or value.__module__ != plugin.module_name:
        return None
    try:
        return inspect.getsourcelines(value)[1]
    except (OSError, TypeError):
        return None


def _line_of_answer(error: ContractViolation, plugin: Plugin) -> int | None:
    """Line of the property with the wrong value, or of its class."""
    cls = type(error.part)
    if cls.__module__ != plugin.module_name:
        return None
    getter = getattr(inspect.getattr_static(cls, error.attribute, None), "fget", None)
    code = getattr(getter, "__code__", None)
    if isinstance(code, CodeType) and code.co_filename == plugin.path:
        return code.co_firstlineno
    return line_of_class(cls, plugin)


def raised(error: BaseException) -> str:
    """Return what was raised as one line, whatever its message holds."""
    if isinstance(error, ContractViolation):
        return str(error)
    return type_and_text(error)


@contextmanager
def attribute_errors_to(
    plugins: Sequence[Plugin], *, when: Callable[[], str] | None = None
) -> Iterator[None]:
    """Add the line of the plugin to exceptions that its code raises.

    Args:
        plugins: those that are in use.
        when: says at which moment of a running benchmark; None while files are read.

    Raises:
        PluginError: what a plugin raised while files were read.
        RunFailed: ... while the benchmark was running.
    """
    try:
        yield
    except UwsimError:
        raise
    except BaseException as error:
        if is_user_interrupt(error):
            raise
        for plugin in plugins:
            line = plugin.line_of(error)
            if line is None and isinstance(error, ContractViolation):
                line = _line_of_answer(error, plugin)
            if line is not None:
                message = raised(error)
                if when is not None:
                    raise RunFailed(f"{plugin.path}:{line}: {message} ({when()})") from error
                raise plugin.diagnostic(message, line) from error
        raise


def check_bound(
    plugins: Sequence[Plugin],
    parts: Sequence[Part],
    stage: Stage,
) -> None:
    """Bind all measures, triggers and updaters of plugins, and check the results.

    Raises:
        PluginError: it cannot be used in a run.
    """
    own = {plugin.module_name: plugin for plugin in plugins}
    for part in parts:
        plugin = own.get(type(part).__module__)
        if plugin is None:
            continue
        live: object = bind_part(part, stage)
        for spec, kind in LIVE:
            if isinstance(part, spec) and not isinstance(live, kind):
                gives = "None" if live is None else type(live).__name__
                message = f"{type(part).__name__}.bind gives {gives}; expected a {kind.__name__}"
                raise plugin.diagnostic(message, line_of_class(type(part), plugin))
        if isinstance(live, Measure) and not isinstance(getattr(live, "unit", None), str):
            message = f"{type(live).__name__} has no unit, such as unit = 'm/s'"
            raise plugin.diagnostic(message, line_of_class(type(live), plugin))
        if isinstance(live, Measure | Trigger):
            live.close()


def hashes(plugins: Sequence[Plugin]) -> tuple[tuple[str, str], ...]:
    """Return name and hash of each plugin, in the order of their names."""
    return tuple(sorted((plugin.name, plugin.sha256) for plugin in plugins))
