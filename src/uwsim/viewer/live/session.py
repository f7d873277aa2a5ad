"""A live session: the views of consecutive simulations, their pacing, and their pilots.

Viewers change a simulation only by a pilot's inputs and by resets. The inputs are published on the
bus, like the commands of any program.
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
from .clock import MAX_SLEEP, Clock
from .mapping import PilotMapping
from .pilot_targets import find_pilot_targets
from .server import LiveServer
from .view import LiveView
from .viewer_requests import Changes, ViewerRequests

REPORT_DELAY = 1.0
"""The time without a viewer after which the terminal shows that the simulation waits [s]."""


class LiveSession:
    """The live views of consecutive simulations (`uwsim.runs.trial.trial_observer`).

    Args:
        server: the server of the pages.
        real_time_factor: the simulation time per wall time [1]; 0: no limit.
        mapping: the mapping of keys and sticks; None: viewers cannot pilot.
        waits_for_page: True if a simulation begins only when there is a viewer.
        allows_reset: True if viewers may reset vehicles and objects; not in a scored run.
        wall: the function that returns the wall time [s].
        report: the function that prints a line on the terminal; None: nothing is printed.
    """

    def __init__(
        self,
        server: LiveServer,
        *,
        real_time_factor: float = 1.0,
        mapping: PilotMapping | None = None,
        waits_for_page: bool = False,
        allows_reset: bool = False,
        wall: Callable[[], float] = time.monotonic,
        report: Callable[[str], None] | None = None,
    ) -> None:
        self._server, self._wall, self._report = server, wall, report
        self._clock = Clock(real_time_factor, wall)
        self._requests = ViewerRequests(server, self._clock, mapping)
        self._mapping = mapping
        self._waits_for_page, self._allows_reset = waits_for_page, allows_reset
        self._pilot_fields: dict[
            str, Any
        ] = {  # the fields of the message "state" that concern the pilot
            **{"vehicle": 0, "why": "", "names": {}},
            "sticks": ["", "", "", ""] if mapping is None else list(mapping.sticks),
            "mapping": {} if mapping is None else dict(mapping.keys),
            "reserved": [] if mapping is None else sorted(mapping.keys),
        }
        self.view: LiveView | None = None
        """The view of the open simulation."""

    def open(
        self,
        simulation: Simulation,
        title: str,
        parameters: Mapping[str, float | str] | None = None,
    ) -> None:
        """Show a simulation from now on; it is at step 0.

        Args:
            simulation: the simulation.
            title: the title of the page.
            parameters: the parameters of the pilot; None: the page shows all keys and sticks, or
                there is no pilot.
        """
        self._update_pilot_fields(simulation, parameters)
        self._server.remove_channels(lambda channel: channel != "state")
        self.view = view = LiveView(
            simulation,
            self._server,
            self._requests,
            title=title,
            vehicle=self._pilot_fields["vehicle"],
            allows_reset=self._allows_reset,
            wall=self._wall,
        )
        self._publish_state()
        view.publish_due(is_paused=self._clock.is_paused)
        if self._waits_for_page:
            self._wait_for_page()
        self._clock.begin(simulation.time)
        simulation.watch(lambda: self._on_step(simulation, view))

    def _update_pilot_fields(
        self, simulation: Simulation, parameters: Mapping[str, float | str] | None
    ) -> None:
        """Update the fields that concern the pilot; warn if no vehicle can be steered."""
        mapping = self._mapping
        if mapping is None or parameters is None:
            return
        targets = find_pilot_targets(simulation.world, parameters)
        if targets.reason and targets.reason != self._pilot_fields["why"]:
            warn(targets.reason)
        self._pilot_fields |= {
            "vehicle": targets.vehicle,
            "sticks": targets.sticks(mapping),
            "why": targets.reason,
            "names": targets.names,
            "mapping": targets.keys(mapping),
        }

    def _wait_for_page(self) -> None:
        """Wait until there is a viewer; a reloaded page returns before the report."""
        report_time = self._wall() + REPORT_DELAY
        while not self._server.n_viewers:
            time.sleep(MAX_SLEEP)
            if self._report is not None and self._wall() >= report_time:
                self._report(f"waiting for a page: open {self._server.url}")
                report_time = math.inf

    def begin_level(self, level: Level, measures: Sequence[TriggeredMeasure]) -> None:
        """Show that the measurement of a level begins."""
        if self.view is not None:
            self.view.begin_level(level, measures)

    def end_level(self, row: LevelRow) -> None:
        """Show that a level is over."""
        if self.view is not None:
            self.view.end_level(row)

    def pilot(self) -> Sequence[float] | None:
        """Return the sum of all pilots' inputs; None before the first input."""
        return self._requests.take_inputs()

    def close(self) -> None:
        """End the view, before the simulation is closed."""
        if self.view is not None:
            self.view.close()
        self.view = None

    def end(self, reason: str) -> None:
        """Send the end of the view to all pages."""
        self._server.publish("end", json.dumps({"type": "end", "why": reason}))

    def _on_step(self, simulation: Simulation, view: LiveView) -> None:
        """Publish what is due; wait while the simulation is paused or ahead of its pacing."""
        if self.view is not view:
            return
        self._handle_requests(view)
        while self._clock.has_to_wait(simulation.time):
            self._clock.sleep(simulation.time)
            self._handle_requests(view)
        self._clock.count_step()

    def _handle_requests(self, view: LiveView) -> None:
        changes = self._requests.receive()
        if Changes.PACING in changes:
            self._publish_state()
        if Changes.RESET in changes and self._allows_reset:
            view.reset()
        if Changes.INPUT in changes:
            view.request_row()
        view.publish_due(is_paused=self._clock.is_paused)

    def _publish_state(self) -> None:
        state = {
            "type": "state",
            "paused": self._clock.is_paused,
            "speed": self._clock.real_time_factor,
            "pilot": self._mapping is not None,
            "resets": self._allows_reset,
            **self._pilot_fields,
        }
        self._server.publish("state", json.dumps(state))
