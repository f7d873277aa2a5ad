"""Run two levels with two algorithms, and read the scores from result.json.

A result is self-describing: columns with units, a row for each level, and a reason for every
missing value. The standard library is enough to read it.
"""

import json
import subprocess
import sys
from pathlib import Path

ALGORITHMS = ("esm", "frozen")
LEVELS = ("fog=0", "fog=1.3")  # [1/m]
MAX_ERROR = 5.0  # the paper's limit of good tracking, for the total [px]


def main() -> None:
    for algorithm in ALGORITHMS:
        folder = Path(f"{algorithm}.result")
        command = [sys.executable, "-m", "uwsim", "bench", "visibility", "--seed", "1"]
        command += ["--algorithm", algorithm, "--out", str(folder), "--overwrite"]
        for level in LEVELS:
            command += ["--level", level]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

        result = json.loads((folder / "result.json").read_text())
        names = [column["name"] for column in result["columns"]]
        for number, row in enumerate(result["rows"]):
            cells = dict(zip(names, row, strict=True))
            if cells["total"] is None:
                message = "nothing to measure"
                reasons = [m["why"] for m in result["missing"] if m["row"] == number]
                message += ": " + reasons[0].split(":")[0].rsplit(" at ", 1)[0]
            else:
                message = f"total below {MAX_ERROR:g} px: {cells['total'] < MAX_ERROR}"
            print(f"{algorithm}, fog {cells['fog']:.1f} 1/m: {cells['status']}; {message}")


if __name__ == "__main__":
    main()
