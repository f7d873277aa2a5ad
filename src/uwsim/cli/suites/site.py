"""``uwsim suite site``: the page of a leaderboard from a folder of submissions."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import Annotated

import typer

from ...base.terminal import clean_text, warn
from ..options.help_texts import INPUT, OUTPUT, option
from ..options.options import OutputOption, OverwriteOption
from ..output.progress import progress
from .seed_options import DrawnSeedOptions

Submissions = Annotated[
    Path, typer.Argument(metavar="DIR", help="The folder with a subfolder for each submission.")
]
FILM_SIZE = (480, 360)
"""The width and height of films [px]."""
FILM_RATE = 5.0
"""The number of images of a film per second [Hz]."""
FILM_SPEED = 4.0
"""The playback speed of films: simulation time per time of the film [1]."""


def write_leaderboard(
    directory: Submissions,
    out: OutputOption,
    seeds: DrawnSeedOptions,
    suite: Annotated[
        str,
        option(
            INPUT,
            "--suite",
            metavar="SUITE",
            help="The suite: its tasks, tracks and seeds are the conditions of the page.",
        ),
    ] = "intervention",
    replays: Annotated[
        str,
        option(
            OUTPUT,
            "--replays",
            metavar="none|best|all|NAME",
            help="Submissions whose median and worst trial are shown in each task: none, the best "
            "of each task, all, or the one of a name. A replay takes about 10 s and 1 to 4 MB.",
        ),
    ] = "best",
    films: Annotated[
        bool, option(OUTPUT, "--films", help="Films (WebP) in place of replays; takes longer.")
    ] = False,
    overwrite: OverwriteOption = False,
) -> None:
    """Write the page of a leaderboard from a folder of submissions.

    It has ranks with ties and intervals, over all tasks and in each, and a heat map of tasks and
    difficulty. Each task has success rates, failures with reasons, times to success and replays.
    Each submission has a card; excluded ones have the reason. Only those that `uwsim suite verify`
    has verified have a rank. The seeds are all of the suite's first split, unless options choose
    others. The page opens from disk, and can be published as it is.
    The same submissions give the same bytes.
    """
    from ...results.directory import clear_directory
    from ...suites.site.collect import Conditions, collect_submissions
    from ...suites.site.trials import notable_trials
    from ...suites.site.write import REPLAYS_FOLDER, SITE_FILES, choose_replays, write_site
    from ...suites.suite import find_suite, read_suite

    source = read_suite(find_suite(suite))
    conditions = Conditions(
        suite=source, seeds=seeds.read(source), is_short=seeds.public_seeds.is_short
    )
    board = collect_submissions(directory, conditions)
    pairs = choose_replays(board, replays)
    trials = [notable_trials(board.candidates[j].results[board.tasks[i].name]) for i, j in pairs]
    clear_directory(out, overwrite=overwrite, pattern=SITE_FILES, folders=(REPLAYS_FOLDER,))
    with progress("replays", sum(map(len, trials)), unit="files") as on_replay:
        page = write_site(
            board,
            out,
            selection=replays,
            save_trial=save_film if films else save_replay,
            suffix=".webp" if films else ".html",
            on_replay=on_replay,
        )
    if board.suite is None:
        name = board.candidates[0].submission.suite
        warn(f"no bundled suite is called {name!r}: add --suite FILE for descriptions of tasks.")
    for entry in board.exclusions:
        print(clean_text(f"excluded: {entry.name}: {' '.join(entry.reasons)}"))
    n = len(board.candidates)
    n_others = sum(not candidate.is_verified for candidate in board.candidates)
    addition = f", {n_others} not verified and without rank" if n_others else ""
    print(f"{n} submission{'s' * (n != 1)} compared{addition}; written: {page}")


def save_replay(directory: Path, trial: int, path: Path) -> None:
    """Write the page of a trial."""
    from ...viewer.replay import Replay

    Replay(directory, (trial,)).save(path)


def save_film(directory: Path, trial: int, path: Path) -> None:
    """Write a small film of a trial at four times its speed."""
    from ...verify.recorded_plan import FileOverrides
    from ...viewer.film.film import FilmSpec, TrialSequenceFilm
    from ...viewer.film.film import save_film as write_film
    from ...viewer.recorded import RecordedTrial

    recorded_trial = RecordedTrial.open(directory, trial, FileOverrides())
    with closing(
        TrialSequenceFilm(
            [recorded_trial], FilmSpec(size=FILM_SIZE, rate=FILM_RATE, speed=FILM_SPEED)
        )
    ) as film:
        write_film(film, path)
