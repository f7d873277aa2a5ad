"""The option ``--ardupilot`` of ``uwsim run`` and ``uwsim bench``."""

from __future__ import annotations

from typing import Annotated

from .help_texts import AUTOPILOTS, option

ArduPilotOption = Annotated[
    bool,
    option(
        AUTOPILOTS,
        "--ardupilot",
        help="Let ArduPilot steer, in lock-step through its JSON physics backend: the vehicles "
        "with <u:ardupilot>, or else the first vehicle with dynamics. Start ArduPilot with "
        "--model JSON:127.0.0.1.",
    ),
]
