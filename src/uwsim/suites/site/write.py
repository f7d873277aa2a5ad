"""The files of a page: ``index.html``, and the replays of notable trials in ``replays/``."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from ...base.terminal import warn
from ...errors import UnknownName, UwsimError
from ...results.atomic_file import write_text
from .board import Candidate, Leaderboard
from .page import render
from .task_section import Links, ReplayLink
from .trials import describe_row, notable_trials

PAGE = "index.html"
REPLAYS_FOLDER = "replays"
SITE_FILES = re.compile(r"index\.html|replays/\d+-\d+-(median|worst)\.(html|webp)")
"""The paths of the files that uwsim writes into the folder of a page."""
SELECTIONS = ("none", "best", "all")
"""The words that select replays; others are names of submissions."""
SaveTrial = Callable[[Path, int, Path], object]
"""A function that writes the replay of a trial: result directory, number of the trial, path."""


def choose_replays(board: Leaderboard, selection: str) -> list[tuple[int, int]]:
    """Return the submissions whose trials are shown: indices of tasks and of submissions.

    Args:
        board: the submissions.
        selection: ``none``, ``best`` for the verified one with most successes in each task,
            ``all``, or the name of a submission.

    Raises:
        UnknownName: there is no submission of that name.
    """
    names = [candidate.name for candidate in board.candidates]
    if selection not in (*SELECTIONS, *names):
        raise UnknownName("submission", selection, [*SELECTIONS, *names])
    pairs = []
    for i, task in enumerate(board.tasks):
        members = [names.index(entry.name) for entry in task.entries]
        n_ok = {j: board.candidates[j].submission.tasks[task.name].n_ok for j in members}
        best_index = min(members, key=lambda j: (not board.candidates[j].is_verified, -n_ok[j], j))
        pairs += [
            (i, j)
            for j in members
            if selection in ("all", names[j]) or (selection, j) == ("best", best_index)
        ]
    return pairs


def write_site(
    board: Leaderboard,
    out: Path,
    *,
    selection: str,
    save_trial: SaveTrial,
    suffix: str = ".html",
    on_replay: Callable[[], object] = lambda: None,
) -> Path:
    """Write the page and the replays; return the path of the page.

    Args:
        board: the submissions.
        out: the folder.
        selection: the submissions whose median and worst trials are shown (`choose_replays`).
        save_trial: the function that writes a replay.
        suffix: ``.html`` for pages, ``.webp`` for films.
        on_replay: the function that is called after each replay.
    """
    links: dict[tuple[str, str], list[ReplayLink]] = {}
    for i, j in choose_replays(board, selection):
        task, candidate = board.tasks[i].name, board.candidates[j]
        links[task, candidate.name] = []
        for word, row in notable_trials(candidate.results[task]).items():
            path = f"{REPLAYS_FOLDER}/{i}-{j}-{word}{suffix}"
            if _save(candidate, task, row, out / path, save_trial):
                text = f"{word} ({describe_row(candidate.results[task], row)})"
                links[task, candidate.name].append(ReplayLink(path=path, text=text))
            on_replay()
    return write_page(board, out, links)


def write_page(board: Leaderboard, out: Path, links: Links) -> Path:
    """Write ``index.html``; return its path."""
    out.mkdir(parents=True, exist_ok=True)
    write_text(out / PAGE, render(board, links))
    return out / PAGE


def _save(candidate: Candidate, task: str, row: int, path: Path, save_trial: SaveTrial) -> bool:
    """Write the replay of a row; return False, with a warning, if it has none."""
    result = candidate.results[task]
    n_rows, n_trials = len(result.rows), (result.run.trial_counts or (0, len(result.rows)))[1]
    directory = candidate.directory / task
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        save_trial(directory, row * n_trials // n_rows, path)
    except UwsimError as error:
        warn(f"{directory}: no replay of row {row}: {error}")
        return False
    return True
