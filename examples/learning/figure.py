"""Draw the baselines of the four tasks, as in docs/environments.md, and print their table.

    python examples/learning/figure.py RUNS docs/images/baselines.png

The folder RUNS has results of ``uwsim bench``, ``TASK/ALGORITHM`` as ``circle/position-p``, those
of policies of several training seeds, ``TASK/ppo1``, and the learning curves of `ppo.py`,
``TASK/ppo1.csv``. The error after the approach is the mean distance from `APPROACH` on.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from uwsim.analysis.plots import PALETTE, save_plot, styled_figure
from uwsim.statistics.interval import mean_interval

TASKS = {
    "station-keeping": "station keeping, 0.2 m/s",
    "circle": "circle, 0.1 m/s",
    "helix": "helix, 0.1 m/s",
    "lemniscate": "lemniscate, 0.1 m/s",
}
ALGORITHMS = {
    "position-p": "P",
    "position-pi": "PI",
    "position-lqr": "LQR",
    "mpc": "MPC",
    "cem": "CEM",
}
APPROACH = 10.0  # s


def read_result(folder):
    """Return the score [m], the error after the approach [m] and the energy [J] of each repeat."""
    result = json.loads((folder / "result.json").read_text())
    names = [column["name"] for column in result["columns"]]
    rows = [dict(zip(names, row, strict=True)) for row in result["rows"]]
    log = np.genfromtxt(folder / "measure-offset.csv", delimiter=",", skip_header=1)
    repeats, time, distance = log[:, 0], log[:, 3], log[:, 4]
    errors = [
        float(distance[(repeats == row["repeat"]) & (time >= APPROACH)].mean()) for row in rows
    ]
    return {
        "score": [row["offset"] for row in rows],
        "error": errors,
        "energy": [row["energy"] for row in rows],
    }


def read_task(folder):
    """Return the numbers of each algorithm; for PPO the means of each training seed."""
    numbers = {
        label: read_result(folder / name)
        for name, label in ALGORITHMS.items()
        if (folder / name).is_dir()
    }
    seeds = [read_result(path.with_suffix("")) for path in sorted(folder.glob("ppo*.csv"))]
    numbers["PPO"] = {
        name: [float(np.mean(seed[name])) for seed in seeds]
        for name in ("score", "error", "energy")
    }
    return numbers


def print_table(tasks):
    """Print means and 95 % intervals as a table of Markdown."""
    print("| task | | score [m] | error after 10 s [m] | energy [J] |\n|---|---|---|---|---|")
    for name, numbers in tasks.items():
        for label, values in numbers.items():
            cells = [
                format_interval(values["score"], "{:.3f}"),
                format_interval(values["error"], "{:.4f}"),
                format_interval(values["energy"], "{:.0f}"),
            ]
            print(f"| `{name}` | {label} | {' | '.join(cells)} |")


def format_interval(values, form):
    """Return a mean with its 95 % interval."""
    interval = mean_interval(values)
    mean, low, high = (form.format(x) for x in (interval.mean, interval.low, interval.high))
    return f"{mean} [{low}, {high}]"


def draw(runs, tasks, out):
    """Draw the learning curves of each task, with the scores of the controllers as lines."""
    with styled_figure(size=(7.2, 4.6)) as figure:
        panels = figure.subplots(2, 2, sharey=True).ravel()
        for panel, (name, numbers) in zip(panels, tasks.items(), strict=True):
            files = sorted((runs / name).glob("ppo*.csv"))
            curves = [np.genfromtxt(path, delimiter=",", skip_header=1) for path in files]
            steps = curves[0][:, 0] / 1000.0
            errors = np.array([curve[:, 2] for curve in curves])
            panel.fill_between(steps, errors.min(0), errors.max(0), color=PALETTE[0], alpha=0.25)
            panel.plot(steps, np.median(errors, axis=0), color=PALETTE[0], label="PPO, training")
            scores = numbers["PPO"]["score"]
            points = {"color": PALETTE[0], "ls": "none", "marker": "o", "ms": 3, "clip_on": False}
            panel.plot([steps[-1]] * len(scores), scores, label="PPO, benchmark", **points)
            for i, label in enumerate(("P", "PI", "LQR", "MPC")):
                if label not in numbers:
                    continue
                level = float(np.mean(numbers[label]["score"]))
                panel.axhline(level, color=PALETTE[i + 1], ls="--", lw=1.0, label=label)
            panel.set(yscale="log", title=TASKS[name], xlim=(0.0, steps[-1]))
        for panel in panels[2:]:
            panel.set_xlabel("training [1000 steps]")
        for panel in panels[::2]:
            panel.set_ylabel("rms distance [m]")
        panels[1].legend(ncols=2, fontsize=7)
        save_plot(figure, out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("runs", type=Path)
    parser.add_argument("out", type=Path, help="the image, such as baselines.png")
    arguments = parser.parse_args()
    tasks = {name: read_task(arguments.runs / name) for name in TASKS}
    print_table(tasks)
    draw(arguments.runs, tasks, arguments.out)


if __name__ == "__main__":
    main()
