"""``uwsim verify``: replay a stored result and compare it byte for byte."""

from __future__ import annotations

import secrets
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.exceptions import convert_to_run_failed
from ..base.interrupts import raise_on_interrupt
from ..base.terminal import clean_text
from ..errors import ResultError
from ..runs.foreign_code import announce_code
from ..verify.recorded_plan import (
    NOT_RENDERED,
    FileOverrides,
    check_inputs,
    plan_of,
    recorded_input,
)
from .exit_status import RUN_FAILED
from .options.help_texts import RUN, option
from .options.options import ResultArgument, WorkerOptions
from .options.recorded_files import FileOptions
from .output.progress import progress

if TYPE_CHECKING:
    from ..results.result import Result
    from ..runs.planning.plan import Trial
    from ..runs.run import Run
    from ..verify.verify import Verification

N_SEEDS = 2**32
"""The number of seeds from which the seed of the sample is drawn."""
MAX_SHOWN = 20
"""The greatest number of printed differences."""


@dataclass(frozen=True, kw_only=True)
class SampleOptions:
    """The options that choose the trials to replay."""

    sample: Annotated[
        int,
        option(
            RUN, "--sample", metavar="N", min=1, help="Number of trials to replay, drawn at random."
        ),
    ] = 3
    all_trials: Annotated[bool, option(RUN, "--all", help="Replay every trial.")] = False
    sample_seed: Annotated[
        int | None,
        option(
            RUN,
            "--sample-seed",
            metavar="N",
            min=0,
            help="Replay the same trials as an earlier call, which printed this number.",
        ),
    ] = None

    def choose(
        self, run: Run, stored_result: Result, words: Sequence[str]
    ) -> tuple[int, tuple[Trial, ...]]:
        """Choose trials to replay, and print which; return how many are finished, and the chosen.

        Args:
            run: the run of the result.
            stored_result: the result.
            words: the words of the command line after ``uwsim``.

        Raises:
            ResultError: no trial is finished.
        """
        from ..results.interrupted import resume_command
        from ..verify.verify import choose_trials, complete_trials

        finished_trials = complete_trials(run.out, run.plan, stored_result)
        if not finished_trials:
            command = resume_command(run.out)
            hint = f" Resume with: {command}" if command else ""
            raise ResultError(f"{run.out}: no trial of it is finished: nothing to verify.{hint}")
        seed = secrets.randbelow(N_SEEDS) if self.sample_seed is None else self.sample_seed
        trials = choose_trials(finished_trials, None if self.all_trials else self.sample, seed)
        typer.echo(
            describe_result(stored_result, run.out, len(finished_trials), len(run.plan.trials()))
        )
        if len(trials) < len(finished_trials):
            sample_text = f"{len(trials)} of {format_count(len(finished_trials), 'trial')}"
            command = same_sample_command(words, seed)
            typer.echo(f"sample: {sample_text}, at random; the same again: {command}")
        return len(finished_trials), trials


def same_sample_command(command_line: Sequence[str], seed: int) -> str:
    """Return the command that replays the same sample as the given command line."""
    words, skip = [], False
    for word in command_line:
        if not skip and word.partition("=")[0] != "--sample-seed":
            words.append(word)
        skip = word == "--sample-seed"
    return shlex.join(["uwsim", *words, "--sample-seed", str(seed)])


def verify(
    context: typer.Context,
    result: ResultArgument,
    sample: SampleOptions,
    worker_options: WorkerOptions,
    file_options: FileOptions,
) -> None:
    """Replay a sample of a stored result and compare it with the stored files, byte for byte.

    A trial is the unit of execution: the whole sweep of a seed, or one level if the benchmark is
    independent. Files are found by name (next to the result, here, bundled) and identified by the
    recorded hash; another hash is an error. Before any replay, the rows, tables and logs of the
    result are computed again from its trials and compared. Every total and every derived value is
    computed again from its row. Plots, the report and provenance.json are not compared.
    The sample of trials is drawn from the system's random source, so it cannot be predicted; the
    seed that draws it again is printed.

    Exit status 0: the same. 3: there are differences. The report names trial, level, column and
    sample; from the fingerprints of each trial it names the first step and the body or image. 2:
    invalid input, such as a scene that was changed since. RESULT/control can be verified, too.
    """
    from ..results.result_file import file_of, load
    from ..verify.environment import environment_differences
    from ..verify.verify import verify as compare

    executor = worker_options.executor()
    stored_result, directory = load(result), file_of(result).parent
    run = prepare_replay(stored_result, directory, file_options.overrides())
    n_finished, trials = sample.choose(run, stored_result, context.obj)
    n_levels = sum(len(trial.levels) for trial in trials)
    differences = environment_differences(stored_result, directory, run.info)
    for line in differences.values():
        typer.echo(clean_text(line))
    raise_on_interrupt()
    with (
        convert_to_run_failed(),
        progress(
            "replaying", n_levels, unit="levels", n_parallel=worker_options.n_parallel
        ) as on_level,
    ):
        verification = compare(
            directory, stored_result, run, trials, executor=executor, on_level=on_level
        )
    for line in describe_outcome(verification, n_finished, differences):
        typer.echo(clean_text(line))
    if verification.differences:
        raise typer.Exit(RUN_FAILED)


def prepare_replay(stored_result: Result, directory: Path, overrides: FileOverrides) -> Run:
    """Return the run of a result, after a check of its inputs.

    Raises:
        UwsimError: a file does not exist, or its hash differs from the recorded one.
    """
    from ..runs.prepare import prepare_run

    plan = plan_of(stored_result, directory, overrides)
    announce_code(plan.scene)
    run = prepare_run(plan, directory)
    check_inputs(stored_result.inputs, run.inputs)
    renderer = NOT_RENDERED if plan.is_blind else run.renderer
    return replace(run, inputs=stored_result.inputs, renderer=renderer)


def describe_result(stored_result: Result, directory: Path, n_finished: int, n_trials: int) -> str:
    """Return a description of the result and of the files found."""
    from ..results.per_level import seeds_of

    run = stored_result.run
    names = [recorded_input(stored_result, kind)[0] for kind in ("benchmark", "scene")]
    n_others = len(stored_result.inputs.assets or {})
    trials_text = format_count(n_trials, "trial")
    if n_finished < n_trials:
        trials_text = f"{n_finished} of {trials_text} finished"
    seeds = sorted({seed for seed in seeds_of(stored_result) if seed is not None})
    seeds_text = f"seeds {seeds[0]} to {seeds[-1]}" if len(seeds) > 1 else f"seed {run.seed}"
    return clean_text(
        f"{directory}: {run.algorithm}, {seeds_text}, {run.mode}, "
        f"{format_count(len(stored_result.rows), 'row')}, {trials_text}\n"
        f"files: the same ({', '.join(names)} and {n_others} more)"
    )


def describe_outcome(
    verification: Verification, n_finished: int, environment_lines: Mapping[str, str]
) -> list[str]:
    """Return the lines that describe the outcome; the last one states if the results are equal."""
    from ..verify.environment import likely_cause

    messages = [str(difference) for difference in verification.differences[:MAX_SHOWN]]
    if len(verification.differences) > MAX_SHOWN:
        messages.append(f"and {len(verification.differences) - MAX_SHOWN} more differences")
    messages += [f"not compared: {subject}" for subject in verification.not_compared]
    n = len(verification.trials)
    n_levels = sum(len(trial.levels) for trial in verification.trials)
    sample_text = f"{n} of" if n < n_finished else "all of"
    trials_text = f"{sample_text} {format_count(n_finished if n < n_finished else n, 'trial')}"
    replay_text = f"{trials_text} replayed, {format_count(n_levels, 'level')}"
    if not verification.differences:
        return [*messages, f"the same, byte for byte: {replay_text}"]
    return [*messages, f"DIFFERS: {replay_text}. {likely_cause(verification, environment_lines)}"]


def format_count(number: int, noun: str) -> str:
    """Return a number with its noun: ``1 trial``, ``2 trials``."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
