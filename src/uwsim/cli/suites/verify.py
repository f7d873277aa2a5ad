"""``uwsim suite verify``: check submissions, and run some of their trials again."""

from __future__ import annotations

import secrets
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...base.exceptions import convert_to_run_failed
from ...base.interrupts import raise_on_interrupt
from ...base.terminal import clean_text
from ...errors import BadSetting, UwsimError
from ..exit_status import RUN_FAILED
from ..options.help_texts import INPUT, RUN, option
from ..options.options import WorkerOptions
from ..output.progress import progress

if TYPE_CHECKING:
    from ...runs.executors.executor import OnLevel
    from ...suites.verification import Verification

Directories = Annotated[
    list[Path], typer.Argument(metavar="DIR", help="Folders of submissions.", show_default=False)
]


def verify_submissions(
    directories: Directories,
    worker_options: WorkerOptions,
    suite: Annotated[
        str | None,
        option(INPUT, "--suite", metavar="SUITE", help="The suite. [the name that DIR states]"),
    ] = None,
    share: Annotated[
        float,
        option(
            RUN,
            "--share",
            metavar="SHARE",
            min=0.0,
            max=1.0,
            help="Share of the trials of each task to run again; at least one is.",
        ),
    ] = 0.01,
    sample: Annotated[
        str | None,
        option(
            RUN,
            "--sample",
            metavar="TEXT",
            help="Draw the same trials as an earlier call, which printed this text. [random]",
        ),
    ] = None,
    date: Annotated[
        str | None,
        option(
            RUN,
            "--date",
            metavar="YYYY-MM-DD",
            help="The date of the split test, as the organiser announced it.",
        ),
    ] = None,
    beacon: Annotated[
        str | None,
        option(RUN, "--beacon", metavar="TEXT", help="The public text of that date."),
    ] = None,
) -> None:
    """Check submissions, and run a share of their trials again.

    The verdict is written to DIR/verification.json. Other bytes in a row exclude a submission from
    ranks. So do false claims about tasks, seeds, levels, track or algorithm. The trials are drawn
    by a hash of the submission and of a random text, so no author can choose them. Code of the
    author in DIR/code is run, in a process of its own: use a machine or a container that may run
    it. An entry with test seeds needs --date and --beacon.

    Exit status 0: all are verified. 3: one differs, or cannot be verified here.
    """
    from ...suites.suite import find_suite, read_suite
    from ...suites.verification import VERIFIED_VERDICT

    if (date is None) != (beacon is None):
        raise BadSetting(f"--date and --beacon: add {'--date' if date is None else '--beacon'}.")
    text = secrets.token_hex(8) if sample is None else sample
    test_seeds = None if date is None or beacon is None else (date, beacon.strip())
    if suite is not None:
        read_suite(find_suite(suite))
    raise_on_interrupt()
    is_same = True
    print(f"sample: {text}; the same trials again: --sample {text}")
    for directory in directories:
        try:
            verification = _verify(directory, suite, text, share, worker_options, test_seeds)
        except (UwsimError, OSError) as error:
            print(clean_text(f"{directory}: not checked: {' '.join(str(error).split())}"))
            is_same = False
            continue
        n = sum(map(len, verification.trials.values()))
        print(clean_text(f"{directory}: {verification.verdict}, {n} trials run again"))
        for reason in verification.reasons:
            print(clean_text(f"  {reason}"))
        is_same &= verification.verdict == VERIFIED_VERDICT
    if not is_same:
        raise typer.Exit(RUN_FAILED)


def _verify(
    directory: Path,
    suite: str | None,
    sample: str,
    share: float,
    worker_options: WorkerOptions,
    test_seeds: tuple[str, str] | None,
) -> Verification:
    """Verify a submission, and write its verdict."""
    from ...suites.entry_files import entry_files
    from ...suites.submission import load_submission
    from ...suites.suite import find_suite, read_suite
    from ...suites.verification import save_verification, verify_submission

    entry_files(directory)  # refuses links, pipes and devices before any is opened
    source = read_suite(find_suite(suite or load_submission(directory).suite).absolute())
    with convert_to_run_failed(), ExitStack() as stack:

        def open_progress(title: str, total: int) -> OnLevel:
            display = progress(title, total, unit="levels", n_parallel=worker_options.n_parallel)
            on_level: OnLevel = stack.enter_context(display)
            return on_level

        verification = verify_submission(
            directory,
            source,
            sample,
            test_seeds=test_seeds,
            share=share,
            executor=worker_options.executor(),
            open_progress=open_progress,
        )
    save_verification(verification, directory)
    return verification
