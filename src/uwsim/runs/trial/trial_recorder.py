"""The protocol of a recorder of the messages of trials."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Protocol

from ...simulation import Simulation
from ..planning.plan import Trial


class TrialRecorder(Protocol):
    """A recorder of trials; it changes nothing in them, and can be sent to another process."""

    def recording(self, simulation: Simulation, trial: Trial) -> AbstractContextManager[None]:
        """Return a context that records a trial.

        On entry the simulation is at step 0, and no algorithm is attached to it.
        """
