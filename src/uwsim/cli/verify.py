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
from ..verify.recorded_plan import NOT_DRAWN, FileOverrides, check_inputs, named_input, plan_of
from .exit_status import RUN_FAILED
from .options.help_texts import FILES, RUN, in_group
from .options.options import CodeOptions, ResultArgument, WorkerOptions
from .output.progress import progress

if TYPE_CHECKING:
    from ..results.result import Result
    from ..runs.planning.plan import Trial
    from ..runs.run import Run
    from ..verify.verify import Verification

SEEDS = 2**32
"""How many samples there are to draw from."""
SHOWN = 20
"""Greatest number of differences printed."""


@dataclass(frozen=True, kw_only=True)
class SampleOptions:
    """Which trials are replayed."""

    sample: Annotated[
        int,
        in_group(
            RUN,
            "--sample",
            metavar="N",
            min=1,
            help="How many trials to replay, chosen by chance.",
        ),
    ] = 3
    whole: Annotated[bool, in_group(RUN, "--all", help="Replay every trial.")] = False
    sample_seed: Annotated[
        int | None,
        in_group(
            RUN,
            "--sample-seed",
            metavar="N",
            min=0,
            help="Replay the same trials as an earlier call, which printed this number.",
        ),
    ] = None

    def choose(
        self, run: Run, stored: Result, typed: Sequence[str]
    ) -> tuple[int, tuple[Trial, ...]]:
        """Print and return which of the finished trials are replayed, and how many there are.

        Args:
            run: the run that made the result.
            stored: the result.
            typed: the command, as it was typed behind ``uwsim``.

        Raises:
            ResultError: none is finished.
        """
        from ..results.interrupted import resume_command
        from ..verify.verify import choose_trials, complete_trials

        whole = complete_trials(run.out, run.plan, stored)
        if not whole:
            command = resume_command(run.out)
            how = f" Resume with: {command}" if command else ""
            raise ResultError(f"{run.out}: no trial of it is finished: nothing to verify.{how}")
        drawn = secrets.randbelow(SEEDS) if self.sample_seed is None else self.sample_seed
        trials = choose_trials(whole, None if self.whole else self.sample, drawn)
        typer.echo(head(stored, run.out, len(whole), len(run.plan.trials())))
        if len(trials) < len(whole):
            which = f"{len(trials)} of {count(len(whole), 'trial')}"
            typer.echo(f"sample: {which}, by chance; the same again: {same_sample(typed, drawn)}")
        return len(whole), trials


@dataclass(frozen=True, kw_only=True)
class PlaceOptions:
    """Where the files of a result are."""

    benchmark: Annotated[
        Path | None,
        in_group(
            FILES,
            "--benchmark",
            metavar="FILE.xml",
            help="The benchmark, where it is not found by its name.",
        ),
    ] = None
    scene: Annotated[
        Path | None,
        in_group(
            FILES,
            "--scene",
            metavar="FILE.xml",
            help="The scene, where it is not found by its name.",
        ),
    ] = None
    code: CodeOptions

    def overrides(self) -> FileOverrides:
        """Return the same for the search."""
        return FileOverrides(
            benchmark=self.benchmark,
            scene=self.scene,
            plugins=tuple(self.code.plugin or ()),
            data_path=self.code.folders,
            no_code=self.code.no_code,
        )


def same_sample(typed: Sequence[str], seed: int) -> str:
    """Return the command that replays the same sample as a command that was typed."""
    words, skip = [], False
    for word in typed:
        if not skip and word.partition("=")[0] != "--sample-seed":
            words.append(word)
        skip = word == "--sample-seed"
    return shlex.join(["uwsim", *words, "--sample-seed", str(seed)])


def verify(
    context: typer.Context,
    result: ResultArgument,
    sample: SampleOptions,
    by: WorkerOptions,
    places: PlaceOptions,
) -> None:
    """Replay a sample of a stored result and compare it with what is stored, byte for byte.

    A trial is the unit of execution: the whole sweep of a seed, or one level where the benchmark is
    independent. Files are found by name (next to the result, here, bundled) and identified by the
    recorded hash; others are refused. Before any replay, the rows, tables and logs of the result
    are made anew from its trials and compared, and every total and every derived value is computed
    again from its row. Plots, the report and provenance.json are not compared.
    The sample of trials is drawn from the system's random source, so it cannot be predicted; the
    seed that draws it again is printed.

    Exit status 0: the same. 3: something differs; the report names trial, level, column and sample
    and, from the fingerprints of each trial, the first step and the body or image that differ.
    2: wrong input, such as a scene that was changed since. RESULT/control can be verified, too.
    """
    from ..results.result_file import file_of, load
    from ..verify.environment import environment_differences
    from ..verify.verify import verify as compare

    executor = by.executor()
    stored, directory = load(result), file_of(result).parent
    run = replayed_run(stored, directory, places.overrides())
    n_whole, trials = sample.choose(run, stored, context.obj)
    n_levels = sum(len(trial.levels) for trial in trials)
    others = environment_differences(stored, directory, run.info)
    for line in others.values():
        typer.echo(clean_text(line))
    raise_on_interrupt()
    with (
        convert_to_run_failed(),
        progress("replaying", n_levels, of="levels", at_once=by.at_once) as on_level,
    ):
        found = compare(directory, stored, run, trials, executor=executor, on_level=on_level)
    for line in tell(found, n_whole, others):
        typer.echo(clean_text(line))
    if found.differences:
        raise typer.Exit(RUN_FAILED)


def replayed_run(stored: Result, directory: Path, overrides: FileOverrides) -> Run:
    """Return the run that a result was made with; its inputs have been checked.

    Raises:
        UwsimError: a file is not there, or not the one with which the result was made.
    """
    from ..runs.prepare import prepare_run

    plan = plan_of(stored, directory, overrides)
    announce_code(plan.scene)
    run = prepare_run(plan, directory)
    check_inputs(stored.inputs, run.inputs)
    renderer = NOT_DRAWN if plan.is_blind else run.renderer
    return replace(run, inputs=stored.inputs, renderer=renderer)


def head(stored: Result, directory: Path, n_whole: int, n_trials: int) -> str:
    """Print what is verified and which files were found."""
    from ..results.per_level import seeds_of

    run = stored.run
    names = [named_input(stored, kind)[0] for kind in ("benchmark", "scene")]
    n_others = len(stored.inputs.assets or {})
    finished = count(n_trials, "trial")
    if n_whole < n_trials:
        finished = f"{n_whole} of {finished} finished"
    seeds = sorted({seed for seed in seeds_of(stored) if seed is not None})
    which = f"seeds {seeds[0]} to {seeds[-1]}" if len(seeds) > 1 else f"seed {run.seed}"
    return clean_text(
        f"{directory}: {run.algorithm}, {which}, {run.mode}, "
        f"{count(len(stored.rows), 'row')}, {finished}\n"
        f"files: the same ({', '.join(names)} and {n_others} more)"
    )


def tell(found: Verification, n_whole: int, others: Mapping[str, str]) -> list[str]:
    """Return the lines of the outcome, the verdict last."""
    from ..verify.environment import likely_cause

    messages = [str(difference) for difference in found.differences[:SHOWN]]
    if len(found.differences) > SHOWN:
        messages.append(f"and {len(found.differences) - SHOWN} more differences")
    messages += [f"not compared: {what}" for what in found.not_compared]
    n = len(found.trials)
    which = f"{n} of {count(n_whole, 'trial')}" if n < n_whole else f"all of {count(n, 'trial')}"
    played = f"{which} replayed, {count(sum(len(trial.levels) for trial in found.trials), 'level')}"
    if not found.differences:
        return [*messages, f"the same, byte for byte: {played}"]
    return [*messages, f"DIFFERS: {played}. {likely_cause(found, others)}"]


def count(number: int, what: str) -> str:
    """``1 trial``, ``2 trials``."""
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
