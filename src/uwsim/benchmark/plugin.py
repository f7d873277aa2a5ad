"""Plugins: Python files with a user's own measures, triggers, updaters and algorithms.

.. code-block:: python

    MEASURES = {"topSpeed": TopSpeedSpec}       # <u:topSpeed> in a benchmark file
    TRIGGERS = {"arrived": ArrivedSpec}         # <type>u:arrived</type>
    UPDATERS = {"turbidity": TurbiditySpec}     # <u:turbidity>
    ALGORITHMS = {"brightest": Brightest}       # --algorithm brightest

Any of the four dicts may be left out. Element names without a prefix are those of the original
UWSim, so the elements of a plugin are in the namespace ``urn:uwsim:1``. A name that uwsim or
another plugin already has is an error.

A plugin is one file, and its source is sent to the workers: each worker process, here or on another
machine, runs the source whose hash is in the result. The modules that a plugin imports must be
installed. The name of a plugin's own module contains the hash, so two plugins do not affect each
other.
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
from ..errors import AssetError, Diagnostic, PluginError, RunFailed, UwsimError, type_and_text
from ..world import Stage
from .bind_part import Part, bind_part
from .measures import Measure, MeasureSpec
from .plugin_checks import ContractViolation
from .triggers import Trigger, TriggerSpec
from .updaters import SceneUpdater, SceneUpdaterSpec

MODULE_PREFIX = "uwsim_plugin_"
"""The prefix of the name of a plugin's module."""
MAX_BYTES = 10_000_000
"""The greatest size of a plugin file [byte]."""
LIVE_CLASSES = ((MeasureSpec, Measure), (TriggerSpec, Trigger), (SceneUpdaterSpec, SceneUpdater))
"""The base class of a spec, and the base class of the object to which the spec binds."""


@dataclass(frozen=True)
class Plugin:
    """A plugin file and its source."""

    path: str
    """The path of the file as given by the user."""
    source: bytes = field(repr=False)
    """The content of the file."""
    is_isolated: bool = field(default=False, repr=False)
    """True if only the process of an algorithm imports the file."""

    def __reduce__(self) -> tuple[Callable[..., Plugin], tuple[object, ...]]:
        """Pickle the fields; unpickling imports the module, which defines classes of the plan.

        An isolated file defines none, and is not imported.
        """
        if self.is_isolated:
            return Plugin, (self.path, self.source, True)
        return _import_plugin, (self.path, self.source)

    @property
    def name(self) -> str:
        """The name of the file, without its folders."""
        return Path(self.path).name

    @property
    def sha256(self) -> str:
        """The SHA-256 hash of the source, after the prefix ``sha256:``."""
        return "sha256:" + hashlib.sha256(self.source).hexdigest()

    @property
    def module_name(self) -> str:
        """The name of the module in Python, which contains the start of the hash of the source."""
        stem = re.sub(r"\W", "_", Path(self.path).stem, flags=re.ASCII)
        return f"{MODULE_PREFIX}{stem}_{hashlib.sha256(self.source).hexdigest()[:16]}"

    def module(self) -> ModuleType:
        """Return the module of the plugin; the first call imports it.

        Raises:
            PluginError: the module cannot be imported.
        """
        try:
            return source_module(self.module_name, self.path, self.source)
        except SyntaxError as error:
            line = error.lineno if error.filename == self.path else None
            raise self.diagnostic(f"not Python: {error.msg}", line) from error
        except BaseException as error:
            if is_user_interrupt(error):
                raise
            message = f"cannot be imported: {format_exception(error)}"
            if isinstance(error, ModuleNotFoundError):
                message += " (a plugin is one file; what it imports must be installed)"
            raise self.diagnostic(message, self.line_of(error)) from error

    def diagnostic(self, message: str, line: int | None = None) -> PluginError:
        """Return a `PluginError` with a message about this file, and a line of it if known."""
        return PluginError([Diagnostic(file=self.path, line=line, message=message)])

    def line_of(self, error: BaseException) -> int | None:
        """Return the last line of this file in the traceback of an error; None if it has none."""
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == self.path]
        return lines[-1] if lines else None


def _import_plugin(path: str, source: bytes) -> Plugin:
    plugin = Plugin(path, source)
    plugin.module()
    return plugin


def read_plugin(path: Path) -> Plugin:
    """Read and import a plugin; raise PluginError if the file cannot be read or imported."""
    plugin = read_isolated(path)
    return _import_plugin(plugin.path, plugin.source)


def read_isolated(path: Path, name: str = "") -> Plugin:
    """Read a file that the process of an algorithm alone imports.

    Args:
        path: the file.
        name: its path in messages; empty for that of the file.

    Raises:
        PluginError: the file cannot be read.
    """
    try:
        source = read_bytes(path, at_most=MAX_BYTES)
    except AssetError as error:
        message = str(error).removeprefix(f"{path}: ").removesuffix(".")
        raise Plugin(str(path), b"").diagnostic(f"{message}: not a plugin") from None
    except OSError as error:
        raise Plugin(str(path), b"").diagnostic(f"cannot be read: {error.strerror}") from None
    return Plugin(name or str(path), source, is_isolated=True)


def line_of_class(value: object, plugin: Plugin) -> int | None:
    """Return the line at which a class of the plugin is defined; None for any other value."""
    if not isinstance(value, type) or value.__module__ != plugin.module_name:
        return None
    try:
        return inspect.getsourcelines(value)[1]
    except (OSError, TypeError):
        return None


def _line_of_attribute(error: ContractViolation, plugin: Plugin) -> int | None:
    """Return the line of the invalid property, or else of its class; None if in another file."""
    cls = type(error.part)
    if cls.__module__ != plugin.module_name:
        return None
    getter = getattr(inspect.getattr_static(cls, error.attribute, None), "fget", None)
    code = getattr(getter, "__code__", None)
    if isinstance(code, CodeType) and code.co_filename == plugin.path:
        return code.co_firstlineno
    return line_of_class(cls, plugin)


def format_exception(error: BaseException) -> str:
    """Return an exception as one line, whatever its message contains."""
    if isinstance(error, ContractViolation):
        return str(error)
    return type_and_text(error)


@contextmanager
def attribute_errors_to(
    plugins: Sequence[Plugin], *, describe_progress: Callable[[], str] | None = None
) -> Iterator[None]:
    """Replace an exception raised by a plugin's code by an error that names its file and line.

    Args:
        plugins: the plugins in use.
        describe_progress: a function that describes the present level and time of a running
            benchmark; None while files are read.

    Raises:
        PluginError: a plugin raised an exception while files were read.
        RunFailed: a plugin raised an exception while the benchmark was running.
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
                line = _line_of_attribute(error, plugin)
            if line is not None:
                message = format_exception(error)
                if describe_progress is not None:
                    raise RunFailed(
                        f"{plugin.path}:{line}: {message} ({describe_progress()})"
                    ) from error
                raise plugin.diagnostic(message, line) from error
        raise


def check_bound(plugins: Sequence[Plugin], parts: Sequence[Part], stage: Stage) -> None:
    """Bind all measures, triggers and updaters that plugins define, and check the bound objects.

    Raises:
        PluginError: a spec binds to an object of the wrong class, or a measure has no unit.
    """
    plugins_by_module = {plugin.module_name: plugin for plugin in plugins}
    for part in parts:
        plugin = plugins_by_module.get(type(part).__module__)
        if plugin is None:
            continue
        instance: object = bind_part(part, stage)
        for spec, kind in LIVE_CLASSES:
            if isinstance(part, spec) and not isinstance(instance, kind):
                name = "None" if instance is None else type(instance).__name__
                message = f"{type(part).__name__}.bind gives {name}; expected a {kind.__name__}"
                raise plugin.diagnostic(message, line_of_class(type(part), plugin))
        if isinstance(instance, Measure) and not isinstance(getattr(instance, "unit", None), str):
            message = f"{type(instance).__name__} has no unit, such as unit = 'm/s'"
            raise plugin.diagnostic(message, line_of_class(type(instance), plugin))
        if isinstance(instance, Measure | Trigger):
            instance.close()


def hashes(plugins: Sequence[Plugin]) -> tuple[tuple[str, str], ...]:
    """Return the name and the hash of each plugin, in the order of the names."""
    return tuple(sorted((plugin.name, plugin.sha256) for plugin in plugins))
