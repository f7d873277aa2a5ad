"""Reading benchmark files: the whole dialect in any order, and every error with its line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

import uwsim
from tests.support.fakes import FakeBody, FakeCamera, FakeWorld
from uwsim.benchmark.ground_truth import (
    CentroidFromCameraSpec,
    ConstantSpec,
    CornersFromCameraSpec,
    RelativeLocationSpec,
)
from uwsim.benchmark.measures import (
    MEASURES,
    CollisionSpec,
    DistanceSpec,
    EuclideanNormSpec,
    ObjectCenteredOnCamSpec,
    PathFollowingSpec,
    PositionErrorSpec,
    Reconstruction3DSpec,
    TimeSpec,
)
from uwsim.benchmark.measures.outcome import OutcomeSpec
from uwsim.benchmark.reader import check_benchmark, read_benchmark
from uwsim.benchmark.spec import BenchmarkSpec, FunctionSpec
from uwsim.benchmark.triggers import (
    NeverSpec,
    OnInitSpec,
    OnMoveSpec,
    OnNoMoveSpec,
    PositionSpec,
    ServiceSpec,
    TopicSpec,
)
from uwsim.benchmark.updaters import (
    ArmMoveUpdaterSpec,
    BagFogUpdaterSpec,
    CameraNoiseUpdaterSpec,
    CurrentForceUpdaterSpec,
    NoneSpec,
    RepeatSpec,
    SceneFogUpdaterSpec,
    SceneLightUpdaterSpec,
    SphericalSpec,
    n_levels,
)
from uwsim.errors import BenchmarkError, Diagnostic

BUNDLED = Path(uwsim.__file__).parent / "data" / "benchmarks"
ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
GATE = "<startOn><type>onInit</type></startOn><stopOn><type>never</type></stopOn>"
FOG = (
    "<sceneFogUpdater><initialValue>0</initialValue><finalValue>1.3</finalValue>"
    "<step>0.05</step><interval>2</interval></sceneFogUpdater>"
)


def text(
    measures: str = f"<time><name>t</name>{GATE}</time>",
    *,
    gate: str = GATE,
    function: str = "<function>t</function>",
    updater: str = "<none/>",
    head: str = "",
    attributes: str = "",
) -> str:
    return (
        f"{head}<benchmark {attributes}>\n<measures>\n{measures}\n</measures>\n{gate}\n"
        f"{function}\n<sceneUpdater>\n{updater}\n</sceneUpdater>\n</benchmark>\n"
    )


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "b.xml"


def reading(file: Path, content: str) -> BenchmarkSpec:
    file.write_text(content)
    return read_benchmark(file)


def diagnostics(file: Path, content: str) -> list[Diagnostic]:
    file.write_text(content)
    return [diagnostic for diagnostic in check_benchmark(file)[0] if diagnostic.severity == "error"]


def only_error(file: Path, content: str) -> Diagnostic:
    found = diagnostics(file, content)
    assert len(found) == 1, [str(diagnostic) for diagnostic in found]
    with pytest.raises(BenchmarkError):
        read_benchmark(file)
    return found[0]


WHOLE = f"""<!DOCTYPE benchmark SYSTEM "benchmark.dtd">
<benchmark><measures>
 <time><name> taskTime </name>
  <startOn><type>onMove</type><target> girona500
  </target></startOn>
  <stopOn><type>service</type><target>stop</target></stopOn></time>
 <collision><name>hits</name><target>blackbox</target><log>0.5</log>{GATE}</collision>
 <positionError><name>station</name><target>girona500</target>
  <position><x>1</x><y>M_PI</y><z>-2.5</z></position><topic>goal</topic>
  <startOn><type>position</type><target>girona500</target>
   <position><x>0</x><y>0</y><z>1</z></position></startOn>
  <stopOn><type>onNoMove</type><target>girona500</target></stopOn></positionError>
 <distance><name>trip</name><target>girona500</target>
  <startOn><type>topic</type><target>ready</target></startOn>
  <stopOn><type>never</type></stopOn></distance>
 <euclideanNorm><name>fixed</name>
  <groundTruth type="constant"><value>257.5</value><value>162.5</value></groundTruth>
  <target>a</target>{GATE}</euclideanNorm>
 <euclideanNorm><name>corners</name><groundTruth type="cornersFromCamera">
   <camera>bowtech1</camera><target>blackbox</target><publishOn> autoInit</publishOn></groundTruth>
  <target> cornersTopic </target>{GATE}</euclideanNorm>
 <euclideanNorm><name>centroid</name><groundTruth type="centroidFromCamera">
   <camera>bowtech1</camera><target>blackbox</target></groundTruth>
  <target>b</target>{GATE}</euclideanNorm>
 <euclideanNorm><name>place</name><groundTruth type="relativeLocation">
   <from>girona500</from><to>blackbox</to></groundTruth>
  <target>c</target>{GATE}</euclideanNorm>
 <objectCenteredOnCam><name>centred</name><target>blackbox</target><camera>bowtech1</camera>
  {GATE}</objectCenteredOnCam>
 <reconstruction3D detailedResultsToGlobals="true"><name>cloud</name><target>blackbox</target>
  <topic>/points</topic><from>kinematic_base</from><levelOfDetail>0.01</levelOfDetail>
  {GATE}</reconstruction3D>
 <pathFollowing><name>path</name><target>girona500</target><topic>p</topic>
  <from>localizedWorld</from>{GATE}</pathFollowing>
</measures>
<startOn><type>service</type><target> startBench </target></startOn>
<stopOn><type>never</type></stopOn>
<function publishResult="true" publishRate="0.5"> corners+centroid </function>
<sceneUpdater><currentForceUpdater publishAsForce="true">
  <initialValue>0</initialValue><finalValue>0.4</finalValue>
  <sphericalDirection><theta> 1.57 </theta><phi> 0 </phi></sphericalDirection>
  <forceVariation>0.005</forceVariation><forcePeriod>4</forcePeriod>
  <directionVariation><theta>0</theta><phi>0.7</phi></directionVariation>
  <directionPeriod><theta>4</theta><phi>30</phi></directionPeriod>
  <random>0.01</random><step>0.025</step><interval>120</interval><target>girona500</target>
  <sceneUpdater><armMoveUpdater>
    <armPosition><joint>0</joint><joint>0.5</joint></armPosition>
    <armPosition><joint>1</joint><joint>0.7</joint></armPosition>
    <step>4</step><interval>10</interval><target>girona500</target>
    <sceneUpdater><repeat><iterations>3</iterations><interval>5</interval></repeat></sceneUpdater>
  </armMoveUpdater></sceneUpdater>
</currentForceUpdater></sceneUpdater></benchmark>
"""
ON, OFF = OnInitSpec(), NeverSpec()
WHOLE_SPEC = BenchmarkSpec(
    measures=(
        TimeSpec(
            name="taskTime",
            start_on=OnMoveSpec(target="girona500"),
            stop_on=ServiceSpec(target="stop"),
        ),
        CollisionSpec(name="hits", target="blackbox", log=0.5),
        PositionErrorSpec(
            name="station",
            target="girona500",
            position=(1.0, 3.141592653589793, -2.5),
            topic="goal",
            start_on=PositionSpec(target="girona500", position=(0.0, 0.0, 1.0)),
            stop_on=OnNoMoveSpec(target="girona500"),
        ),
        DistanceSpec(name="trip", target="girona500", start_on=TopicSpec(target="ready")),
        EuclideanNormSpec(
            name="fixed", ground_truth=ConstantSpec(values=(257.5, 162.5)), target="a"
        ),
        EuclideanNormSpec(
            name="corners",
            ground_truth=CornersFromCameraSpec(
                camera="bowtech1", target="blackbox", publish_on="autoInit"
            ),
            target="cornersTopic",
        ),
        EuclideanNormSpec(
            name="centroid",
            ground_truth=CentroidFromCameraSpec(camera="bowtech1", target="blackbox"),
            target="b",
        ),
        EuclideanNormSpec(
            name="place",
            ground_truth=RelativeLocationSpec(from_="girona500", to="blackbox"),
            target="c",
        ),
        ObjectCenteredOnCamSpec(name="centred", target="blackbox", camera="bowtech1"),
        Reconstruction3DSpec(
            name="cloud",
            target="blackbox",
            topic="/points",
            from_="kinematic_base",
            level_of_detail=0.01,
            detailed_results_to_globals=True,
        ),
        PathFollowingSpec(name="path", target="girona500", topic="p", from_="localizedWorld"),
    ),
    start_on=ServiceSpec(target="startBench"),
    stop_on=OFF,
    function=FunctionSpec(text="corners+centroid", publish_result=True, publish_rate=0.5),
    scene_updater=CurrentForceUpdaterSpec(
        initial_value=0.0,
        final_value=0.4,
        spherical_direction=SphericalSpec(theta=1.57, phi=0.0),
        force_variation=0.005,
        force_period=4.0,
        direction_variation=SphericalSpec(theta=0.0, phi=0.7),
        direction_period=SphericalSpec(theta=4.0, phi=30.0),
        random=0.01,
        step=0.025,
        interval=120.0,
        target="girona500",
        publish_as_force=True,
        child=ArmMoveUpdaterSpec(
            arm_position=((0.0, 0.5), (1.0, 0.7)),
            step=4,
            interval=10.0,
            target="girona500",
            child=RepeatSpec(iterations=3, interval=5.0),
        ),
    ),
)


def test_the_whole_dialect_becomes_specs(file: Path) -> None:
    assert reading(file, WHOLE) == WHOLE_SPEC
    assert n_levels(WHOLE_SPEC.scene_updater) == 16 * 6 * 3


def test_the_whole_dialect_stands_in_the_originals_order(file: Path) -> None:
    file.write_text(WHOLE)
    assert [f for f in check_benchmark(file, is_strict=True)[0] if f.severity == "error"] == []


def reverse(node: etree._Element) -> None:
    """Put the children of every element into the opposite order, but for lists of equals."""
    children = list(node)
    for child in children:
        reverse(child)
    if node.tag in ("measures", "groundTruth", "armPosition", "armMoveUpdater"):
        return
    for child in children:
        node.remove(child)
    node.extend(reversed(children))


def test_any_order_gives_the_same_specs_and_strict_names_what_is_misplaced(file: Path) -> None:
    root = etree.fromstring(WHOLE)
    reverse(root)
    file.write_bytes(etree.tostring(root))
    assert read_benchmark(file) == WHOLE_SPEC
    misplaced = [str(f) for f in check_benchmark(file, is_strict=True)[0] if f.severity == "error"]
    assert any("<startOn> comes after" in message for message in misplaced)
    assert any("the original expects it before" in message for message in misplaced)


@pytest.mark.parametrize(
    ("updater", "spec"),
    [
        (
            "<sceneFogUpdater><initialFog>0</initialFog><finalFog>2</finalFog><step>0.05</step>"
            "<interval>5</interval></sceneFogUpdater>",
            SceneFogUpdaterSpec(initial_value=0.0, final_value=2.0, step=0.05, interval=5.0),
        ),
        (
            "<sceneLightUpdater><initialLight>0</initialLight><finalLight>1.02</finalLight>"
            "<step>0.05</step><interval>20</interval></sceneLightUpdater>",
            SceneLightUpdaterSpec(initial_value=0.0, final_value=1.02, step=0.05, interval=20.0),
        ),
        (
            "<cameraNoiseUpdater><initialValue>0</initialValue><finalValue>0.1</finalValue>"
            "<step>0.02</step><interval>20</interval></cameraNoiseUpdater>",
            CameraNoiseUpdaterSpec(initial_value=0.0, final_value=0.1, step=0.02, interval=20.0),
        ),
        (
            "<bagFogUpdater><initialValue>0</initialValue><finalValue>1</finalValue>"
            "<step>0.5</step><interval>2</interval><bag>a.bag</bag><imageTopic>i</imageTopic>"
            "<infoTopic>c</infoTopic><imageDepth>2</imageDepth><imagePub>j</imagePub>"
            "</bagFogUpdater>",
            BagFogUpdaterSpec(
                initial_value=0.0, final_value=1.0, step=0.5, interval=2.0, bag="a.bag",
                image_topic="i", info_topic="c", image_depth=2.0, image_pub="j",
            ),
        ),
        ("<none/>", NoneSpec()),
    ],
)  # fmt: skip
def test_every_updater_is_read_old_names_included(file: Path, updater: str, spec: object) -> None:
    assert reading(file, text(updater=updater)).scene_updater == spec


def test_old_names_are_a_warning_and_no_error(file: Path) -> None:
    content = text(updater=FOG.replace("initialValue", "initialFog"))
    assert diagnostics(file, content) == []
    assert any(
        "<initialFog> is an old name of <initialValue>" in str(f) for f in check_benchmark(file)[0]
    )


def test_a_target_that_a_trigger_does_not_need_is_ignored_with_a_warning(file: Path) -> None:
    gate = GATE.replace("onInit</type>", "onInit</type><target>girona500</target>")
    assert reading(file, text(gate=gate)).start_on == OnInitSpec()
    assert any(
        "the type 'onInit' ignores <target>" in str(diagnostic)
        for diagnostic in check_benchmark(file)[0]
    )


def test_extensions_are_read(file: Path) -> None:
    attributes = (
        'xmlns:u="urn:uwsim:1" u:scene="s.xml" u:algorithm="esm" u:mode="independent" '
        'u:compatibility="thresholds rows" u:patience="3"'
    )
    measure = (
        '<euclideanNorm u:value="mean" u:truth="face"><name>c</name>'
        '<groundTruth type="cornersFromCamera"><camera>a</camera><target>b</target></groundTruth>'
        "<target>t</target></euclideanNorm>"
    )
    spec = reading(file, text(measure, attributes=attributes, function="<function>c</function>"))
    assert (spec.scene, spec.algorithm, spec.mode) == ("s.xml", "esm", "independent")
    assert (spec.compatibility, spec.patience) == (("thresholds", "rows"), 3.0)
    norm = spec.measures[0]
    assert isinstance(norm, EuclideanNormSpec)
    assert (norm.value, norm.truth, norm.start_on, norm.stop_on) == ("mean", "face", ON, OFF)


def test_a_ground_truth_of_2013_without_a_type_is_its_constants(file: Path) -> None:
    measure = (
        "<euclideanNorm><name>t</name><groundTruth><value>0.2 </value><value> 1.5</value>"
        f"</groundTruth><target>x</target>{GATE}</euclideanNorm>"
    )
    norm = reading(file, text(measure)).measures[0]
    assert isinstance(norm, EuclideanNormSpec)
    assert norm.ground_truth == ConstantSpec(values=(0.2, 1.5))
    assert any("constant" in diagnostic.message for diagnostic in check_benchmark(file)[0])


def test_a_ground_truth_of_a_camera_wants_its_type(file: Path) -> None:
    measure = (
        "<euclideanNorm><name>t</name><groundTruth><camera>c</camera><target>b</target>"
        f"</groundTruth><target>x</target>{GATE}</euclideanNorm>"
    )
    diagnostic = only_error(file, text(measure))
    assert "<groundTruth> lacks the attribute type" in diagnostic.message


def test_a_reconstruction_without_from_is_given_in_the_world(file: Path) -> None:
    measure = (
        f"<reconstruction3D><name>t</name><target>b</target><topic>p</topic>{GATE}"
        "</reconstruction3D>"
    )
    cloud = reading(file, text(measure)).measures[0]
    assert isinstance(cloud, Reconstruction3DSpec)
    assert cloud.from_ is None


TIME = f"<time><name>t</name>{GATE}</time>"
FACE = (
    '<euclideanNorm xmlns:u="urn:uwsim:1" u:truth="face"><name>t</name><groundTruth '
    f'type="constant"><value>1</value></groundTruth><target>x</target>{GATE}</euclideanNorm>'
)


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        (text(TIME + "\n<tme/>"), 4, "<tme> is not an element of <measures>. Did you mean time?"),
        (text(f"<distance><name>t</name>{GATE}</distance>"), 3, "<distance> lacks <target>"),
        (text(TIME.replace("<name>t</name>", "")), 3, "<time> lacks <name>"),
        (text(TIME + "\n" + TIME), 4, "another measure (line 3) has the name 't'"),
        (text(TIME + "\n" + TIME.replace(">t<", ">my time<")), 4, "cannot be used in the function"),
        (text(TIME + "\n" + TIME.replace(">t<", ">2nd<")), 4, "cannot be used in the function"),
        (text(TIME + "\n" + TIME.replace(">t<", ">total<")), 4, "another column of the result"),
        (text(TIME + "\n" + TIME.replace(">t<", ">_pi<")), 4, "'_pi' is a constant"),
        (text(TIME + "\n" + TIME.replace(">t<", ">_e<")), 4, "'_e' is a constant of the"),
        (text(TIME + "\n" + TIME.replace(">t<", ">if<")), 4, "'if' is a function of the language"),
        (text(TIME + "\n" + TIME.replace(">t<", ">min<")), 4, "'min' is a function"),
        (text(TIME.replace("onInit", "onint")), 3, "expected one of never, onInit"),
        (text(TIME.replace("onInit", "onint")), 3, "Did you mean 'onInit'"),
        (text(TIME.replace("<type>never</type>", "")), 3, "<stopOn> lacks <type>"),
        (text(TIME.replace("onInit", "topic")), 3, "<startOn> lacks <target>"),
        (text(TIME.replace("onInit", "position</type><target>a</target><type>")), 3, ""),
        (text(TIME.replace("</name>", "</name><log>0</log>")), 3, "expected a number > 0 [s]"),
        (text(function="<function>t+</function>"), 6,
         "<function>: the expression ends too early (column 3)\n  t+\n    ^"),
        (text(function="<function>2*tt</function>"), 6, "no measure is called 'tt'"),
        (text(function="<function></function>"), 6, "<function> is empty"),
        (text(function=""), 1, "<benchmark> lacks <function>"),
        (text(gate="<stopOn><type>never</type></stopOn>"), 1, "<benchmark> lacks <startOn>"),
        (text(updater=FOG.replace(">0.05<", ">-0.05<")), 8, "is '-0.05'; expected a number > 0"),
        (text(updater=FOG.replace(">2<", ">0<")), 8, "is '0'; expected a number > 0 [s]"),
        (text(updater=FOG.replace(">1.3<", ">-1<")), 8, "expected a number >= 0"),
        (text(updater=FOG.replace("e>0<", "e>2<")), 8, "1.3 is below <initialValue> 2"),
        (text(updater=FOG.replace(">0.05<", ">1e-9<")), 8, "more than 100000 levels"),
        (text(updater=FOG.replace(">0.05<", ">NaN<")), 8, "<step> is 'NaN'; expected a number"),
        (text(updater=FOG.replace("Updater>", "Updatr>")), 8, "Did you mean sceneFogUpdater"),
        (text(updater=""), 7, "<sceneUpdater> is empty"),
        (text(updater="<none/>\n<none/>"), 9, "expected one"),
        (text(updater="<repeat><iterations>0</iterations><interval>1</interval></repeat>"), 8,
         "expected a whole number >= 1"),
        (text(FACE), 3, "u:truth='face' needs a ground truth of type"),
        (text(TIME.replace("<time>", '<time xmlns:u="urn:uwsim:1" u:value="mean">')), 3,
         "the value of <time> is always its last"),
        (text(TIME.replace("<time>", '<time xmlns:u="urn:uwsim:1" u:value="men">')), 3,
         "Did you mean 'mean'"),
        (text(attributes='xmlns:u="urn:uwsim:1" u:mode="fast"'), 1, "'sequential'"),
        (text(attributes='xmlns:u="urn:uwsim:1" u:compatibility="row"'), 1, "Did you mean rows"),
        (text(attributes='xmlns:u="urn:uwsim:1" u:scen="s.xml"'), 1, "Did you mean u:scene"),
        (text(head='<!DOCTYPE benchmark SYSTEM "b.dtd">',
              attributes='xmlns:u="urn:uwsim:1" u:scene="s.xml"'), 1, "remove the DOCTYPE"),
        ("<UWSimScene/>", 1, "expected <benchmark>"),
        ("<benchmark><measures>", 1, "not well-formed XML"),
    ],
)  # fmt: skip
def test_an_error_gives_its_line_and_the_right_answer(
    file: Path, content: str, line: int, message: str
) -> None:
    found = diagnostics(file, content)
    assert any(message in diagnostic.message and diagnostic.line == line for diagnostic in found), (
        found
    )
    with pytest.raises(BenchmarkError):
        read_benchmark(file)


def test_one_mistake_is_one_error(file: Path) -> None:
    assert "tme" in only_error(file, text(TIME + "\n<tme/>")).message
    assert "lacks <type>" in only_error(file, text(TIME.replace("<type>never</type>", ""))).message
    only_error(file, text(function="<function>t+</function>"))
    only_error(file, text(updater=FOG.replace(">0.05<", ">-0.05<")))
    only_error(file, text(FACE.replace(' u:truth="face"', "").replace("constant", "constnt")))


def test_all_errors_are_reported_at_once_in_the_order_of_the_file(file: Path) -> None:
    content = text(
        TIME.replace("onInit", "onint") + "\n<tme/>\n<distance><name>d</name></distance>",
        function="<function>t +* d</function>",
        updater=FOG.replace(">0.05<", ">x<").replace(">2<", ">soon<"),
    )
    assert [diagnostic.line for diagnostic in diagnostics(file, content)] == [3, 4, 5, 8, 10, 10]


def test_every_measure_of_the_original_is_played(file: Path) -> None:
    file.write_text(WHOLE)
    assert [str(diagnostic) for diagnostic in check_benchmark(file)[0]] == []


def test_a_path_without_a_topic_is_a_warning(file: Path) -> None:
    path = f"<pathFollowing><name>p</name><target>girona500</target>{GATE}</pathFollowing>"
    file.write_text(text(path, function="<function>p</function>"))
    warnings = [diagnostic.message for diagnostic in check_benchmark(file)[0]]
    assert "<pathFollowing> without <topic> and <u:path> has no path, and no value" in warnings


def test_a_benchmark_that_nothing_ends_is_a_warning(file: Path) -> None:
    file.write_text(text())
    assert any(
        "a level ends after 600 s, in timeout" in diagnostic.message
        for diagnostic in check_benchmark(file)[0]
    )


def test_updaters_nested_to_a_hundred_levels_are_read(file: Path) -> None:
    updater = "<none/>"
    for _ in range(100):
        updater = (
            "<repeat><iterations>1</iterations><interval>1</interval>"
            f"<sceneUpdater>{updater}</sceneUpdater></repeat>"
        )
    assert n_levels(reading(file, text(updater=updater)).scene_updater) == 1


def test_too_many_levels_by_nesting_are_an_error_and_not_a_long_wait(file: Path) -> None:
    updater = "<none/>"
    for _ in range(40):
        updater = (
            "<repeat><iterations>1000</iterations><interval>1</interval>"
            f"<sceneUpdater>{updater}</sceneUpdater></repeat>"
        )
    assert any(
        "more than 100000 levels" in f.message for f in diagnostics(file, text(updater=updater))
    )


def test_more_arm_positions_than_levels_are_an_error_and_no_flood(file: Path) -> None:
    updater = (
        "<armMoveUpdater>"
        + "<armPosition><joint>1</joint></armPosition>" * 100
        + "<step>100000</step><interval>1</interval><target>a</target></armMoveUpdater>"
    )
    assert (
        "9900100 positions; expected at most 100000"
        in only_error(file, text(updater=updater)).message
    )


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_a_damaged_file_gives_errors_and_never_an_exception(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    file = tmp_path_factory.getbasetemp() / "damaged.xml"
    root = etree.fromstring(WHOLE)
    nodes = list(root.iter("*"))[1:]
    for node in data.draw(st.lists(st.sampled_from(nodes), min_size=1, max_size=4, unique=True)):
        harm = data.draw(st.sampled_from(["remove", "rename", "double", "say"]))
        parent = node.getparent()
        if harm == "say":
            node.text = data.draw(st.sampled_from(["", "NaN", "-1", "1e999", "x", "0", "1e-300"]))
        elif harm == "rename":
            node.tag = data.draw(st.sampled_from(nodes)).tag
        elif harm == "double" and parent is not None:
            parent.append(etree.fromstring(etree.tostring(node, with_tail=False)))
        elif parent is not None:
            parent.remove(node)
    file.write_bytes(etree.tostring(root))
    assert all(diagnostic.message for diagnostic in check_benchmark(file, is_strict=True)[0])


def test_a_benchmark_can_be_read_with_one_more_measure(file: Path) -> None:
    content = text("<trip><name>t</name><target>girona500</target></trip>")
    file.write_text(content)
    spec = read_benchmark(file, measures=MEASURES | {"trip": DistanceSpec})
    assert spec.measures == (DistanceSpec(name="t", target="girona500"),)
    assert "trip" not in MEASURES


@pytest.mark.parametrize("name", ["visibility", "visibility-moving"])
def test_the_bundled_benchmarks_are_those_of_the_design(name: str) -> None:
    spec = read_benchmark(BUNDLED / f"{name}.xml")
    assert spec.scene_updater == SceneFogUpdaterSpec(
        initial_value=0.0, final_value=1.3, step=0.05, interval=2.0
    )
    assert n_levels(spec.scene_updater) == 27
    assert spec.scene == f"{name}-scene.xml"
    assert spec.algorithm == "esm"
    assert spec.mode == ("sequential" if name == "visibility" else "independent")
    box, face = ["corners", "centroid"], ["cornersFace", "centroidFace"]
    if name == "visibility":
        scored, others = box, face
    else:
        scored, others = face, box
    assert spec.function.text == "+".join(scored)
    outcomes = [m for m in spec.measures if isinstance(m, OutcomeSpec)]
    assert len(outcomes) == (name == "visibility-moving")
    errors = [m for m in spec.measures if m not in outcomes]
    assert [m.name for m in errors] == scored + others
    assert {m.value for m in errors} == {"mean"}
    assert {m.log for m in errors} == {0.1}
    truths = {m.name: getattr(m, "truth", "") for m in errors}
    assert truths == dict.fromkeys(box, "original") | dict.fromkeys(face, "face")
    told = {m.name: m.ground_truth.publish_on for m in errors}  # type: ignore[attr-defined]
    assert told == dict.fromkeys(box + face, None) | {scored[0]: "autoInit"}


SCORED_BY_EXTENSIONS = (
    *("circle", "formation", "helix", "inspection", "lemniscate", "relay", "square", "survey"),
)
"""Bundled benchmarks whose score is that of a measure which the original lacks."""


@pytest.mark.parametrize(
    "name",
    sorted({path.stem for path in BUNDLED.glob("*.xml")} - {*SCORED_BY_EXTENSIONS}),
)
def test_a_bundled_benchmark_without_extensions_is_one_of_the_original(
    name: str, file: Path
) -> None:
    tree = etree.parse(BUNDLED / f"{name}.xml")
    for node in [node for node in tree.iter("*") if str(node.tag).startswith("{urn:uwsim:1}")]:
        parent = node.getparent()
        assert parent is not None
        parent.remove(node)
        if parent.tag == "sceneUpdater" and len(parent) == 0:
            one_level = etree.SubElement(parent, "repeat")  # for an updater that is an extension
            etree.SubElement(one_level, "iterations").text = "1"
            etree.SubElement(one_level, "interval").text = "5"
    for node in tree.iter("*"):
        for attribute in [key for key in node.attrib if str(key).startswith("{urn:uwsim:1}")]:
            del node.attrib[attribute]
    etree.cleanup_namespaces(tree)
    file.write_bytes(etree.tostring(tree, doctype='<!DOCTYPE benchmark SYSTEM "benchmark.dtd">'))
    diagnostics = [str(one) for one in check_benchmark(file, is_strict=True)[0]]
    no_path = "<pathFollowing> without <topic> and <u:path> has no path"  # an extension gave it
    assert [one for one in diagnostics if no_path not in one] == []


def test_the_bundled_benchmarks_bind() -> None:
    world = FakeWorld({"blackbox": FakeBody()}, {"bowtech1": FakeCamera()})
    for spec in read_benchmark(BUNDLED / "visibility.xml").measures:
        assert spec.bind(world).unit == "px"


@pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
def test_every_original_file_is_read_without_an_error() -> None:
    paths = sorted(
        path
        for path in Path(ORIGINALS or "").rglob("*.xml")
        if path.is_file() and b"<benchmark" in path.read_bytes()
    )
    assert paths
    for path in paths:
        assert [
            str(f) for f in check_benchmark(path, is_strict=True)[0] if f.severity == "error"
        ] == []
