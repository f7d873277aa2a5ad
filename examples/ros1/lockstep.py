"""Lock-step with uwsim for programs of rospy: simulation time waits for the program.

Copy this file next to your program. It needs rospy and std_msgs, and nothing of uwsim.

    class Controller:
        def __init__(self, lockstep):
            self.publish = lockstep.publisher("/g500/twist", TwistStamped)
            lockstep.subscribe("/uwsim/girona500/odom", Odometry, self.on_odometry)
            lockstep.create_timer(0.1, self.command)

    lockstep.run("controller", Controller)

and `uwsim bench BENCHMARK --ros1 --client controller`. Each trial has a new Controller.
Its callbacks run once all messages of a step have arrived: by topic name, then in the order of
arrival; its timers run after them. Messages that they publish take effect in the same step.
Simulation time waits while a service of the program is called.
"""

import json
import os
import threading
import time
import uuid
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
from std_msgs.msg import String

JOIN, TICK, ACK = (f"/uwsim/lockstep/{name}" for name in ("join", "tick", "ack"))
SIMULATOR = "/uwsim"
"""The name of the node of the simulator."""
DEPTH = 1000
RETRY_INTERVAL = 2.0
"""The interval of new subscriptions to unconnected topics, and of joins before a tick [s]."""
POLL_INTERVAL = 0.05
"""The interval of checks of the connections, which change without a notification [s]."""


class LockStep:
    """The interface of an algorithm to the simulation: topics, services, timers and time.

    Args:
        client: the name of the client.
        before_ack: called before each acknowledgement, for example to delay it.
    """

    def __init__(self, client, before_ack=lambda: None):
        self.now = 0.0
        self._client, self._before_ack = client, before_ack
        self._condition = threading.Condition()
        self._callbacks, self._kinds, self._publishers = {}, {}, {}
        self._queues, self._local_messages = {}, []  # by topic; own messages that only it reads
        self._n_arrived, self._n_handled, self._n_published = {}, {}, {}
        self._timers, self._ticks, self._services = [], [], []
        self._subscribers, self._node, self._simulator_topics = {}, None, set()
        self._uri = ""  # XML-RPC address of the simulator's node
        self._id = uuid.uuid4().hex[:8]  # distinguishes two clients of one name
        self._error = None  # the reason of a refusal

    def subscribe(self, topic, kind, callback):
        """Call a callback with each message of a topic."""
        self._callbacks[topic], self._kinds[topic] = callback, kind

    def publisher(self, topic, kind):
        """Return ``publish(message)``."""
        self._publishers[topic] = self._make_publisher(topic, kind)

        def publish(message):
            self._publish(topic, message)

        return publish

    def serve(self, name, kind, handler):
        """Offer a service; simulation time waits during a call."""

        def answer(request):
            response = handler(request)
            while not rospy.is_shutdown() and not self._has_arrived():
                rospy.rostime.wallsleep(0.001)
            return response

        self._services.append(rospy.Service(name, kind, answer))

    def create_timer(self, period, callback):
        """Call a callback every ``period`` [s] of simulation time, from the start on."""
        self._timers.append([period, 0, callback])

    def take_part(self):
        """Join, and answer ticks until the simulation leaves."""
        join, ack = self._make_publisher(JOIN, String), self._make_publisher(ACK, String)
        self._subscribe(TICK, String, self._on_tick)
        for topic in sorted(set(self._callbacks) - set(self._publishers)):
            self._add_queue(topic)
            self._subscribe(topic, self._kinds[topic], self._make_receiver(topic))
        publishers = {**self._publishers, JOIN: join, ACK: ack}
        while not self._ticks:
            if not self._connect(publishers):
                return
            local_topics = sorted(set(self._callbacks) & set(self._n_published))
            for topic in set(local_topics) - set(self._queues):
                self._add_queue(topic)
            secret = os.environ.get("UWSIM_CLIENT_SECRET")  # if the simulation has one
            secret_fields = {"secret": secret} if secret else {}
            self._publish_json(
                join,
                topics=list(self._queues),
                own=local_topics,
                next=self._next(),
                **secret_fields,
            )
            # The join may have reached a trial that ends.
            self._wait(lambda: self._ticks, RETRY_INTERVAL)
        # The connection of the next trial may exist before rospy drops that of this one.
        connections = list(self._subscribers[TICK].impl.connections)
        while self._wait(lambda: self._is_complete() or self._has_left(connections)):
            if not self._is_complete():
                break
            self._answer(ack)
        if not rospy.is_shutdown() and self._was_killed():
            raise SystemExit(f"{self._client}: the simulation terminated unexpectedly.")
        for end in (*publishers.values(), *self._subscribers.values()):
            end.unregister()
        for service in self._services:
            service.shutdown()

    def _answer(self, ack):
        with self._condition:
            tick = self._ticks.pop(0)
            batches = []
            for topic, n in sorted(_absolute_names(tick["sent"]).items()):
                n -= self._n_handled[topic]
                batches.append((topic, self._queues[topic][:n]))
                del self._queues[topic][:n]
                self._n_handled[topic] += n
        self.now = tick["time"]
        for topic, messages in batches:
            for message in messages:
                self._call(topic, message)
        for timer in self._timers:
            if self.now >= _due(timer):
                timer[1] += 1
                timer[2]()
                self._call_local()
        self._before_ack()
        self._publish_json(ack, tick=tick["tick"], published=self._n_published, next=self._next())

    def _call(self, topic, message):
        self._callbacks[topic](message)
        self._call_local()

    def _call_local(self):
        """Run the callbacks of own messages that the program also reads."""
        while self._local_messages:
            topic, message = self._local_messages.pop(0)
            self._callbacks[topic](message)

    def _publish(self, topic, message):
        """Publish a message; one that the program also reads returns with the simulation's tick."""
        if topic in self._queues:
            self._make_receiver(topic)(message)
        elif topic in self._callbacks:
            self._local_messages.append((topic, message))
        if topic in self._n_published:
            self._n_published[topic] += 1
        self._publishers[topic].publish(message)

    def _connect(self, publishers):
        """Wait until all topics are connected; return False at the end of the program.

        rospy may apply an answer of the master after a newer update, and then waits forever for a
        publisher that it has removed. A new subscription repairs this.
        """
        while not self._wait(lambda: self._is_connected(publishers), RETRY_INTERVAL):
            if rospy.is_shutdown():
                return False
            for topic in self._unconnected_topics():
                subscriber = self._subscribers[topic]
                kind, receive = subscriber.data_class, subscriber.callback
                subscriber.unregister()
                self._subscribe(topic, kind, receive)
        return True

    def _is_connected(self, publishers):
        """Return True if each topic shared with the simulation has a connection."""
        try:
            uri = rosgraph.Master(rospy.get_name()).lookupNode(SIMULATOR)
            self._node, self._uri = ServerProxy(uri), uri
            published_topics = {topic for topic, _ in self._node.getPublications("/x")[2]}
            subscribed_topics = {topic for topic, _ in self._node.getSubscriptions("/x")[2]}
        except (OSError, rosgraph.MasterException):
            return False
        if TICK not in published_topics:
            return False
        self._simulator_topics = published_topics
        self._n_published = {topic: 0 for topic in self._publishers if topic in subscribed_topics}
        return not self._unconnected_topics() and all(
            end.get_num_connections()
            for topic, end in publishers.items()
            if topic in subscribed_topics
        )

    def _unconnected_topics(self):
        """Return the subscribed topics of the simulation that have no connection."""
        return [
            topic
            for topic, subscriber in self._subscribers.items()
            if subscriber.resolved_name in self._simulator_topics
            and not subscriber.get_num_connections()
        ]

    def _has_arrived(self):
        """Return True if the simulation has received all published messages."""
        if self._node is None or not any(self._n_published.values()):
            return True
        counts = _absolute_names(self._node.getArrived("/x")[2])
        return all(counts.get(topic, 0) >= n for topic, n in self._n_published.items())

    def _add_queue(self, topic):
        self._queues[topic], self._n_arrived[topic], self._n_handled[topic] = [], 0, 0

    def _is_complete(self):
        """Return True if a tick and all messages sent before it have arrived."""
        counts = _absolute_names(self._ticks[0]["sent"]) if self._ticks else {}
        return bool(self._ticks) and all(self._n_arrived[topic] >= n for topic, n in counts.items())

    def _wait(self, condition, timeout=float("inf")):
        """Wait until a condition holds; return False at the end of the program or after timeout."""
        end = time.monotonic() + timeout
        with self._condition:
            while not condition():
                if self._error is not None:
                    raise SystemExit(f"{self._client}: {self._error}")
                if rospy.is_shutdown() or time.monotonic() > end:
                    return False
                self._condition.wait(POLL_INTERVAL)
        return True

    def _on_tick(self, message):
        tick = json.loads(message.data)
        if tick.get("client") == self._client:
            with self._condition:
                if "error" in tick:
                    if (
                        tick.get("id") == self._id
                    ):  # otherwise the error is of another client of this name
                        self._error = tick["error"]
                else:
                    self._ticks.append(tick)
                self._condition.notify()

    def _make_receiver(self, topic):
        def receive(message):
            with self._condition:
                self._queues[topic].append(message)
                self._n_arrived[topic] += 1
                self._condition.notify()

        return receive

    def _has_left(self, connections):
        """Return True if none of these connections exists any more."""
        return not any(
            connection in connections for connection in self._subscribers[TICK].impl.connections
        )

    def _was_killed(self):
        """Return True if the simulation is registered, but does not respond."""
        if not self._is_registered():
            return False  # it unregistered, or its own master ended with it
        try:
            ServerProxy(self._uri).getPid("/x")
        except OSError:
            return self._is_registered()  # it may have unregistered since
        return False

    def _is_registered(self):
        try:
            return rosgraph.Master(rospy.get_name()).lookupNode(SIMULATOR) == self._uri
        except (OSError, rosgraph.MasterException):
            return False

    def _next(self):
        times = [_due(timer) for timer in self._timers]
        return max(0.0, min(times)) if times else None

    def _subscribe(self, topic, kind, receive):
        def receive_from_simulator(message):
            """Drop messages of other nodes on topics of the simulation."""
            sender = message._connection_header["callerid"]
            is_simulators = (
                not self._simulator_topics or rospy.resolve_name(topic) in self._simulator_topics
            )
            if sender == SIMULATOR or not is_simulators:
                receive(message)

        subscriber = rospy.Subscriber(
            topic, kind, receive_from_simulator, queue_size=None, tcp_nodelay=True
        )
        self._subscribers[topic] = subscriber

    def _make_publisher(self, topic, kind):
        return rospy.Publisher(topic, kind, queue_size=DEPTH, tcp_nodelay=True)

    def _publish_json(self, publisher, **content):
        publisher.publish(
            String(data=json.dumps({"client": self._client, "id": self._id, **content}))
        )


def _due(timer):
    period, n, _ = timer
    return n * period - 1e-9 * period


def _absolute_names(counts):
    return {"/" + topic.lstrip("/"): n for topic, n in counts.items()}


def run(client, algorithm, before_ack=lambda: None, trials=None):
    """Take part in all trials, until the program ends.

    Args:
        client: the name of `uwsim bench --client`.
        algorithm: called with a LockStep for each trial.
        before_ack: called before each acknowledgement.
        trials: the number of trials; None for no limit.
    """
    if not rospy.core.is_initialized():
        rospy.init_node(client)
    n = 0
    while not rospy.is_shutdown() and (trials is None or n < trials):
        lockstep = LockStep(client, before_ack)
        algorithm(lockstep)
        lockstep.take_part()
        n += 1
