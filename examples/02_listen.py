"""Subscribe to topics, as an algorithm under test does.

An algorithm is a class with ``start(node)``. It subscribes and publishes, and has no access to the
simulator. This one prints each message with its time of arrival.
"""

import uwsim
from uwsim.messages import CameraInfo, Image, seconds

SCENE = "visibility-scene.xml"
TOPIC = "/uwsim/camera1"
SECONDS = 0.2  # of simulation time [s]


class Listener:
    """An algorithm that prints a line for each image."""

    def start(self, node: uwsim.Node) -> None:
        """Subscribe to the topics; from now on only callbacks run."""
        self.node = node
        node.subscribe(TOPIC, Image, self.print_image)
        node.subscribe(f"{TOPIC}_info", CameraInfo, self.print_camera_info)
        node.create_timer(0.1, lambda: print(f"{node.now:.3f} s: every tenth of a second"))

    def print_image(self, image: Image) -> None:
        """Print the size, the encoding and the stamp of an image."""
        print(
            f"{self.node.now:.3f} s: {image.width}x{image.height} {image.encoding}, "
            f"stamped {seconds(image.header.stamp):.3f} s"
        )

    def print_camera_info(self, info: CameraInfo) -> None:
        """Print the focal length of the camera."""
        print(f"{self.node.now:.3f} s: focal length {info.k[0]:.2f} px")


def main() -> None:
    with uwsim.load(SCENE, seed=1) as simulation:
        simulation.attach(Listener())
        simulation.advance(SECONDS)


if __name__ == "__main__":
    main()
