"""What is wrong with a benchmark file, through the command line, before anything is simulated."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest

from uwsim.cli import main

FILES = Path(__file__).parents[2] / "benchmark" / "files"
BASE = (FILES / "vision-auto.xml").read_text()
SCENE = "visibility-scene"
GATE = "<startOn><type>onInit</type></startOn><stopOn><type>never</type></stopOn>"
AT_ONCE = 2.0
"""So little of the processor's time it takes to say what is wrong, once all is loaded [s]."""


def changed(*pairs: str) -> str:
    """The base file with each odd word replaced, once, by the one behind it."""
    text = BASE
    for old, new in zip(pairs[::2], pairs[1::2], strict=True):
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def with_measure(measure: str) -> str:
    return changed("  </measures>", f"{measure}\n  </measures>")


def with_updater(updater: str) -> str:
    return re.sub("(<sceneUpdater>).*(</sceneUpdater>)", rf"\1{updater}\2", BASE, flags=re.DOTALL)


def extended(text: str) -> str:
    """The same with the namespace of extensions, and so without a DOCTYPE."""
    return re.sub("<!DOCTYPE[^>]*>", "", text).replace(
        "<benchmark>", '<benchmark xmlns:u="urn:uwsim:1">'
    )


def line_of(text: str, word: str, n: int = 1) -> int:
    """Line of the n-th place at which a word stands."""
    places = [match.start() for match in re.finditer(re.escape(word), text)]
    return text.count("\n", 0, places[n - 1]) + 1


@pytest.fixture(scope="module", autouse=True)
def loaded() -> None:
    """Have the heavy modules loaded before anything is timed."""
    main(["check", str(FILES / "vision-auto.xml"), "--scene", SCENE])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "b.xml"


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str], file: Path) -> object:
    """Check a file and play it: both refuse it with the same lines. Gives those lines."""

    def refused(text: str | bytes, *, scene: str | None = SCENE) -> list[str]:
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        words = [] if scene is None else ["--scene", scene]
        capsys.readouterr()
        began = time.process_time()
        assert main(["check", str(file), *words]) == 2
        assert time.process_time() - began < AT_ONCE
        out = capsys.readouterr()
        assert out.err == ""
        # an error of the function is followed by the function, and a caret under what is wrong
        checked = [line for line in out.out.splitlines() if line.startswith(f"{file}")]
        shown = [line for line in out.out.splitlines() if line.startswith("  ")]
        warnings = {line for line in checked if ": warning: " in line}
        *errors, count = (line for line in checked if line not in warnings)
        assert re.fullmatch(r".*: (1 error|\d+ errors)", count)
        folder = file.with_suffix(".out")
        began = time.process_time()
        status = main(
            ["bench", str(file), "--scene", SCENE, "--algorithm", "frozen", "--out", str(folder)]
        )
        assert time.process_time() - began < AT_ONCE
        out = capsys.readouterr()
        assert (status, out.out) == (2, "")
        assert [line for line in out.err.splitlines() if line not in shown] == errors
        assert all(line in out.err for line in shown)
        assert not folder.exists()
        return [error.removeprefix(f"{file}:") for error in errors]

    return refused


CURRENT = (
    "<currentForceUpdater><initialValue>0</initialValue><finalValue>0.1</finalValue>"
    "<sphericalDirection><theta>0</theta><phi>0</phi></sphericalDirection>"
    "<forceVariation>0</forceVariation>\n<forcePeriod>4</forcePeriod>\n"
    "<directionVariation><theta>0</theta><phi>0</phi></directionVariation>"
    "<directionPeriod><theta>4</theta><phi>4</phi></directionPeriod>"
    "<random>0</random><step>0.1</step>LENGTH<target>girona500</target></currentForceUpdater>"
)
CAMERA = "<camera>bowtech1</camera>"
ERRORS = {
    "an unknown measure": (
        changed("<euclideanNorm>", "<euclidianNorm>", "</euclideanNorm>", "</euclidianNorm>"),
        "<euclidianNorm>", "Did you mean euclideanNorm?",
    ),
    "a missing target": (
        changed("      <target> cornersTopic </target>\n", ""),
        "<euclideanNorm>", "lacks <target>: the topic of the estimate (std_msgs/Float32MultiArray)",
    ),
    "an unknown trigger": (
        changed("<type>service<", "<type>servise<"),
        "servise", "expected one of never, onInit, onMove, onNoMove, position, service, topic",
    ),
    "a trigger without its target": (
        changed("<type>onInit</type>", "<type>onMove</type>"),
        "<startOn>", "<startOn> lacks <target>",
    ),
    "a trigger without its place": (
        changed("<type>onInit</type>", "<type>position</type><target>girona500</target>"),
        "<startOn>", "<startOn> lacks <position>",
    ),
    "a syntax error": (
        changed("corners+centroid", "corners+*centroid"),
        "<function", "<function>: '*' is not allowed here (column 9)",
    ),
    "a measure that is not there in the function": (
        changed("corners+centroid", "corners+centre"),
        "<function", "no measure is called 'centre'. Did you mean 'centroid'?",
    ),
    "a name that is no identifier": (
        changed("<name>centroid", "<name>2nd centroid", "corners+centroid", "corners"),
        "<euclideanNorm>\n      <name>2nd", "'2nd centroid' cannot be used in the function",
    ),
    "a name that no file can be called by": (
        changed("<name>centroid", f"<name>{'c' * 300}", "corners+centroid", "corners"),
        "<euclideanNorm>\n      <name>ccc", "c'... has 300 letters; expected at most 100",
    ),
    "two measures with one name": (
        changed("<name>centroid", "<name>corners", "corners+centroid", "corners"),
        "<euclideanNorm>\n      <name>corners</name>\n      <groundTruth type=\"centroid",
        "another measure (line 6) has the name 'corners'",
    ),
    "a negative step": (
        changed("<step>0.05", "<step>-0.05"), "<step>", "expected a number > 0 [1/m]",
    ),
    "a step of 0": (changed("<step>0.05", "<step>0"), "<step>", "expected a number > 0 [1/m]"),
    "an interval of 0": (
        changed("<interval>5", "<interval>0"), "<interval>", "expected a number > 0 [s]",
    ),
    "an interval of less than half a step": (
        changed("<interval>5", "<interval>0.0009"),
        "<interval>", "<interval> is 0.0009 s: less than half a step of 0.002 s, so no step",
    ),
    "a settling time of less than half a step": (
        extended(
            with_updater(CURRENT.replace("LENGTH", "<interval>9</interval>")).replace(
                "<currentForceUpdater", '<currentForceUpdater u:settlingTime="0.0004"'
            )
        ),
        "<currentForceUpdater", "u:settlingTime is 0.0004 s: less than half a step of 0.002 s",
    ),
    "a tracker that nobody initialises once": (
        extended(
            changed(
                "<euclideanNorm>", '<euclideanNorm u:autoInit="once">',
                "<publishOn> autoInit</publishOn>", "",
            )
        ),
        "<euclideanNorm", "u:autoInit='once' needs <publishOn> in <groundTruth>",
    ),
    "a period that no water swells in": (
        with_updater(CURRENT.replace("LENGTH", "<interval>9</interval>").replace(">4<", ">4e-4<")),
        "<forcePeriod>", "<forcePeriod> is '4e-4'; expected a number >= 0.01 [s]",
    ),
    "a log of less than half a step": (
        with_measure(f"<time><name>t</name>\n<log>0.0004</log>{GATE}</time>"),
        "<log>0.0004", "<log> is 0.0004 s: less than half a step of 0.002 s",
    ),
    "results published within a step": (
        changed("<function", '<function publishRate="0.0009"'),
        "<function", "publishRate is 0.0009 s: less than half a step of 0.002 s; 0 publishes",
    ),
    "a final value below the initial one": (
        changed("<initialValue>0", "<initialValue>3"),
        "<finalValue>", "<finalValue> 2 is below <initialValue> 3",
    ),
    "an updater beside another": (
        changed("<sceneFogUpdater>", "<none/><sceneFogUpdater>"),
        "<sceneFogUpdater>", "expected one: nest it in a <sceneUpdater> of its own",
    ),
    "an arm that goes nowhere": (
        with_updater("<armMoveUpdater><step>1</step><interval>1</interval>"
                     "<target>girona500</target></armMoveUpdater>"),
        "<armMoveUpdater>", "lacks <armPosition>: at least one is required",
    ),
    "an unknown camera": (
        changed(CAMERA, CAMERA.replace("h1", "h")), "<camera>bowtech<", "Did you mean 'bowtech1'?",
    ),
    "an unknown body": (
        changed("<target>blackbox", "<target>blakbox"), "blakbox", "Did you mean 'blackbox'?",
    ),
    "an unknown body in a trigger": (
        changed("<type>onInit</type>", "<type>onMove</type>\n<target>girona</target>"),
        "<target>girona<", "Did you mean 'girona500'?",
    ),
    "an unknown vehicle in an updater": (
        with_updater("<armMoveUpdater><armPosition><joint>0</joint></armPosition><step>1</step>"
                     "<interval>1</interval>\n<target>girona</target></armMoveUpdater>"),
        "<target>girona<", "No vehicle is called 'girona'. Did you mean 'girona500'?",
    ),
    "a topic of two types": (
        with_measure("<positionError><name>e</name><target>girona500</target><position><x>0</x>"
                     f"<y>0</y><z>0</z></position>\n<topic>centroidTopic</topic>{GATE}"
                     "</positionError>"),
        "<topic>centroidTopic", "carries std_msgs/msg/Float32MultiArray, not geometry_msgs/",
    ),
    "a topic of the scene's": (
        changed("<target> cornersTopic", "<target>/uwsim/camera1"),
        "/uwsim/camera1", "carries sensor_msgs/msg/Image, not std_msgs/msg/Float32MultiArray",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ERRORS)
def test_one_error_is_one_line_that_both_commands_say(said: object, name: str) -> None:
    text, place, message = ERRORS[name]
    [error] = said(text)  # type: ignore[operator]
    assert error.startswith(f"{line_of(text, place)}: ")
    assert message in error


def test_names_that_the_scene_does_not_have_are_reported_all_at_once(said: object) -> None:
    text = with_measure(
        "<objectCenteredOnCam><name>o</name>\n<target>bx</target>\n<camera>cam</camera>\n"
        "<startOn><type>onMove</type>\n<target>sub</target></startOn>\n"
        "<stopOn><type>never</type></stopOn></objectCenteredOnCam>\n"
        "<reconstruction3D><name>r</name>\n<target>box2</target><topic>a</topic>\n"
        f"<from>base</from>{GATE}</reconstruction3D>\n"
        f"<pathFollowing><name>p</name>\n<target>box3</target>\n<from>frm</from>{GATE}"
        "</pathFollowing>\n<euclideanNorm><name>rel</name>"
        "<groundTruth type='relativeLocation'>\n<from>f1</from>\n<to>t1</to></groundTruth>"
        f"<target>c</target>{GATE}</euclideanNorm>"
    )
    names = ["bx", "cam", "sub", "box2", "base", "box3", "frm", "f1", "t1"]
    errors = said(text)  # type: ignore[operator]
    assert [int(error.partition(":")[0]) for error in errors] == [
        line_of(text, f">{name}<") for name in names
    ]
    assert all(f" is called {name!r}." in error for name, error in zip(names, errors, strict=True))


def test_a_name_that_is_wrong_in_two_places_is_reported_for_each(said: object) -> None:
    text = BASE.replace("blackbox", "blakbox")
    errors = said(text)  # type: ignore[operator]
    lines = [line_of(text, "blakbox", n) for n in (1, 2)]
    assert [int(error.partition(":")[0]) for error in errors] == lines


def test_errors_of_benchmark_and_scene_are_reported_together(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, scene = tmp_path / "b.xml", tmp_path / "s.xml"
    file.write_text(changed("<step>0.05", "<step>0"))
    scene.write_text("<UWSimScene>\n<vehicel/></UWSimScene>")
    for words in (["check"], ["bench", "--algorithm", "frozen", "--out", str(tmp_path / "out")]):
        assert main([*words, str(file), "--scene", str(scene)]) == 2
        out = capsys.readouterr()
        both = (out.out + out.err).splitlines()
        assert any(line.startswith(f"{file}:35: <step>") for line in both)
        assert any(line.startswith(f"{scene}:2: <vehicel>") for line in both)


def test_a_measure_with_an_error_of_its_own_may_stand_in_the_function(said: object) -> None:
    [error] = said(changed("      <target> cornersTopic </target>\n", ""))  # type: ignore[operator]
    assert "lacks <target>" in error


def test_an_updater_within_another_of_its_kind_is_a_warning(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    inner = re.search("<sceneFogUpdater>.*</sceneFogUpdater>", BASE, flags=re.DOTALL)
    assert inner is not None
    nested = f"</interval>\n<sceneUpdater>{inner[0]}</sceneUpdater>\n</sceneFog"
    text = re.sub(r"</interval>\s*</sceneFog", nested, BASE)
    file.write_text(text)
    assert main(["check", str(file), "--scene", SCENE]) == 0
    line = line_of(text, "<sceneFogUpdater>", 2)
    assert f"{file}:{line}: warning: <sceneFogUpdater> within another: only the inner" in (
        capsys.readouterr().out
    )


def test_levels_that_are_over_before_their_current_begins_are_a_warning(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (FILES / "vision-recursive.xml").read_text()
    file.write_text(text.replace("<interval>5<", "<interval>2<"))
    assert main(["check", str(file)]) == 0
    line = line_of(text, "<interval>", 2)
    said = capsys.readouterr().out
    assert f"{file}:{line}: warning: <interval> 2 s: for 2 s after each change of the" in said


DECLARED = '<?xml version="1.0" encoding="ISO-8859-1"?>'
REPEATS = "<none/>"
for _ in range(200):
    REPEATS = (
        "<repeat><iterations>1</iterations><interval>1</interval>"
        f"<sceneUpdater>{REPEATS}</sceneUpdater></repeat>"
    )
DAMAGED: dict[str, tuple[str | bytes, str]] = {
    "cut off": (BASE[: len(BASE) // 2], "the file ends in the middle"),
    "cut off in a tag": (BASE[: BASE.index("<finalValue") + 6], "the file ends in the middle"),
    "empty": ("", "the file is empty"),
    "zero bytes": (b"\0" * 100, "contains zero bytes"),
    "UTF-32": (BASE.encode("utf-32"), "contains zero bytes"),
    "Latin-1 that is not declared": (
        changed("<!--", "<!-- \xe9").encode("latin-1"), "the byte 0xe9 is not UTF-8; save the file",
    ),
    "an unknown encoding": (
        changed('<?xml version="1.0"?>', '<?xml version="1.0" encoding="EBCDIC-XML-UK"?>'),
        "the encoding 'EBCDIC-XML-UK' is not read; write the file as UTF-8",
    ),
    "a letter that no name may have": (
        changed('<?xml version="1.0"?>', DECLARED, "<name>corners", "<name>coin\xe9",
                "corners+", "").encode("latin-1"),
        "the name 'coin\xe9' cannot be used in the function",
    ),
    "an external entity": (
        changed('"benchmark.dtd">', '"benchmark.dtd" [<!ENTITY x SYSTEM "file:///etc/passwd">]>',
                ">corners<", ">&x;<"),
        "<!ENTITY> declarations are not read; a DOCTYPE may only name the DTD",
    ),
    "a parameter entity": (
        changed('"benchmark.dtd">',
                '"benchmark.dtd" [<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;]>'),
        "<!ENTITY> declarations are not read",
    ),
    "entities in entities": (
        changed('"benchmark.dtd">', '"benchmark.dtd" [<!ENTITY a "aaaaaaaa">'
                '<!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'),
        "<!ENTITY> declarations are not read",
    ),
    "a file to be put in": (
        changed("<measures>", '<measures><xi:include xmlns:xi="http://www.w3.org/2001/XInclude" '
                'href="/etc/passwd" parse="text"/>'),
        "is not an element of <measures>; nothing is included: write it here",
    ),
    "two roots": (BASE + "<benchmark/>", "Extra content at the end of the document"),
    "200 updaters in each other": (with_updater(REPEATS), "Excessive depth in document: 256"),
    "200 elements in each other": (
        changed("<measures>", "<measures>" + "<x>" * 200 + "</x>" * 200),
        "<x> is not an element of <measures>",
    ),
    "200 brackets in each other": (
        changed("corners+centroid", "(" * 200 + "corners" + ")" * 200),
        "brackets nested deeper than 100 levels",
    ),
    "a function without end": (
        changed("corners+centroid", "corners" + "+corners" * 20000), "longer than 4096 characters",
    ),
    "a number beyond all": (changed(">2.0<", ">1e308<"), "no quantity is beyond 1e+09"),
    "a number beyond numbers": (changed(">2.0<", ">1e999<"), "is '1e999'; expected a number"),
    "no number": (changed(">2.0<", ">NaN<"), "is 'NaN'; expected a number"),
    "a number of 400 digits": (changed(">2.0<", f">{'9' * 400}<"), "expected a number"),
    "a comma for a point": (changed(">2.0<", ">2,0<"), "is '2,0'; expected a number"),
    "an empty number": (changed(">2.0<", "> <"), "<finalValue> is empty; expected a number"),
    "an empty name": (
        changed("<name>corners<", "<name><", "corners+", ""), "<name> is empty; expected text",
    ),
    "an empty trigger": (changed("<type>service<", "<type><"), "<startOn> lacks <type>: one of"),
    "a hundred million levels": (changed(">0.05<", ">1e-9<"), "more than 100000 levels"),
}  # fmt: skip


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_file_is_refused_at_once_in_clean_lines(said: object, name: str) -> None:
    text, message = DAMAGED[name]
    errors = said(text)  # type: ignore[operator]
    assert any(message in error for error in errors), errors
    assert len(errors) <= 2
    assert all(len(error) < 400 for error in errors)
    assert not any("root:" in error for error in errors)  # of /etc/passwd


WHOLE: dict[str, str | bytes] = {
    "CRLF": BASE.replace("\n", "\r\n"),
    "a byte order mark": b"\xef\xbb\xbf" + BASE.encode(),
    "UTF-16": BASE.encode("utf-16"),
    "Latin-1": changed('<?xml version="1.0"?>', DECLARED, "<!--", "<!-- \xe9").encode("latin-1"),
    "no declaration": changed('<?xml version="1.0"?>\n', ""),
    "no DOCTYPE": changed('<!DOCTYPE benchmark SYSTEM "benchmark.dtd">\n', ""),
    "a DTD out of the net": changed('"benchmark.dtd"', '"http://127.0.0.1:1/benchmark.dtd"'),
    "an empty subset": changed('"benchmark.dtd">', '"benchmark.dtd" []>'),
    "CDATA": changed(">corners<", "><![CDATA[corners]]><"),
    "a comment in a name": changed(">corners<", ">cor<!-- -->corners<"),
    "a processing instruction": changed("<measures>", "<measures><?editor folded?>"),
    "blanks and lines": changed(">corners<", ">\n\t corners \n<"),
}


@pytest.mark.parametrize("name", WHOLE)
def test_what_editors_and_systems_do_to_a_file_does_no_harm(file: Path, name: str) -> None:
    text = WHOLE[name]
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["check", str(file), "--scene", SCENE]) == 0
