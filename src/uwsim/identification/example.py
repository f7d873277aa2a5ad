"""The example of ``uwsim identify``: a simulated log, and a first guess by rules of thumb."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from lxml import etree

from ..base.files.staging import stage_directory
from ..logs import write_csv_log
from ..results.atomic_file import write_text
from ..scene.hydrodynamics.vehicle_file import read_vehicle
from ..scene.hydrodynamics.vehicle_sets import find_vehicle
from ..schema import write
from .simulated_log import Excitation, simulate_log
from .vehicle_model import make_scene

TRUTH = "bluerov2_heavy"
"""The hydrodynamics file of the vehicle that makes the log."""
ROBOT = "bluerov2_heavy.urdf"
"""The robot of the example."""
POOL_START = (0.0, 2.4, 3.3)
"""The position in L at which the log begins, in the bundled pool of 12 x 8 x 4 m [m]."""
SEED, HEAVE_OFFSET = 98, 0.05
"""The seed and the command against the buoyancy with which the vehicle stays in the pool."""
LOG_NAME, GUESS_NAME = "swim.csv", "guess.xml"
"""The names of the files."""
SOURCE = (
    "First guess by the rules of thumb of docs/your-own-vehicle.md. Added mass: half the displaced "
    "mass or inertia. Drag: 500 A for a projected area A, and a tenth of that for slow motion."
)
ADDED_MASS = (6.7, 6.7, 6.7, 0.13, 0.115, 0.185)
LINEAR_DAMPING = (7.3, 5.8, 13.1, 0.1, 0.1, 0.1)
QUADRATIC_DAMPING = (73.0, 58.0, 131.0, 1.0, 1.0, 1.0)


def write_example(directory: Path, *, duration: float = 120.0) -> tuple[Path, Path]:
    """Write a log and a first guess; return their paths.

    Args:
        directory: the directory.
        duration: the length of the log [s].
    """
    scene = make_scene(TRUTH, position=POOL_START)
    excitation = Excitation(duration=duration, heave_offset=HEAVE_OFFSET)
    log = simulate_log(scene, seed=SEED, excitation=excitation)
    truth = read_vehicle(find_vehicle(TRUTH))
    body = replace(
        truth.bodies[0],
        added_mass=ADDED_MASS,
        linear_damping=LINEAR_DAMPING,
        quadratic_damping=QUADRATIC_DAMPING,
    )
    guess = replace(truth, name=Path(GUESS_NAME).stem, source=SOURCE, bodies=(body,))
    root = write(guess, "hydrodynamics")
    etree.indent(root)
    with stage_directory(directory) as draft:
        write_text(draft / LOG_NAME, write_csv_log(log))
        text = etree.tostring(root, encoding="unicode")
        write_text(draft / GUESS_NAME, f'<?xml version="1.0"?>\n{text}\n')
    return directory / LOG_NAME, directory / GUESS_NAME
