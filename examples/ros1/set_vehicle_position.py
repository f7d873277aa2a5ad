#!/usr/bin/python3
"""Hold a vehicle at a pose by nav_msgs/Odometry, as UWSim's setVehiclePosition: 10 Hz.

    set_vehicle_position.py TOPIC x y z roll pitch yaw      m and rad; the rotation is Rx Ry Rz

With `uwsim run cirs --ros1`:  set_vehicle_position.py /dataNavigator 1 0 2 0 0 0.5
"""

import contextlib
import sys

import poses
import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != 6:
        sys.exit(__doc__)
    x, y, z, *angles = parse_numbers(words, __doc__)
    rospy.init_node("set_vehicle_position", anonymous=True)
    publisher = rospy.Publisher(topic, Odometry, queue_size=1)
    rate = rospy.Rate(10)
    while not rospy.is_shutdown():
        message = Odometry()
        message.header.stamp = rospy.Time.now()
        poses.write(message.pose.pose, (x, y, z), poses.quaternion(*angles))
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
