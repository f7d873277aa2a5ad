"""Lock-step with uwsim for programs of rospy: simulation time waits for what they compute.

Copy this file next to your program. It needs rospy and std_msgs, and nothing of uwsim.

    class Controller:
        def __init__(self, lockstep):
            self.publish = lockstep.publisher("/g500/twist", TwistStamped)
            lockstep.subscribe("/uwsim/girona500/odom", Odometry, self.on_odometry)
            lockstep.every(0.1, self.command)

    lockstep.run("controller", Controller)

and `uwsim bench BENCHMARK --ros1 --client controller`. For each trial there is a new Controller.
Its callbacks are called by topic name and then in the order of arrival, once all messages of a step
are there, then its timers; what they publish takes effect in the same step. Simulation time stands
while a service of the program is called.
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
"""Name of the node."""
DEPTH = 1000
PATIENCE = 2.0
"""How often it subscribes again to what stays unconnected, and joins until it is ticked [s]."""
GLANCE = 0.05
"""How often connections are looked at; they come and go without a notice [s]."""


class LockStep:
    """What an algorithm sees of the simulation.

    Args:
        client: its name.
        before_ack: called before each answer; a test lets it sleep.
    """

    def __init__(self, client, before_ack=lambda: None):
        self.now = 0.0
        self._client, self._before_ack = client, before_ack
        self._news = threading.Condition()
        self._callbacks, self._kinds, self._publishers = {}, {}, {}
        self._waiting, self._own = {}, []  # messages by topic; its own that only it reads
        self._arrived, self._handled, self._published = {}, {}, {}
        self._timers, self._ticks, self._services = [], [], []
        self._readers, self._node, self._sent = {}, None, set()
        self._uri = ""  # of the simulation's node
        self._id = uuid.uuid4().hex[:8]  # of two of one name one is heard
        self._error = None  # what the simulation has refused

    def subscribe(self, topic, kind, callback):
        """Have a callback called with each message of a topic."""
        self._callbacks[topic], self._kinds[topic] = callback, kind

    def publisher(self, topic, kind):
        """Return ``publish(message)``."""
        self._publishers[topic] = self._out(topic, kind)

        def publish(message):
            self._publish(topic, message)

        return publish

    def serve(self, name, kind, handler):
        """Offer a service; simulation time stands while it is called."""

        def answer(request):
            response = handler(request)
            while not rospy.is_shutdown() and not self._has_arrived():
                rospy.rostime.wallsleep(0.001)
            return response

        self._services.append(rospy.Service(name, kind, answer))

    def every(self, period, callback):
        """Have a callback called every ``period`` [s] of simulation time, from the start on."""
        self._timers.append([period, 0, callback])

    def take_part(self):
        """Join, and answer ticks until the simulation leaves."""
        join, ack = self._out(JOIN, String), self._out(ACK, String)
        self._in(TICK, String, self._on_tick)
        for topic in sorted(set(self._callbacks) - set(self._publishers)):
            self._expect(topic)
            self._in(topic, self._kinds[topic], self._receiver(topic))
        outs = {**self._publishers, JOIN: join, ACK: ack}
        while not self._ticks:
            if not self._connect(outs):
                return
            own = sorted(set(self._callbacks) & set(self._published))
            for topic in set(own) - set(self._waiting):
                self._expect(topic)
            secret = os.environ.get("UWSIM_CLIENT_SECRET")  # if the simulation was given one
            has = {"secret": secret} if secret else {}
            self._say(join, topics=list(self._waiting), own=own, next=self._next(), **has)
            # this may have gone to a trial that ends
            self._wait(lambda: self._ticks, PATIENCE)
        # that of the next trial may be there before rospy has dropped that of this one
        simulator = list(self._readers[TICK].impl.connections)
        while self._wait(lambda: self._is_complete() or self._has_left(simulator)):
            if not self._is_complete():
                break
            self._answer(ack)
        if not rospy.is_shutdown() and self._was_killed():
            raise SystemExit(f"{self._client}: the simulation is gone without having ended.")
        for end in (*outs.values(), *self._readers.values()):
            end.unregister()
        for service in self._services:
            service.shutdown()

    def _answer(self, ack):
        with self._news:
            tick = self._ticks.pop(0)
            batches = []
            for topic, n in sorted(_slashed(tick["sent"]).items()):
                n -= self._handled[topic]
                batches.append((topic, self._waiting[topic][:n]))
                del self._waiting[topic][:n]
                self._handled[topic] += n
        self.now = tick["time"]
        for topic, messages in batches:
            for message in messages:
                self._call(topic, message)
        for timer in self._timers:
            if self.now >= _due(timer):
                timer[1] += 1
                timer[2]()
                self._call_own()
        self._before_ack()
        self._say(ack, tick=tick["tick"], published=self._published, next=self._next())

    def _call(self, topic, message):
        self._callbacks[topic](message)
        self._call_own()

    def _call_own(self):
        """Have what it published itself and reads called back."""
        while self._own:
            topic, message = self._own.pop(0)
            self._callbacks[topic](message)

    def _publish(self, topic, message):
        """Send a message; one that it reads itself comes back with the simulation's tick."""
        if topic in self._waiting:
            self._receiver(topic)(message)
        elif topic in self._callbacks:
            self._own.append((topic, message))
        if topic in self._published:
            self._published[topic] += 1
        self._publishers[topic].publish(message)

    def _connect(self, outs):
        """Wait until all is connected; False at the end of the program.

        rospy may apply an answer of the master after news that are younger than it, and then waits
        for ever for a publisher that it has forgotten.
        """
        while not self._wait(lambda: self._is_connected(outs), PATIENCE):
            if rospy.is_shutdown():
                return False
            for topic in self._unconnected():
                reader = self._readers[topic]
                kind, receive = reader.data_class, reader.callback
                reader.unregister()
                self._in(topic, kind, receive)
        return True

    def _is_connected(self, outs):
        """Whether each topic that it shares with the simulation has a connection."""
        try:
            uri = rosgraph.Master(rospy.get_name()).lookupNode(SIMULATOR)
            self._node, self._uri = ServerProxy(uri), uri
            sends = {topic for topic, _ in self._node.getPublications("/x")[2]}
            reads = {topic for topic, _ in self._node.getSubscriptions("/x")[2]}
        except (OSError, rosgraph.MasterException):
            return False
        if TICK not in sends:
            return False
        self._sent = sends
        self._published = {topic: 0 for topic in self._publishers if topic in reads}
        return not self._unconnected() and all(
            end.get_num_connections() for topic, end in outs.items() if topic in reads
        )

    def _unconnected(self):
        """What it subscribes to and the simulation sends, without a connection."""
        return [
            topic
            for topic, reader in self._readers.items()
            if reader.resolved_name in self._sent and not reader.get_num_connections()
        ]

    def _has_arrived(self):
        """Whether the simulation has all that was published."""
        if self._node is None or not any(self._published.values()):
            return True
        arrived = _slashed(self._node.getArrived("/x")[2])
        return all(arrived.get(topic, 0) >= n for topic, n in self._published.items())

    def _expect(self, topic):
        self._waiting[topic], self._arrived[topic], self._handled[topic] = [], 0, 0

    def _is_complete(self):
        """Whether there is a tick, and all messages that were sent before it."""
        sent = _slashed(self._ticks[0]["sent"]) if self._ticks else {}
        return bool(self._ticks) and all(self._arrived[topic] >= n for topic, n in sent.items())

    def _wait(self, condition, patience=float("inf")):
        """Wait until a condition holds; False at the end of the program, or of patience [s]."""
        end = time.monotonic() + patience
        with self._news:
            while not condition():
                if self._error is not None:
                    raise SystemExit(f"{self._client}: {self._error}")
                if rospy.is_shutdown() or time.monotonic() > end:
                    return False
                self._news.wait(GLANCE)
        return True

    def _on_tick(self, message):
        tick = json.loads(message.data)
        if tick.get("client") == self._client:
            with self._news:
                if "error" in tick:
                    if tick.get("id") == self._id:  # else another of this name is meant
                        self._error = tick["error"]
                else:
                    self._ticks.append(tick)
                self._news.notify()

    def _receiver(self, topic):
        def receive(message):
            with self._news:
                self._waiting[topic].append(message)
                self._arrived[topic] += 1
                self._news.notify()

        return receive

    def _has_left(self, simulator):
        """Whether none of these connections is there any more."""
        return not any(each in simulator for each in self._readers[TICK].impl.connections)

    def _was_killed(self):
        """Whether the simulation that ticked it is still registered, and not there."""
        if not self._is_registered():
            return False  # it has left the graph, or a master of its own has gone with it
        try:
            ServerProxy(self._uri).getPid("/x")
        except OSError:
            return self._is_registered()  # it may have been leaving just then
        return False

    def _is_registered(self):
        try:
            return rosgraph.Master(rospy.get_name()).lookupNode(SIMULATOR) == self._uri
        except (OSError, rosgraph.MasterException):
            return False

    def _next(self):
        times = [_due(timer) for timer in self._timers]
        return max(0.0, min(times)) if times else None

    def _in(self, topic, kind, receive):
        def of_its_sender(message):
            """Drop what another node sends on a topic of the simulation's."""
            sender = message._connection_header["callerid"]
            is_simulators = not self._sent or rospy.resolve_name(topic) in self._sent
            if sender == SIMULATOR or not is_simulators:
                receive(message)

        reader = rospy.Subscriber(topic, kind, of_its_sender, queue_size=None, tcp_nodelay=True)
        self._readers[topic] = reader

    def _out(self, topic, kind):
        return rospy.Publisher(topic, kind, queue_size=DEPTH, tcp_nodelay=True)

    def _say(self, out, **content):
        out.publish(String(data=json.dumps({"client": self._client, "id": self._id, **content})))


def _due(timer):
    period, n, _ = timer
    return n * period - 1e-9 * period


def _slashed(counts):
    return {"/" + topic.lstrip("/"): n for topic, n in counts.items()}


def run(client, algorithm, before_ack=lambda: None, trials=None):
    """Take part in trial after trial, until the program is ended.

    Args:
        client: the name that `uwsim bench --client` has.
        algorithm: called with a LockStep for each trial.
        before_ack: called before each answer.
        trials: how many; None for no end.
    """
    if not rospy.core.is_initialized():
        rospy.init_node(client)
    n = 0
    while not rospy.is_shutdown() and (trials is None or n < trials):
        lockstep = LockStep(client, before_ack)
        algorithm(lockstep)
        lockstep.take_part()
        n += 1
