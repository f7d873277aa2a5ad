"""Make a benchmark from the log of a mission, and score a tracker on its images in added fog.

A simulated dive stands for the real one: its recording has odometry and the images of a camera. The
scene of the tank gives the depth of each pixel and the true corners of the box.
"""

import json
import subprocess
import sys
from pathlib import Path

from uwsim.assets.bundled import scene_file

MAX_ERROR = 1.0  # the mean error of the corners [px]
ODOMETRY = (
    "<PATToROSOdom> <topic>/girona500/odom</topic> <vehicleName>girona500</vehicleName> "
    "<rate>50</rate> </PATToROSOdom>"
)


def main() -> None:
    tank, recording, scenario = Path("tank.xml"), Path("dive.mcap"), Path("scenario")
    text = scene_file("visibility-moving-scene").read_text()
    tank.write_text(text.replace("<rosInterfaces>", f"<rosInterfaces> {ODOMETRY}", 1))
    run("run", tank, "--for", "2s", "--record", recording)

    options = ["--images", "/uwsim/camera1", "--target", "blackbox", "--levels", "0:0.8:0.4"]
    run("scenario", recording, "--scene", tank, *options, "-o", scenario)
    print("files:", ", ".join(sorted(path.name for path in scenario.iterdir())))

    for name in ("benchmark", "benchmark-rendered"):
        result = Path(f"{name}.result")
        run("bench", scenario / f"{name}.xml", "--algorithm", "esm", "--out", result)
        for row in read_rows(result):
            is_good = row["corners"] is not None and row["corners"] < MAX_ERROR
            print(f"{name}, fog {row['fog']:.1f} 1/m: {row['status']}; below 1 px: {is_good}")


def run(*words: object) -> None:
    """Run a command of uwsim quietly."""
    command = [sys.executable, "-m", "uwsim", *map(str, words)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def read_rows(result: Path) -> list[dict]:
    """Return the rows of a result as dictionaries by the names of the columns."""
    document = json.loads((result / "result.json").read_text())
    names = [column["name"] for column in document["columns"]]
    return [dict(zip(names, row, strict=True)) for row in document["rows"]]


if __name__ == "__main__":
    main()
