"""The options of runs: duration, program, UDP address, seed and recording."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from .ardupilot_option import ArduPilotOption
from .completion import algorithm_names, complete_names
from .help_texts import INPUT, OUTPUT, RUN, option
from .options import JsonOption
from .px4_option import Px4Option


@dataclass(frozen=True, kw_only=True)
class ProgramOptions:
    """The options of the duration, the program and the UDP address."""

    duration: Annotated[
        str | None,
        option(
            INPUT,
            "--for",
            metavar="TIME",
            help="Duration in simulation time: 10s, 500ms, 2min, 1h [10s; with a connection until "
            "Ctrl-C; the length of a recording].",
        ),
    ] = None
    program: Annotated[
        str | None,
        option(
            INPUT,
            "--program",
            metavar="FILE.py|module:Class",
            help="Your own program: a class with start(node), as of an algorithm (FILE.py:Class "
            "if the file has several); or a name of `uwsim list algorithms`. --set "
            "algorithm.NAME=VALUE sets its parameters.",
            autocompletion=algorithm_names,
        ),
    ] = None
    udp_address: Annotated[
        str | None,
        option(
            INPUT,
            "--udp-address",
            metavar="ADDRESS",
            help="Address of this computer, such as 127.0.0.1, at which a vehicle receives the UDP "
            "datagrams of a flight dynamics model, the element fdm; such a run is not repeatable.",
        ),
    ] = None
    ardupilot: ArduPilotOption = False
    px4: Px4Option = False

    @property
    def has_autopilot(self) -> bool:
        """True if an autopilot outside steers."""
        return self.ardupilot or self.px4

    @property
    def port_address(self) -> str | None:
        """The address of this computer at which ports are opened; None: none are."""
        from ...runs.planning.ardupilot_scene import ADDRESS

        return self.udp_address or (ADDRESS if self.has_autopilot else None)


SeedOption = Annotated[int, option(RUN, "--seed", metavar="N", min=0, help="Random seed.")]

ImagesOption = Annotated[
    str,
    option(
        OUTPUT,
        "--images",
        metavar="raw|png|none",
        help="Images in the recording: uncompressed, as TOPIC/compressed without loss (smaller, "
        "slower), or none.",
        autocompletion=complete_names(("raw", "png", "none")),
    ),
]


@dataclass(frozen=True, kw_only=True)
class RecordOptions:
    """The options of the output and the recording."""

    hz: Annotated[
        bool,
        option(
            OUTPUT,
            "--hz",
            help="Read every topic, images too, and report number, rate and gaps of its messages.",
        ),
    ] = False
    record: Annotated[
        Path | None,
        option(
            OUTPUT,
            "--record",
            metavar="FILE.mcap|.bag",
            help="Record every topic: .mcap of ROS 2 (read by ros2 bag, Foxglove, rosbags), "
            ".bag of ROS 1 (rosbag).",
        ),
    ] = None
    images: ImagesOption = "raw"
    overwrite: Annotated[bool, option(OUTPUT, "--overwrite", help="Replace a recording.")] = False
    as_json: JsonOption = False


@dataclass(frozen=True, kw_only=True)
class TrialRecordOptions:
    """The options of the recordings of the trials of a benchmark."""

    record: Annotated[
        Path | None,
        option(
            OUTPUT,
            "--record",
            metavar="FILE.mcap|.bag",
            help="Record the topics of each trial, for ROS 2 or ROS 1; for several trials as "
            "FILE-00000.mcap and so on, numbered as in the result. The result does not change. "
            "Not for ray.",
        ),
    ] = None
    images: ImagesOption = "raw"
