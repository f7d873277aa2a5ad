"""Specs in XML: every error at once, at its line, with the nearest right name."""

from __future__ import annotations

import contextlib
import math
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from uwsim import schema
from uwsim.errors import FileError
from uwsim.schema import (
    Diagnostics,
    Numbers,
    Original,
    TwoNumbers,
    element,
    parse,
    parse_number,
    read,
    write,
)


@dataclass(frozen=True, kw_only=True)
class ItemSpec:
    """An ``<item>``."""

    name: str
    """Its name."""


@dataclass(frozen=True, kw_only=True)
class ThingSpec:
    """A ``<thing>``."""

    name: str
    """Its name."""
    fog_density: float = element(default=0.5, minimum=0)
    """How thick [1/m]."""
    count: int = 3
    """How many [px]."""
    flag: bool = element(default=False, original=Original(invalid_flag_value=True))
    """Whether."""
    mode: Literal["fast", "slow"] = "fast"
    """How."""
    lean: float = element(default=0.0, original=Original(allows_trailing_text=True))
    """Tilt [deg]."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where [m]."""
    colour: tuple[float, float, float] = element("color", default=(0.0, 0.0, 0.0), parts="rgb")
    """Colour."""
    joint_values: tuple[float, ...] = element(item="joint", default=())
    """Joints [rad]."""
    items: tuple[ItemSpec, ...] = element("item", default=())
    """Items."""
    best: ItemSpec | None = None
    """One item."""
    buried: float = element(attribute=True, default=0.0)
    """How deep [1]."""
    label: str = element(default="", original=Original(aliases=("title",)))
    """Text."""
    extra: str | None = element(namespaced=True, default=None)
    """An extension."""


def read_text(
    text: str, folder: Path, *, strict: bool = False
) -> tuple[ThingSpec | None, list[str]]:
    file = folder / "thing.xml"
    file.write_text(text)
    diagnostics = Diagnostics("thing.xml", is_strict=strict)
    spec = read(ThingSpec, parse(file).root, diagnostics)
    return spec, [str(diagnostic) for diagnostic in diagnostics.to_list()]


def refused(data: bytes, folder: Path) -> str:
    file = folder / "thing.xml"
    file.write_bytes(data)
    with pytest.raises(FileError) as caught:
        parse(file)
    return str(caught.value)


def test_elements_may_stand_in_any_order(tmp_path: Path) -> None:
    spec, said = read_text(
        "<thing><color><b>3</b><r>1</r><g>2</g></color><count>5</count>"
        "<fogDensity> 1e-7\t</fogDensity><name> a </name></thing>",
        tmp_path,
    )
    assert said == []
    assert spec == ThingSpec(name="a", fog_density=1e-7, count=5, colour=(1.0, 2.0, 3.0))


def test_strict_holds_a_file_against_the_order_of_the_fields(tmp_path: Path) -> None:
    _, said = read_text("<thing>\n<count>5</count>\n<name>a</name></thing>", tmp_path, strict=True)
    assert said == ["thing.xml:3: <name> comes after <count>; the original expects it before"]


def test_every_error_is_reported_at_once_with_its_line(tmp_path: Path) -> None:
    _, said = read_text(
        """<thing>
        <fogDensty>1</fogDensty>
        <fogDensity>thick</fogDensity>
        <count>many</count>
        <position> <x>1</x> <y>nan</y> </position>
        <mode>fasst</mode>
        <item/>
        <best> <nam>x</nam> </best>
        </thing>""",
        tmp_path,
    )
    assert said == [
        "thing.xml:1: <thing> lacks <name>: its name",
        "thing.xml:2: <fogDensty> is not an element of <thing>. Did you mean fogDensity?",
        "thing.xml:3: <fogDensity> is 'thick'; expected a number >= 0 [1/m]",
        "thing.xml:4: <count> is 'many'; expected a whole number [px]",
        "thing.xml:5: <y> of <position> is 'nan'; expected a number [m]",
        "thing.xml:5: <position> lacks <z>",
        "thing.xml:6: <mode> is 'fasst'; expected one of 'fast', 'slow'. Did you mean 'fast'?",
        "thing.xml:7: <item> lacks <name>: its name",
        "thing.xml:8: <nam> is not an element of <best>. Did you mean name?",
        "thing.xml:8: <best> lacks <name>: its name",
    ]


def test_what_the_original_read_leniently_is_a_warning(tmp_path: Path) -> None:
    spec, said = read_text(
        "<thing><name>a</name><count>320.5</count><flag>yes</flag><lean>3deg</lean></thing>",
        tmp_path,
    )
    assert spec == ThingSpec(name="a", count=320, flag=True, lean=3.0)
    assert len(said) == 3


def test_an_element_that_may_stand_once_stands_once(tmp_path: Path) -> None:
    _, said = read_text("<thing><name>a</name>\n<name>b</name></thing>", tmp_path)
    assert said == [
        "thing.xml:2: <name> is given twice in <thing> (first in line 1); only one is allowed"
    ]


def test_an_old_name_is_read_with_a_warning(tmp_path: Path) -> None:
    spec, said = read_text("<thing><name>a</name><title>t</title></thing>", tmp_path)
    assert spec is not None
    assert spec.label == "t"
    assert said == ["thing.xml:1: warning: <title> is an old name of <label>"]


def test_of_text_split_by_comments_the_last_piece_wins(tmp_path: Path) -> None:
    spec, said = read_text("<thing><name>a<!-- x -->b<!-- y --> </name></thing>", tmp_path)
    assert spec is not None
    assert spec.name == "b"
    assert said == [
        "thing.xml:1: warning: a comment splits the text of <name>; its last piece is read, 'b', "
        "as the original does"
    ]


@pytest.mark.parametrize("text", ["a<!-- x -->", "<!-- x --> a", "<!-- x -->a<!-- y -->\n"])
def test_a_comment_beside_a_text_is_none_of_it(text: str, tmp_path: Path) -> None:
    spec, said = read_text(f"<thing><name>{text}</name></thing>", tmp_path)
    assert spec is not None
    assert (spec.name, said) == ("a", [])


@pytest.mark.parametrize("version", ["0.0", "0.1", "1.0", "1.1", "2.0", "10.0"])
def test_any_version_of_xml_is_read(version: str, tmp_path: Path) -> None:
    """Robots of PyBullet have 0.0, those of SMaRC 2.0."""
    text = f"<?xml version='{version}' ?>\n<thing><name>a</name></thing>"
    spec, said = read_text(text, tmp_path)
    assert spec is not None
    assert (spec.name, said) == ("a", [])


def test_an_empty_element_keeps_the_default(tmp_path: Path) -> None:
    spec, said = read_text("<thing><name>a</name><count> </count></thing>", tmp_path)
    assert (spec, said) == (ThingSpec(name="a"), [])


def test_an_empty_joint_is_an_error_because_it_would_shift_the_others(tmp_path: Path) -> None:
    _, said = read_text(
        "<thing><name>a</name><jointValues><joint>1</joint><joint/></jointValues></thing>", tmp_path
    )
    assert said == ["thing.xml:1: <joint> is empty; expected a number [rad]"]


def test_stray_text_and_unknown_attributes_are_errors(tmp_path: Path) -> None:
    _, said = read_text('<thing buryed="1">oops<name>a</name></thing>', tmp_path)
    assert said == [
        "thing.xml:1: stray text 'oops' in <thing>",
        "thing.xml:1: buryed is not an attribute of <thing>. Did you mean buried?",
    ]


def test_an_unknown_extension_names_the_right_one(tmp_path: Path) -> None:
    spec, said = read_text(
        '<thing xmlns:u="urn:uwsim:1"><name>a</name><u:extra>e</u:extra><u:extar/></thing>',
        tmp_path,
    )
    assert spec == ThingSpec(name="a", extra="e")
    assert said == ["thing.xml:1: <u:extar> is not an element of <thing>. Did you mean u:extra?"]


def test_an_extension_without_its_namespace_is_unknown(tmp_path: Path) -> None:
    _, said = read_text("<thing><name>a</name><extra>e</extra></thing>", tmp_path)
    assert said == ["thing.xml:1: <extra> is not an element of <thing>. Did you mean u:extra?"]


def test_a_file_with_extensions_carries_no_doctype(tmp_path: Path) -> None:
    file = tmp_path / "thing.xml"
    file.write_text(
        '<!DOCTYPE thing SYSTEM "t.dtd">\n<thing xmlns:u="urn:uwsim:1">\n<u:extra/></thing>'
    )
    diagnostics = Diagnostics("thing.xml")
    schema.check_head(parse(file), "thing", diagnostics)
    assert [diagnostic.line for diagnostic in diagnostics.to_list()] == [3]
    assert "remove the DOCTYPE" in diagnostics.to_list()[0].message


def test_lines_beyond_65535_are_right(tmp_path: Path) -> None:
    _, said = read_text("<thing>" + "\n" * 70_000 + "<oops/></thing>", tmp_path)
    assert any(line.startswith("thing.xml:70001: <oops>") for line in said)


def test_errors_beyond_a_hundred_are_counted(tmp_path: Path) -> None:
    _, said = read_text("<thing><name>a</name>" + "<x/>" * 150 + "</thing>", tmp_path)
    assert len(said) == 101
    assert said[-1] == "thing.xml: and 50 more errors"


@pytest.mark.parametrize(("token", "value"), sorted(schema.TOKENS.items()))
def test_pi_may_stand_for_a_number(token: str, value: float) -> None:
    assert parse_number(token) == value
    assert abs(value) in (math.pi, math.pi / 2, math.pi / 4)


@pytest.mark.parametrize(
    "text", ["nan", "inf", "-inf", "1e999", "M_PI/2", "3.14f", "0x10", "1_0", "", "1 2", "٣"]
)
def test_what_is_no_finite_number_is_none(text: str) -> None:
    assert parse_number(text) is None


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_finite_float_is_read_as_it_was_written(value: float) -> None:
    assert parse_number(repr(value)) == value


TEXT = st.text(st.characters(min_codepoint=33, max_codepoint=0x2FFF, categories=["L", "P", "N"]))
NUMBERS = st.floats(-schema.MAX_NUMBER, schema.MAX_NUMBER)
NAMES = TEXT.filter(bool)
SPECS = st.builds(
    ThingSpec,
    name=NAMES,
    fog_density=st.floats(0, 1e9),
    count=st.integers(-(2**31) + 1, 2**31 - 1),
    flag=st.booleans(),
    mode=st.sampled_from(["fast", "slow"]),
    lean=NUMBERS,
    position=st.tuples(NUMBERS, NUMBERS, NUMBERS),
    colour=st.tuples(NUMBERS, NUMBERS, NUMBERS),
    joint_values=st.lists(NUMBERS).map(tuple),
    items=st.lists(st.builds(ItemSpec, name=NAMES)).map(tuple),
    best=st.none() | st.builds(ItemSpec, name=NAMES),
    buried=NUMBERS,
    label=TEXT,
    extra=st.none() | NAMES,
)


@given(SPECS)
def test_reading_what_was_written_gives_the_same_spec(spec: ThingSpec) -> None:
    diagnostics = Diagnostics("thing.xml", is_strict=True)
    assert read(ThingSpec, write(spec, "thing"), diagnostics) == spec
    assert diagnostics.to_list() == []


def test_a_field_documents_itself() -> None:
    docs = schema.field_docs(ThingSpec)
    assert docs["fog_density"] == "How thick [1/m]."
    assert {field.name for field in schema.fields_of(ThingSpec)} == set(docs)


BOMB = b"""<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;">]><a>&b;</a>"""
NEAR = b'<?xml version="1.0"?>\n'


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "the file is empty"),
        (b" \r\n", "the file is empty"),
        (b"<a>", "not well-formed"),
        (b"<a/><b/>", "not well-formed"),
        (BOMB, "<!ENTITY> declarations are not read"),
        (b'<!DOCTYPE a [<!ATTLIST a b CDATA "x">]><a/>', "<!ATTLIST> declarations"),
        (NEAR + b"<a>" * 300 + b"</a>" * 300, "Excessive depth"),
        (NEAR + b"<a>" + b"<b/>" * 200_000 + b"</a>", "more than 50000 elements"),
        (NEAR + b"<a>" + b"x" * 11_000_000 + b"</a>", "too long"),
        (b" " * (schema.MAX_BYTES + 1), "larger than 16 MB"),
        (b"\0\0", "zero bytes"),
        (b'<?xml version="1.0" encoding="ebcdic-us"?><a/>', "encoding 'ebcdic-us' is not read"),
        (b"<a>\xff</a>", "not well-formed"),
        (b"<a>\n<!-- posici\xf3n --></a>", ":2: not well-formed XML: the byte 0xf3 is not UTF-8"),
    ],
)
def test_hostile_files_are_refused_with_a_clean_error(
    data: bytes, said: str, tmp_path: Path
) -> None:
    assert said in refused(data, tmp_path)


def test_a_dtd_is_never_loaded(tmp_path: Path) -> None:
    (tmp_path / "t.dtd").write_text('<!ENTITY secret "loaded">')
    _, said = read_text(
        '<!DOCTYPE thing SYSTEM "t.dtd"><thing><name>&secret;</name></thing>', tmp_path
    )
    assert said[0] == "thing.xml:1: '&secret;' in <name>: entities are not read"


def test_utf_16_and_a_byte_order_mark_are_read(tmp_path: Path) -> None:
    file = tmp_path / "thing.xml"
    for encoding in ("utf-16", "utf-8-sig"):
        file.write_bytes('<?xml version="1.0"?><thing>ä</thing>'.encode(encoding))
        assert parse(file).root.text == "ä"


@pytest.mark.parametrize("name", [".", "nothing.xml", "x" * 300])
def test_what_is_no_file_is_reported_cleanly(name: str, tmp_path: Path) -> None:
    with pytest.raises(FileError):
        parse(tmp_path / name)


@given(st.binary(max_size=300))
def test_no_bytes_raise_anything_but_a_file_error(data: bytes) -> None:
    with tempfile.NamedTemporaryFile(suffix=".xml") as file:
        file.write(data)
        file.flush()
        with contextlib.suppress(FileError):
            parse(Path(file.name))


@pytest.mark.parametrize("text", ["1e300", "-1e308", "1000000001"])
def test_numbers_beyond_any_quantity_are_errors(text: str, tmp_path: Path) -> None:
    _, said = read_text(f"<thing><name>a</name><lean>{text}</lean></thing>", tmp_path)
    assert said == [f"thing.xml:1: <lean> is '{text}'; no quantity is beyond 1e+09"]


def test_a_file_that_was_cut_off_is_one_error_in_whole_words(tmp_path: Path) -> None:
    file = tmp_path / "thing.xml"
    whole = "<thing>\n  <name>a</name>\n  <fogDensity>0.5</fogDensity>\n</thing>"
    for n in range(len("<thing>\n"), len(whole)):
        file.write_text(whole[:n])
        with pytest.raises(FileError) as caught:
            parse(file)
        (diagnostic,) = caught.value.diagnostics
        cut = "the file ends in the middle; its end is missing"
        if not whole[:n].rstrip().endswith(">"):
            assert diagnostic.message == f"not well-formed XML: {cut}"


@dataclass(frozen=True, kw_only=True)
class CurveSpec:
    """A ``<curve>``: numbers in one text."""

    terms: Numbers = element(default=(), minimum=0.0)
    """Coefficients [N]."""
    ends: TwoNumbers | None = None
    """Least and greatest."""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<terms>1 2, 3</terms> <ends>-1 M_PI</ends>", ((1.0, 2.0, 3.0), (-1.0, math.pi))),
        ("<terms/>", ((), None)),
        ("<terms>1 x 3</terms>", "<terms> contains 'x'; expected numbers >= 0 [N]"),
        ("<terms>1 -2</terms>", "<terms> contains '-2'; expected numbers >= 0 [N]"),
        ("<terms>,</terms>", "<terms> contains ','; expected numbers >= 0 [N]"),
        ("<terms>1e12</terms>", "<terms> contains '1e12'; no quantity is beyond 1e+09"),
        ("<ends>1 2 3</ends>", "<ends> has 3 numbers; expected 2"),
        (f"<terms>{'1 ' * 201}</terms>", "<terms> has 201 numbers; expected 200 at most"),
    ],
)
def test_numbers_stand_in_one_text(text: str, expected: object) -> None:
    node = etree.fromstring(f"<curve>{text}</curve>")
    diagnostics = Diagnostics("curve.xml")
    spec = read(CurveSpec, node, diagnostics)
    assert spec is not None
    if isinstance(expected, str):
        assert [diagnostic.message for diagnostic in diagnostics.to_list()] == [expected]
        return
    assert (spec.terms, spec.ends) == expected
    assert read(CurveSpec, write(spec, "curve"), Diagnostics("curve.xml")) == spec


def test_a_field_refers_to_something_that_a_scene_has() -> None:
    with pytest.raises(ValueError, match="refers_to='bodi': expected one of actuators, body"):
        element(refers_to="bodi")  # type: ignore[arg-type]
