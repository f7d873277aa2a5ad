"""The phases of a grasp: a state machine whose states are classes.

==========  ===================================================  =======================
phase       action                                               next
==========  ===================================================  =======================
search      fly a square spiral until the box is detected        detect
detect      stay for more sightings                              station
station     fly over the box until its position is known         pregrasp
pregrasp    arm down, jaw open and across the handle             align
align       grip over the handle                                 descend
descend     grip down to the handle                              close
close       close the jaw, check that it holds an object         lift, or retry
lift        rise                                                 hold, or retry
hold        stay                                                 retreat, or retry
retreat     rise further, with the box                           done
retry       open the jaw, rise, wait for sightings               station, or search
done        stay
aborted     stay; the reason is published
==========  ===================================================  =======================

A phase that exceeds its `limit` continues with its `timeout_phase`. `step` returns the name of the
next phase, or None to stay.
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
