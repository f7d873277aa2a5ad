"""The error of a map: a million points of one message, added to a reconstruction of a box.

Run ``python benchmarks/reconstruction.py``. Times are CPU times.
"""

from __future__ import annotations

import numpy as np
from measure import main, milliseconds

from uwsim.base.geometry import rotation_from_rpy
from uwsim.benchmark.metrics.coverage import Coverage
from uwsim.benchmark.metrics.reconstruction import Reconstruction
from uwsim.world import Box

N_POINTS = 1_000_000
CELL = 0.003
"""The size of the cells of the coverage [m]."""
TARGET_MS = 500.0


def measure() -> dict[str, object]:
    """Measure the target."""
    box = Box((-0.5, -0.3, 0.0), (0.5, 0.3, 0.4))
    generator = np.random.default_rng(0)
    points = generator.uniform((-0.6, -0.4, -0.1), (0.6, 0.4, 0.5), (N_POINTS, 3))
    reconstruction = Reconstruction(box, Coverage(box, CELL))
    rotation, position = rotation_from_rpy(0.01, 0.02, 0.03), np.zeros(3)

    def add() -> None:
        reconstruction.add(points, rotation, position)

    return {"a million points [ms]": milliseconds(add, target=TARGET_MS, calls=1, batches=5)}


if __name__ == "__main__":
    main(measure)
