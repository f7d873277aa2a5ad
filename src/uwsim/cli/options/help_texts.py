"""The help texts of commands, and the errors of their options.

Options stand in groups, each option where `in_group` put it; arguments are named as they are typed.
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

INPUT = "What is run"
RUN = "Repeats and processes"
SEARCH = "What is searched"
COMPARED = "What is compared"
CONNECTED = "Connections"
FILES = "Your own files and code"
OUTPUT = "Output"
OTHERS = "Options"
"""Groups of options, in the order in which help shows them."""
ORDER = (INPUT, COMPARED, SEARCH, CONNECTED, RUN, OUTPUT, FILES, OTHERS)

Completion = Callable[[str], list[tuple[str, str]]]
"""What has been typed of a word -> words it may become, each with a line about it."""


def in_group(group: str, *names: str, **about: Any) -> Any:
    """Return an option that help shows in a group; all else is typer's."""
    return typer.Option(*names, rich_help_panel=group, **about)


class TaughtCommand(TyperCommand):
    """A command that reports the errors of all its options at once."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the options; raises SeveralErrors, or typer's own where there is but one."""
        given = list(args)
        try:
            return super().parse_args(ctx, args)
        except typer.TyperException as first:
            wrong = ErrorCollector()
            values, rest, _ = self.make_parser(ctx).parse_args(args=given)
            for parameter in self.get_params(ctx):
                if parameter.is_eager:
                    continue
                with wrong.collect():
                    try:
                        parameter.handle_parse_result(ctx, values, rest)
                    except typer.TyperException as error:
                        raise BadSetting(error.format_message()) from None
            with suppress(BadSetting):  # the only one: as typer says it
                wrong.raise_errors()
            raise first

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """``[OPTIONS] BENCHMARK``, ``[OPTIONS] RESULT...``, ``[OPTIONS] [KIND]``."""
        return ["[OPTIONS]", *(_usage(each) for each in self._arguments(ctx))]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options, group by group."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for parameter in self._options(ctx):
            record = parameter.get_help_record(ctx)
            if record is not None:
                groups.setdefault(parameter.rich_help_panel or OTHERS, []).append(record)
        arguments = [(_shown(each), each.help or "") for each in self._arguments(ctx)]
        if arguments:
            with formatter.section("Arguments"):
                formatter.write_dl(arguments)
        for title in (*ORDER, *(name for name in groups if name not in ORDER)):
            if title in groups:
                with formatter.section(title):
                    formatter.write_dl(groups[title])

    def _arguments(self, ctx: Any) -> Sequence[Any]:
        return [each for each in self.get_params(ctx) if each.param_type_name == "argument"]

    def _options(self, ctx: Any) -> Sequence[Any]:
        return [each for each in self.get_params(ctx) if each.param_type_name == "option"]


def _shown(argument: Any) -> str:
    return str(argument.metavar or argument.name.upper())


def _usage(argument: Any) -> str:
    name = _shown(argument) + ("..." if argument.nargs != 1 else "")
    return name if argument.required else f"[{name}]"
