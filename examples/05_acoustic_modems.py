"""Two vehicles measure their distance with acoustic modems.

The first sends a packet every two seconds; the second replies at once with its depth. The one-way
travel time is half the time from packet to reply, less the airtime of a packet. Messages wait for
the next step of 2 ms at both ends, so the distance is up to 3 m too long.
"""

import numpy as np

import uwsim
from uwsim.messages import Odometry, UInt8MultiArray, floats

SOUND_SPEED = 1496.6  # in this water, after Mackenzie [m/s]
AIRTIME = 0.05 + 8 * 4 / 1000.0  # preamble and 4 bytes at 1000 bit/s [s]


class Initiator:
    """An algorithm that sends requests and prints the distance to the replying device."""

    def start(self, node: uwsim.Node) -> None:
        """Send a request every two seconds."""
        self.node = node
        self.publish = node.publisher("/modem1/tx", UInt8MultiArray)
        node.subscribe("/modem1/rx", UInt8MultiArray, self.print_distance)
        node.create_timer(2.0, self.send)

    def send(self) -> None:
        """Send a request of four bytes."""
        self.send_time = self.node.now
        self.publish(UInt8MultiArray(data=np.zeros(4, np.uint8)))

    def print_distance(self, reply: UInt8MultiArray) -> None:
        """Print the address of the replying device, its depth and its distance."""
        travel_time = 0.5 * (self.node.now - self.send_time) - AIRTIME
        [depth] = reply.data.view(np.float32)
        device = f"device {reply.layout.dim[0].size} is {depth:.2f} m deep"
        print(f"{self.node.now:.3f} s: {device} and {travel_time * SOUND_SPEED:.0f} m away")


class Transponder:
    """An algorithm that replies to every request with its depth."""

    def start(self, node: uwsim.Node) -> None:
        """Store the depth (the frame of the scene has z down), and reply at once."""
        publish = node.publisher("/modem2/tx", UInt8MultiArray)
        depth = [0.0]
        node.subscribe("/second/odom", Odometry, lambda m: depth.append(m.pose.pose.position.z))
        node.subscribe(
            "/modem2/rx",
            UInt8MultiArray,
            lambda _: publish(UInt8MultiArray(data=floats(depth[-1:]).data.view(np.uint8))),
        )


if __name__ == "__main__":
    with uwsim.load("two-vehicles-scene", seed=1) as simulation:
        simulation.attach(Transponder())
        simulation.attach(Initiator())
        simulation.advance(7.0)
