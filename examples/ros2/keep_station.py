"""Keep a position in a current: a node of ROS 2 that needs nothing of uwsim.

    uwsim bench examples/ros1/keep_station.xml --ros2 --client keep_station --sync none
    python examples/ros2/keep_station.py --ros-args -p use_sim_time:=true

Ten times a second it commands a velocity towards the goal, 0.4 1/s times the distance. With the
first command it calls `startBench`, which starts a benchmark. For this service, the simulator must
use the same middleware (DDS) as the node, as uwsim does where it finds rclpy. With `--sync output
--output /g500/twist=10Hz` simulation time waits for each command.
"""

import contextlib

import rclpy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import Empty

GOAL, KP, PERIOD = (-9.0, -8.0, 10.0), 0.4, 0.1


class KeepStation(Node):
    """A node with a proportional controller of the position."""

    def __init__(self) -> None:
        super().__init__("keep_station")
        self.odometry, self.has_begun = None, False
        self.publisher = self.create_publisher(TwistStamped, "/g500/twist", 10)
        self.start_client = self.create_client(Empty, "/startBench")
        self.create_subscription(Odometry, "/g500/odom", self.store_odometry, 10)
        self.create_timer(PERIOD, self.control)

    def store_odometry(self, odometry: Odometry) -> None:
        """Store the latest odometry."""
        self.odometry = odometry

    def control(self) -> None:
        """Command a velocity in the axes of the vehicle."""
        if self.odometry is None:
            return
        if not self.has_begun:
            self.has_begun = True
            self.start_client.call_async(Empty.Request())
        pose, command = self.odometry.pose.pose, TwistStamped()
        command.header.stamp = self.get_clock().now().to_msg()
        linear = command.twist.linear
        linear.x, linear.y, linear.z = velocity(pose.position, pose.orientation)
        self.publisher.publish(command)


def velocity(p, q) -> list[float]:
    """Return the velocity towards the goal in the axes of the vehicle, 3 numbers [m/s]."""
    ground_velocity = [KP * (g - x) for g, x in zip(GOAL, (p.x, p.y, p.z), strict=True)]
    axis = [q.x, q.y, q.z]
    cross_product = cross(axis, ground_velocity)  # the velocity, rotated by the inverse attitude
    return [
        v - 2.0 * q.w * t + 2.0 * u
        for v, t, u in zip(ground_velocity, cross_product, cross(axis, cross_product), strict=True)
    ]


def cross(a: list[float], b: list[float]) -> list[float]:
    """Return the cross product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def main() -> None:
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(KeepStation())


if __name__ == "__main__":
    main()
