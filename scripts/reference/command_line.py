"""``docs/command-line.md``: the help texts of all commands."""

from __future__ import annotations

import contextlib
import io
import os
import unittest.mock

from uwsim.cli.app import COMMANDS, main

HEAD = """\
# The command line

This page is what `uwsim --help` and `uwsim COMMAND --help` print; `scripts/docs` writes it.

Exit status: 0 done; 2 wrong input, with one line on stderr for each error; 3 the run failed,
partial results kept; 130 interrupted, finished parts kept.

Run `uwsim --install-completion` once; then Tab completes commands, options, and the names of
scenes, benchmarks and algorithms; `python -m uwsim` is the same command. With `--json`, `list`,
`info`, `check` and `compare` print JSON for programs.

A file is searched next to the file that names it and in each of its parent folders; as given; in
every `--data-path`; in `~/.uwsim/data` and `~/.uwsim`; in the package; in each of these also under
`data`, `data/scenes`, `objects`, `terrain`, `robot` and `textures`. Packages of ROS are found by
[their names](assets.md#packages-of-ros), also in a workspace. Bundled scenes and benchmarks are
called by their bare name.

A PATH in `--set PATH=VALUE` is element names joined by dots; `[name]` selects one of several
elements: `vehicle[girona500].virtualCamera[bowtech1].std=0.016`.
"""


def page() -> str:
    """Return the page as Markdown."""
    parts = [HEAD, section("uwsim", "--help")]
    for name, command in COMMANDS.items():
        parts.append(section(f"uwsim {name}", name, "--help"))
        parts += [
            section(f"uwsim {name} {word}", name, word, "--help") for word in command.subcommands
        ]
    return "\n".join(parts)


def section(title: str, *arguments: str) -> str:
    """Return a section: the title and the output of ``uwsim ARGUMENTS``."""
    output = io.StringIO()
    with unittest.mock.patch.dict(os.environ, COLUMNS="80"), contextlib.redirect_stdout(output):
        main(arguments)
    return f"## {title}\n\n```text\n{output.getvalue().strip()}\n```\n"


if __name__ == "__main__":
    print(page(), end="")
