#!/usr/bin/python3
"""Rock a vehicle about its start pose, as UWSim's setVehicleDisturbances: 25 Hz.

    set_vehicle_disturbances.py ODOMETRY_TOPIC CONTROL_TOPIC ax ay az ar ap ay    m and rad

At the angle a, 0.01 rad more each time, it is moved by (ax sin 2a, ay sin a, az sin a) in the frame
of the first odometry and turned by Rx Ry Rz of (ar, ap, ay) sin a.
With `uwsim run cirs --ros1`:
set_vehicle_disturbances.py /uwsim/girona500/odom /dataNavigator 0.1 0.1 0.1 0 0 0.1
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry


def main() -> None:
    words = rospy.myargv()[1:]
    if len(words) != 8:
        sys.exit(__doc__)
    x, y, z, *angles = parse_numbers(words[2:], __doc__)
    rospy.init_node("set_vehicle_disturbances", anonymous=True)
    publisher = rospy.Publisher(words[1], Odometry, queue_size=1)
    start, attitude = poses.read(rospy.wait_for_message(words[0], Odometry).pose.pose)
    rate, a = rospy.Rate(25), 0.0
    while not rospy.is_shutdown():
        displacement = (x * math.sin(2 * a), y * math.sin(a), z * math.sin(a))
        rotation = poses.quaternion(*(angle * math.sin(a) for angle in angles))
        message = Odometry()
        message.header.stamp = rospy.Time.now()
        position = [p + d for p, d in zip(start, poses.rotate(attitude, displacement), strict=True)]
        poses.write(message.pose.pose, position, poses.multiply(attitude, rotation))
        publisher.publish(message)
        a += 0.01
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
