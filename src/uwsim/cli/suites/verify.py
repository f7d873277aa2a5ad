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
from ..exit_status import RUN_FAILED
from ..options.help_texts import INPUT, RUN, option
from ..options.options import WorkerOptions
from ..output.progress import progress

if TYPE_CHECKING:
    from ...runs.executors.executor import OnLevel

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
) -> None:
    """Check submissions, and run a share of their trials again.

    The verdict is written to DIR/verification.json. Other bytes in a row exclude a submission from
    ranks. So do false claims about tasks, seeds, levels, track or algorithm. The trials are drawn
    by a hash of the submission and of a random text, so no author can choose them. Code of the
    author in DIR/code is run: use a machine or a container that may run it.

    Exit status 0: all are verified. 3: one differs, or cannot be verified here.
    """
    from ...suites.submission import load_submission
    from ...suites.suite import find_suite, read_suite
    from ...suites.verification import VERIFIED_VERDICT, save_verification, verify_submission

    text = secrets.token_hex(8) if sample is None else sample
    executor = worker_options.executor()
    suites = [
        read_suite(find_suite(suite or load_submission(directory).suite).absolute())
        for directory in directories
    ]
    raise_on_interrupt()
    is_same = True
    print(f"sample: {text}; the same trials again: --sample {text}")
    for directory, source in zip(directories, suites, strict=True):
        with convert_to_run_failed(), ExitStack() as stack:

            def open_progress(title: str, total: int, stack: ExitStack = stack) -> OnLevel:
                display = progress(
                    title, total, unit="levels", n_parallel=worker_options.n_parallel
                )
                on_level: OnLevel = stack.enter_context(display)
                return on_level

            verification = verify_submission(
                directory,
                source,
                text,
                share=share,
                executor=executor,
                open_progress=open_progress,
            )
        save_verification(verification, directory)
        n = sum(map(len, verification.trials.values()))
        print(clean_text(f"{directory}: {verification.verdict}, {n} trials run again"))
        for reason in verification.reasons:
            print(clean_text(f"  {reason}"))
        is_same &= verification.verdict == VERIFIED_VERDICT
    if not is_same:
        raise typer.Exit(RUN_FAILED)
