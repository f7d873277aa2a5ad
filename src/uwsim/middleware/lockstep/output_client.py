"""A node without support of lock-step: simulation time waits for the outputs that are due.

The node reads its inputs and the clock of the simulation, as any node with ``use_sim_time``. The
user declares its outputs: the topics on which it publishes at a rate, or once for each message on
an input topic. Each step ends in two phases, as ROS does not order topics relative to each other.
First, published messages are sent and given time to arrive. Then ``/clock`` is published, and
simulation time does not advance until the outputs that are due in this step have come. They are
published on the bus in the same step.

An output that follows an input is due only from its first message on, because trackers like those
for UWSim (C++) publish nothing until they are initialized.

Such a node does not confirm that it has received messages: over ROS, its results are marked as not
guaranteed.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Sequence
from functools import partial

from ...bus import Bus, Node
from ...errors import BadSetting, ClientLost, NeverStarted, did_you_mean
from ..bridge import Bridge
from ..clock_topic import COARSE_PERIOD
from .external_program import ExternalProgram
from .spec import ClientSpec, OutputSpec

READY_WAIT_S = 1.0
"""The time for a node to become ready after all topics are connected [s of wall time]."""
FIRST_WAIT_S = 0.2
"""The time for messages that come together with the first message of an output, and for the answer
of a node that may not be initialized yet [s of wall time]."""
CLOCK_INTERVAL_S = 0.05
"""The interval of ``/clock`` until the node is connected [s of wall time]."""


class OutputClient(ExternalProgram):
    """One node with declared outputs; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: the bridge of the node's transport.
        spec: the specification of the node and its outputs.
        timestep: the step of the simulation [s].
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec, *, timestep: float) -> None:
        super().__init__(bridge, spec)
        self._timestep = timestep
        self._n_inputs: Counter[str] = Counter()  # messages on each input topic so far
        self._n_before: Counter[str] = Counter()  # messages of each output that are not counted
        self._n_unanswered: Counter[str] = Counter()  # inputs without an output, by output
        self._due = {output.topic: 0 for output in spec.outputs}
        self._begun_outputs: set[str] = set()  # outputs whose first message has come
        self._wait_times: dict[str, float] = dict.fromkeys(self._due, 0.0)  # [s of wall time]
        self._n_called = 0  # calls of external services before the start
        self._n_sent = 0

    def start(self, node: Node) -> None:
        """Wait until the node has advertised its outputs and subscribed to their inputs.

        Raises:
            NeverStarted: the node has not done so within the limit.
        """
        self._node = node
        bridge, spec = self._bridge, self._spec
        check_outputs(spec.outputs, bridge.bus)
        bridge.clock_topic.period = COARSE_PERIOD  # before each message, others must have arrived
        for output in spec.outputs:
            self._subscribe(output)
        for topic in filter(None, dict.fromkeys(o.input_topic for o in spec.outputs)):
            node.subscribe(topic, object, self._make_counter(topic))
        self._n_called = bridge.external_services.n_called
        bridge.step()
        if not self._wait_with_clock(spec.limit, condition=lambda: not self._missing_connections()):
            faults = "; ".join(self._missing_connections())
            raise NeverStarted(
                f"Client {spec.name!r}: {faults}, within {spec.limit:g} s of wall time "
                "(--client-limit)."
            )
        self._wait_with_clock(READY_WAIT_S, condition=_return_false)
        self._n_before.update(bridge.arrivals.n_arrived)
        node.create_timer(self._timestep, self._barrier)

    def _wait_with_clock(self, limit: float, condition: Callable[[], bool]) -> bool:
        """Wait for a condition and publish the time meanwhile; return whether it holds."""
        n_intervals = math.ceil(limit / CLOCK_INTERVAL_S)
        for _ in range(n_intervals):
            self._bridge.clock_topic.send()
            if self._bridge.wait_for(condition, limit / n_intervals):
                return True
        return False

    def _subscribe(self, output: OutputSpec) -> None:
        """Subscribe to an output, so that transports always read it."""
        bus = self._bridge.bus
        endpoints = bus.endpoints(output.topic)
        assert endpoints is not None
        bus.subscribe(output.topic, endpoints.type, _ignore_message)

    def _make_counter(self, topic: str) -> Callable[[object], None]:
        def count(message: object) -> None:
            self._n_inputs[topic] += 1

        return count

    def _missing_connections(self) -> list[str]:
        """Describe the missing publishers and subscribers of the topics."""
        bridge, outputs = self._bridge, self._spec.outputs
        faults = [
            f"nobody publishes /{o.topic}" for o in outputs if not bridge.has_publisher(o.topic)
        ]
        is_read = bridge.subscribers.is_read
        inputs = filter(None, dict.fromkeys(o.input_topic for o in outputs))
        faults += [f"nobody reads /{name}" for name in inputs if not is_read(name)]
        has_timer = any(o.rate is not None for o in outputs)
        if has_timer and not bridge.clock_topic.is_read:
            faults.append("nobody reads /clock (use_sim_time must be true before the node starts)")
        return faults

    def _barrier(self) -> None:
        """Publish the time, and wait for the outputs that are due."""
        bridge = self._bridge
        due = {output.topic: self._n_due(output) for output in self._spec.outputs}
        if due == self._due and not bridge.clock_topic.is_due:
            return
        n_due_before, self._due = self._due, due
        if bridge.subscribers.n_sent > self._n_sent and self._spec.settle_time:
            bridge.wait_for(_return_false, self._spec.settle_time)
        self._n_sent = bridge.subscribers.n_sent
        bridge.clock_topic.send()
        for output in self._spec.outputs:
            topic, n = output.topic, due[output.topic]
            if output.input_topic is not None and topic not in self._begun_outputs:
                self._await_first(topic, n, has_input=n > n_due_before[topic])
            elif not bridge.wait_for(partial(self._has_arrived, topic, n), self._spec.limit):
                raise self._lost_error(topic)
            elif n > 0 and topic not in self._begun_outputs:
                self._begin(topic, n)
            self._check_excess(topic, n)
        bridge.step()

    def _lost_error(self, topic: str) -> ClientLost:
        return ClientLost(
            f"Client {self.name!r} did not publish on /{topic} what was due at "
            f"{self._node.now:g} s within {self._spec.limit:g} s of wall time "
            "(--client-limit): the run is invalid."
        )

    def _begin(self, topic: str, n_due: int) -> None:
        """Count all messages that come with the first message of an output as ``n_due`` messages.

        A timer of rospy that was created before the first ``/clock`` fires twice at the start.
        """
        self._begun_outputs.add(topic)
        self._bridge.wait_for(_return_false, FIRST_WAIT_S)
        self._n_before[topic] = self._bridge.arrivals.n_arrived[topic] - n_due

    def _await_first(self, topic: str, n_inputs: int, *, has_input: bool) -> None:
        """Wait for the first message of an output that follows an input.

        A node may answer only after it is initialized, as trackers for UWSim (C++) are by their
        service ``autoInit``. Until a service of the node is called, the wait for each answer is
        short; from then on, it is as long as for any output.

        Args:
            topic: the topic of the output.
            n_inputs: the number of inputs so far.
            has_input: True if an input came since the last barrier.

        Raises:
            ClientLost: no answer has come within the limit.
        """
        bridge, limit = self._bridge, self._spec.limit
        is_called = bridge.external_services.n_called > self._n_called
        if has_input:
            wait_s = limit if is_called else min(FIRST_WAIT_S, limit - self._wait_times[topic])
            start_time = time.monotonic()
            bridge.wait_for(partial(self._has_arrived, topic, 1), wait_s)
            self._wait_times[topic] += time.monotonic() - start_time
        if self._has_arrived(topic, 1):
            self._accept_first_answers(topic, n_inputs)
        elif has_input and (is_called or self._wait_times[topic] >= limit):
            raise self._lost_error(topic)

    def _accept_first_answers(self, topic: str, n_inputs: int) -> None:
        """Accept the answers that come now; earlier inputs without an answer stay unanswered."""
        self._begun_outputs.add(topic)
        bridge, start = self._bridge, self._n_before[topic]
        while (n := bridge.arrivals.n_arrived[topic] - start) < n_inputs:
            if not bridge.wait_for(partial(self._has_arrived, topic, n + 1), FIRST_WAIT_S):
                break
        self._n_unanswered[topic] = max(0, n_inputs - n)
        self._n_before[topic] -= self._n_unanswered[topic]

    def _check_excess(self, topic: str, n_due: int) -> None:
        """Raise ClientLost if a node has published outputs that are not due."""
        n = self._bridge.arrivals.n_arrived[topic] - self._n_before[topic]
        if n > n_due + self._n_unanswered[topic]:
            raise ClientLost(
                f"Client {self.name!r} has published {n} messages on /{topic} by "
                f"{self._node.now:g} s, where {n_due} are due: the run is invalid. Check that the "
                "node uses /clock (use_sim_time true before it starts), and the --output."
            )

    def _n_due(self, output: OutputSpec) -> int:
        """Return the number of messages of an output that are due by now."""
        if output.input_topic is not None:
            return self._n_inputs[output.input_topic]
        assert output.rate is not None
        return math.floor(self._node.now * output.rate + 1e-6)

    def _has_arrived(self, topic: str, n: int) -> bool:
        return self._bridge.arrivals.n_arrived[topic] >= self._n_before[topic] + n


def check_outputs(outputs: Sequence[OutputSpec], bus: Bus) -> None:
    """Raise BadSetting if neither scene nor benchmark has a topic of an output."""
    for output in outputs:
        for topic in filter(None, (output.topic, output.input_topic)):
            if bus.endpoints(topic) is None:
                topics = [f"/{name}" for name in bus.topics]
                raise BadSetting(
                    f"--output: neither scene nor benchmark has the topic /{topic}."
                    f"{did_you_mean(f'/{topic}', topics)}"
                )


def _return_false() -> bool:
    return False


def _ignore_message(message: object) -> None:
    """Ignore a message, which is an output of the node."""
