"""The ranks of an overview for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from .ranks import TaskRanks, places_text, rank_algorithms
from .tasks import OverviewTask

RANK_LEGEND = (
    "The rank is 1 plus the number of algorithms that are shown to be better. It is by sign-flip "
    "tests of paired seeds at 5 %, Holm over all pairs. Algorithms with the same rank are tied. "
    "The column places has the range of the place by success in 95 % of resamples of the seeds. "
    "See docs/statistics.md."
)
STRENGTH_LEGEND = (
    " The strength is that of Bradley and Terry, with its standard error; a game is a task."
)


def overview_parts(tasks: Sequence[OverviewTask]) -> Iterator[RenderableType]:
    """Yield the table of ranks with its legend, or the reason why there is none."""
    ranks = rank_algorithms(tasks)
    if ranks is None:
        yield Text("No ranks: no task was run by all algorithms under a shared seed and level.")
        return
    counts = ", ".join(
        f"{name} ({n} seed{'s' * (n != 1)})"
        for name, n in zip(ranks.tasks, ranks.n_seeds, strict=True)
    )
    yield Text(f"Success over {counts}", style="bold")
    yield _rank_table(ranks)
    if ranks.note:
        yield Text(ranks.note, style="bold")
    yield Text(RANK_LEGEND + (STRENGTH_LEGEND if ranks.strengths else ""))


def _rank_table(ranks: TaskRanks) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("rank", justify="right")
    table.add_column("algorithm", overflow="fold")
    headings = ["success", "places", "worse than", "better than"]
    for heading in [*headings, "strength"] if ranks.strengths else headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for i, (name, rank) in enumerate(zip(ranks.algorithms, ranks.ranks, strict=True)):
        cells = [
            f"{100 * rank.score:.1f} %",
            places_text(rank),
            str(rank.n_better),
            str(rank.n_worse),
        ]
        if ranks.strengths:
            strength = ranks.strengths[i]
            cells.append(f"{strength.value + 0.0:.2f} ± {strength.standard_error:.2f}")
        table.add_row(str(rank.rank), Text(name), *cells)
    return table
