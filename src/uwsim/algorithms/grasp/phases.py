"""The phases of a grasp: a state machine whose states are classes.

===========  ==================================================  =======================
phase        what is done                                        then
===========  ==================================================  =======================
`Search`     fly a square spiral until the box was seen          detect
`Detect`     stay, look again                                    station
`Station`    fly over it, look until its place is sure           pregrasp
`Pregrasp`   arm down, jaw open and across the handle            align
`Align`      grip over the handle                                descend
`Descend`    grip down to the handle                             close
`Close`      close the jaw, feel whether something is in it      lift, or retry
`Lift`       rise                                                hold, or retry
`Hold`       stay there                                          retreat, or retry
`Retreat`    rise further, with the box                          done
`Retry`      open the jaw, rise, look again                      station, or search
`Done`       stay
`Aborted`    stay; the reason is published
===========  ==================================================  =======================

A phase that outlasts its `limit` goes on to `late`. `step` returns the name of the next phase, or
None to stay.
"""

from __future__ import annotations

from .carrying import Aborted, Done, Hold, Lift, Retreat, Retry
from .finding import Detect, Pregrasp, Search, Station
from .phase import Phase
from .taking import Align, Close, Descend

__all__ = ["PHASES", "Phase"]

PHASES: dict[str, type[Phase]] = {
    "search": Search,
    "detect": Detect,
    "station": Station,
    "pregrasp": Pregrasp,
    "align": Align,
    "descend": Descend,
    "close": Close,
    "lift": Lift,
    "hold": Hold,
    "retreat": Retreat,
    "retry": Retry,
    "done": Done,
    "aborted": Aborted,
}
"""The phases by name, in their usual order."""
