"""Packets between modems: when they arrive, and why they do not."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from tests.network.links import Line
from uwsim.base.record import assign, copy_record
from uwsim.errors import UnknownName
from uwsim.network import BitErrors, EnergyModel, Mac, RateErrors, WaterChannel

BYTES_25 = bytes(25)  # 0.2 s at 1000 bit/s


def test_a_kilometre_takes_two_thirds_of_a_second_and_the_packet_its_airtime() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 1000.0)
    line.send("a", BYTES_25)
    assert line.run(0.866) == []
    assert line.run(1.0) == [("b", pytest.approx(1000 / 1500 + 0.2, abs=1e-9), BYTES_25)]


def test_a_preamble_comes_before_each_packet() -> None:
    line = Line()
    line.add("a", 0.0, preamble=0.05)
    line.add("b", 1500.0)
    line.send("a", BYTES_25)
    assert [time for _, time, _ in line.run(2.0)] == [pytest.approx(1.25, abs=1e-9)]


def test_packets_that_arrive_together_are_both_lost() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 3000.0)
    line.add("c", 1500.0)
    line.send("a", b"one")
    line.send("b", b"two", at=0.01)
    assert [name for name, _, _ in line.run(3.0)] == ["b", "a"]
    assert line.modems["c"].counts.n_collisions == 2


def test_packets_that_arrive_one_after_the_other_are_both_received() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 3000.0)
    line.add("c", 1500.0)
    line.send("a", BYTES_25)
    line.send("b", BYTES_25, at=0.2)
    assert [name for name, _, _ in line.run(1.5)] == ["c", "c"]


def test_who_sends_hears_nothing() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 1500.0)
    line.send("a", BYTES_25)
    line.send("b", BYTES_25, at=1.1)  # while a's packet arrives
    received = line.run(5.0)
    assert [name for name, _, _ in received] == ["a"]
    assert line.modems["b"].counts.n_half_duplex == 1


def test_who_sends_on_another_channel_than_it_listens_to_hears_while_it_sends() -> None:
    line = Line()
    line.add("a", 0.0, sends_on="down", listens_to="up")
    line.add("b", 1500.0, sends_on="up", listens_to="down")
    line.send("a", BYTES_25)
    line.send("b", BYTES_25, at=1.1)
    assert [name for name, _, _ in line.run(5.0)] == ["b", "a"]


def test_packets_are_sent_one_after_the_other_in_their_order() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 150.0)
    for letter in (b"x", b"y", b"z"):
        line.send("a", 25 * letter)
    received = line.run(2.0)
    assert [data[:1] for _, _, data in received] == [b"x", b"y", b"z"]
    assert [time for _, time, _ in received] == pytest.approx([0.3, 0.5, 0.7], abs=1e-8)


def test_packets_that_follow_at_once_do_not_collide_at_a_receiver_that_comes_nearer() -> None:
    line = Line()
    line.add("a", 0.0)
    line.add("b", 1500.0)
    for _ in range(10):
        line.send("a", BYTES_25)
    for step in range(2500):
        line.places["b"] = 1500.0 - 2.0 * 0.002 * step
        line.run(0.002 * step)
    assert line.modems["b"].counts.n_received == 10


def test_a_full_queue_takes_no_more() -> None:
    line = Line()
    modem = line.add("a", 0.0, queue_size=50)
    for _ in range(3):
        line.send("a", BYTES_25)
    assert (modem.counts.n_queued, modem.counts.n_queue_full) == (3, 1)
    line.send("a", BYTES_25, at=0.21)  # the first is sent
    line.run(2.0)
    assert (modem.counts.n_sent, modem.counts.n_queue_full) == (3, 1)


def test_only_devices_within_range_hear_it() -> None:
    line = Line()
    line.add("a", 0.0, min_range=10.0, max_range=100.0)
    for name, x in (("near", 9.0), ("there", 50.0), ("far", 101.0)):
        line.add(name, x)
    line.send("a", b"?")
    assert [name for name, _, _ in line.run(1.0)] == ["there"]


def test_a_packet_for_one_device_is_handed_on_by_that_one_alone() -> None:
    line = Line()
    for x, name in enumerate("abc"):
        line.add(name, 10.0 * x)
    line.send("a", b"hi", to=2)
    assert [name for name, _, _ in line.run(1.0)] == ["c"]


def test_jitter_delays_each_packet_by_at_most_its_size_and_keeps_their_order() -> None:
    line = Line()
    line.add("a", 0.0, send_delay=0.1, send_jitter=0.05)
    line.add("b", 1500.0, receive_jitter=0.5)
    for start in range(40):
        line.send("a", bytes([start]), at=0.25 * start)
    received = line.run(20.0)
    assert [data[0] for _, _, data in received] == list(range(40))
    delays = np.array([time - 0.25 * i - 1.108 for i, (_, time, _) in enumerate(received)])
    assert delays.min() > 0.0
    assert 0.3 < delays.max() < 0.55


def test_of_many_packets_as_many_are_lost_as_the_model_says() -> None:
    line = Line()
    line.add("a", 0.0, errors=BitErrors(rate=1e-3), bit_rate=1e6)
    line.add("b", 100.0)
    for i in range(1000):
        line.send("a", bytes(64), at=0.001 * i)
    line.run(2.0)
    expected = 1.0 - (1.0 - 1e-3) ** 512  # 0.401
    spread = 4.0 * (expected * (1.0 - expected) / 1000.0) ** 0.5  # 4 sigma: 1 in 16000
    assert abs(line.modems["b"].counts.n_errors / 1000.0 - expected) < spread


def test_one_more_device_changes_no_other_devices_losses() -> None:
    def lost(names: str) -> list[bytes]:
        line = Line(seed=5)
        for name in names:
            line.add(name, 100.0 * "abc".index(name), errors=BitErrors(rate=0.02), bit_rate=1e6)
        for i in range(100):
            line.send("a", bytes([i]), at=0.01 * i)
        return [data for name, _, data in line.run(2.0) if name == "b"]

    assert lost("ab") == lost("cab") == lost("acb")
    assert 0 < len(lost("ab")) < 100


def test_the_formula_of_an_error_rate_holds_for_bits_bytes_and_packets() -> None:
    def lost(unit: str) -> float:
        errors = RateErrors(rate=lambda metres: 1e-4 * metres, unit=unit)  # type: ignore[arg-type]
        line = Line()
        line.add("a", 0.0, errors=errors)
        path = line.network._path(*[line.modems["a"], line.add("b", 10.0)])
        return errors.probability(path, 100)

    assert lost("packet") == pytest.approx(1e-3)
    assert lost("byte") == pytest.approx(1.0 - (1.0 - 1e-3) ** 100)
    assert lost("bit") == pytest.approx(1.0 - (1.0 - 1e-3) ** 800)


def test_slotted_aloha_begins_at_slots_and_avoids_the_collision_of_aloha() -> None:
    def received(mac: Mac) -> int:
        line = Line()
        for name, x in (("a", 0.0), ("b", 3000.0), ("c", 1500.0)):
            line.add(name, x, mac=mac)
        line.send("a", BYTES_25, at=0.1)
        line.send("b", BYTES_25, at=0.25)
        line.run(0.9)
        line.run(9.0)
        return line.modems["c"].counts.n_received

    assert received(Mac(kind="aloha")) == 0
    slots = Mac(kind="slotted", slot=200_000_000)
    assert received(slots) == 2


def test_csma_waits_while_another_is_heard_and_aloha_does_not() -> None:
    def received(mac: Mac) -> list[float]:
        line = Line()
        line.add("a", 0.0)
        line.add("b", 15.0, mac=mac)
        line.send("a", BYTES_25)
        line.send("b", BYTES_25, at=0.1)
        return [time for name, time, _ in line.run(9.0) if name == "a"]

    assert received(Mac(kind="aloha")) == []  # a was still sending
    [time] = received(Mac(kind="csma", slot=100_000_000, max_backoff=4))
    slots = (time - 0.01 - 0.2 - 0.1) / 0.1
    assert slots >= 1.0
    assert slots == pytest.approx(round(slots), abs=1e-6)


def test_energy_is_used_by_sending_receiving_and_waiting_until_none_is_left() -> None:
    line = Line()
    model = EnergyModel(
        initial_energy=10.0,
        turn_on_energy=1.0,
        sending_power=5.0,
        receiving_power=2.0,
        idle_power=0.5,
    )
    a = line.add("a", 0.0, energy=model)
    b = line.add("b", 1500.0, energy=model)
    line.send("a", BYTES_25)
    line.run(2.0)
    assert a.energy(2_000_000_000) == pytest.approx(10.0 - 1.0 - 5.0 * 0.2 - 0.5 * 1.8)
    assert b.energy(2_000_000_000) == pytest.approx(10.0 - 1.0 - 2.0 * 0.2 - 0.5 * 1.8)
    line.send("a", BYTES_25, at=30.0)
    line.run(40.0)
    assert a.energy(40_000_000_000) == 0.0
    assert (a.counts.n_sent, a.counts.n_no_energy) == (1, 1)


def test_a_restored_network_goes_on_to_the_same_bits() -> None:
    def line() -> Line:
        made = Line(seed=3)
        made.add("a", 0.0, errors=BitErrors(rate=0.005), send_jitter=0.01)
        made.add("b", 700.0, mac=Mac(kind="csma", slot=50_000_000))
        return made

    first, second = line(), line()
    for i in range(20):
        first.send("a", bytes([i]), at=0.03 * i)
        first.send("b", bytes([100 + i]), at=0.03 * i)
    saved = copy_record(first.network.state)
    assign(second.network.state, pickle.loads(pickle.dumps(saved)))
    first.received.clear()
    assert first.run(9.0) == second.run(9.0)
    assert len(first.received) > 5


def test_a_modem_that_is_not_there_is_named() -> None:
    line = Line()
    line.add("girona500/modem", 0.0)
    with pytest.raises(UnknownName, match="girona500/modem"):
        line.network.modem("girona500/moden")


def test_what_becomes_of_each_packet_is_traced() -> None:
    line = Line()
    line.add("a", 0.0, queue_size=30)
    line.add("b", 1500.0)
    lines: list[str] = []
    line.network.trace = lines.append
    line.send("a", BYTES_25)
    line.send("a", BYTES_25)
    line.run(2.0)
    assert lines == [
        "0.000000000 a queued a#0 25 bytes",
        "0.000000000 a sent a#0 25 bytes",
        "0.000000000 a queued a#1 25 bytes",
        "0.000000000 a queue_full a#1 25 bytes",
        "1.200000000 b received a#0 25 bytes",
    ]


def test_empty_packets_fill_a_queue_too() -> None:
    line = Line()
    modem = line.add("a", 0.0, queue_size=10, preamble=1.0)
    for _ in range(100):
        line.send("a", b"")
    assert modem.counts.n_queue_full == 90


def test_depths_beyond_all_seas_do_not_turn_time_back() -> None:
    line = Line()
    line.add("a", 0.0, channel=WaterChannel())
    line.add("b", 1000.0)
    line.network._surface = 1e6
    line.send("a", b"x")
    [(_, time, _)] = line.run(5.0)
    assert 0.4 < time < 1.0
