"""u:delivery: the packets of one device that reach another, directly or by a third one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.support.fakes import FakeWorld
from uwsim.benchmark.measures import Delivery, DeliverySpec
from uwsim.errors import UnknownName
from uwsim.messages import UInt8MultiArray
from uwsim.network import BitErrors, DelayChannel, Modem, ModemSettings, Packet

SPEC = DeliverySpec(name="delivered", from_="a_modem", to="b_modem", period=2.0, packets=3, size=16)
BIT_RATE, SOUND_SPEED, RANGE = 128.0, 1500.0, 100.0


class Sea:
    """A sender at 0 m, a relay at 75 m and a receiver at 150 m, with a range of 100 m."""

    def __init__(self) -> None:
        self.world = FakeWorld(timestep=0.1)
        self.relayed_bytes: list[bytes] = []
        self.senders: dict[str, Callable[[bytes, int], None]] = {}
        for address, (name, x) in enumerate((("a", 0.0), ("relay", 75.0), ("b", 150.0))):
            settings = ModemSettings(
                name=f"{name}/modem",
                address=address,
                sends_on="water",
                listens_to="water",
                channel=DelayChannel(per_metre=1.0 / SOUND_SPEED),
                errors=BitErrors(),
                bit_rate=BIT_RATE,
                max_range=RANGE,
            )
            position = np.array([x, 0.0, 0.0])
            publish = self.world.bus.publisher(f"{name}_modem/rx", UInt8MultiArray)
            modem = Modem(settings, lambda p=position: p, self._receiver(name, publish))
            self._connect(name, self.world.network.join(modem))

    def _receiver(
        self, name: str, publish: Callable[[UInt8MultiArray], None]
    ) -> Callable[[Packet, int], None]:
        def receive(packet: Packet, time: int) -> None:
            publish(UInt8MultiArray(data=np.frombuffer(packet.data, np.uint8)))
            if name == "relay":
                self.relayed_bytes.append(packet.data)

        return receive

    def _connect(self, name: str, send: Callable[[bytes, int], None]) -> None:
        self.senders[name] = send
        self.world.bus.subscribe(
            f"{name}_modem/tx", UInt8MultiArray, lambda message: send(message.data.tobytes(), -1)
        )

    def run(self, measure: Delivery, end_time: float) -> None:
        while self.world.time < end_time - 1e-9:
            self.world.advance()
            self.world.network.advance(round(self.world.time * 1e9))
            measure.update()


def start_delivery() -> tuple[Sea, Delivery]:
    sea = Sea()
    measure = SPEC.bind(sea.world)
    measure.start()
    return sea, measure


def test_the_column_for_rewards_is_in_the_log() -> None:
    _, measure = start_delivery()
    assert set(SPEC.columns) <= set(measure.log_header[1:])


def test_packets_beyond_the_range_are_not_delivered() -> None:
    sea, measure = start_delivery()
    sea.run(measure, 10.0)
    assert measure.value == 0.0
    assert measure.details["sent"] == 3.0
    assert len(sea.relayed_bytes) == len(set(sea.relayed_bytes)) == 3
    assert {len(data) for data in sea.relayed_bytes} == {16}
    assert set(measure.reasons) == {"mean_delay", "time_done"}


def test_a_packet_that_a_third_device_sends_again_is_delivered_once() -> None:
    sea, measure = start_delivery()
    sea.run(measure, 5.9)  # all three are sent, 1 s and 75 m each
    for data in (sea.relayed_bytes[0], sea.relayed_bytes[0], sea.relayed_bytes[2]):
        sea.senders["relay"](data, 2)
    sea.run(measure, 10.0)
    assert measure.value == pytest.approx(2.0 / 3.0)
    assert measure.details["bytes"] == 32.0
    # sent at 0 and 4 s; sent again at 5.9 s, each 1 s long; the third one after the copy
    travel = 75.0 / SOUND_SPEED
    arrivals = np.array([6.9, 8.9]) + travel
    assert measure.details["mean_delay"] == pytest.approx((arrivals - [0.0, 4.0]).mean(), abs=0.25)


def test_it_is_done_when_the_last_packet_arrives() -> None:
    sea, measure = start_delivery()
    sea.run(measure, 5.2)
    for data in sea.relayed_bytes:
        sea.senders["relay"](data, 2)
    sea.run(measure, 9.0)
    assert measure.value == 1.0
    assert measure.details["time_done"] == pytest.approx(8.2 + 75.0 / SOUND_SPEED, abs=0.25)


def test_the_topics_of_both_ends_are_hidden_from_algorithms() -> None:
    sea, _ = start_delivery()
    topics = [f"{name}_modem/{end}" for name in ("a", "relay", "b") for end in ("tx", "rx")]
    assert [topic for topic in topics if sea.world.bus.hidden_reason(topic)] == [
        "a_modem/tx",
        "b_modem/rx",
    ]


def test_other_bytes_do_not_count() -> None:
    sea, measure = start_delivery()
    sea.run(measure, 2.0)
    sea.senders["relay"](bytes(16), 2)
    sea.run(measure, 5.0)
    assert measure.value == 0.0


def test_the_bytes_are_those_of_the_seed() -> None:
    (first, measure), (second, other) = start_delivery(), start_delivery()
    first.run(measure, 6.0)
    second.run(other, 6.0)
    assert first.relayed_bytes == second.relayed_bytes


def test_an_unknown_device_is_named() -> None:
    with pytest.raises(UnknownName, match=r"'c_modem'.*a_modem"):
        DeliverySpec(name="d", from_="c_modem", to="b_modem", period=1.0, packets=1).bind(
            Sea().world
        )
