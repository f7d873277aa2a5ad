"""Links with a delay and losses: when messages arrive, which ones do, and what is hidden."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.assets.bundled import bundled_files
from uwsim.base import rng
from uwsim.bus import Bus, Node
from uwsim.devices.topic_link import TopicLinkSpec, TopicRoute, TopicRouteSpec
from uwsim.errors import NotAllowed
from uwsim.messages import Float64, Odometry, Twist, TwistStamped, Vector3, seconds
from uwsim.runs.planning.make_plan import make_plan
from uwsim.runs.planning.plan_request import PlanRequest
from uwsim.runs.tracks.topic_sources import command_topics, topic_sources, topics_on_board
from uwsim.runs.tracks.withheld_topics import withhold_topics
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec

SCENE = """
<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>3</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
    <u:topicLink>
      <name>tether</name> <delay>0.5</delay>
      <command> <from>/operator/twist</from> <to>/rov/twist</to> </command>
      <report> <from>/rov/odom</from> <to>/operator/odom</to> <rate>5</rate> </report>
    </u:topicLink>
  </vehicle>
  <rosInterfaces>
    <PATToROSOdom>
      <topic>/rov/odom</topic> <vehicleName>rov</vehicleName> <rate>10</rate>
    </PATToROSOdom>
    <ROSTwistToPAT> <topic>/rov/twist</topic> <vehicleName>rov</vehicleName> </ROSTwistToPAT>
  </rosInterfaces>
</UWSimScene>
"""


class Receiver:
    """A route with a clock of its own, and what arrived: the times, and the numbers."""

    def __init__(self, rate: float | None = None, **link: float) -> None:
        self.now = 0.0
        self.arrivals: list[tuple[float, float]] = []
        self.route = TopicRoute(
            TopicLinkSpec(name="link", **link),
            TopicRouteSpec(from_="a", to="b", rate=rate),
            lambda: self.now,
            lambda message: self.arrivals.append((self.now, message.data)),
            rng.stream(1, "link"),
        )

    def run(self, n: int, period: float, duration: float) -> list[tuple[float, float]]:
        """Send the numbers from 0 to n - 1 at a period, in steps of 10 ms."""
        for step in range(round(duration / 0.01)):
            self.now = step * 0.01
            self.route.publish_due(self.now)
            if step % round(period / 0.01) == 0 and step * 0.01 < n * period - 1e-9:
                self.route.receive(Float64(data=step * 0.01 / period))
        return self.arrivals


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> SceneSpec:
    path: Path = tmp_path_factory.mktemp("link") / "scene.xml"
    path.write_text(SCENE)
    return read_scene(path)


def test_messages_arrive_after_the_delay_in_their_order() -> None:
    arrivals = Receiver(delay=0.25).run(4, 0.1, 1.0)
    assert np.array(arrivals) == pytest.approx(
        np.array([(0.25 + 0.1 * k, float(k)) for k in range(4)])
    )


def test_without_a_delay_messages_arrive_at_once() -> None:
    receiver = Receiver()
    receiver.route.receive(Float64(data=7.0))
    assert receiver.arrivals == [(0.0, 7.0)]


def test_jitter_delays_and_never_exchanges_messages() -> None:
    arrivals = Receiver(delay=0.1, jitter=0.4).run(200, 0.01, 3.0)
    delays = [time - 0.01 * number for time, number in arrivals]
    assert [number for _, number in arrivals] == pytest.approx(list(range(200)))
    assert min(delays) >= 0.1 - 1e-9
    assert max(delays) <= 0.51 + 1e-9
    # of 40 messages sent within the jitter, nearly always one has nearly all of it
    assert np.mean(delays) > 0.4


def test_the_share_of_lost_messages_is_the_probability() -> None:
    n_arrived = len(Receiver(loss=0.3).run(4000, 0.01, 40.0))
    deviation = np.sqrt(4000 * 0.3 * 0.7)
    assert abs(n_arrived - 4000 * 0.7) < 4.0 * deviation


def test_messages_that_are_too_soon_are_left_out() -> None:
    arrivals = Receiver(rate=5.0).run(100, 0.01, 1.0)
    assert [time for time, _ in arrivals] == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8])


def test_an_operator_sees_and_moves_the_vehicle_after_the_delay(scene: SceneSpec) -> None:
    with open_scene(scene, is_blind=True) as simulation:
        reports: list[tuple[float, float]] = []
        simulation.world.bus.subscribe(
            "/operator/odom",
            Odometry,
            lambda m: reports.append((simulation.time, seconds(m.header.stamp))),
        )
        start = simulation.pose("rov").position[0]
        moved_time = None
        for _ in range(150):
            twist = Twist(linear=Vector3(0.5, 0.0, 0.0), angular=Vector3(0.0, 0.0, 0.0))
            simulation.publish("/operator/twist", TwistStamped(twist=twist))
            simulation.advance(0.01)
            if moved_time is None and simulation.pose("rov").position[0] != start:
                moved_time = simulation.time
        assert moved_time == pytest.approx(0.5, abs=0.05)
        ages = [arrival - stamp for arrival, stamp in reports]
        assert len(ages) == 5
        assert ages == pytest.approx([0.5] * 5, abs=0.011)


class Cheat:
    """An algorithm that reads the pose of the vehicle itself."""

    def start(self, node: Node) -> None:
        node.subscribe("/rov/odom", Odometry, print)


def test_the_topics_of_the_vehicle_are_hidden_and_the_way_to_them_is_named(
    scene: SceneSpec,
) -> None:
    expected = "'/rov/odom' is reached only over the link 'tether', as 'operator/odom'"
    with (
        open_scene(scene, is_blind=True) as simulation,
        pytest.raises(NotAllowed, match=expected),
    ):
        simulation.attach(Cheat())


def test_a_relayed_topic_belongs_to_the_sensor_of_its_source(scene: SceneSpec) -> None:
    assert topic_sources(scene)["operator/odom"] == "PATToROSOdom"
    assert {"operator/twist", "rov/twist"} <= command_topics(scene)


def test_a_pilot_steers_over_the_link(scene: SceneSpec) -> None:
    with open_scene(scene, is_blind=True) as simulation:
        assert pilot_topics(simulation)["twist_topic"] == "/operator/twist"


def test_all_topics_of_a_vehicle_are_behind_its_link() -> None:
    scene = read_scene(bundled_files("scenes")["teleoperation-scene"])
    topics = topics_on_board(scene)
    assert set(topics) == {
        f"bluerov2/{name}" for name in ("odom", "camera", "camera_info", "imu", "depth", "dvl")
    }
    assert set(topics.values()) == {"operator"}
    assert topics_on_board(read_scene(bundled_files("scenes")["open-water-scene"])) == {}


def test_an_operator_cannot_subscribe_to_the_camera_on_board() -> None:
    bus = Bus()
    withhold_topics(make_plan(PlanRequest(benchmark="teleoperation", algorithm="nothing")), bus)
    for name in ("bluerov2/camera", "bluerov2/odom"):
        assert "behind the link 'operator'" in str(bus.hidden_reason(name))
