"""The option ``--px4`` of ``uwsim run`` and ``uwsim bench``."""

from __future__ import annotations

from typing import Annotated

from .help_texts import AUTOPILOTS, option

Px4Option = Annotated[
    bool,
    option(
        AUTOPILOTS,
        "--px4",
        help="Let PX4 steer, in lock-step over its HIL messages at TCP port 4560: the vehicles "
        "with <u:px4>, or else the first vehicle with dynamics. Start PX4 with "
        "PX4_SIMULATOR=none.",
    ),
]
