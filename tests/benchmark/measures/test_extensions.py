"""``u:energy`` and ``u:control`` in benchmark files: read, refused, looked up, left out again."""

from __future__ import annotations

from pathlib import Path

import pytest
from lxml import etree

import uwsim
from tests.support.fakes import FakeActuators, FakeBody, FakeWorld
from tests.support.short_benchmark import run
from uwsim.benchmark.measures import ControlSpec, EnergySpec, MeasureSpec
from uwsim.benchmark.measures.energy import BatterySpec
from uwsim.benchmark.measures.outcome import OutcomeSpec
from uwsim.benchmark.reader import check_benchmark, read_benchmark
from uwsim.checks import check_file
from uwsim.schema import NAMESPACE, fields_of

CURRENTS = Path(uwsim.__file__).parent / "data" / "benchmarks" / "currents.xml"
PAGE = Path(__file__).parents[3] / "docs" / "measures.md"
PLACE = "<target>girona500</target> <position> <x>3</x> <y>2</y> <z>1</z> </position>"
TOPIC = "<topic>/dataNavigator</topic>"


def written(folder: Path, *measures: str) -> Path:
    file = folder / "b.xml"
    lines = "\n".join(measures)
    file.write_text(
        f"""<benchmark xmlns:u="urn:uwsim:1" u:scene="currents-scene.xml"><measures>
{lines}
</measures>
<startOn><type>onInit</type></startOn> <stopOn><type>never</type></stopOn>
<function>m</function>
<sceneUpdater><repeat><iterations>1</iterations><interval>1</interval></repeat></sceneUpdater>
</benchmark>"""
    )
    return file


def said(file: Path) -> list[str]:
    return [f"{diagnostic.line}: {diagnostic.message}" for diagnostic in check_file(file)]


def test_energy_is_read_with_its_battery_in_either_unit(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        "<u:energy> <name>m</name> <target>girona500</target> <hotelLoad>60</hotelLoad>",
        '<battery unit="Wh">2000</battery> <log>1</log> </u:energy>',
        "<u:energy> <name>n</name> <target>girona500</target> <battery>9e6</battery> </u:energy>",
    )
    battery = BatterySpec(capacity=2000.0, unit="Wh")
    assert read_benchmark(file).measures == (
        EnergySpec(name="m", target="girona500", hotel_load=60.0, battery=battery, log=1.0),
        EnergySpec(name="n", target="girona500", battery=BatterySpec(capacity=9e6)),
    )


def test_control_is_read_whole(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        f"<u:control> <name>m</name> {TOPIC} <axes>vx vy</axes> {PLACE} <band>0.05</band>",
        "<leastStep>0.2</leastStep> <quantity>settlingTime</quantity> </u:control>",
    )
    assert read_benchmark(file).measures == (
        ControlSpec(
            name="m",
            topic="/dataNavigator",
            axes="vx vy",
            target="girona500",
            position=(3.0, 2.0, 1.0),
            band=0.05,
            least_step=0.2,
            quantity="settlingTime",
        ),
    )
    assert said(file) == []


@pytest.mark.parametrize(
    ("inside", "message"),
    [
        ("", "2: needs a <topic> of commands, a <target>, or an <errorTopic>"),
        ("<target>girona500</target>", "2: <target> and <position> go together; give both or none"),
        (f"{PLACE} <errorTopic>e</errorTopic>",
         "2: <target> and <errorTopic> both give the error; use one"),
        (f"{PLACE} <axes>vx</axes>", "2: <axes> are those of a <topic>, which is not given"),
        (f"{PLACE} <quantity>effort</quantity>",
         "2: <quantity> 'effort' is that of a <topic>, which is not given"),
        (f"{TOPIC} <quantity>iae</quantity>",
         "2: <quantity> 'iae' needs an error: <target> and <position>, or <errorTopic>"),
        (f"{TOPIC} <quantity>settling</quantity>", "2: <quantity> is 'settling'; expected one of"),
        (f"{PLACE} <band>-0.02</band>",
         "2: <band> is '-0.02'; expected a number > 0 and < 1 [1]"),
        (f"{PLACE} <leastStep>-1</leastStep>", "2: <leastStep> is '-1'; expected a number >= 0"),
        (PLACE.replace("girona500", "girona50"),
         "2: No body is called 'girona50'. Did you mean 'girona500'?"),
        (f"{TOPIC} <axes>vx vq</axes>", "2: No axis is called 'vq'. Known: vx, vy, vz, wx, wy"),
        ("<topic>/uwsim/camera1</topic>",
         "'/uwsim/camera1' carries sensor_msgs/msg/Image; expected one of Float64MultiArray"),
        (f"{TOPIC} <topc>u</topc>", "2: <topc> is not an element of <u:control>. Did you mean top"),
    ],
)  # fmt: skip
def test_a_control_that_cannot_be_is_refused_with_its_line(
    tmp_path: Path, inside: str, message: str
) -> None:
    found = said(written(tmp_path, f"<u:control> <name>m</name> {inside} </u:control>"))
    assert len(found) == 1, found
    assert message in found[0]


@pytest.mark.parametrize(
    ("inside", "message"),
    [
        ("<target>girona50</target>",
         "2: No vehicle is called 'girona50'. Did you mean 'girona500'?"),
        ("<target>blackbox</target>", "2: No vehicle is called 'blackbox'"),
        ("", "2: <u:energy> lacks <target>: the name of the vehicle"),
        ("<target>girona500</target> <hotelLoad>-1</hotelLoad>",
         "2: <hotelLoad> is '-1'; expected a number >= 0 [W]"),
        ("<target>girona500</target> <battery>0</battery>",
         "2: <battery> is '0'; expected a number > 0"),
        ('<target>girona500</target> <battery unit="kWh">2</battery>',
         "2: unit= of <battery> is 'kWh'; expected one of 'J', 'Wh'"),
    ],
)  # fmt: skip
def test_an_energy_that_cannot_be_is_refused_with_its_line(
    tmp_path: Path, inside: str, message: str
) -> None:
    found = said(written(tmp_path, f"<u:energy> <name>m</name> {inside} </u:energy>"))
    assert message in found[0], found


@pytest.mark.parametrize(("name", "spec"), [("u:energy", EnergySpec), ("u:control", ControlSpec)])
def test_every_element_and_every_detail_stands_in_the_page_of_measures(
    name: str, spec: type[EnergySpec] | type[ControlSpec]
) -> None:
    section = PAGE.read_text().split(f"\n## {name}\n")[1].split("\n## ")[0]
    of_all = {field.name for field in fields_of(MeasureSpec)}
    elements = [field.label for field in fields_of(spec) if field.name not in of_all]
    world = FakeWorld({"v": FakeBody()})
    world.actuators_by_vehicle["v"] = FakeActuators()
    place = {"topic": "u", "position": (1.0, 0.0, 0.0)} if spec is ControlSpec else {}
    details = spec(name="m", target="v", **place).bind(world).details  # type: ignore[arg-type]
    assert [each for each in (*elements, *details) if f"`{each}`" not in section] == []


def test_the_bundled_benchmark_that_uses_them_is_right_and_its_function_does_not_need_them() -> (
    None
):
    assert said(CURRENTS) == []
    spec = read_benchmark(CURRENTS)
    assert [type(m) for m in spec.measures[-3:]] == [EnergySpec, ControlSpec, OutcomeSpec]
    assert spec.function.text == "offset"


def test_dropping_the_extensions_leaves_the_originals_measures(tmp_path: Path) -> None:
    tree = etree.parse(CURRENTS)
    mark = f"{{{NAMESPACE}}}"
    for node in list(tree.iter("*")):
        for name in [name for name in node.attrib if str(name).startswith(mark)]:
            del node.attrib[name]
        if str(node.tag).startswith(mark):
            node.getparent().remove(node)  # type: ignore[union-attr]
    etree.cleanup_namespaces(tree)
    file = tmp_path / "b.xml"
    file.write_bytes(etree.tostring(tree, doctype='<!DOCTYPE benchmark SYSTEM "benchmark.dtd">'))
    assert check_benchmark(file, is_strict=True)[0] == []
    assert [m.name for m in read_benchmark(file).measures] == [
        "offset", "corners", "centroid", "objectCentered",
    ]  # fmt: skip


ALGORITHM = """
import numpy as np
from uwsim.messages import Empty, Float64MultiArray, MultiArrayLayout


class Late:
    def start(self, node):
        publish = node.publisher("own", Float64MultiArray)
        layout = MultiArrayLayout(dim=[], data_offset=0)

        def speak():
            if node.now > 0.25:
                publish(Float64MultiArray(layout=layout, data=np.array([node.now])))

        node.create_timer(0.1, speak)
"""


def test_in_a_run_what_comes_late_has_its_columns_and_what_is_missing_its_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = written(
        tmp_path,
        "<u:control> <name>m</name> <topic>own</topic> <log>0.1</log> </u:control>",
        "<u:energy> <name>e</name> <target>girona500</target> <log>0.1</log> </u:energy>",
    )
    text = file.read_text().replace("<iterations>1", "<iterations>2")
    file.write_text(text.replace("<interval>1", "<interval>0.2"))
    (tmp_path / "late.py").write_text(ALGORITHM)
    monkeypatch.syspath_prepend(tmp_path)
    result = run(file, tmp_path / "out", algorithm="late:Late")
    assert result.values("status") == ("ok", "ok")
    assert result.numbers("m") == (None, pytest.approx(0.1))
    assert result.reason(0, "m") == "no command on 'own'"
    assert result.numbers("m.u0.effort")[0] is None
    assert result.columns[result.index("m.effort")].unit == "s"
    energies = result.numbers("e")
    assert all(energy is not None and energy > 0.0 for energy in energies)
    assert result.reason(1, "e.charge") == "no <battery> is given"
    assert result.reasons(1) == ()
    log = (tmp_path / "out" / "measure-e.csv").read_text().splitlines()
    assert log[0].endswith("time [s],energy [J],power [W],charge [1]")
    assert len(log) == 1 + 2 * 3


def test_a_vehicle_that_is_not_simulated_leaves_the_score_empty_and_says_why(
    tmp_path: Path,
) -> None:
    file = written(tmp_path, "<u:energy> <name>m</name> <target>girona500</target> </u:energy>")
    text = file.read_text().replace("currents-scene", "visibility-scene")
    file.write_text(text.replace("<interval>1", "<interval>0.1"))
    result = run(file, tmp_path / "out", algorithm="frozen")
    assert (result.values("m"), result.values("total")) == ((None,), (None,))
    assert result.reason(0, "m") == (
        "the vehicle 'girona500' has no <u:dynamics>: nothing drives it"
    )
