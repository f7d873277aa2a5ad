"""Drive a vehicle to a position: a node of ROS 2 that reads odometry and publishes velocities.

    uwsim run cirs --ros2
    python examples/ros2/goto_position.py --goal 2 1 3

It needs rclpy, nav_msgs and geometry_msgs, and nothing of uwsim.
"""

import argparse
import contextlib
import math

import rclpy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class GotoPosition(Node):
    """A node that answers each odometry message with a velocity towards the goal."""

    def __init__(self, goal: list[float], options: argparse.Namespace) -> None:
        super().__init__("goto_position")
        self.goal, self.tolerance, self.speed = goal, options.tolerance, options.speed
        self.distance = float("inf")
        self.publisher = self.create_publisher(TwistStamped, options.command, 10)
        self.create_subscription(Odometry, options.odometry, self.steer, 10)

    def steer(self, odometry: Odometry) -> None:
        """Publish the velocity in the axes of the vehicle."""
        position, orientation = odometry.pose.pose.position, odometry.pose.pose.orientation
        offset = [self.goal[0] - position.x, self.goal[1] - position.y, self.goal[2] - position.z]
        self.distance = sum(coordinate**2 for coordinate in offset) ** 0.5
        factor = min(1.0, self.speed / max(self.distance, 1e-9))
        velocity = rotate_to_body(offset, orientation)
        command = TwistStamped()
        command.header.stamp = odometry.header.stamp
        command.twist.linear.x = factor * velocity[0]
        command.twist.linear.y = factor * velocity[1]
        command.twist.linear.z = factor * velocity[2]
        self.publisher.publish(command)


def rotate_to_body(vector: list[float], orientation) -> list[float]:
    """Rotate a vector by the inverse of a quaternion."""
    w, x, y, z = orientation.w, -orientation.x, -orientation.y, -orientation.z
    a, b, c = vector
    # t = 2 q x v; v' = v + w t + q x t
    t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)]
    return [
        a + w * t[0] + y * t[2] - z * t[1],
        b + w * t[1] + z * t[0] - x * t[2],
        c + w * t[2] + x * t[1] - y * t[0],
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--goal", type=float, nargs=3, default=[2.0, 1.0, 3.0], metavar="X")
    parser.add_argument(
        "--near",
        dest="tolerance",
        type=float,
        default=0.1,
        help="accepted distance from the goal [m]",
    )
    parser.add_argument("--speed", type=float, default=0.5, help="highest speed [m/s]")
    parser.add_argument("--odometry", default="/uwsim/girona500/odom")
    parser.add_argument("--command", default="/g500/twist")
    options = parser.parse_args()
    if not all(map(math.isfinite, (*options.goal, options.tolerance, options.speed))):
        parser.error("expected finite numbers")
    rclpy.init()
    node = GotoPosition(options.goal, options)
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        while node.distance > options.tolerance:
            rclpy.spin_once(node, timeout_sec=0.1)
        node.publisher.publish(TwistStamped())  # stop
        print(f"reached {options.goal}: {node.distance:.2f} m away")
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
