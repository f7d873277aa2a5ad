"""``uwsim verify``: is a stored result what its recorded inputs give, byte for byte?"""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ResultError
from ..files.input_files import recorded
from ..interrupts import raise_from_now_on
from ..runs.foreign_code import announce_code
from ..terminal import printable
from ..verify.recorded_plan import NOT_DRAWN, FileOverrides, check_inputs, named_input, plan_of
from .executor import CALLBACK_LIMIT, CallbackLimitOption, WorkersOption, executor_of, n_at_once
from .faults import RUN_FAILED, running
from .options import DataPathOption, NoCodeOption, PluginOption, ResultArgument
from .progress import progress
from .taught import FILES, RUN, in_group

if TYPE_CHECKING:
    from ..results.result import Result
    from ..verify.verify import Verification

SEEDS = 2**32
"""How many samples there are to draw from."""
SHOWN = 20
"""So many differences are said in full."""
MEANS = {
    "version": "uwsim",
    "physics": "physics",
    "renderer": "renderer",
    "numpy": "numpy",
    "cpu": "processor",
    "code": "code for the processor",
    "system": "system",
    "python": "Python",
}
"""What a result was made with, in words."""
PROMISES = {
    "version": "between versions of uwsim nothing is promised",
    "physics": "between versions of MuJoCo nothing is promised",
    "renderer": "another renderer draws single grey levels otherwise: promised is the motion of "
    "whatever no image steers, not images nor what is found in them",
    "numpy": "between versions of numpy random numbers and sums may differ",
    "cpu": "another processor may round otherwise: its kernels are compiled for it",
    "code": "what is bundled gives the same bytes all the same; an algorithm or a measure of one's "
    "own may not",
    "system": "another system has other libraries of mathematics",
    "python": "between versions of Python nothing is expected to differ",
}
"""What holds where that differs."""


def verify(
    result: ResultArgument,
    sample: Annotated[
        int,
        in_group(
            RUN,
            "--sample",
            metavar="N",
            min=1,
            help="How many trials to replay, chosen by chance.",
        ),
    ] = 3,
    whole: Annotated[bool, in_group(RUN, "--all", help="Replay every unit.")] = False,
    sample_seed: Annotated[
        int | None,
        in_group(
            RUN,
            "--sample-seed",
            metavar="N",
            min=0,
            help="Choose the units that an earlier call has chosen, which said this number.",
        ),
    ] = None,
    workers: WorkersOption = "1",
    callback_limit: CallbackLimitOption = CALLBACK_LIMIT,
    benchmark: Annotated[
        Path | None,
        in_group(
            FILES,
            "--benchmark",
            metavar="FILE.xml",
            help="The benchmark, where it is not found by its name.",
        ),
    ] = None,
    scene: Annotated[
        Path | None,
        in_group(
            FILES,
            "--scene",
            metavar="FILE.xml",
            help="The scene, where it is not found by its name.",
        ),
    ] = None,
    plugin: PluginOption = None,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Replay a sample of a stored result and compare it with what is stored, byte for byte.

    A trial is what is played in one go: a seed's whole sweep, or one level of it where the
    benchmark is independent. Files are found by name (beside the result, here, bundled) and known
    by the hash that was recorded; others are refused. Before any replay, every file of the result
    is made anew from its trials and compared, every total is worked out from its row, and every
    value held against the detail that it is. Nobody can know beforehand which trials are replayed:
    the sample is drawn from the system's own chance, and the number that draws it again is said.

    Exit status 0: the same. 3: something differs; says which trial, level, column and sample, and
    from the fingerprints that every trial keeps, from which step on and in which body or image.
    2: wrong input, such as a scene that was changed since. RESULT/control can be verified, too.
    """
    from ..results.interrupted import resuming
    from ..results.result_file import file_of, load
    from ..runs.input_watch import watchable
    from ..runs.run import Run, hash_inputs
    from ..verify.verify import choose, finished
    from ..verify.verify import verify as compare

    executor = executor_of(workers, callback_limit)
    stored = load(result)
    directory = file_of(result).parent
    given = FileOverrides(
        benchmark=benchmark,
        scene=scene,
        plugins=tuple(plugin or ()),
        data_path=tuple(data_path or ()),
        no_code=no_code,
    )
    plan = plan_of(stored, directory, given)
    announce_code(plan.scene)
    with recorded() as files:
        inputs, renderer = hash_inputs(plan)
    check_inputs(stored.inputs, inputs)
    renderer = NOT_DRAWN if plan.is_blind else renderer
    run = Run(
        plan=plan,
        out=directory,
        inputs=stored.inputs,
        renderer=renderer,
        files=watchable(files),
    )
    whole_units = finished(directory, plan, stored)
    if not whole_units:
        command = resuming(directory)
        how = f" Go on with: {command}" if command else ""
        raise ResultError(f"{directory}: no unit of it is finished: nothing to verify.{how}")
    drawn = secrets.randbelow(SEEDS) if sample_seed is None else sample_seed
    units = choose(whole_units, None if whole else sample, drawn)
    n_levels = sum(len(trial.levels) for trial in units)
    typer.echo(head(stored, directory, len(whole_units), len(plan.units())))
    if len(units) < len(whole_units):
        which = f"{len(units)} of {count(len(whole_units), 'unit')}"
        typer.echo(f"sample: {which}, by chance; the same again with --sample-seed {drawn}")
    others = made_otherwise(stored, directory, run.head(units[0])["run"])
    for line in others.values():
        typer.echo(printable(line))
    raise_from_now_on()
    at_once = n_at_once(workers)
    with running(), progress("replaying", n_levels, of="levels", at_once=at_once) as on_level:
        found = compare(directory, stored, run, units, executor=executor, on_level=on_level)
    for line in tell(found, len(whole_units), others):
        typer.echo(printable(line))
    if found.differences:
        raise typer.Exit(RUN_FAILED)


def head(stored: Result, directory: Path, n_whole: int, n_units: int) -> str:
    """Say what is verified, and that its files are there."""
    run = stored.run
    names = [named_input(stored, kind)[0] for kind in ("benchmark", "scene")]
    others = stored.inputs.get("assets", {})
    n_others = len(others) if isinstance(others, Mapping) else 0
    finished = count(n_units, "unit")
    if n_whole < n_units:
        finished = f"{n_whole} of {finished} finished"
    return printable(
        f"{directory}: {run.get('algorithm')}, seed {run.get('seed')}, {run.get('mode')}, "
        f"{count(len(stored.rows), 'row')}, {finished}\n"
        f"files: the same ({', '.join(names)} and {n_others} more)"
    )


def made_otherwise(stored: Result, directory: Path, run: Mapping[str, object]) -> dict[str, str]:
    """Say what differs between how the result was made and how it is replayed, and what holds."""
    from ..results.chosen_code import other_code
    from ..results.provenance import codes_of, load_provenance, machine
    from ..verify.verify import ENVIRONMENT

    pairs = {name: (stored.run.get(name), run.get(name)) for name in ENVIRONMENT}
    recorded, here = load_provenance(directory), machine()
    for name in ("system", "python", *(["cpu"] if "code" not in recorded else [])):
        if name in recorded:
            pairs[name] = (recorded[name], here[name])
    said = {
        name: f"{MEANS[name]}: made with {before}, replayed with {now}; {PROMISES[name]}"
        for name, (before, now) in pairs.items()
        if before != now
    }
    if codes := [text for code in codes_of(recorded) if (text := other_code(code))]:
        said["code"] = f"{MEANS['code']}: {'; '.join(codes)}; {PROMISES['code']}"
    return said


def tell(found: Verification, n_whole: int, others: Mapping[str, str]) -> list[str]:
    """Say what came out, the verdict last."""
    said = [str(difference) for difference in found.differences[:SHOWN]]
    if len(found.differences) > SHOWN:
        said.append(f"and {len(found.differences) - SHOWN} more differences")
    said += [f"not compared: {what}" for what in found.not_compared]
    n = len(found.units)
    which = f"{n} of {count(n_whole, 'unit')}" if n < n_whole else f"all of {count(n, 'unit')}"
    played = f"{which} replayed, {count(sum(len(trial.levels) for trial in found.units), 'level')}"
    if not found.differences:
        return [*said, f"the same, byte for byte: {played}"]
    return [*said, f"DIFFERS: {played}. {blame(found, others)}"]


def count(number: int, what: str) -> str:
    """``1 trial``, ``2 trials``."""
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def blame(found: Verification, others: Mapping[str, str]) -> str:
    """Say which part of the program the differences point to."""
    bodies = [part for part in found.parts if not part.startswith("/")]
    if bodies:
        where = f"It begins in the physics: {', '.join(bodies)} moved otherwise."
        return where + _because(others, ("version", "physics", "numpy", "cpu", "code", "system"))
    if found.parts:
        where = f"Every body moved the same; the images on {', '.join(found.parts)} are others."
        return where + _because(others, ("version", "renderer", "numpy", "cpu", "code", "system"))
    if found.is_replayed:
        return "Every replayed unit gave what it stored; other parts of the result were changed."
    if not found.is_steady:
        return "Its stored fingerprints are not those of a replay."
    return (
        "Every body moved and every image was the same: what is stored was changed, or the "
        "algorithm or a measure is not repeatable (its own chance, a clock, threads)."
    )


def _because(others: Mapping[str, str], names: tuple[str, ...]) -> str:
    known = [MEANS[name] for name in names if name in others]
    return f" Made otherwise: {', '.join(known)}." if known else ""
