"""Turn a torpedo-shaped AUV with its fins, and measure its turning circle.

The REMUS 100 of the bundled scene has one propeller and four fins, which are commanded by topics:
a command from -1 to 1 for the propeller, and angles in radians for the fins.
"""

import numpy as np

import uwsim
from uwsim.messages import Float64MultiArray, MultiArrayLayout, Odometry

RUDDER, PLANES = -0.07, -0.03  # [rad]: the stern to port, so the bow to starboard; level flight
SECONDS = 60.0  # of simulation time [s]


class Helmsman:
    """Commands propeller and fins once, and keeps the track."""

    def start(self, node: uwsim.Node) -> None:
        """Subscribe, and command at the first tick."""
        self.track: list[tuple[float, float]] = []
        self.propeller = node.publisher("/remus/propeller", Float64MultiArray)
        self.fins = node.publisher("/remus/fins", Float64MultiArray)
        node.subscribe("/remus/odometry", Odometry, self.note)
        node.create_timer(1.0, self.steer)

    def steer(self) -> None:
        """Full ahead; both rudders alike, both planes alike."""
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self.propeller(Float64MultiArray(layout=layout, data=np.array([1.0])))
        angles = np.array([RUDDER, RUDDER, PLANES, PLANES])
        self.fins(Float64MultiArray(layout=layout, data=angles))

    def note(self, message: Odometry) -> None:
        """Keep the place, north and east [m]."""
        place = message.pose.pose.position
        self.track.append((place.x, place.y))


def circle(places: np.ndarray) -> tuple[float, float, float]:
    """Centre and radius of the circle through places (n, 2), by least squares [m]."""
    sides = np.column_stack([2.0 * places, np.ones(len(places))])
    x, y, rest = np.linalg.lstsq(sides, (places**2).sum(axis=1), rcond=None)[0]
    return x, y, float(np.sqrt(rest + x * x + y * y))


def main() -> None:
    helmsman = Helmsman()
    with uwsim.load("remus-scene") as simulation:
        simulation.attach(helmsman)
        simulation.advance(SECONDS)
    x, y, radius = circle(np.array(helmsman.track[len(helmsman.track) // 2 :]))
    print(f"turns about {x:.1f} m north, {y:.1f} m east, with a radius of {radius:.1f} m")


if __name__ == "__main__":
    main()
