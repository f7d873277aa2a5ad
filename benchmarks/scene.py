"""The scene ``cirs`` with every topic read: CPU time of a second of simulation time.

Two cameras and a depth camera of 320x240 and a multibeam of 1201 beams at 10 Hz, and all other
sensors; target: at least three times faster than real time. One JSON on stdout.
"""

from __future__ import annotations

import json
import time

import uwsim

SECONDS, REPEATS = 2.0, 5


def measure() -> dict[str, float]:
    """Simulation time over CPU time: the median of some repeats, after half a second."""
    with uwsim.load("cirs") as simulation:
        for topic in list(simulation.bus.topics):
            simulation.bus.subscribe(topic, object, lambda message: None)
        simulation.advance(0.5)
        factors = []
        for _ in range(REPEATS):
            begin = time.process_time()
            simulation.advance(SECONDS)
            factors.append(SECONDS / (time.process_time() - begin))
    return {"cirs_times_real_time": round(sorted(factors)[REPEATS // 2], 2)}


if __name__ == "__main__":
    print(json.dumps(measure()))
