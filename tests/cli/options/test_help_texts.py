"""The groups of options in help texts."""

from __future__ import annotations

import re

import pytest

from uwsim.cli import main
from uwsim.cli.options.help_texts import COMMON_OPTIONS


@pytest.mark.parametrize("command", sorted(COMMON_OPTIONS))
def test_help_shows_the_common_options_first_and_each_option_once(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    main([command, "--help"])
    text = capsys.readouterr().out.partition("Arguments:")[2]
    names = re.findall(r"^  (?:-\w, )?(--[a-z0-9-]+)", text, re.MULTILINE)
    n_common = len(COMMON_OPTIONS[command])
    assert tuple(names[:n_common]) == COMMON_OPTIONS[command]
    assert len(names) == len(set(names))
    assert text.index("Common options:") < text.index("Output:")
