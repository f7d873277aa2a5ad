#!/usr/bin/python3
"""Print a line for each of the first N images of a camera.

    image_echo.py TOPIC [N]

With `uwsim run cirs --ros1`:  image_echo.py /uwsim/camera1 10
"""

import contextlib
import sys

import rospy
from arguments import parse_numbers
from sensor_msgs.msg import Image


def main() -> None:
    if len(rospy.myargv()) not in (2, 3):
        sys.exit(__doc__)
    topic, *rest = rospy.myargv()[1:]
    (n,) = parse_numbers(rest or ["10"], __doc__, int)
    rospy.init_node("image_echo", anonymous=True)
    for _ in range(n):
        image = rospy.wait_for_message(topic, Image)
        mean = sum(image.data) / max(1, len(image.data))
        print(
            f"{image.header.stamp.to_sec():.3f} s: {image.width}x{image.height} {image.encoding}, "
            f"mean {mean:.1f}",
            flush=True,
        )


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        main()
