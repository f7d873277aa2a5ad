"""The phases of a grasp: a state machine whose states are classes.

==========  ===================================================  =======================
phase       action                                               next
==========  ===================================================  =======================
search      follow a square spiral until the box is detected     detect, or aborted
detect      keep position, wait for more sightings               station, or search
station     stay over the box until its position is known        pregrasp, or search
pregrasp    lower the arm, open the jaw across the handle        align
align       bring the grip over the handle                       descend, or retry
descend     lower the grip to the handle                         close
close       close the jaw, check that it holds an object         lift, or retry
lift        rise with the box                                    hold, or retry
hold        keep position with the box                           retreat, or retry
retreat     rise further with the box                            done, or retry
retry       open the jaw, rise, wait for sightings               station, or aborted
done        keep position
aborted     keep position; the reason is published
==========  ===================================================  =======================

A phase that exceeds its `limit` is followed by its `timeout_phase`.
"""

from __future__ import annotations

from .approach_phases import DetectPhase, PregraspPhase, SearchPhase, StationPhase
from .grasp_phases import AlignPhase, ClosePhase, DescendPhase
from .lift_phases import AbortedPhase, DonePhase, HoldPhase, LiftPhase, RetreatPhase, RetryPhase
from .phase import Phase

__all__ = ["PHASES", "Phase"]

PHASES: dict[str, type[Phase]] = {
    "search": SearchPhase,
    "detect": DetectPhase,
    "station": StationPhase,
    "pregrasp": PregraspPhase,
    "align": AlignPhase,
    "descend": DescendPhase,
    "close": ClosePhase,
    "lift": LiftPhase,
    "hold": HoldPhase,
    "retreat": RetreatPhase,
    "retry": RetryPhase,
    "done": DonePhase,
    "aborted": AbortedPhase,
}
"""The phases by name, in their usual order."""
