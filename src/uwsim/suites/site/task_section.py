"""The section of the page with one task: ranks, success by level, failures with their reasons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...analysis.overview.ranks import compare_algorithms, places_text, success_of
from ...analysis.overview.tasks import OverviewTask
from ...analysis.plots import written_unit
from ...analysis.templates import data_url
from ...results.table import exact_decimals, number_text
from ...statistics import Rate
from .board import Leaderboard
from .figures import draw_endings, draw_times, endings, png
from .standings import rank_candidates
from .trials import frequent_reasons


@dataclass(frozen=True, kw_only=True)
class ReplayLink:
    """A link to the replay of a trial."""

    path: str
    """The path relative to the page."""
    text: str
    """The text of the link: which trial, with its seed and level."""


Links = Mapping[tuple[str, str], Sequence[ReplayLink]]
"""The links by the name of the task and of the submission."""


def count_text(n: int, noun: str) -> str:
    """Return a number with its noun: ``1 task``, ``2 tasks``."""
    return f"{n} {noun}{'s' * (n != 1)}"


def task_section(
    task: OverviewTask, board: Leaderboard, links: Links, statuses: Sequence[str]
) -> dict[str, Any]:
    """Return the content of the section of a task.

    Args:
        task: the task.
        board: the submissions.
        links: the links to replays.
        statuses: the statuses of all tasks of the page, which determine the colours.
    """
    specs = {spec.name: spec for spec in board.suite.tasks}
    counts = endings(task)
    own_statuses = [s for s in statuses if any(n[s] for n in counts.values())]
    heads, rows = _level_rows(task)
    n_trials = sum(n.total() for n in counts.values())
    return {
        "name": task.name,
        "anchor": f"task-{board.tasks.index(task)}",
        "description": specs[task.name].description if task.name in specs else "",
        "summary": f"{count_text(len(task.entries), 'submission')}, "
        f"{count_text(n_trials, 'trial')}.",
        **_rank_table(task, board),
        "level_heads": heads,
        "entries": [
            {"name": entry.name, "algorithm": entry.result.run.algorithm_label}
            for entry in task.entries
        ],
        "rows": rows,
        "figures": _figures(task, statuses),
        "statuses": own_statuses,
        "has_links": any(links.get((task.name, entry.name)) for entry in task.entries),
        "endings": [
            {
                "name": entry.name,
                "algorithm": entry.result.run.algorithm_label,
                "counts": [counts[entry.name][status] for status in own_statuses],
                "links": links.get((task.name, entry.name), ()),
                "reasons": frequent_reasons(entry.result),
            }
            for entry in task.entries
        ],
    }


def _rank_table(task: OverviewTask, board: Leaderboard) -> dict[str, Any]:
    """Return the ranks in one task, and what each submission is shown to be better than."""
    by_name = {candidate.name: candidate for candidate in board.candidates}
    members = [by_name[entry.name] for entry in task.entries]
    standings = rank_candidates(members, [task])
    references = [candidate.name for candidate in members if candidate.is_reference]
    algorithms = {entry.name: entry.result.run.algorithm_label for entry in task.entries}
    rows = []
    for candidate in standings.all_candidates:
        rank = standings.rank_of(candidate)
        opponents = [name for name in references if name != candidate.name]
        comparisons = compare_algorithms([task], candidate.name, opponents)
        verdicts = {
            verdict: ", ".join(n for n, other in comparisons.items() if other.verdict == verdict)
            for verdict in ("better", "worse")
        }
        rows.append(
            {
                "rank": standings.rank_text(candidate),
                "name": candidate.name,
                "algorithm": algorithms[candidate.name],
                "success": f"{100 * success_of([task], candidate.name):.1f}",
                "places": "–" if rank is None else places_text(rank),
                "n_better": "–" if rank is None else str(rank.n_better),
                "n_worse": "–" if rank is None else str(rank.n_worse),
                **verdicts,
            }
        )
    note = "" if standings.ranks is None else standings.ranks.note
    return {
        "ranks": rows,
        "note": note.replace("algorithms", "submissions"),
        "has_references": bool(references),
    }


def _figures(task: OverviewTask, statuses: Sequence[str]) -> list[dict[str, str]]:
    bars = ", ".join(
        f"{name}: " + " ".join(f"{n[status]} {status}" for status in statuses if n[status])
        for name, n in endings(task).items()
    )
    figures = [
        {
            "data": data_url(png(draw_endings(task, statuses)), "png"),
            "alt": f"Stacked bars of how trials ended. {bars}",
            "caption": "How the trials ended, over all levels.",
        }
    ]
    if (times_figure := draw_times(task)) is not None:
        figures.append(
            {
                "data": data_url(png(times_figure), "png"),
                "alt": "Curves of the share of trials that succeeded by each time",
                "caption": "Share of all trials that succeeded by each time (Kaplan and Meier), "
                "over all levels, up to the end of the longest trial.",
            }
        )
    return figures


def _level_rows(task: OverviewTask) -> tuple[list[dict[str, str]], list[dict[str, Any]]]:
    """Return the heads of the levels, and the success rates of all submissions at each level."""
    columns = task.entries[0].result.columns_of_kind("level")
    rates = task.rates()
    levels = sorted({level for values in rates.values() for level in values})
    decimals = [exact_decimals([level[i] for level in levels]) for i in range(len(columns))]
    heads = [
        {"name": column.name, "unit": written_unit(column.unit) if column.unit else ""}
        for column in columns
    ]
    rows = [
        {
            "level": [number_text(v, d) for v, d in zip(level, decimals, strict=True)],
            "cells": [_rate_cell(rates[entry.name].get(level)) for entry in task.entries],
        }
        for level in levels
    ]
    return heads, rows


def _rate_cell(rate: Rate | None) -> dict[str, str]:
    if rate is None:
        return {"rate": "–", "interval": ""}
    return {
        "rate": f"{rate.successes}/{rate.n}",
        "interval": f"{100 * rate.low:.0f} to {100 * rate.high:.0f}",
    }
