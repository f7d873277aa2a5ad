"""The sections of the page with ranks, and with comparisons with the references."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...analysis.overview.ranks import CommonTasks, compare_algorithms, places_text, success_of
from ..campaign import cpu_time_text
from ..suite_spec import TrackSpec
from .board import Candidate, Leaderboard
from .standings import Standings, rank_candidates


def rank_sections(board: Leaderboard) -> list[dict[str, Any]]:
    """Return the ranks over all tracks, and of each narrower track with several submissions."""
    sections = [_section(board, board.candidates, "Ranks", "All submissions of all tracks.")]
    tracks = board.suite.tracks
    for track in tracks:
        members = [c for c in board.candidates if _is_within(c.submission.track, track, tracks)]
        if 1 < len(members) < len(board.candidates):
            caption = f"Sensors: {track.description}; and submissions with fewer."
            sections.append(_section(board, members, f"Ranks in track {track.name}", caption))
    return sections


def reference_section(board: Leaderboard) -> dict[str, Any] | None:
    """Return the comparisons of all submissions with the references; None without references."""
    references = [candidate.name for candidate in board.candidates if candidate.is_reference]
    if not references or len(board.candidates) < 2:
        return None
    rows = []
    for candidate in board.candidates:
        opponents = [name for name in references if name != candidate.name]
        comparisons = compare_algorithms(board.tasks, candidate.name, opponents)
        cells = [_comparison_cell(comparisons.get(name)) for name in references]
        rows.append({"name": candidate.name, "cells": cells})
    return {"heads": references, "rows": rows}


def _comparison_cell(comparison: CommonTasks | None) -> dict[str, str]:
    if comparison is None:
        return {"verdict": "–", "note": ""}
    n = comparison.n_tasks
    return {
        "verdict": comparison.verdict,
        "note": f"{100 * comparison.first:.0f} to {100 * comparison.second:.0f} %, "
        f"{n} task{'s' * (n != 1)}",
    }


def _section(
    board: Leaderboard, members: Sequence[Candidate], title: str, caption: str
) -> dict[str, Any]:
    standings = rank_candidates(members, board.tasks)
    groups = [
        ("", standings.ranked_candidates),
        ("without all tasks, not ranked: success is over the tasks that were run",
         standings.partial_candidates),
        ("references of the suite, not ranked: success is over the tasks that each has",
         standings.references),
        ("not verified, or changed since: not ranked; the numbers are those of the authors",
         standings.unverified_candidates),
    ]  # fmt: skip
    note = "" if standings.ranks is None else standings.ranks.note
    return {
        "title": title,
        "caption": caption,
        "note": note.replace("algorithms", "submissions"),
        "groups": [
            {"head": head, "rows": [_row(board, standings, candidate) for candidate in group]}
            for head, group in groups
            if group
        ],
    }


def _row(board: Leaderboard, standings: Standings, candidate: Candidate) -> dict[str, Any]:
    submission, rank = candidate.submission, standings.rank_of(candidate)
    score = success_of(board.tasks, candidate.name) if rank is None else rank.score
    return {
        "name": candidate.name,
        "anchor": f"submission-{board.candidates.index(candidate)}",
        "kind": f"{submission.kind}, human" if submission.is_human else submission.kind,
        "track": submission.track,
        "n_tasks": f"{len(submission.tasks)} of {len(board.tasks)}",
        "cpu": cpu_time_text(submission.cpu_s),
        "verdict": candidate.verdict,
        "rank": standings.rank_text(candidate),
        "success": f"{100 * score:.1f}",
        "places": "–" if rank is None else places_text(rank),
        "n_better": "–" if rank is None else str(rank.n_better),
        "n_worse": "–" if rank is None else str(rank.n_worse),
    }


def _is_within(name: str, track: TrackSpec, tracks: Sequence[TrackSpec]) -> bool:
    """Return whether the track of a name permits no more sources than another track."""
    own_track = next((entry for entry in tracks if entry.name == name), None)
    if own_track is None:
        return False
    if not track.sources:
        return True
    return bool(own_track.sources) and set(own_track.sources) <= set(track.sources)
