"""The scene ``cirs`` with every topic read: CPU time of a second of simulation time.

Two cameras and a depth camera of 320x240 and a multibeam of 1201 beams at 10 Hz, and all other
sensors; target: three times faster than real time. One JSON on stdout.
"""

from __future__ import annotations

from measure import main, milliseconds

import uwsim

TARGET = 1000.0 / 3.0  # CPU time of a second of simulation time [ms]


def measure() -> dict[str, object]:
    """Measure a second of the scene, after half a second."""
    with uwsim.load("cirs") as simulation:
        for topic in list(simulation.bus.topics):
            simulation.bus.subscribe(topic, object, lambda message: None)
        simulation.advance(0.5)
        second = milliseconds(lambda: simulation.advance(1.0), target=TARGET, calls=2, batches=5)
    return {"a second of cirs": second}


if __name__ == "__main__":
    main(measure)
