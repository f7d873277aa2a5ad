"""A tracker like those of the original UWSim: without lock-step, and with two outputs.

It subscribes to the images, calls ``startBench`` at the first, and publishes nothing until its
service ``autoInit`` is called. From then on it publishes corners and centroid for each image: the
quad of ``autoInit``, moved by a number that is computed from the pixels. So each image has
its own answer.
"""

from __future__ import annotations

from uwsim.bus import Node
from uwsim.messages import Empty, GTpublish, GTpublishResponse, Image, floats, pixels_of
from uwsim.messages import Float32MultiArray as Floats

CAMERA = "/uwsim/camera1"
OUTPUTS = ("--output", f"/cornersTopic={CAMERA}", "--output", f"/centroidTopic={CAMERA}")

COMPUTE = '''
def corners_and_centroid(quad, pixels):
    """Return the answers to an image of bytes, 8 and 2 numbers [px]."""
    shift = sum(pixels[::97]) % 64 / 16.0
    corners = [value + shift for value in quad]
    return corners, [sum(corners[0::2]) / 4.0, sum(corners[1::2]) / 4.0]
'''
"""The computation of all variants, without numpy for Debian's Python."""

ROSPY = (
    COMPUTE
    + '''
import struct, sys
import genpy, rospy
from sensor_msgs.msg import Image
from std_msgs.msg import Float32MultiArray
from std_srvs.srv import Empty

class Floats(genpy.Message):
    """float32[] groundTruth"""
    __slots__ = ["groundTruth"]
    _slot_types = ["float32[]"]
    _type, _md5sum, _full_text = "underwater_sensor_msgs/GTpublishRequest", "", __doc__
    def deserialize(self, data):
        (n,) = struct.unpack_from("<I", data)
        self.groundTruth = list(struct.unpack_from("<%df" % n, data, 4))
        return self

class Nothing(genpy.Message):
    __slots__, _slot_types = [], []
    _type, _md5sum, _full_text = "underwater_sensor_msgs/GTpublishResponse", "", ""
    def serialize(self, buffer):
        pass

class GTpublish:
    _type, _md5sum = "underwater_sensor_msgs/GTpublish", sys.argv[1]
    _request_class, _response_class = Floats, Nothing

class Tracker:
    def __init__(self):
        self.quad, self.has_begun = None, False
        self.corners = rospy.Publisher("/cornersTopic", Float32MultiArray, queue_size=10)
        self.centroid = rospy.Publisher("/centroidTopic", Float32MultiArray, queue_size=10)
        rospy.Service("/autoInit", GTpublish, self.auto_init)
        rospy.Subscriber("CAMERA", Image, self.on_image, queue_size=10, buff_size=2**24)

    def auto_init(self, request):
        self.quad = request.groundTruth
        return Nothing()

    def on_image(self, image):
        if not self.has_begun:
            self.has_begun = True
            rospy.ServiceProxy("/startBench", Empty)()
        elif self.quad is not None:
            corners, centroid = corners_and_centroid(self.quad, image.data)
            self.corners.publish(Float32MultiArray(data=corners))
            self.centroid.publish(Float32MultiArray(data=centroid))

rospy.init_node("tracker")
tracker = Tracker()
rospy.spin()
'''.replace("CAMERA", CAMERA)
)
"""The program with rospy; its argument is the MD5 sum of ``GTpublish``."""

WEB = (
    COMPUTE
    + """
import base64, json, sys
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

def send(**frame):
    socket.send(json.dumps(frame))

with connect(sys.argv[1], max_size=2**26) as socket:
    for topic in ("/cornersTopic", "/centroidTopic"):
        send(op="advertise", topic=topic, type="std_msgs/Float32MultiArray")
    send(op="advertise_service", service="/autoInit", type="underwater_sensor_msgs/GTpublish")
    send(op="subscribe", topic="CAMERA")
    quad, has_begun = None, False
    while True:
        try:
            frame = json.loads(socket.recv())
        except ConnectionClosed:
            break
        if frame["op"] == "call_service":
            quad = frame["args"]["groundTruth"]
            about = {"service": frame["service"], "id": frame["id"]}
            send(op="service_response", result=True, values={}, **about)
        elif frame["op"] == "publish" and not has_begun:
            has_begun = True
            send(op="call_service", service="/startBench", args={})
        elif frame["op"] == "publish" and quad is not None:
            answers = corners_and_centroid(quad, base64.b64decode(frame["msg"]["data"]))
            for topic, answer in zip(("/cornersTopic", "/centroidTopic"), answers):
                send(op="publish", topic=topic, msg={"data": answer})
""".replace("CAMERA", CAMERA)
)
"""The program with rosbridge; its argument is the URI."""

_compute: dict[str, object] = {}
exec(COMPUTE, _compute)


class OriginalTracker:
    """The tracker as an algorithm in the process of the simulation."""

    def start(self, node: Node) -> None:
        self._node, self._has_begun = node, False
        self._quad: list[float] | None = None
        self._corners = node.publisher("cornersTopic", Floats)
        self._centroid = node.publisher("centroidTopic", Floats)
        node.serve("autoInit", GTpublish, self._auto_init)
        node.subscribe(CAMERA, Image, self._on_image)

    def _auto_init(self, request: GTpublish) -> GTpublishResponse:
        self._quad = [float(value) for value in request.groundTruth]
        return GTpublishResponse()

    def _on_image(self, image: Image) -> None:
        if not self._has_begun:
            self._has_begun = True
            self._node.call("startBench", Empty())
        elif self._quad is not None:
            compute = _compute["corners_and_centroid"]
            assert callable(compute)
            corners, centroid = compute(self._quad, pixels_of(image).tobytes())
            self._corners(floats(corners))
            self._centroid(floats(centroid))
