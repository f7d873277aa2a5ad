"""The import and description of an algorithm's class, within the process of the algorithm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ...algorithms import check_parameters, load_algorithm
from ...base.files.python_sources import find_sources
from ...benchmark.plugin import Plugin
from ...errors import PluginError, UwsimError
from ..program import class_of_file
from .facts import facts_of


def describe(source: Sequence[Any], name: str, parameters: Mapping[str, float | str]) -> object:
    """Import a class in this process, that of the algorithm; return the answer for the other.

    Args:
        source: the path and the source of the file; empty for a module.
        name: the program.
        parameters: the parameters that the user sets.

    Returns:
        The facts, the refused parameters and the files; or an error and its places in files.
    """
    module, _, class_name = name.partition(":")
    try:
        cls = class_of_file(Plugin(*source), class_name) if source else load_algorithm(name)
    except PluginError as error:
        return [str(error), [[d.file, d.line, d.message] for d in error.diagnostics]]
    except UwsimError as error:
        return [str(error), []]
    refusals = []
    for key, value in parameters.items():
        try:
            check_parameters(cls, {key: value})
        except UwsimError as error:
            refusals.append([key, str(error)])
    facts = facts_of(cls)
    names = None if facts.parameter_names is None else list(facts.parameter_names)
    files = [[key, str(path.absolute())] for key, path in find_sources(module).items()]
    facts_list = [facts.module, facts.qualname, names, facts.is_piloted, facts.is_policy]
    return [facts_list, refusals, files]
