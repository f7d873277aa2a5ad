"""Options of ``uwsim run``: for how long, with what program, and what is written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from .completion import algorithm_names, one_of
from .help_texts import INPUT, OUTPUT, RUN, in_group
from .options import JsonOption


@dataclass(frozen=True, kw_only=True)
class ProgramOptions:
    """For how long, and with what program."""

    duration: Annotated[
        str | None,
        in_group(
            INPUT,
            "--for",
            metavar="TIME",
            help="How long, in simulation time: 10s, 500ms, 2min, 1h [10s; with a connection "
            "until Ctrl-C; the length of a recording].",
        ),
    ] = None
    program: Annotated[
        str | None,
        in_group(
            INPUT,
            "--program",
            metavar="FILE.py|module:Class",
            help="A program of your own: a class with start(node), as of an algorithm "
            "(FILE.py:Class where the file has several); or a name of `uwsim list algorithms`. "
            "--set algorithm.NAME=VALUE sets its parameters.",
            autocompletion=algorithm_names,
        ),
    ] = None
    udp_address: Annotated[
        str | None,
        in_group(
            INPUT,
            "--udp-address",
            metavar="ADDRESS",
            help="Address of this computer at which the element fdm of a vehicle takes UDP "
            "packets, as 127.0.0.1; such a run is not repeatable.",
        ),
    ] = None


SeedOption = Annotated[
    int, in_group(RUN, "--seed", metavar="N", min=0, help="Seed of every random stream.")
]

ImagesOption = Annotated[
    str,
    in_group(
        OUTPUT,
        "--images",
        metavar="raw|png|none",
        help="In the recording: images as they are, as TOPIC/compressed without loss (smaller, "
        "slower), or none.",
        autocompletion=one_of(("raw", "png", "none")),
    ),
]


@dataclass(frozen=True, kw_only=True)
class RecordOptions:
    """What is written."""

    hz: Annotated[
        bool,
        in_group(
            OUTPUT,
            "--hz",
            help="Read every topic, images too, and report number, rate and gaps of its messages.",
        ),
    ] = False
    record: Annotated[
        Path | None,
        in_group(
            OUTPUT,
            "--record",
            metavar="FILE.mcap|.bag",
            help="Record every topic: .mcap of ROS 2 (read by ros2 bag, Foxglove, rosbags), "
            ".bag of ROS 1 (rosbag).",
        ),
    ] = None
    images: ImagesOption = "raw"
    overwrite: Annotated[
        bool, in_group(OUTPUT, "--overwrite", help="Replace an earlier recording.")
    ] = False
    as_json: JsonOption = False


@dataclass(frozen=True, kw_only=True)
class TrialRecordOptions:
    """What is recorded of the trials of a benchmark."""

    record: Annotated[
        Path | None,
        in_group(
            OUTPUT,
            "--record",
            metavar="FILE.mcap|.bag",
            help="Record the topics of each trial, for ROS 2 or ROS 1; of several trials "
            "FILE-00000.mcap and so on, as numbered in the result, whose bytes stay the same. "
            "Not for ray.",
        ),
    ] = None
    images: ImagesOption = "raw"
