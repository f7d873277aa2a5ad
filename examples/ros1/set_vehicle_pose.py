#!/usr/bin/python3
"""Hold a vehicle at a pose by geometry_msgs/Pose, as UWSim's setVehiclePose: 25 Hz.

    set_vehicle_pose.py TOPIC x y z roll pitch yaw          m and rad; the rotation is Rx Ry Rz

With `uwsim run cirs --ros1`:  set_vehicle_pose.py /g500/pose 1 0 2 0 0 0.5
"""

import contextlib
import sys

import poses
import rospy
from arguments import parse_numbers
from geometry_msgs.msg import Pose


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != 6:
        sys.exit(__doc__)
    x, y, z, *angles = parse_numbers(words, __doc__)
    rospy.init_node("set_vehicle_pose", anonymous=True)
    publisher = rospy.Publisher(topic, Pose, queue_size=1)
    message = Pose()
    poses.write(message, (x, y, z), poses.quaternion(*angles))
    rate = rospy.Rate(25)
    while not rospy.is_shutdown():
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
