"""Turn a torpedo-shaped AUV with its fins, and measure its turning circle.

The REMUS 100 of the bundled scene has one propeller and four fins, which are commanded by topics:
a command from -1 to 1 for the propeller, and angles in radians for the fins.
"""

import numpy as np

import uwsim
from uwsim.messages import Float64MultiArray, MultiArrayLayout, Odometry

RUDDER, ELEVATOR = -0.07, -0.03  # [rad]: bow to starboard, level flight
SECONDS = 60.0  # of simulation time [s]


class Helmsman:
    """An algorithm that commands the propeller and the fins, and records the track."""

    def start(self, node: uwsim.Node) -> None:
        """Create the publishers, the subscription and a timer for the commands."""
        self.track: list[tuple[float, float]] = []
        self.propeller = node.publisher("/remus/propeller", Float64MultiArray)
        self.fins = node.publisher("/remus/fins", Float64MultiArray)
        node.subscribe("/remus/odometry", Odometry, self.store_position)
        node.create_timer(1.0, self.steer)

    def steer(self) -> None:
        """Command full thrust, both rudders alike, and both elevators alike."""
        layout = MultiArrayLayout(dim=[], data_offset=0)
        self.propeller(Float64MultiArray(layout=layout, data=np.array([1.0])))
        angles = np.array([RUDDER, RUDDER, ELEVATOR, ELEVATOR])
        self.fins(Float64MultiArray(layout=layout, data=angles))

    def store_position(self, message: Odometry) -> None:
        """Append the position, north and east [m]."""
        position = message.pose.pose.position
        self.track.append((position.x, position.y))


def fit_circle(positions: np.ndarray) -> tuple[float, float, float]:
    """Fit a circle to positions (n, 2) by least squares; return centre x, y and radius [m]."""
    matrix = np.column_stack([2.0 * positions, np.ones(len(positions))])
    x, y, rest = np.linalg.lstsq(matrix, (positions**2).sum(axis=1), rcond=None)[0]
    return x, y, float(np.sqrt(rest + x * x + y * y))


def main() -> None:
    helmsman = Helmsman()
    with uwsim.load("remus-scene") as simulation:
        simulation.attach(helmsman)
        simulation.advance(SECONDS)
    x, y, radius = fit_circle(np.array(helmsman.track[len(helmsman.track) // 2 :]))
    print(f"turns about {x:.1f} m north, {y:.1f} m east, with a radius of {radius:.1f} m")


if __name__ == "__main__":
    main()
