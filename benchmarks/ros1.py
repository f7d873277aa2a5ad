"""What ROS 1 costs: images to a subscriber of rospy.

Run ``python benchmarks/ros1.py``; ``scripts/ros1_peers`` installs rospy. Images of 640x480 are
published at 30 Hz by the wall clock; the target is 5 ms one way, without loss.
"""

from __future__ import annotations

import json
import os
import subprocess
import time
from statistics import median

import numpy as np
from measure import main

from uwsim.bus import Bus
from uwsim.messages import Image, image
from uwsim.middleware.log import Log
from uwsim.middleware.ros1 import Master, Ros1Bridge

TARGET = 5.0
"""Of an image, one way [ms]."""
N_IMAGES, RATE = 150, 30.0
PYTHON = "/usr/bin/python3"
LISTENER = """
import json, sys, time, rospy
from sensor_msgs.msg import Image
times = []
def receive(message):
    times.append(time.time() - message.header.stamp.to_sec() + 1.0)
    if len(times) == int(sys.argv[1]):
        rospy.signal_shutdown("done")
rospy.init_node("listener")
rospy.Subscriber("/camera", Image, receive, queue_size=10, buff_size=2**24, tcp_nodelay=True)
rospy.spin()
print(json.dumps(times))
"""


def images(n: int = N_IMAGES) -> dict[str, object]:
    """Publish images at 30 Hz and have rospy note when each is there."""
    bus, log = Bus(), Log("ros1", lambda line: None)
    master = Master(log)
    bridge = Ros1Bridge(bus, lambda: 0.0, master=master.uri, log=log, parameters={})
    publish = bus.publisher("camera", Image)
    bridge.step()
    own = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    environment = {**own, "ROS_MASTER_URI": master.uri, "ROS_IP": "127.0.0.1"}
    listener = subprocess.Popen(
        [PYTHON, "-c", LISTENER, str(n)], env=environment, stdout=subprocess.PIPE, text=True
    )
    pixels = np.zeros((480, 640, 3), np.uint8)
    while not bus.has_readers("camera"):
        bridge.step()
        time.sleep(0.01)
    began = time.monotonic()
    for i in range(n):
        time.sleep(max(0.0, began + i / RATE - time.monotonic()))
        publish(image(pixels, time=time.time()))
        bus.deliver()
        bridge.step()
    try:
        printed, _ = listener.communicate(timeout=10.0)
        times = [1000.0 * each for each in json.loads(printed)]
    except subprocess.TimeoutExpired:
        listener.kill()
        return {"lost": "some", "of": n}
    finally:
        bridge.close()
        master.close()
    return {
        "wall_ms": round(median(times), 3),
        "wall_ms_95": round(sorted(times)[int(0.95 * len(times))], 3),
        "lost": n - len(times),
        "of": n,
        "target_ms": TARGET,
        "ratio": round(median(times) / TARGET, 3),
    }


if __name__ == "__main__":
    main(lambda: {"640x480 image to rospy": images()})
