"""Benchmark files as people wrote them for years: what the original plays is played."""

from __future__ import annotations

from pathlib import Path

import pytest

from uwsim.benchmark.reader import check_benchmark, read_benchmark
from uwsim.benchmark.updaters import swept_parameters
from uwsim.errors import BenchmarkError

DOCTYPE = '<!DOCTYPE benchmark SYSTEM "benchmark.dtd">'
FOG = """<sceneFogUpdater> <initialValue>{}</initialValue> <finalValue>{}</finalValue>
<step>{}</step> <interval>{}</interval> </sceneFogUpdater>"""
WHOLE = """{head}
<benchmark>
  <measures>
    <time> <name>t</name>
      <startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn> </time>
    {more}
  </measures>
  <startOn> <type>onInit</type> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>{function}</function>
  <sceneUpdater> {updater} </sceneUpdater>
</benchmark>
"""


def written(
    tmp_path: Path,
    *numbers: str,
    head: str = DOCTYPE,
    more: str = "",
    function: str = "t",
    encoding: str = "utf-8",
) -> Path:
    updater = FOG.format(*(numbers or ("0", "0.2", "0.1", "1")))
    text = WHOLE.format(head=head, more=more, function=function, updater=updater)
    path = tmp_path / "benchmark.xml"
    path.write_bytes(text.encode(encoding))
    return path


def said(path: Path) -> list[str]:
    return [error.message for error in check_benchmark(path)[0]]


def test_numbers_are_read_as_far_as_they_go_as_the_original_reads_them(tmp_path: Path) -> None:
    path = written(tmp_path, "0.0f", "+.2", " 1e-1 ", "2 s")
    updater = read_benchmark(path).scene_updater
    assert len(updater.values()) == 3
    assert updater.seconds_per_level == 2.0
    assert swept_parameters(updater) == ("fog",)
    assert said(path) == [
        "<initialValue> is '0.0f'; read as 0, as the original does",
        "<interval> is '2 s'; read as 2, as the original does",
    ]


def test_a_file_that_the_original_would_not_read_is_held_to_whole_numbers(tmp_path: Path) -> None:
    path = written(tmp_path, "0", "0.2", "0.1", "2 s", head="")
    assert said(path) == ["<interval> is '2 s'; expected a number > 0 [s]"]


def test_a_decimal_comma_is_an_error_and_not_the_number_before_it(tmp_path: Path) -> None:
    path = written(tmp_path, "0", "1,5", "0,5", "2")
    assert said(path) == [
        "<finalValue> is '1,5'; expected a number >= 0. Did you mean 1.5?",
        "<step> is '0,5'; expected a number. Did you mean 0.5?",
    ]


@pytest.mark.parametrize("name", ["latin-1", "Latin1", "ISO-8859-1", "windows-1252"])
def test_letters_beyond_ascii_may_stand_in_the_encoding_that_is_named(
    tmp_path: Path, name: str
) -> None:
    head = f'<?xml version="1.0" encoding="{name}"?>\n<!-- medici\u00f3n -->{DOCTYPE}'
    path = written(tmp_path, head=head, encoding="latin-1")
    assert said(path) == []


@pytest.mark.parametrize(
    ("function", "advice"),
    [
        ("t > 1 && t", "a bare '&'; write &amp;"),
        ("t &t", "a bare '&'; write &amp;"),
        ("t < 2 ? 1 : 0", "a '<' that begins no element; for 'less than' write &lt;"),
    ],
)
def test_a_sign_reserved_by_xml_is_reported_with_its_escape(
    tmp_path: Path, function: str, advice: str
) -> None:
    with pytest.raises(BenchmarkError, match="not well-formed XML") as caught:
        read_benchmark(written(tmp_path, function=function))
    assert advice in str(caught.value)


@pytest.mark.parametrize(
    ("space", "advice"),
    [
        ("http://ros.org/wiki/xacro", "expand the file with xacro first"),
        ("http://www.w3.org/2001/XInclude", "nothing is included: write it here"),
    ],
)
def test_what_another_program_should_have_replaced_is_reported(
    tmp_path: Path, space: str, advice: str
) -> None:
    path = written(tmp_path, more=f'<x:include xmlns:x="{space}" href="m.xml"/>', head="")
    assert said(path) == [f"<include> (in {space!r}) is not an element of <measures>; {advice}."]


def test_an_attribute_of_another_namespace_is_named_with_it(tmp_path: Path) -> None:
    path = written(tmp_path, head="")
    path.write_text(path.read_text().replace("<measures>", '<measures xml:lang="es">'))
    [error] = said(path)
    assert "lang" in error
    assert error.count("<") == error.count(">")
