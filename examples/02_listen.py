"""Listen: a program that lives outside the simulator and sees topics only.

An algorithm under test is a class with ``start(node)``: it subscribes and publishes, and never
touches the simulator. This one notes what arrives and when.
"""

import uwsim
from uwsim.messages import CameraInfo, Image, seconds

SCENE = "visibility-scene.xml"
TOPIC = "/uwsim/camera1"
SECONDS = 0.2  # of simulation time [s]


class Listener:
    """Prints a line for each picture."""

    def start(self, node: uwsim.Node) -> None:
        """Say what it wants to hear; from here on it lives on callbacks."""
        self.node = node
        node.subscribe(TOPIC, Image, self.look)
        node.subscribe(f"{TOPIC}_info", CameraInfo, self.note)
        node.every(0.1, lambda: print(f"{node.now:.3f} s: every tenth of a second"))

    def look(self, image: Image) -> None:
        """Look at a picture."""
        print(
            f"{self.node.now:.3f} s: {image.width}x{image.height} {image.encoding}, "
            f"stamped {seconds(image.header.stamp):.3f} s"
        )

    def note(self, info: CameraInfo) -> None:
        """Note what the camera says of itself."""
        print(f"{self.node.now:.3f} s: focal length {info.k[0]:.2f} px")


def main() -> None:
    with uwsim.load(SCENE, seed=1) as simulation:
        simulation.attach(Listener())
        simulation.advance(SECONDS)


if __name__ == "__main__":
    main()
