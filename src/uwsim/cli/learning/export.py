"""``uwsim export``: a recording as CSV, as a LeRobot data set, or as a Minari data set."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from ...errors import BadSetting
from ..options.help_texts import INPUT, OUTPUT, option

RecordingArgument = Annotated[
    list[Path],
    typer.Argument(
        metavar="RESULT|RECORDING",
        help="A recording (.mcap, .bag, .db3, a rosbag2), or a result directory for --csv. "
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

    --csv of a result writes its rows.

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
        if not formats.csv:
            raise BadSetting(
                f"{recording}: is a result, which has rows and no messages; expected --csv, or a "
                "recording (uwsim run --record)."
            )
        print(f"1 table with {export_rows(recording, out)} rows; written: {out}")
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
    n_steps = sum(len(episode.times) for episode in episodes)
    count = "1 episode" if len(episodes) == 1 else f"{len(episodes)} episodes"
    print(f"{name}: {count} of {n_steps} steps at {steps.rate:g} Hz; written: {out}")


def add_slash(topic: str) -> str:
    """Return a topic with a leading slash."""
    return f"/{topic.strip('/')}"
