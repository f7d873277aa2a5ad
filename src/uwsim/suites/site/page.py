"""The page of a leaderboard, rendered from its template.

The page needs no network: it contains its images and style, and links to the replays next to it. A
content security policy forbids scripts and other files, and every text of a submission is escaped.
"""

from __future__ import annotations

import re
from typing import Any

from ...analysis.overview.tasks import overview_rows
from ...analysis.plots import success_overview
from ...analysis.templates import data_url, template
from ...results.result import Result
from ...version import __version__
from ..campaign import cpu_time_text
from .board import Candidate, Leaderboard
from .figures import all_statuses, png
from .rank_section import rank_sections, reference_section
from .task_section import Links, count_text, task_section

LINK = re.compile(r"https?://[^\s<>\"']{1,300}", re.ASCII)
"""The pattern of an address that becomes a link; others are left out."""


def render(board: Leaderboard, links: Links) -> str:
    """Return the HTML of the page.

    Args:
        board: the submissions.
        links: the links to replays.
    """
    names = [candidate.name for candidate in board.candidates]
    n_trials = sum(t.n_trials for c in board.candidates for t in c.submission.tasks.values())
    cpu_s = sum(c.submission.cpu_s for c in board.candidates)
    seeds = board.seeds
    statuses = all_statuses(board.tasks)
    n_verified = sum(candidate.is_verified for candidate in board.candidates)
    n_references = sum(candidate.is_reference for candidate in board.candidates)
    return template("suite.html.j2").render(
        title=board.suite.name,
        lead=board.suite.description,
        cards=[
            _card(
                "submissions",
                str(len(names) - n_references),
                f"{count_text(n_references, 'reference')}, {n_verified} of all verified, "
                f"{len(board.exclusions)} excluded",
            ),
            _card(
                "trials",
                f"{n_trials}",
                f"{seeds.text}, split {seeds.split}",
            ),
            _card(
                "CPU time",
                cpu_time_text(cpu_s),
                "of all trials on the authors' machines, with the "
                "start of each process; without programs outside",
            ),
            _card(
                "uwsim", board.candidates[0].submission.version, "version of the first submission"
            ),
        ],
        n_tasks=count_text(len(board.tasks), "task"),
        is_short=board.is_short,
        rankings=rank_sections(board),
        reference=reference_section(board),
        overview=data_url(png(success_overview(overview_rows(board.tasks), names)), "png"),
        overview_alt="Heat maps of success rates, tasks against difficulty, for "
        + ", ".join(names),
        tasks=[task_section(task, board, links, statuses) for task in board.tasks],
        submissions=[_submission(candidate, i) for i, candidate in enumerate(board.candidates)],
        exclusions=board.exclusions,
        version=__version__,
    )


def _card(label: str, value: str, note: str) -> dict[str, str]:
    return {"label": label, "value": value, "note": note}


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
