#!/usr/bin/python3
"""Move a vehicle along the lanes of a survey, as UWSim's makeVehicleSurvey: 20 Hz.

    make_vehicle_survey.py TOPIC x y z yaw length step       m and rad

At the angle a, 0.01 rad more each time, it is at (x + length sin a, y + step a, z); its yaw is
(pi/2)(1 - cos a), with the sign of STEP. As in UWSim, YAW is not used.
With `uwsim run cirs --ros1`:  make_vehicle_survey.py /dataNavigator 0 0 2 0 2 0.2
"""

import contextlib
import math
import sys

import poses
import rospy
from arguments import parse_numbers
from nav_msgs.msg import Odometry


def main() -> None:
    topic, *words = rospy.myargv()[1:] or [""]
    if not topic or len(words) != 6:
        sys.exit(__doc__)
    x, y, z, _, length, step = parse_numbers(words, __doc__)
    rospy.init_node("make_vehicle_survey", anonymous=True)
    publisher = rospy.Publisher(topic, Odometry, queue_size=1)
    rate, a = rospy.Rate(20), 0.0
    while not rospy.is_shutdown():
        message = Odometry()
        message.header.stamp = rospy.Time.now()
        yaw = math.copysign(math.pi / 2, step) * (1 - math.cos(a))
        position = (x + length * math.sin(a), y + step * a, z)
        poses.write(message.pose.pose, position, poses.quaternion(0.0, 0.0, yaw))
        publisher.publish(message)
        a += 0.01
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
