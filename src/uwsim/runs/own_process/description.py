"""The description of an algorithm's class by a process of its own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...base.exceptions import RemoteError
from ...benchmark.plugin import Plugin
from ...errors import BadSetting, Diagnostic, PluginError
from ...results.seal import deny_access_to_memory
from ...simulation import CallStopped
from .facts import AlgorithmFacts, Description, search_path
from .process import OwnProcess

LIMIT = 300.0
"""The longest import of an algorithm [s of wall time]."""


def describe_program(
    name: str, plugin: Plugin | None, folder: Path, parameters: Mapping[str, float | str]
) -> Description:
    """Import the class of a program in a process of its own, and return what that process says.

    This process denies others access to its memory first, and the other process ends with the call.

    Args:
        name: the program: ``FILE.py:Class`` or ``module:Class``.
        plugin: the file; None for a module.
        folder: the working directory of the process, in which it also searches for modules.
        parameters: the parameters that the user sets.

    Raises:
        BadSetting: there is no such class, or its import does not end well.
        PluginError: the file cannot be imported.
    """
    deny_access_to_memory()
    source = [] if plugin is None else [plugin.path, plugin.source]
    try:
        with OwnProcess(LIMIT, folder) as process:
            answer = process.request(
                ["describe", search_path(folder), source, name, dict(parameters)],
                lambda request: None,
            )
    except (CallStopped, RemoteError) as error:
        raise BadSetting(f"Algorithm {name!r}: {error}, while it was imported.") from None
    return _read_answer(name, answer)


def _read_answer(name: str, answer: Any) -> Description:
    """Return the description in an answer; raise the error that it states."""
    try:
        match answer:
            case [str(), [_, *_] as lines]:
                raise PluginError(
                    [Diagnostic(file=f, line=n, message=str(text)) for f, n, text in lines]
                )
            case [str(message), []]:
                raise BadSetting(message)
            case [[str(module), str(qualname), names, bool(pilot), bool(policy)], refusals, files]:
                return Description(
                    facts=AlgorithmFacts(
                        module=module,
                        qualname=qualname,
                        parameter_names=None if names is None else tuple(map(str, names)),
                        is_piloted=pilot,
                        is_policy=policy,
                    ),
                    refusals={str(key): str(text) for key, text in refusals},
                    sources={str(key): Path(str(path)) for key, path in files},
                )
    except (TypeError, ValueError):
        pass  # the process may send anything
    raise BadSetting(f"Algorithm {name!r}: its process sent a frame that nobody understands.")
