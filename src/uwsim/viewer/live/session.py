"""The live views of one simulation after another, their pace, and the pilots who look on.

Nothing is written to a simulation but a pilot's inputs, which go over the bus like those of any
program.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ...base.terminal import warn
from ...benchmark.updaters import Level
from ...runs.trial.level_row import LevelRow
from ...runs.trial.triggered_measure import TriggeredMeasure
from ...simulation import Simulation
from .audience import Audience, News
from .clock import NAP, Clock
from .mapping import PilotMapping
from .piloted import piloted_of
from .server import LiveServer
from .view import LiveView

PATIENCE = 1.0
"""So long nobody may look before the terminal is told that a simulation waits [s]."""


class LiveSession:
    """What viewers see and do while simulations come and go (`uwsim.runs.trial.onlooker.Onlooker`).

    Args:
        server: to whom it is handed.
        speed: simulation time a second of the wall clock; 0: as fast as it can.
        mapping: what keys and sticks do; None: nobody pilots.
        waits: whether a simulation does not begin before somebody looks.
        resets: whether viewers may put vehicles and objects back where they began; not where
            anything is scored.
        wall: returns the wall time [s].
        say: is told in words what it waits for.
    """

    def __init__(
        self,
        server: LiveServer,
        *,
        speed: float = 1.0,
        mapping: PilotMapping | None = None,
        waits: bool = False,
        resets: bool = False,
        wall: Callable[[], float] = time.monotonic,
        say: Callable[[str], None] | None = None,
    ) -> None:
        self._server, self._wall, self._say = server, wall, say
        self._clock = Clock(speed, wall)
        self._audience = Audience(server, self._clock, mapping)
        self._mapping, self._waits, self._resets = mapping, waits, resets
        self._piloted: dict[str, Any] = {  # what pilots move, as pages are told
            **{"vehicle": 0, "why": "", "names": {}},
            "sticks": ["", "", "", ""] if mapping is None else list(mapping.sticks),
            "mapping": {} if mapping is None else dict(mapping.keys),
            "reserved": [] if mapping is None else sorted(mapping.keys),
        }
        self.view: LiveView | None = None
        """The view of the simulation that is open."""

    def open(
        self,
        simulation: Simulation,
        title: str,
        parameters: Mapping[str, float | str] | None = None,
    ) -> None:
        """Show a simulation from now on; it is at step 0.

        Args:
            simulation: the one.
            title: of the page.
            parameters: of the pilot; None: all keys and sticks are shown, or nobody pilots.
        """
        self._find_out_what_pilots_move(simulation, parameters)
        self._server.forget(lambda channel: channel != "state")
        self.view = view = LiveView(
            simulation,
            self._server,
            self._audience,
            title=title,
            vehicle=self._piloted["vehicle"],
            resets=self._resets,
            wall=self._wall,
        )
        self._say_state()
        view.hand_over(is_paused=self._clock.is_paused)
        if self._waits:
            self._wait_for_a_page()
        self._clock.begin(simulation.time)
        simulation.watch(lambda: self._look(simulation, view))

    def _find_out_what_pilots_move(
        self, simulation: Simulation, parameters: Mapping[str, float | str] | None
    ) -> None:
        """Keep it for pages, and say on the terminal where it is nothing."""
        mapping = self._mapping
        if mapping is None or parameters is None:
            return
        piloted = piloted_of(simulation.world, parameters)
        if piloted.why and piloted.why != self._piloted["why"]:
            warn(piloted.why)
        self._piloted |= {
            "vehicle": piloted.vehicle,
            "sticks": piloted.sticks(mapping),
            "why": piloted.why,
            "names": piloted.names,
            "mapping": piloted.keys(mapping),
        }

    def _wait_for_a_page(self) -> None:
        """Wait until somebody looks; a page that is loaded again is back sooner than it is told."""
        tells_at = self._wall() + PATIENCE
        while not self._server.n_viewers:
            time.sleep(NAP)
            if self._say is not None and self._wall() >= tells_at:
                self._say(f"waits for a page: open {self._server.url}")
                tells_at = math.inf

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """A level is measured from now on."""
        if self.view is not None:
            self.view.begin_level(level, measures)

    def end_level(self, row: LevelRow) -> None:
        """A level is over."""
        if self.view is not None:
            self.view.end_level(row)

    def pilot(self) -> Sequence[float] | None:
        """Return what all pilots do together; None before the first has done anything."""
        return self._audience.inputs

    def close(self) -> None:
        """The simulation is about to be closed."""
        if self.view is not None:
            self.view.close()
        self.view = None

    def end(self, why: str) -> None:
        """Tell everybody that nothing more comes."""
        self._server.publish("end", json.dumps({"type": "end", "why": why}))

    def _look(self, simulation: Simulation, view: LiveView) -> None:
        """Hand over what is due, and wait where the view is paused or ahead of its time."""
        if self.view is not view:
            return
        self._hear(view)
        while self._clock.waits(simulation.time):
            self._clock.sleep(simulation.time)
            self._hear(view)
        self._clock.stepped()

    def _hear(self, view: LiveView) -> None:
        """Do what viewers have asked for, and hand over what is due."""
        news = self._audience.hear()
        if News.PACE in news:
            self._say_state()
        if News.RESET in news and self._resets:
            view.reset()
        if News.INPUT in news:
            view.follow()
        view.hand_over(is_paused=self._clock.is_paused)

    def _say_state(self) -> None:
        state = {
            "type": "state",
            "paused": self._clock.is_paused,
            "speed": self._clock.speed,
            "pilot": self._mapping is not None,
            "resets": self._resets,
            **self._piloted,
        }
        self._server.publish("state", json.dumps(state))
