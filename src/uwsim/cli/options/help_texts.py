"""The help texts of commands, and the errors of their options.

Options are shown in the groups that `option` sets, after those of `COMMON_OPTIONS`; positional
arguments are shown by their metavar, such as ``SCENE``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import typer
from typer.core import TyperCommand

from ...errors import BadSetting, ErrorCollector

HELP_NAMES: dict[str, Any] = {"help_option_names": ["-h", "--help"]}
"""The help options of ``uwsim`` and of each command."""

FIRST_OPTIONS = "Common options"
INPUT = "Input"
RUN = "Repeats and processes"
RELIEF = "Relief of a new floor"
SEARCH = "Search"
COMPARISON = "Comparison"
AUTOPILOTS = "Autopilots"
ROS = "ROS"
PROGRAMS = "Programs outside"
CLOCK = "Clock, and hardware in the loop"
LIVE_VIEW = "Live view and pilot"
FOLLOW = "Poses of a real vehicle, live"
LOG_POSES = "Poses of a log"
COMPOSITION = "Virtual objects in real images"
FILES = "Your own files and code"
OUTPUT = "Output"
OTHER_OPTIONS = "Options"
"""The titles of the groups of options in help texts."""
GROUP_ORDER = (
    FIRST_OPTIONS,
    INPUT,
    RELIEF,
    COMPARISON,
    SEARCH,
    RUN,
    OUTPUT,
    LIVE_VIEW,
    ROS,
    PROGRAMS,
    AUTOPILOTS,
    CLOCK,
    LOG_POSES,
    FOLLOW,
    COMPOSITION,
    FILES,
    OTHER_OPTIONS,
)
"""The order of the groups in help texts."""
COMMON_OPTIONS = {
    "run": ("--for", "--program", "--view", "--record", "--hz", "--set", "--seed"),
    "play": ("--for", "--program", "--commands", "--virtual-sensors", "--record", "--hz"),
}
"""The options that the help of a command with many groups shows first, in this order."""

Completion = Callable[[str], list[tuple[str, str]]]
"""A function from an incomplete word to its completions, each with a description."""


def option(group: str, *names: str, **arguments: Any) -> Any:
    """Return an option that help texts show in a group.

    The names and ``arguments`` are passed to `typer.Option`.
    """
    return typer.Option(*names, rich_help_panel=group, **arguments)


class ErrorCollectingCommand(TyperCommand):
    """A command that reports the errors of all its options at once."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the options; raise SeveralErrors, or the error of typer if there is only one."""
        all_arguments = list(args)
        try:
            return super().parse_args(ctx, args)
        except typer.TyperException as first_error:
            errors = ErrorCollector()
            values, rest, _ = self.make_parser(ctx).parse_args(args=all_arguments)
            for parameter in self.get_params(ctx):
                if parameter.is_eager:
                    continue
                with errors.collect():
                    try:
                        parameter.handle_parse_result(ctx, values, rest)
                    except typer.TyperException as error:
                        raise BadSetting(error.format_message()) from None
            with suppress(BadSetting):  # a single error: raise that of typer instead
                errors.raise_errors()
            raise first_error

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """Return the words after the command, such as ``[OPTIONS] RESULT...``."""
        return ["[OPTIONS]", *(_usage(argument) for argument in self._arguments(ctx))]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options, group by group."""
        groups: dict[str, list[tuple[str, str]]] = {}
        common_names = COMMON_OPTIONS.get(self.name or "", ())
        options = {parameter.opts[0]: parameter for parameter in self._options(ctx)}
        for name in sorted(options, key=lambda name: _find_rank(name, common_names)):
            record = options[name].get_help_record(ctx)
            group = FIRST_OPTIONS if name in common_names else options[name].rich_help_panel
            if record is not None:
                groups.setdefault(group or OTHER_OPTIONS, []).append(record)
        arguments = [(_metavar(argument), argument.help or "") for argument in self._arguments(ctx)]
        if arguments:
            with formatter.section("Arguments"):
                formatter.write_dl(arguments)
        for title in (*GROUP_ORDER, *(name for name in groups if name not in GROUP_ORDER)):
            if title in groups:
                with formatter.section(title):
                    formatter.write_dl(groups[title])

    def _arguments(self, ctx: Any) -> Sequence[Any]:
        return [entry for entry in self.get_params(ctx) if entry.param_type_name == "argument"]

    def _options(self, ctx: Any) -> Sequence[Any]:
        return [entry for entry in self.get_params(ctx) if entry.param_type_name == "option"]


def _find_rank(name: str, common_names: Sequence[str]) -> int:
    """Return the place of an option among the common ones; all others follow them."""
    return common_names.index(name) if name in common_names else len(common_names)


def _metavar(argument: Any) -> str:
    return str(argument.metavar or argument.name.upper())


def _usage(argument: Any) -> str:
    name = _metavar(argument) + ("..." if argument.nargs != 1 else "")
    return name if argument.required else f"[{name}]"
