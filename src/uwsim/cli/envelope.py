"""``uwsim envelope``: up to where a benchmark holds, as one number with its bound."""

from __future__ import annotations

import math
import re
import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import BadSetting, UwsimError, did_you_mean
from .bench import chosen_level, interrupt, make_plan
from .crew import WorkersOption, crew_of
from .faults import printable
from .options import CompatOption, DataPathOption
from .plugins import PluginOption
from .progress import progress

if TYPE_CHECKING:
    from ..benchmark.bench import Bench
    from ..benchmark.crew import Crew
    from ..benchmark.envelope import Criterion, Envelope, Range
    from ..benchmark.plan import Plan
    from ..benchmark.updaters import Level, SceneUpdaterSpec

MOST_CUTS = 30
"""A range is not cut finer than 2 to the power of minus this."""
MAX_REPEATS = 1000


def envelope(
    benchmark: Annotated[
        str, typer.Argument(metavar="BENCHMARK", help="A benchmark file, or a bundled name.")
    ],
    over: Annotated[
        str,
        typer.Option(metavar="REFERENCE", help="What grows: a reference of its sweep, as fog."),
    ],
    until: Annotated[
        str,
        typer.Option(
            metavar="CRITERION",
            help="When a run counts as broken, in the language of scores: corners > 5.",
        ),
    ],
    start: Annotated[
        float | None,
        typer.Option("--from", metavar="A", help="Near end, where it holds [first of the sweep]."),
    ] = None,
    stop: Annotated[
        float | None,
        typer.Option("--to", metavar="B", help="Far end, where it breaks [last of the sweep]."),
    ] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(metavar="T", help="How finely each seed is searched [1 % of the range]."),
    ] = None,
    repeat: Annotated[
        int, typer.Option(min=1, help="Search with K seeds, SEED ... SEED+K-1.")
    ] = 10,
    confidence: Annotated[
        float, typer.Option(help="How surely the bound shall hold the breaking point.")
    ] = 0.95,
    scene: Annotated[
        str | None,
        typer.Option(help="The scene; without it the one that the benchmark names (u:scene)."),
    ] = None,
    algorithm: Annotated[
        str | None,
        typer.Option(help="What is tested; without it the one that the benchmark names."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the first search.")] = 0,
    level: Annotated[
        list[str] | None,
        typer.Option(help="Where another reference of the sweep stays, as current=0.1."),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PATH=VALUE",
            help="Change the scene or the algorithm, as for bench; may be repeated.",
        ),
    ] = None,
    compat: CompatOption = None,
    workers: WorkersOption = "1",
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Where it goes [./NAME.envelope].")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Use the runs that are in --out already.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an earlier envelope in --out.")
    ] = False,
    plugin: PluginOption = None,
    data_path: DataPathOption = None,
) -> None:
    """Find the level at which a benchmark breaks: one number, its unit, and its bound.

    Each seed is searched by bisection, every level played alone (mode independent). A run is broken
    where the criterion is not 0, and where its status is not ok: what is lost has no error. A
    criterion that asks for the status decides itself: 'status == lost', with the names ok, lost,
    timeout, collision and error. What is found is the median of the seeds' breaking points, with
    its exact limits; six seeds are the fewest for 95 %. 'Does not break up to B', and a criterion
    that goes back, are said.

    Written: envelope.json, the same bytes twice, with every run; envelope.png. With --resume the
    runs in --out are used again, whatever criterion, range, tolerance or number of seeds is asked
    for now.
    """
    from ..benchmark.envelope import parse_criterion, plan_for

    crew = crew_of(workers)
    if not 0.0 < confidence < 1.0:
        raise BadSetting(f"--confidence is {confidence:g}; expected more than 0 and less than 1.")
    if repeat > MAX_REPEATS:
        raise BadSetting(f"--repeat {repeat}: at most {MAX_REPEATS}.")
    plan = make_plan(
        benchmark,
        scene=scene,
        algorithm=algorithm,
        seed=seed,
        repeat=1,
        mode="independent",
        levels=[],
        settings=settings or [],
        compat=compat or [],
        data_path=tuple(data_path or ()),
        plugins=plugin or [],
    )
    spec = updater_of(plan, over)
    where = range_of(spec, over, start, stop, tolerance)
    at = fixed_levels(plan, over, [chosen_level(text) for text in level or []])
    try:
        criterion = parse_criterion(until, [m.name for m in plan.benchmark.measures])
    except UwsimError as error:
        raise BadSetting(f"--until: {error}") from None
    directory = out or Path(f"{Path(plan.benchmark.path).stem}.envelope")
    seeds = tuple(range(seed, seed + repeat))
    play(
        plan_for(plan), directory, spec, criterion, where, at, seeds, over=over,
        confidence=confidence, crew=crew, resume=resume, overwrite=overwrite,
    )  # fmt: skip


def play(
    plan: Plan,
    directory: Path,
    spec: SceneUpdaterSpec,
    criterion: Criterion,
    where: Range,
    at: Level,
    seeds: tuple[int, ...],
    *,
    over: str,
    confidence: float,
    crew: Crew,
    resume: bool,
    overwrite: bool,
) -> None:
    """Search, write and say what was found."""
    from ..benchmark.bench import Bench, open_once
    from ..benchmark.directory import alone_in, make_room
    from ..benchmark.envelope import Asked, Envelope, Evaluations, strategy
    from ..benchmark.envelope.plot import draw
    from ..benchmark.provenance import machine, save_provenance

    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    inputs, renderer = open_once(plan)
    signal.signal(signal.SIGTERM, interrupt)
    if not resume:
        hint = "Use --resume to use its runs, or --overwrite to start anew."
        make_room(directory, overwrite=overwrite, ours=OURS, folders=FOLDERS, hint=hint)
    began = time.time()
    with alone_in(directory):
        bench = Bench(plan=plan, out=directory, inputs=inputs, renderer=renderer)
        most = 9 + len(seeds) * (where.most_cuts() + 1)
        title = f"{Path(plan.benchmark.path).stem} ({plan.algorithm_name}), at most"
        with progress(title, most, of="runs") as on_run:
            runs = Evaluations(bench, at=at, over=over, criterion=criterion)
            found = runs.run(strategy(seeds, where), crew, on_run)
        envelope = Envelope(
            asked=Asked(
                over=over,
                unit=spec.reference_unit,
                until=criterion.text,
                fixed={name: value for name, value in at.values if name != over},
                where=where,
                seeds=seeds,
                confidence=confidence,
            ),
            found=found,
            evaluations=tuple(runs.made[key] for key in sorted(runs.made, key=lambda k: k[::-1])),
            inputs=inputs,
            run=played(bench),
        )
        envelope.save(directory)
        draw(envelope, directory)
        save_provenance(
            {**machine(), "wall_s": time.time() - began, "command": sys.argv[1:]}, directory
        )
    tell(envelope, directory)


OURS = re.compile(
    r"""(?x)
    envelope\.(json|png) | provenance\.json | units/\d+\.(jsonl|part)
  | pictures/\d+-[^/]+\.png(\.part)? | (units/|pictures/)?\.[^/]+\.part
    """
)
"""Files that this command writes."""
FOLDERS = ("units", "pictures")


def updater_of(plan: Plan, over: str) -> SceneUpdaterSpec:
    """Find the updater that is searched over.

    Raises:
        BadSetting: the benchmark does not sweep it, or there is nothing between its values.
    """
    from ..benchmark.updaters import chain, references

    names = references(plan.benchmark.scene_updater)
    if over not in names:
        swept = ", ".join(name for name in names if name != "none") or "nothing"
        raise BadSetting(
            f"--over {over}: this benchmark sweeps {swept}.{did_you_mean(over, names)}"
        )
    spec = chain(plan.benchmark.scene_updater)[names.index(over)]
    if spec.name == "none" or spec.blend(spec.initial + 1.0, 0.5) == spec.initial + 1.0:
        raise BadSetting(f"--over {over}: there is nothing between two values of it.")
    return spec


def range_of(
    spec: SceneUpdaterSpec,
    over: str,
    start: float | None,
    stop: float | None,
    tolerance: float | None,
) -> Range:
    """Put the range together.

    Raises:
        BadSetting: it is empty, too fine, or reaches where the updater cannot go.
    """
    from ..benchmark.envelope import Range

    values = spec.values()
    ends = {"--from": values[0] if start is None else start}
    ends["--to"] = values[-1] if stop is None else stop
    for option, value in ends.items():
        if not math.isfinite(value):
            raise BadSetting(f"{option} is {value}; expected a number.")
        if limit := beyond(spec, value):
            raise BadSetting(f"{option} {value:g}: {over} must be {limit}.")
    near, far = ends.values()
    width = abs(far - near)
    if width == 0.0:
        raise BadSetting(f"--from and --to are both {near:g}: there is nothing to search.")
    step = round_down(width / 100) if tolerance is None else tolerance
    if not 0.0 < step < width:
        raise BadSetting(f"--tolerance is {step:g}; expected more than 0 and less than {width:g}.")
    if width / step > 2.0**MOST_CUTS:
        raise BadSetting(f"--tolerance {step:g} is too fine for a range of {width:g}.")
    return Range(start=near, stop=far, tolerance=step)


def beyond(spec: SceneUpdaterSpec, value: float) -> str | None:
    """Say what the updater's file would have to hold, where a value is beyond that."""
    from ..dialect import slots

    slot = {slot.field: slot for slot in slots(type(spec))}.get("initial_value")
    if slot is None:
        low, high = min(spec.values()), max(spec.values())
        return None if low <= value <= high else f"from {low:g} to {high:g}"
    xml = slot.xml
    fits = (
        (xml.minimum is None or value >= xml.minimum)
        and (xml.maximum is None or value <= xml.maximum)
        and (xml.above is None or value > xml.above)
        and (xml.below is None or value < xml.below)
    )
    return None if fits else slot.expected


def round_down(width: float) -> float:
    """Return the nearest 1, 2 or 5 of a power of ten that is not larger."""
    power = 10.0 ** math.floor(math.log10(width))
    digit = next(d for d in (5.0, 2.0, 1.0) if d * power <= width * (1 + 1e-9))
    return float(f"{digit * power:.1g}")


def fixed_levels(plan: Plan, over: str, chosen: list[tuple[str, float]]) -> Level:
    """Return where every reference stands but the one that is searched over.

    Raises:
        BadSetting: a reference is not in the sweep, or has several values and none was chosen.
    """
    from ..benchmark.updaters import Level, chain, references

    names = references(plan.benchmark.scene_updater)
    for name, _ in chosen:
        if name == over:
            raise BadSetting(f"--level {name}: that is what is searched over.")
        if name not in names:
            near = did_you_mean(name, names)
            raise BadSetting(f"--level {name}: this benchmark sweeps {', '.join(names)}.{near}")
    values = []
    for name, spec in zip(names, chain(plan.benchmark.scene_updater), strict=True):
        given = [value for wanted, value in chosen if wanted == name]
        if len(given) > 1:
            raise BadSetting(f"--level {name} is given twice; a search plays one.")
        if name != over and not given and len(spec.values()) > 1:
            raise BadSetting(
                f"The benchmark also sweeps {name} ({len(spec.values())} levels); choose one, as "
                f"--level {name}={spec.values()[0]:g}."
            )
        if given and (limit := beyond(spec, given[0])):
            raise BadSetting(f"--level {name}={given[0]:g}: {name} must be {limit}.")
        values.append((name, given[0] if given else spec.initial))
    return Level(tuple(values))


def played(bench: Bench) -> dict[str, object]:
    """Say what was played and with what, as results do; seeds and levels stand elsewhere."""
    from ..benchmark.plan import Unit

    head = bench.head(Unit(index=0, repeat=0, seed=0, levels=(), is_alone=True))
    return {k: v for k, v in head["run"].items() if k not in ("seed", "repeats", "levels")}


def tell(envelope: Envelope, directory: Path) -> None:
    """Print what was found."""
    from ..benchmark.envelope.criterion import reasons

    lines = [envelope.sentence]
    by = reasons(e.judgement for e in envelope.evaluations)
    n_broken = sum(by.values())
    why = f": {', '.join(f'{name} {n}' for name, n in by.items())}" if by else ""
    n_seeds = len(envelope.asked.seeds)
    seeds = "1 seed" if n_seeds == 1 else f"{n_seeds} seeds"
    lines.append(f"{seeds}, {len(envelope.evaluations)} runs, {n_broken} broken{why}")
    lines += [f"warning: {warning}" for warning in envelope.warnings]
    lines.append(f"written: {directory}/envelope.json, envelope.png")
    typer.echo(printable("\n".join(lines)))
