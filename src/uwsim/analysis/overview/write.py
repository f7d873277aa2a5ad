"""The files of an overview: ``overview.csv``, ``overview.json`` and the heat map as PNG and PDF.

.. code-block:: text

    task,algorithm,level,n,n_ok,rate,rate_low,rate_high
    reach,reach,current 0.2 m/s,10,7,0.7,0.348,0.933

There is a line for each level of each result. The JSON file has the ranks and strengths.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Sequence
from pathlib import Path

from ...results.atomic_file import write_text
from ..plots import levels_text, save_pdf, save_plot, success_overview
from .ranks import TaskRanks, rank_algorithms
from .tasks import OverviewTask, algorithm_names, overview_rows

FORMAT = "uwsim-overview/1"
OVERVIEW_FILES = re.compile(r"overview\.(csv|json|png|pdf)")
"""The paths of the files that uwsim writes into the directory of an overview."""


def write_overview(tasks: Sequence[OverviewTask], directory: Path) -> Path:
    """Write the numbers and the heat map into ``directory``; return the path of the PNG file."""
    directory.mkdir(parents=True, exist_ok=True)
    write_text(directory / "overview.csv", overview_csv(tasks))
    write_text(directory / "overview.json", overview_json(tasks, rank_algorithms(tasks)))
    figure = success_overview(overview_rows(tasks), algorithm_names(tasks))
    save_pdf(figure, directory / "overview.pdf")
    return save_plot(figure, directory / "overview.png")


def overview_csv(tasks: Sequence[OverviewTask]) -> str:
    """Return the text of ``overview.csv``."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    header = ("task", "algorithm", "level", "n", "n_ok", "rate", "rate_low", "rate_high")
    writer.writerow(header)
    for task in tasks:
        columns = task.entries[0].result.columns_of_kind("level")
        for name, rates in task.rates().items():
            for level, rate in rates.items():
                level_name = levels_text(columns, level)
                numbers = (rate.n, rate.successes, rate.value, rate.low, rate.high)
                writer.writerow((task.name, name, level_name, *numbers))
    return stream.getvalue()


def overview_json(tasks: Sequence[OverviewTask], ranks: TaskRanks | None) -> str:
    """Return the text of ``overview.json``."""
    document = {
        "format": FORMAT,
        "tasks": [
            {
                "name": task.name,
                "differing_experiments": list(task.experiment_differences),
                "results": [
                    {"algorithm": entry.name, "directory": entry.source, "sha256": entry.sha256}
                    for entry in task.entries
                ],
            }
            for task in tasks
        ],
        "ranked_tasks": []
        if ranks is None
        else [
            {"name": name, "n_seeds": n} for name, n in zip(ranks.tasks, ranks.n_seeds, strict=True)
        ],
        "ranks": [] if ranks is None else _rank_fields(ranks),
    }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _rank_fields(ranks: TaskRanks) -> list[dict[str, object]]:
    fields: list[dict[str, object]] = []
    for i, (name, rank) in enumerate(zip(ranks.algorithms, ranks.ranks, strict=True)):
        strength = ranks.strengths[i] if ranks.strengths else None
        fields.append(
            {
                "algorithm": name,
                "rank": rank.rank,
                "score": rank.score,
                "place": rank.place,
                "place_low": rank.low,
                "place_high": rank.high,
                "n_better": rank.n_better,
                "n_worse": rank.n_worse,
                "strength": strength and strength.value,
                "strength_error": strength and strength.standard_error,
            }
        )
    return fields
