"""The page of a leaderboard, rendered from its template.

The page needs no network: it contains its images and style, and links to the replays next to it. A
content security policy forbids scripts and other files, and every text of a submission is escaped.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...analysis.overview.ranks import TaskRanks, rank_algorithms
from ...analysis.overview.tasks import OverviewTask, overview_rows
from ...analysis.plots import success_overview, written_unit
from ...analysis.templates import data_url, template
from ...results.result import Result
from ...results.table import exact_decimals, number_text
from ...statistics import Rate
from ...version import __version__
from ..campaign import cpu_time_text
from ..suite import TrackSpec
from .collect import Candidate, Leaderboard
from .figures import draw_endings, draw_times, endings, png, statuses_of

LINK = re.compile(r"https?://[^\s<>\"']{1,300}", re.ASCII)
"""The pattern of an address that becomes a link; others are left out."""


@dataclass(frozen=True, kw_only=True)
class ReplayLink:
    """A link to the replay of a trial."""

    path: str
    """The path relative to the page."""
    text: str
    """The text of the link: which trial, with its seed and level."""


Links = Mapping[tuple[str, str], Sequence[ReplayLink]]
"""The links by the name of the task and of the submission."""


def render(board: Leaderboard, links: Links) -> str:
    """Return the HTML of the page.

    Args:
        board: the submissions.
        links: the links to replays.
    """
    names = [candidate.name for candidate in board.candidates]
    n_trials = sum(t.n_trials for c in board.candidates for t in c.submission.tasks.values())
    cpu_s = sum(c.submission.cpu_s for c in board.candidates)
    first_submission = board.candidates[0].submission
    seeds = first_submission.seeds
    return template("suite.html.j2").render(
        title=first_submission.suite,
        lead="" if board.suite is None else board.suite.description,
        cards=[
            _card("submissions", str(len(names)), f"{len(board.exclusions)} excluded"),
            _card(
                "trials",
                f"{n_trials}",
                f"{seeds.text}, split {seeds.split}",
            ),
            _card("CPU time", cpu_time_text(cpu_s), "of all trials, on the authors' machines"),
            _card("uwsim", first_submission.version, "version of the first submission"),
        ],
        rankings=_rankings(board),
        overview=data_url(png(success_overview(overview_rows(board.tasks), names)), "png"),
        overview_alt="Heat maps of success rates, tasks against difficulty, for "
        + ", ".join(names),
        tasks=[_task(task, board, links) for task in board.tasks],
        submissions=[_submission(candidate, i) for i, candidate in enumerate(board.candidates)],
        exclusions=board.exclusions,
        version=__version__,
    )


def _card(label: str, value: str, note: str) -> dict[str, str]:
    return {"label": label, "value": value, "note": note}


def _rankings(board: Leaderboard) -> list[dict[str, Any]]:
    """Return the ranks over all tracks, and of each narrower track with several submissions."""
    rankings = [
        {
            "title": "Ranks",
            "caption": "All submissions, whatever their sensors.",
            "rows": _rank_rows(board, board.candidates),
        }
    ]
    tracks = () if board.suite is None else board.suite.tracks
    for track in tracks:
        members = [c for c in board.candidates if _is_within(c.submission.track, track, tracks)]
        if 1 < len(members) < len(board.candidates):
            rankings.append(
                {
                    "title": f"Ranks in track {track.name}",
                    "caption": f"Sensors: {track.description}; and submissions with fewer.",
                    "rows": _rank_rows(board, members),
                }
            )
    return rankings


def _is_within(name: str, track: TrackSpec, tracks: Sequence[TrackSpec]) -> bool:
    """Return whether the track of a name permits no more sources than another track."""
    own_track = next((entry for entry in tracks if entry.name == name), None)
    if own_track is None:
        return False
    if not track.sources:
        return True
    return bool(own_track.sources) and set(own_track.sources) <= set(track.sources)


def _rank_rows(board: Leaderboard, members: Sequence[Candidate]) -> list[dict[str, Any]]:
    by_name = {candidate.name: candidate for candidate in members}
    tasks = [
        OverviewTask(name=task.name, entries=tuple(e for e in task.entries if e.name in by_name))
        for task in board.tasks
    ]
    ranks = rank_algorithms([t for t in tasks if t.entries], absent_tasks_fail=True)
    rows = []
    for i, name in enumerate(by_name if ranks is None else ranks.algorithms):
        submission = by_name[name].submission
        rows.append(
            {
                "name": name,
                "anchor": f"submission-{board.candidates.index(by_name[name])}",
                "kind": f"{submission.kind}, human" if submission.is_human else submission.kind,
                "track": submission.track,
                "n_tasks": f"{len(submission.tasks)} of {len(board.tasks)}",
                "cpu": cpu_time_text(submission.cpu_s),
                "verdict": by_name[name].verdict,
                **_rank_cells(ranks, i),
            }
        )
    return rows


def _rank_cells(ranks: TaskRanks | None, i: int) -> dict[str, str]:
    if ranks is None:
        return dict.fromkeys(("rank", "success", "places", "n_better", "n_worse"), "")
    rank = ranks.ranks[i]
    return {
        "rank": str(rank.rank),
        "success": f"{100 * rank.score:.1f}",
        "places": str(rank.low) if rank.low == rank.high else f"{rank.low} to {rank.high}",
        "n_better": str(rank.n_better),
        "n_worse": str(rank.n_worse),
    }


def _task(task: OverviewTask, board: Leaderboard, links: Links) -> dict[str, Any]:
    specs = {} if board.suite is None else {spec.name: spec for spec in board.suite.tasks}
    statuses, counts = statuses_of(task), endings(task)
    heads, rows = _level_rows(task)
    bars = ", ".join(
        f"{name}: " + " ".join(f"{n[status]} {status}" for status in statuses if n[status])
        for name, n in counts.items()
    )
    figures = [
        {
            "data": data_url(png(draw_endings(task)), "png"),
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
                "over all levels.",
            }
        )
    n_trials = sum(n.total() for n in counts.values())
    return {
        "name": task.name,
        "anchor": f"task-{board.tasks.index(task)}",
        "description": specs[task.name].description if task.name in specs else "",
        "summary": f"{len(task.entries)} submissions, {n_trials} trials.",
        "level_heads": heads,
        "entries": [
            {"name": entry.name, "algorithm": entry.result.run.algorithm_label}
            for entry in task.entries
        ],
        "rows": rows,
        "figures": figures,
        "statuses": statuses,
        "endings": [
            {
                "name": entry.name,
                "algorithm": entry.result.run.algorithm_label,
                "counts": [counts[entry.name][status] for status in statuses],
                "links": links.get((task.name, entry.name), ()),
            }
            for entry in task.entries
        ],
    }


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


def _submission(candidate: Candidate, i: int) -> dict[str, Any]:
    submission = candidate.submission
    compute = submission.compute
    environment = _environment(next(iter(candidate.results.values())))
    seeds = submission.seeds
    facts = [
        ("author", submission.card.author),
        ("kind", submission.kind + (", piloted by a human" if submission.is_human else "")),
        ("track", submission.track),
        ("seeds", f"{seeds.split}, {seeds.text}"),
        *((("date and text", f"{seeds.date}, {seeds.beacon}"),) if seeds.date else ()),
        ("parameters", " ".join(submission.settings)),
        (
            "compute",
            f"{compute.get('class', '')}: {compute.get('cpu', '')}, "
            f"{compute.get('cores', '')} cores, GPU {compute.get('gpu', '')}",
        ),
        ("CPU time", cpu_time_text(submission.cpu_s)),
        ("versions", environment),
        ("rows run again", candidate.verdict),
        ("suite file", submission.suite_hash),
        ("submission", submission.sha256),
    ]
    link = submission.card.link
    return {
        "name": candidate.name,
        "anchor": f"submission-{i}",
        "description": submission.card.description,
        "facts": [(name, value) for name, value in facts if value],
        "link": link if LINK.fullmatch(link) else "",
        "results": [(name, task.algorithm, task.result) for name, task in submission.tasks.items()],
    }


def _environment(result: Result) -> str:
    """Return the versions of a result in words."""
    run = result.run
    return f"uwsim {run.version}, {run.physics}, numpy {run.numpy}; {run.renderer}"
