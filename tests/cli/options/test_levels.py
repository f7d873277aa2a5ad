"""Texts of ``--level`` are read once, by the command."""

from __future__ import annotations

import pytest

from uwsim.cli.options.levels import read_level, read_levels
from uwsim.errors import BadSetting, ErrorCollector, UwsimError


def test_a_level_is_a_name_and_a_number_with_all_its_digits() -> None:
    assert read_level(f"fog={1 / 3!r}") == ("fog", 1 / 3)
    assert read_level(" fog = 5e-1 ") == ("fog", 0.5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fog", "--level 'fog': expected NAME=VALUE."),
        ("=1", "--level '=1': expected NAME=VALUE."),
        ("fog=thick", "--level 'fog=thick': expected a number behind 'fog'."),
        ("fog=inf", "--level 'fog=inf': expected a number behind 'fog'."),
        ("fog=nan", "--level 'fog=nan': expected a number behind 'fog'."),
    ],
)
def test_what_is_no_level_is_refused(text: str, message: str) -> None:
    with pytest.raises(BadSetting) as caught:
        read_level(text)
    assert str(caught.value) == message


def test_each_wrong_level_is_reported_and_the_others_are_kept() -> None:
    wrong = ErrorCollector()
    assert read_levels(["fog", "fog=1", "current=x"], wrong) == [("fog", 1.0)]
    with pytest.raises(UwsimError, match=r"(?s)'fog': expected NAME.*'current=x'"):
        wrong.raise_errors()
