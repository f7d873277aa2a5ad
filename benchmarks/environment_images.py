"""Speed of image observations and of ``render()``: CPU time of a step. One JSON on stdout.

The time of a step is CPU time of this process, the smallest of several runs of steps, without
start and compilation.
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from measure import main

import uwsim

N_RUNS, N_STEPS = 4, 40
ENVIRONMENTS: dict[str, dict[str, Any]] = {
    "state_alone": {},
    "state_and_image_128x128": {"observation": ["positionError", "camera:image=128x128"]},
    "state_and_grey_84x84": {"observation": ["positionError", "camera:grey=84x84"]},
    "state_and_depth_84x84": {"observation": ["positionError", "camera:depth=84x84"]},
    "render_chase_320x240": {
        "render_mode": "rgb_array",
        "camera": "chase",
        "frame_size": (320, 240),
    },
}


def cpu_ms(options: dict[str, Any]) -> float:
    env = uwsim.make_env("station-keeping", **options)
    env.reset(seed=1)
    env.render()
    times = []
    for _ in range(N_RUNS):
        start = time.process_time()
        for _ in range(N_STEPS):
            env.step(np.zeros(8, np.float32))
            env.render()
        times.append(time.process_time() - start)
    env.close()
    return 1000.0 * min(times) / N_STEPS


def measure() -> dict[str, Any]:
    return {name: {"cpu_ms": round(cpu_ms(options), 2)} for name, options in ENVIRONMENTS.items()}


if __name__ == "__main__":
    main(measure)
