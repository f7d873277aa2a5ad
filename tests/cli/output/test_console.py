"""Escapes that files hold are shown on a terminal, and not obeyed."""

import io

from rich.table import Table
from rich.text import Text

from uwsim.cli.output.console import Console


def test_escapes_in_tables_and_lines_are_shown() -> None:
    out = io.StringIO()
    console = Console(file=out, width=60)
    table = Table(box=None)
    table.add_column(Text("head\x1b[31m"))
    table.add_row(Text("cell\x1b]0;title\x07"))
    console.print(table)
    console.print(Text("line\x1b[2J\nnext"))
    said = out.getvalue()
    assert "\x1b" not in said
    assert "head\\x1b" in said
    assert "line\\x1b[2J" in said
    assert said.count("\n") >= 4


def test_styles_of_the_console_are_still_its_own() -> None:
    out = io.StringIO()
    Console(file=out, force_terminal=True, color_system="standard").print(Text("x", style="bold"))
    assert out.getvalue() == "\x1b[1mx\x1b[0m\n"
