"""Lists, dictionaries, YAML files, arguments and substitutions in xacro."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from uwsim.errors import FileError, SceneError
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.xacro import parse_expanded
from uwsim.scene.xacro.expression import evaluate
from uwsim.scene.xacro.value import DistinctItems, ExpressionError, Value

NAMES: dict[str, Value] = {
    "place": [1.0, -2.5, 0.25],
    "grid": [[1, 2], [3, 4]],
    "hull": {"mass": 12.5, "size": [2, 1, 0.5], "name": "keel", 7: "seven"},
    "word": "bluerov",
    "n": 3,
}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("pow(0.5, 2)", 0.25),
        ("math.pow(n, 2)", 9),
        ("pow(2, -1)", 0.5),
        ("2 in [1, 2]", True),
        ("n not in (1, 2)", True),
        ("'rov' in word", True),
        ("'mass' in hull and 'drag' not in hull", True),
        ("place[0]", 1.0),
        ("place[-1]", 0.25),
        ("place[n - 2] * 2", -5.0),
        ("grid[1][0]", 3),
        ("hull['mass']", 12.5),
        ("hull.size[2]", 0.5),
        ("hull[7]", "seven"),
        ("hull.get('drag', 4)", 4),
        ("word[0] + word[-1]", "bv"),
        ("word.upper()", "BLUEROV"),
        ("sum(place) / len(place)", pytest.approx(-1.25 / 3)),
        ("[1] + [2, 3]", [1, 2, 3]),
        ("range(2, 8, 3)", [2, 5]),
        ("sorted(hull.size)", [0.5, 1, 2]),
        ("dict(a=1)['a']", 1),
        ("None == 0", False),
        ("max([3, 9, 4])", 9),
        ("math.log2(8)", 3.0),
        ("hull.get('drag') is None", True),
        ("n is not None and (n > 2) is True", True),
        ("python.isinstance(n, int)", True),
        ("python.isinstance(word, (int, python.float, list))", False),
        ("isinstance(place, list) and isinstance(hull, dict)", True),
        ("python.len(python.str(n))", 1),
        ("xacro.tokenize('a, b;c  d')", ["a", "b", "c", "d"]),
        ("xacro.tokenize('x-1--y', sep='-', skip_empty=False)", ["x", "1", "", "y"]),
        ("xacro.tokenize('a^]b', '^]')", ["a", "b"]),
        ("xacro.tokenize('ab', '')", ["ab"]),
        ("xacro.dotify(dict(mass=4)).mass", 4),
    ],
)
def test_values(text: str, expected: object) -> None:
    assert evaluate(text, lambda name: NAMES[name]) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("place[3]", "there is no item 3: the list has 3"),
        ("place['x']", "is no number of an item"),
        ("hull.mas", "the dictionary has no 'mas'. Did you mean 'mass'?"),
        ("hull['mas']", "the dictionary has no 'mas'"),
        ("n[0]", "is neither a list nor a dictionary"),
        ("place - 1", "lists can only be added to lists"),
        ("powr(1, 2)", "no function is called 'powr'. Did you mean 'pow'?"),
        ("word.format(1)", "no function is called 'word.format'"),
        ("pow('a', 2)", "'a' is not a number"),
        ("range(10**9)", "a range of more than"),
        ("list(range(9000)) + list(range(9000))", "more than 10000 values"),
        ("n is 3", "write =="),
        ("isinstance(n, complex)", "'complex' is no kind of value"),
        ("isinstance(n, n.__class__)", "is no kind of value"),
        ("xacro.dotify(n)", "is no dictionary"),
    ],
)
def test_what_has_no_value(text: str, message: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        evaluate(text, lambda name: NAMES[name])
    assert message in str(caught.value)


def text_of(folder: Path, body: str, **arguments: str) -> str:
    file = folder / "a.xacro"
    file.write_text(f'<a xmlns:xacro="http://ros.org/wiki/xacro">{body}</a>')
    return "".join(parse_expanded(file, error=SceneError, arguments=arguments).root.itertext())


@pytest.mark.parametrize("scope", ["outside", "in a macro"])
def test_a_property_may_be_a_list(scope: str, tmp_path: Path) -> None:
    body = (
        '<xacro:property name="at" value="${[1.5, 2, x]}"/><xacro:property name="x" value="8"/>'
        "<b>${at[0]} ${at[2] + 1}</b>"
    )
    if scope == "in a macro":
        body = (
            '<xacro:macro name="m" params="x"><xacro:property name="at" value="${[1.5, 2, x]}"/>'
            '<b>${at[0]} ${at[2] + 1}</b></xacro:macro><xacro:m x="8"/>'
        )
    assert text_of(tmp_path, body) == "1.5 9"


def test_optenv_is_the_variable_or_its_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("UWSIM_TEST_ROV", raising=False)
    assert text_of(tmp_path, "<b>$(optenv UWSIM_TEST_ROV two words)</b>") == "two words"
    assert text_of(tmp_path, "<b>$(optenv UWSIM_TEST_ROV)</b>") == ""
    monkeypatch.setenv("UWSIM_TEST_ROV", "heavy")
    assert text_of(tmp_path, "<b>$(optenv UWSIM_TEST_ROV light)</b>") == "heavy"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("<b>${'$(arg kind)' == 'heavy'}</b>", "True"),
        ("<b>${2 * $(arg n)}</b>", "14"),
        ("<b>$(eval 2 * n + 1)</b>", "15"),
        ("<b>$(eval arg('kind') == 'heavy')</b>", "True"),
        ("<b>${xacro.arg('n') + 1}</b>", "8"),
        (
            '<xacro:property name="p" value="my"/><b>$(find ${p}_pkg)/a.dae</b>',
            "package://my_pkg/a.dae",
        ),
    ],
)
def test_substitutions_and_expressions_nest(body: str, expected: str, tmp_path: Path) -> None:
    args = '<xacro:arg name="kind" default="light"/><xacro:arg name="n" default="7"/>'
    assert text_of(tmp_path, args + body, kind="heavy") == expected


YAML = """hull: {mass: 12.5, tilt: !degrees 90}
thrusters:
  - [0.1, 0.2]
  - [-0.1, 0.2]
name: "rov"
"""


@pytest.mark.parametrize("call", ["xacro.load_yaml", "load_yaml"])
@pytest.mark.parametrize("place", ["config/rov.yaml", "../config_pkg/rov.yaml"])
def test_a_dictionary_is_read_from_a_yaml_file(call: str, place: str, tmp_path: Path) -> None:
    folder = tmp_path / "my_pkg" / "urdf"
    folder.mkdir(parents=True)
    (folder / place).parent.mkdir(parents=True, exist_ok=True)
    (folder / place).write_text(YAML)
    file = place if place.startswith("config/") else "$(find config_pkg)/rov.yaml"
    (tmp_path / "my_pkg" / "config_pkg").mkdir(exist_ok=True)
    body = (
        f'<xacro:property name="file" value="{file}"/>'
        f'<xacro:property name="p" value="${{{call}(file)}}"/>'
        "<b>${p['hull']['mass']} ${p.thrusters[1][0]} ${len(p.thrusters)} ${p.hull.tilt}</b>"
    )
    assert text_of(folder, body) == f"12.5 -0.1 2 {math.pi / 2}"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("a: [1", "not YAML"),
        ("a: &x [*x]", "the alias *x is within its own node"),
        ("a: *y", "found undefined alias 'y'"),
        ("a: 1\nb: : 2", "x.yaml:2: not YAML"),
        ("a: !!python/object/apply:os.system [touch /tmp/x]", "not YAML"),
        ("a: !degrees left", "'left'"),
        (b"\xff\xfe\x00", "not YAML"),
        ("[" * 200 + "]" * 200, "nested deeper"),
        (None, "is not found"),
    ],
)
def test_a_wrong_yaml_file_is_one_error(
    content: str | bytes | None, message: str, tmp_path: Path
) -> None:
    if content is not None:
        data = content if isinstance(content, bytes) else content.encode()
        (tmp_path / "x.yaml").write_bytes(data)
    with pytest.raises(SceneError) as caught:
        text_of(tmp_path, "<b>${xacro.load_yaml('x.yaml')['a']}</b>")
    assert message in str(caught.value)
    assert len(caught.value.diagnostics) == 1


def test_a_yaml_file_outside_the_folders_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    (tmp_path / "home" / "sea").mkdir(parents=True)
    (tmp_path / "secret.yaml").write_text("a: 1")
    with pytest.raises(SceneError, match="outside the searched folders"):
        text_of(tmp_path / "home" / "sea", f"<b>${{load_yaml('{tmp_path}/secret.yaml')}}</b>")


@pytest.mark.parametrize("root", ["parts", "robot", "link_library", "foo:bar"])
@pytest.mark.parametrize("nested", [False, True])
def test_the_root_of_an_included_file_is_dropped_whatever_its_name(
    root: str, nested: bool, tmp_path: Path
) -> None:
    xmlns = 'xmlns:xacro="http://www.ros.org/wiki/xacro" xmlns:foo="urn:foo"'
    keel = (
        f'<{root} {xmlns}><link name="keel"/><joint name="fix" type="fixed">'
        f'<parent link="base"/><child link="keel"/></joint></{root}>'
    )
    (tmp_path / "keel.xacro").write_text(keel)
    if nested:
        (tmp_path / "outer.xacro").write_text(
            f'<{root} {xmlns}><xacro:include filename="keel.xacro"/></{root}>'
        )
    (tmp_path / "boat.urdf.xacro").write_text(
        f'<robot name="boat" {xmlns}><link name="base"/>'
        f'<xacro:include filename="{"outer" if nested else "keel"}.xacro"/></robot>'
    )
    robot = read_urdf(tmp_path / "boat.urdf.xacro")
    assert [link.name for link in robot.links] == ["base", "keel"]


def test_two_packages_with_parts_of_one_name_include_their_own(tmp_path: Path) -> None:
    for name in ("hull_pkg", "tool_pkg"):
        (tmp_path / name / "urdf").mkdir(parents=True)
        (tmp_path / name / "urdf" / "parts.xacro").write_text(f'<p><link name="of_{name}"/></p>')
    file = tmp_path / "hull_pkg" / "urdf" / "r.urdf.xacro"
    text = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{}</robot>'
    include = '<xacro:include filename="$(find {})/urdf/parts.xacro"/>'
    for name in ("hull_pkg", "tool_pkg"):
        file.write_text(text.format(include.format(name)))
        assert read_urdf(file).root == f"of_{name}"
    file.write_text(text.format(include.format("gone_pkg")))
    assert "package 'gone_pkg' is not found" in read_urdf(file).expansion.warnings[0].message
    file.write_text(text.format('<xacro:include filename="$(find gone_pkg)/no.xacro"/>'))
    with pytest.raises(SceneError, match="package 'gone_pkg' is not found"):
        read_urdf(file)


@pytest.mark.parametrize(
    ("expression", "expected"),
    [  # as xacro 2 of ROS gives them
        ("list(map(float, '4,8'.split(',')))[1]", "8.0"),
        ("[x * 2 for x in range(4) if x > 1]", "[4, 6]"),
        ("[k + str(v) for k, v in dict(a=1, b=2).items()]", "['a1', 'b2']"),
        ("sum(x * y for x in [1, 2] for y in [3, 4])", "21"),
        ("[[x for x in range(y)] for y in [1, 2]]", "[[0], [0, 1]]"),
        ("'%.2f' % 2.0", "2.00"),
        ("'%s_%03d' % ('thruster', 7)", "thruster_007"),
        ("'abc'[1:]", "bc"),
        ("[1, 2, 3][::-1]", "[3, 2, 1]"),
        ("'-' * 3", "---"),
        ("[0.0] * 2", "[0.0, 0.0]"),
        ("'x' in 'xyz'", "True"),
        ("[n + 1 for n in [7]]", "[8]"),
    ],
)
def test_loops_formats_and_parts_are_those_of_python(
    expression: str, expected: str, tmp_path: Path
) -> None:
    assert text_of(tmp_path, f"<b>${{{expression}}}</b>".replace("<b>", "<b>", 1)) == expected


@pytest.mark.parametrize(
    ("expression", "said"),
    [
        ("[x for x in range(3000)]", "loops of more than 2000 iterations"),
        ("[[x for x in range(100)] for y in range(100)]", "loops of more than 2000 iterations"),
        ("[list(range(1000)) for x in range(9)]", "loops of more than 2000 iterations"),
        ("'%99999999d' % 1", "a field of more than 99 letters"),
        ("'%*d' % (99999999, 1)", "a field of more than 99 letters"),
        ("'abc' * 99999999", "longer than 4096"),
        ("[1] * 99999999", "longer than 10000"),
        ("list(map(flaot, [1]))", "no function is called 'flaot'. Did you mean 'float'?"),
        ("[x for x, y in [1]]", "cannot be the name of an item"),
        ("[y for x in [1]]", "no property is called 'y'"),
    ],
)
def test_what_a_loop_cannot_do_is_said_in_a_line(
    expression: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(FileError, match=re.escape(said)):
        text_of(tmp_path, f"<b>${{{expression}}}</b>")


def test_commas_between_parameters_are_no_part_of_their_names(tmp_path: Path) -> None:
    body = '<xacro:macro name="m" params="x, y"><b>${x + y}</b></xacro:macro><xacro:m x="1" y="2"/>'
    assert text_of(tmp_path, body) == "3"


@pytest.mark.parametrize("depth", ["", "urdf/parameters/"])
def test_a_file_of_a_lost_package_is_not_another_of_its_name(depth: str, tmp_path: Path) -> None:
    (tmp_path / "parts.xacro").write_text("<x><link name='wrong'/></x>")
    body = f'<xacro:include filename="$(find lost_pkg)/{depth}other/parts.xacro"/><b>1</b>'
    with pytest.raises(FileError, match="package 'lost_pkg' is not found"):
        text_of(tmp_path, body)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("python.set('b a b'.split())", ["b", "a"]),
        ("set([3, 1]) - set([1, 2])", [3]),
        ("set([3, 1]) & set([1, 2])", [1]),
        ("set([3, 1]) | set([1, 2])", [3, 1, 2]),
        ("set([1, 2]) == set([2, 1, 2])", True),
        ("set([1]) < set([2, 1])", True),
        ("set([1, 2]) <= set([1])", False),
        ("len(set('abca'))", 3),
        ("isinstance(set([1]), list)", False),
        ("isinstance(set([1]), (list, set))", True),
        ("'a' in set(['a'])", True),
        ("1 if set([1]) - set([1]) else 2", 2),
    ],
)
def test_sets_keep_their_order(text: str, value: object) -> None:
    found = evaluate(text, NAMES.__getitem__)
    assert (list(found) if isinstance(found, DistinctItems) else found) == value


@pytest.mark.parametrize("text", ["set([1]) + set([2])", "set([1]) - [1]", "2 * set([1])"])
def test_sets_have_the_operations_of_sets_alone(text: str) -> None:
    with pytest.raises(ExpressionError, match="sets have"):
        evaluate(text, NAMES.__getitem__)
