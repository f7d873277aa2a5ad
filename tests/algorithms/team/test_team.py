"""Vehicles that meet and relays: the parts without a simulation, and short runs of the tasks."""

from __future__ import annotations

import ast
from pathlib import Path

import numpy as np
import pytest

import uwsim
from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.team.guided_vehicle import place_beside
from uwsim.algorithms.team.packet_store import PacketStore
from uwsim.algorithms.team.position_report import PositionReport, ReportLink
from uwsim.algorithms.team.relay import RelayHold
from uwsim.algorithms.team.rendezvous import RendezvousPursuit
from uwsim.errors import BadSetting
from uwsim.messages import UInt8MultiArray


class TimedNode(FakeNode):
    """A node whose timers never fire."""

    def create_timer(self, period_s: float, callback: object) -> None:
        pass


def test_a_place_beside_another_is_on_the_side_of_the_origin_at_its_depth() -> None:
    place = place_beside(np.array([10.0, 0.0, 9.0]), np.array([0.0, 0.0, 4.0]), 2.0)
    assert place == pytest.approx([8.0, 0.0, 4.0])


def test_nobody_moves_away_who_is_nearer_than_the_distance() -> None:
    origin = np.array([9.0, 0.5, 4.0])
    assert place_beside(np.array([10.0, 0.0, 9.0]), origin, 2.0) == pytest.approx(origin)


def test_packets_are_kept_once_and_sent_in_turn() -> None:
    store = PacketStore()
    assert store.take() is None
    assert [store.add(data) for data in (b"one", b"two", b"one")] == [True, True, False]
    assert len(store) == 2
    assert [store.take() for _ in range(3)] == [b"one", b"two", b"one"]
    store.add(b"three")
    assert [store.take() for _ in range(3)] == [b"three", b"two", b"three"]


def test_a_report_arrives_as_it_was_sent_in_20_bytes() -> None:
    node, reports = TimedNode(), list[PositionReport]()
    link = ReportLink(node, "first_modem", reports.append)
    link.send(np.array([1.5, -2.0, 4.25]), np.array([0.5, 0.25, 0.125]))
    [(topic, packet)] = node.published
    assert topic == "/first_modem/tx"
    assert packet.data.size == 20
    node.now = 3.0
    node.readers["/first_modem/rx"](packet)
    [report] = reports
    assert report.position == pytest.approx([1.5, -2.0, 4.25])
    assert report.position_at(5.0) == pytest.approx([2.5, -1.5, 4.25])


def test_a_vehicle_reads_its_own_topics_only() -> None:
    node = TimedNode()
    RendezvousPursuit().start(node)
    sensors = ("imu", "dvl", "depth", "gps")
    names = ("first", "second")
    expected = {f"/{name}/{sensor}" for name in names for sensor in sensors}
    assert set(node.readers) == expected | {f"/{name}_modem/rx" for name in names}


def test_a_wrong_place_of_an_end_is_named() -> None:
    node = TimedNode(parameters={"sender": "3"})
    with pytest.raises(BadSetting, match=r"'sender' is '3'; expected two numbers \[m\]"):
        RelayHold().start(node)


def test_the_two_vehicles_share_no_object_but_the_node() -> None:
    """Check that a member refers to its own vehicle and link, and to no other member."""
    path = Path(uwsim.__file__).parent / "algorithms" / "team" / "rendezvous.py"
    [member] = [
        node
        for node in ast.parse(path.read_text()).body
        if isinstance(node, ast.ClassDef) and node.name == "_Member"
    ]
    assert "_members" not in ast.unparse(member)


def test_two_vehicles_that_hear_of_one_another_approach() -> None:
    """Run the start of the task rendezvous: both know their places and send reports."""
    with uwsim.load("rendezvous-scene", seed=0, timestep=0.01) as simulation:
        simulation.attach(RendezvousPursuit())
        first_gap = gap_of(simulation)
        simulation.advance(25.0)
        # both go at 0.6 m/s after the first reports, in a current of at most 0.2 m/s
        assert 8.0 < first_gap - gap_of(simulation) < 35.0


def gap_of(simulation: uwsim.Simulation) -> float:
    places = [simulation.pose(name).position for name in ("first", "second")]
    return float(np.linalg.norm(places[0] - places[1]))


def test_a_relay_brings_the_bytes_of_a_packet_to_the_receiver() -> None:
    """Run the task relay in quiet water, where the relay sends from near its start."""
    received: list[bytes] = []
    settings = {"AcousticCommsChannel[acoustic/0].noiseLvl": 40.0}
    with uwsim.load("relay-scene", seed=0, timestep=0.01, settings=settings) as simulation:
        simulation.world.bus.subscribe(
            "/receiver_modem/rx", UInt8MultiArray, lambda m: received.append(m.data.tobytes())
        )
        simulation.attach(RelayHold(), parameters={"receiver": "-30 0"})
        simulation.advance(4.0)
        data = np.arange(24, dtype=np.uint8)
        simulation.publish("/sender_modem/tx", UInt8MultiArray(data=data))
        simulation.advance(16.0)
        assert data.tobytes() in received
        # the relay sends it again: once from the sender, and at least once from the relay
        assert received.count(data.tobytes()) >= 2
