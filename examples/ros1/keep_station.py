#!/usr/bin/python3
"""Keep a place in a current: a program of rospy that knows nothing of uwsim.

    keep_station.py ODOMETRY_TOPIC TWIST_TOPIC x y z        m, in the frame of the odometry

Ten times a second it commands a velocity towards the place, 0.4 1/s times the distance. Before the
first command it calls `startBench`, with which benchmarks start. In two terminals:

    uwsim bench examples/ros1/keep_station.xml --ros1 --client keep_station --sync none
    examples/ros1/keep_station.py /g500/odom /g500/twist -9 -8 10

With `--sync output --output /g500/twist=10Hz` in the place of `--sync none` simulation time waits
for each command.
"""

import contextlib
import sys

import rospy
from arguments import numbers
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty

KP, PERIOD = 0.4, 0.1


class KeepStation:
    """The controller."""

    def __init__(self, odometry_topic: str, twist_topic: str, goal: list) -> None:
        self.goal, self.odometry, self.has_begun = goal, None, False
        self.publisher = rospy.Publisher(twist_topic, TwistStamped, queue_size=1)
        rospy.Subscriber(odometry_topic, Odometry, self.hear, queue_size=1)
        rospy.Timer(rospy.Duration(PERIOD), self.control)

    def hear(self, odometry: Odometry) -> None:
        """Remember the newest odometry."""
        self.odometry = odometry

    def control(self, _event: object) -> None:
        """Command a velocity, with the axes of the vehicle."""
        if self.odometry is None:
            return
        if not self.has_begun:
            self.has_begun = True
            with contextlib.suppress(
                rospy.ServiceException, rospy.ROSException
            ):  # `uwsim run` has none
                rospy.ServiceProxy("startBench", Empty)()
        command = TwistStamped()
        command.header.stamp = rospy.Time.now()
        linear = command.twist.linear
        linear.x, linear.y, linear.z = velocity(self.odometry, self.goal)
        self.publisher.publish(command)


def velocity(odometry: Odometry, goal: list) -> list:
    """Velocity towards the goal with the axes of the vehicle, 3 numbers [m/s]."""
    p, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    away = [KP * (wanted - is_at) for wanted, is_at in zip(goal, (p.x, p.y, p.z), strict=True)]
    axis = (q.x, q.y, q.z)
    turn = cross(axis, away)  # away, turned back by the attitude
    return [
        v - 2.0 * q.w * t + 2.0 * u for v, t, u in zip(away, turn, cross(axis, turn), strict=True)
    ]


def cross(a: list, b: list) -> list:
    """The cross product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def main() -> None:
    if len(rospy.myargv()) != 6:
        sys.exit(__doc__)
    odometry_topic, twist_topic, *given = rospy.myargv()[1:]
    goal = numbers(given, __doc__)
    rospy.init_node("keep_station")
    # no /clock yet; a timer would fire twice at the first
    while rospy.Time.now().is_zero() and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.01)
    KeepStation(odometry_topic, twist_topic, goal)
    rospy.spin()


if __name__ == "__main__":
    main()
