"""A recorded exchange with a real ArduSub: its servo packets, and what the simulation answered.

``python -m tests.support.recorded_exchange`` records it anew; it needs ``UWSIM_ARDUSUB``. With
``--answers`` it keeps the packets and computes the answers to them, after a change of the physics.
"""

from __future__ import annotations

import hashlib
import json
import lzma
import socket
import sys
import threading
from collections.abc import Sequence
from pathlib import Path

from tests.support.opened import open_scene
from tests.support.px4_stub import find_free_port
from tests.support.real_ardusub import ALT_HOLD, MANUAL_MODE, RATE, Order, fly, scene_at

FOLDER = Path(__file__).parents[1] / "autopilots" / "ardupilot" / "exchange"
"""The folder of the recorded exchange."""
PACKETS = FOLDER / "arm-hold-strafe.packets.xz"
"""The packets of 40 bytes, one after the other."""
ANSWERS = FOLDER / "arm-hold-strafe.answers.json"
"""The hash of all answers, and the answer of each second."""
PACKET_SIZE = 40
"""The size of a packet with 16 channels [bytes]."""
ORDERS = [
    Order(time=20.0, mode=MANUAL_MODE),
    Order(time=21.0, is_arming=True),
    Order(time=22.0, mode=ALT_HOLD),
    Order(time=26.0, sticks=(0, 400, 500, 0)),
    Order(time=29.0),
]
"""The orders of the recorded run: arm, hold depth, strafe to starboard, hold."""
DURATION = 32.0
"""The simulation time of the recorded run [s]."""


def read_packets() -> list[bytes]:
    """Return the recorded packets."""
    data = lzma.decompress(PACKETS.read_bytes())
    return [data[i : i + PACKET_SIZE] for i in range(0, len(data), PACKET_SIZE)]


def replay(packets: Sequence[bytes]) -> list[bytes]:
    """Send packets to the simulation in lock-step; return its answers."""
    port = find_free_port()
    answers: list[bytes] = []

    def send() -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
            client.connect(("127.0.0.1", port))
            client.settimeout(30.0)
            for packet in packets:
                client.send(packet)
                answers.append(client.recv(65536))

    with open_scene(
        scene_at(port, find_free_port()),
        timestep=1.0 / RATE,
        udp_address="127.0.0.1",
        is_blind=True,
    ) as simulation:
        thread = threading.Thread(target=send, daemon=True)
        thread.start()
        simulation.advance(len(packets) / RATE)
    thread.join(timeout=30.0)
    return answers


def describe_answers(answers: Sequence[bytes]) -> dict[str, object]:
    """Return the hash of the answers, and the text of one answer for each second."""
    seconds = [answer.decode().strip() for answer in answers[RATE - 1 :: RATE]]
    return {"sha256": hashlib.sha256(b"".join(answers)).hexdigest(), "seconds": seconds}


def main(arguments: list[str]) -> None:
    """Record the exchange, or compute the answers to the recorded packets."""
    if arguments == ["--answers"]:
        answers = replay(read_packets())
    else:
        trial = fly(ORDERS, DURATION)
        PACKETS.write_bytes(lzma.compress(b"".join(trial.packets)))
        answers = trial.answers
    ANSWERS.write_text(json.dumps(describe_answers(answers), indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
