"""Two vehicles measure their distance with acoustic modems.

The first sends a packet every two seconds, the second answers at once with its depth. Half the time
from one to the other, less the airtime of a packet, is the travel time. Messages wait for the next
step of 2 ms at both ends, so the distance is up to 3 m too long.
"""

import numpy as np

import uwsim
from uwsim.messages import Odometry, UInt8MultiArray, floats

SOUND = 1496.6  # in this water, after Mackenzie [m/s]
AIRTIME = 0.05 + 8 * 4 / 1000.0  # preamble and 4 bytes at 1000 bit/s [s]


class Asker:
    """Sends questions and prints the answers."""

    def start(self, node: uwsim.Node) -> None:
        """Ask every two seconds."""
        self.node = node
        self.ask = node.publisher("/modem1/tx", UInt8MultiArray)
        node.subscribe("/modem1/rx", UInt8MultiArray, self.hear)
        node.create_timer(2.0, self.send)

    def send(self) -> None:
        """Send a question of four bytes."""
        self.asked = self.node.now
        self.ask(UInt8MultiArray(data=np.zeros(4, np.uint8)))

    def hear(self, answer: UInt8MultiArray) -> None:
        """Print the address of the answering device, its depth and its distance."""
        travel = 0.5 * (self.node.now - self.asked) - AIRTIME
        [depth] = answer.data.view(np.float32)
        device = f"device {answer.layout.dim[0].size} is {depth:.2f} m deep"
        print(f"{self.node.now:.3f} s: {device} and {travel * SOUND:.0f} m away")


class Answerer:
    """Answers every question with its depth."""

    def start(self, node: uwsim.Node) -> None:
        """Keep the depth (the scene's frame has z down); answer at once."""
        answer = node.publisher("/modem2/tx", UInt8MultiArray)
        depth = [0.0]
        node.subscribe("/second/odom", Odometry, lambda m: depth.append(m.pose.pose.position.z))
        node.subscribe(
            "/modem2/rx",
            UInt8MultiArray,
            lambda _: answer(UInt8MultiArray(data=floats(depth[-1:]).data.view(np.uint8))),
        )


if __name__ == "__main__":
    with uwsim.load("two-vehicles-scene", seed=1) as simulation:
        simulation.attach(Answerer())
        simulation.attach(Asker())
        simulation.advance(7.0)
