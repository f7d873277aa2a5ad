"""``uwsim export``: recordings and results as CSV, as LeRobot or as Minari data sets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting
from ..options.help_texts import INPUT, OUTPUT, option
from ..output.progress import progress

if TYPE_CHECKING:
    from ...datasets.export.steps import Episode

RecordingArgument = Annotated[
    list[Path],
    typer.Argument(
        metavar="RESULT|RECORDING",
        help="A recording (.mcap, .bag, .db3, a rosbag2), or a result directory. "
        "--lerobot takes several recordings, one for each episode.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class ExportFormats:
    """The options that choose a format."""

    csv: Annotated[bool, option(OUTPUT, "--csv", help="One table of numbers for each topic.")] = (
        False
    )
    lerobot: Annotated[
        bool, option(OUTPUT, "--lerobot", help="A LeRobot data set, version 3; extra export.")
    ] = False
    minari: Annotated[bool, option(OUTPUT, "--minari", help="A Minari data set; extra export.")] = (
        False
    )


@dataclass(frozen=True, kw_only=True)
class StepOptions:
    """The options of the steps of an episode."""

    observation: Annotated[
        list[str] | None,
        option(
            INPUT, "--observation", metavar="TOPIC", help="Topic of observations; may be repeated."
        ),
    ] = None
    action: Annotated[
        list[str] | None,
        option(INPUT, "--action", metavar="TOPIC", help="Topic of actions; may be repeated."),
    ] = None
    camera: Annotated[
        list[str] | None,
        option(
            INPUT,
            "--camera",
            metavar="TOPIC",
            help="Topic of images, which --lerobot writes as a film; may be repeated.",
        ),
    ] = None
    rate: Annotated[float, option(INPUT, "--rate", metavar="HZ", help="Rate of the steps.")] = 10.0
    task: Annotated[
        str, option(INPUT, "--task", metavar="TEXT", help="Task in words, for --lerobot.")
    ] = ""
    topic: Annotated[
        list[str] | None,
        option(INPUT, "--topic", metavar="TOPIC", help="Topic of a table; may be repeated [all]."),
    ] = None


def export(
    recordings: RecordingArgument,
    *,
    formats: ExportFormats,
    steps: StepOptions,
    out: Annotated[
        Path, option(OUTPUT, "--out", "-o", metavar="DIR", help="New or empty folder.")
    ] = Path("export"),
) -> None:
    """Export a recording for learning: tables, or steps of observations and actions.

    --csv of a result writes its rows. With --lerobot and --minari, its levels run again.
    Each is an episode, with the observations, actions and rewards of the benchmark's environment.

    A step has the newest message of each topic at its time. A recording is one episode; --lerobot
    takes several.
    """
    from ...datasets.export.result_rows import export_rows, is_result

    n_formats = formats.csv + formats.lerobot + formats.minari
    if n_formats != 1:
        raise BadSetting("Choose one of --csv, --lerobot and --minari.")
    if len(recordings) > 1 and not formats.lerobot:
        raise BadSetting(f"{len(recordings)} recordings: only --lerobot takes more than one.")
    recording = next(filter(is_result, recordings), recordings[0])
    if is_result(recording):
        if len(recordings) > 1:
            raise BadSetting(f"{recording}: is a result; expected no other result or recording.")
        if formats.csv:
            print(f"1 table with {export_rows(recording, out)} rows; written: {out}")
        else:
            print(export_result(recording, out, steps, is_lerobot=formats.lerobot))
        return
    observations = tuple(map(add_slash, steps.observation or ()))
    actions = tuple(map(add_slash, steps.action or ()))
    if formats.csv:
        from ...datasets.export.csv_tables import export_csv

        n_rows = export_csv(recording, out, tuple(map(add_slash, steps.topic or ())))
        print(f"{len(n_rows)} tables with {sum(n_rows.values())} rows; written: {out}")
        return
    if formats.lerobot:
        from ...datasets.export.lerobot import export_lerobot

        episodes = export_lerobot(
            recordings,
            out,
            observations=observations,
            actions=actions,
            cameras=tuple(map(add_slash, steps.camera or ())),
            rate=steps.rate,
            task=steps.task,
        )
        name = "LeRobot v3"
    else:
        from ...datasets.export.minari import export_minari

        identifier, episode = export_minari(
            recording, out, observations=observations, actions=actions, rate=steps.rate
        )
        episodes = [episode]
        name = f"Minari {identifier}"
    print(describe_episodes(name, episodes, out))


def describe_episodes(name: str, episodes: Sequence[Episode], out: Path) -> str:
    """Return the line that describes a written data set."""
    n_steps = sum(len(episode.times) for episode in episodes)
    count = "1 episode" if len(episodes) == 1 else f"{len(episodes)} episodes"
    return f"{name}: {count} of {n_steps} steps at {episodes[0].rate:g} Hz; written: {out}"


def export_result(result: Path, out: Path, steps: StepOptions, *, is_lerobot: bool) -> str:
    """Write the episodes of a result, and return the line that describes them.

    Raises:
        UwsimError: the result has no steps, or its levels do not run again as stored.
    """
    from ...base.exceptions import convert_to_run_failed
    from ...datasets.export import lerobot, minari
    from ...datasets.export.csv_tables import check_folder
    from ...datasets.export.result_episodes import run_episodes
    from ...results.result_file import file_of, load
    from ...verify.recorded_plan import FileOverrides
    from ...verify.verify import complete_trials, row_keys, rows_by_level
    from ..verify import prepare_replay

    if steps != StepOptions(task=steps.task):
        raise BadSetting(
            f"{result}: is a result; expected no --observation, --action, --camera, --rate and "
            "--topic: the environment of the benchmark has its own."
        )
    (lerobot if is_lerobot else minari).check_extras()
    check_folder(out)
    stored_result, directory = load(result), file_of(result).parent
    run = prepare_replay(stored_result, directory, FileOverrides())
    trials = complete_trials(directory, run.plan, stored_result)
    if not trials:
        raise BadSetting(f"{directory}: no trial of it is finished; expected a finished trial.")
    rows, totals = rows_by_level(stored_result, run.plan), stored_result.numbers("total")
    keys = [key for trial in trials for key in row_keys(trial)]
    with convert_to_run_failed(), progress("running again", len(keys), unit="levels") as on_level:
        episodes = list(
            run_episodes(run.plan, trials, [totals[rows[key]] for key in keys], on_level)
        )
    name, algorithm = directory.name.removesuffix(".result"), stored_result.run.algorithm
    if is_lerobot:
        out.mkdir(parents=True, exist_ok=True)
        lerobot.write_lerobot(episodes, out, steps.task or Path(run.plan.benchmark.path).stem)
        return describe_episodes("LeRobot v3", episodes, out)
    identifier = minari.write_minari(
        episodes, out, name, algorithm or "", minari.find_arguments(run.plan)
    )
    return describe_episodes(f"Minari {identifier}", episodes, out)


def add_slash(topic: str) -> str:
    """Return a topic with a leading slash."""
    return f"/{topic.strip('/')}"
