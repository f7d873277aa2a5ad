"""The figures of docs/identification.md: the example of ``uwsim identify``, fitted.

Usage: ``python examples/identification_figures.py docs/images`` (a minute).
"""

import sys
import tempfile
from pathlib import Path

from uwsim.identification import IdentifySettings, identify, make_scene, open_vehicle
from uwsim.identification.example import ROBOT, write_example
from uwsim.identification.report.plots import draw_plots
from uwsim.logs import read_log


def main() -> None:
    """Draw the figures into the directory that the command line names."""
    directory = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        log, guess = write_example(Path(folder) / "swim")
        model = open_vehicle(make_scene(str(guess), ROBOT))
        result = identify(
            [read_log(log)], model, IdentifySettings(free_names=("added_mass", "drag"))
        )
        for path in draw_plots(result, Path(folder) / "plots"):
            if path.stem in ("horizon", "window"):
                path.replace(directory / f"identification-{path.stem}.png")


if __name__ == "__main__":
    main()
