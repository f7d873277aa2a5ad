"""A node that knows nothing of lock-step: time waits for the outputs that are due.

The node works by the clock of the simulation and by what it reads, as any node with
``use_sim_time``. At the end of each step, in two phases (topics are not ordered relative to each
other in ROS): what was published is sent and has time to arrive, then ``/clock`` goes out, and
simulation time stands until the outputs that were declared for this step are there. They are put
on the bus in the same step.

An output that follows an input is due from its first message on: trackers of the original's kind
publish nothing until they are initialised.

That what was sent has arrived is not known of such a node, only likely: over ROS its results are
marked as not guaranteed.
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

STAND_S = 1.0
"""How long time stands when both ends of all topics are there, until the node is ready [s of wall
time]."""
FIRST_S = 0.2
"""How long what comes with the first message of an output may take, and how long a node that is not
initialised yet may take to answer [s of wall time]."""
GLANCE_S = 0.05
"""How often ``/clock`` is sent while a node has not come yet [s of wall time]."""


class OutputClient(ExternalProgram):
    """One node; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: to the transport by which it comes.
        spec: names the outputs.
        timestep: of the simulation [s].
    """

    def __init__(self, bridge: Bridge, spec: ClientSpec, *, timestep: float) -> None:
        super().__init__(bridge, spec)
        self._timestep = timestep
        self._n_given: Counter[str] = Counter()  # messages of the topics that outputs follow
        self._before: Counter[str] = Counter()  # outputs that came while time stood at the start
        self._unanswered: Counter[str] = Counter()  # inputs that an output has not followed
        self._due = {output.topic: 0 for output in spec.outputs}
        self._begun: set[str] = set()  # outputs of which one was due already
        self._waited: dict[str, float] = dict.fromkeys(self._due, 0.0)  # for first ones [s of wall]
        self._n_called = 0  # calls of services outside before the start
        self._n_sent = 0

    def start(self, node: Node) -> None:
        """Wait until the node publishes its outputs and reads what they follow.

        Raises:
            NeverStarted: it did not within the limit.
        """
        self._node = node
        bridge, spec = self._bridge, self._spec
        check_outputs(spec.outputs, bridge.bus)
        bridge.clock_topic.period = COARSE_PERIOD  # each message waits for what was sent before it
        for output in spec.outputs:
            self._read(output)
        for topic in dict.fromkeys(o.follows for o in spec.outputs if o.follows is not None):
            node.subscribe(topic, object, self._counter(topic))
        self._n_called = bridge.external_services.n_called
        bridge.step()
        if not self._stand(spec.limit, until=lambda: not self._missing()):
            raise NeverStarted(
                f"Client {spec.name!r}: {'; '.join(self._missing())}, within {spec.limit:g} s of "
                "wall time (--client-limit)."
            )
        self._stand(STAND_S, until=_never)
        self._before.update(bridge.arrivals.n_arrived)
        node.create_timer(self._timestep, self._barrier)

    def _stand(self, limit: float, until: Callable[[], bool]) -> bool:
        """Wait for something, and tell the time meanwhile; returns whether it came."""
        n_glances = math.ceil(limit / GLANCE_S)
        for _ in range(n_glances):
            self._bridge.clock_topic.send()
            if self._bridge.wait_for(until, limit / n_glances):
                return True
        return False

    def _read(self, output: OutputSpec) -> None:
        """Read an output, so that transports do so all the time."""
        bus = self._bridge.bus
        ends = bus.ends(output.topic)
        assert ends is not None
        bus.subscribe(output.topic, ends.type, _nothing)

    def _counter(self, topic: str) -> Callable[[object], None]:
        def count(message: object) -> None:
            self._n_given[topic] += 1

        return count

    def _missing(self) -> list[str]:
        """Say which ends of the topics are not there."""
        bridge, outputs = self._bridge, self._spec.outputs
        nobody = [
            f"nobody publishes /{o.topic}" for o in outputs if not bridge.has_publisher(o.topic)
        ]
        inputs = dict.fromkeys(o.follows for o in outputs if o.follows is not None)
        nobody += [
            f"nobody reads /{name}"
            for name in inputs
            if not bridge.external_subscribers.is_read(name)
        ]
        has_timer = any(o.rate is not None for o in outputs)
        if has_timer and not bridge.clock_topic.is_read:
            nobody.append("nobody reads /clock (use_sim_time must be true before the node starts)")
        return nobody

    def _barrier(self) -> None:
        """Tell the time, and wait for the outputs that are due."""
        bridge = self._bridge
        due = {output.topic: self._n_due(output) for output in self._spec.outputs}
        if due == self._due and not bridge.clock_topic.is_due:
            return
        before, self._due = self._due, due
        if bridge.external_subscribers.n_sent > self._n_sent and self._spec.settling:
            bridge.wait_for(_never, self._spec.settling)
        self._n_sent = bridge.external_subscribers.n_sent
        bridge.clock_topic.send()
        for output in self._spec.outputs:
            topic, n = output.topic, due[output.topic]
            if output.follows is not None and topic not in self._begun:
                self._await_first(topic, n, has_input=n > before[topic])
            elif not bridge.wait_for(partial(self._has_arrived, topic, n), self._spec.limit):
                raise self._lost(topic)
            elif n > 0 and topic not in self._begun:
                self._begin(topic, n)
            self._refuse_more(topic, n)
        bridge.step()

    def _lost(self, topic: str) -> ClientLost:
        return ClientLost(
            f"Client {self.name!r} did not publish on /{topic} what was due at "
            f"{self._node.now:g} s within {self._spec.limit:g} s of wall time "
            "(--client-limit): the run is invalid."
        )

    def _begin(self, topic: str, n_due: int) -> None:
        """Take for due all that comes with the first of an output.

        A timer of rospy that was made before the first ``/clock`` fires twice then.
        """
        self._begun.add(topic)
        self._bridge.wait_for(_never, FIRST_S)
        self._before[topic] = self._bridge.arrivals.n_arrived[topic] - n_due

    def _await_first(self, topic: str, n_given: int, *, has_input: bool) -> None:
        """Wait for the first message of an output that follows an input.

        A node may begin to answer only when it is initialised, as the original's trackers by their
        service ``autoInit``: until a service of the node is called, each input is waited for a
        short time only, and from then on as long as for any output.

        Args:
            topic: of the output.
            n_given: inputs so far.
            has_input: whether one of them came since the last barrier.

        Raises:
            ClientLost: there is still no answer, and the limit has passed.
        """
        bridge, limit = self._bridge, self._spec.limit
        is_called = bridge.external_services.n_called > self._n_called
        if has_input:
            left = limit if is_called else min(FIRST_S, limit - self._waited[topic])
            began = time.monotonic()
            bridge.wait_for(partial(self._has_arrived, topic, 1), left)
            self._waited[topic] += time.monotonic() - began
        if self._has_arrived(topic, 1):
            self._begin_to_follow(topic, n_given)
        elif has_input and (is_called or self._waited[topic] >= limit):
            raise self._lost(topic)

    def _begin_to_follow(self, topic: str, n_given: int) -> None:
        """Take in what is answered now; inputs that remain without an answer never have one."""
        self._begun.add(topic)
        bridge, start = self._bridge, self._before[topic]
        while (n := bridge.arrivals.n_arrived[topic] - start) < n_given:
            if not bridge.wait_for(partial(self._has_arrived, topic, n + 1), FIRST_S):
                break
        self._unanswered[topic] = max(0, n_given - n)
        self._before[topic] -= self._unanswered[topic]

    def _refuse_more(self, topic: str, n_due: int) -> None:
        """Refuse outputs that are not due; raises ClientLost."""
        n = self._bridge.arrivals.n_arrived[topic] - self._before[topic]
        if n > n_due + self._unanswered[topic]:
            raise ClientLost(
                f"Client {self.name!r} has published {n} messages on /{topic} by "
                f"{self._node.now:g} s, where {n_due} are due: the run is invalid. Does it go by "
                "/clock (use_sim_time true before it starts), and is the --output right?"
            )

    def _n_due(self, output: OutputSpec) -> int:
        """How many messages of an output are due by now."""
        if output.follows is not None:
            return self._n_given[output.follows]
        assert output.rate is not None
        return math.floor(self._node.now * output.rate + 1e-6)

    def _has_arrived(self, topic: str, n: int) -> bool:
        return self._bridge.arrivals.n_arrived[topic] >= self._before[topic] + n


def check_outputs(outputs: Sequence[OutputSpec], bus: Bus) -> None:
    """Raise BadSetting if scene and benchmark have nothing to do with a topic of an output."""
    for output in outputs:
        for topic in filter(None, (output.topic, output.follows)):
            if bus.ends(topic) is None:
                known = [f"/{each}" for each in bus.topics]
                raise BadSetting(
                    f"--output: neither scene nor benchmark has the topic /{topic}."
                    f"{did_you_mean(f'/{topic}', known)}"
                )


def _never() -> bool:
    return False


def _nothing(message: object) -> None:
    """Read by the node's outputs."""
