"""An external program in lock-step as an algorithm: the simulation waits for it after each step."""

from __future__ import annotations

import hmac
import json
import math
import secrets
import sys
import time
from collections import Counter, deque
from collections.abc import Sequence
from functools import partial
from typing import Any

from ...base.peer_json import read_peer_json
from ...bus import Node
from ...errors import BadMessage, BadSetting, ClientLost, NeverStarted
from ...messages import Empty, String
from ...messages.services import Service
from ..admission import Refusal
from ..bridge import Bridge
from ..json_encoding import from_json, to_json
from ..stamps import to_ros_time, to_sim_time
from ..types import message_class, service
from .contract import answer_error, join_error, names_in, object_in, reply_error
from .topics import ACK, JOIN, TICK

MAX_WAITING = 100
"""The maximum number of joins and answers that wait; the newest are kept."""
MAX_LENGTH = 2**20
"""The maximum length of a join or an answer [characters]."""
MAX_ID_LENGTH = 100
"""The number of characters of an ``id`` that a refusal repeats."""
SECRET_ERROR = "secret is missing or another; expected that of UWSIM_CLIENT_SECRET"
"""The error of a join without the secret."""
MAX_TICKS = 1000
"""The maximum number of ticks in one step; a client whose answers cause new ticks exceeds it."""


class LockStepClient:
    """One client in lock-step; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: the bridge of the client's transport.
        name: the name under which the client joins.
        timestep: the step of the simulation [s].
        limit: the time limit for joining, and for answering a tick [s of wall time].
        secret: the secret that the join must have; None: no secret.
    """

    def __init__(
        self, bridge: Bridge, name: str, *, timestep: float, limit: float, secret: str | None = None
    ) -> None:
        self._bridge, self._name, self._timestep, self._limit = bridge, name, timestep, limit
        self._secret = secret
        self._joins: deque[tuple[dict[str, Any], str]] = deque(maxlen=MAX_WAITING)
        self._sender = ""  # the sender that has joined, if the transport distinguishes senders
        self._id: object = None  # the id in the join, if it has one
        self._has_joined = self._takes_part = False
        self._acks: deque[dict[str, Any]] = deque(maxlen=MAX_WAITING)
        self._replies: dict[int, dict[str, Any]] = {}
        self._n_sent: Counter[str] = Counter()
        self._order: list[str] = []  # the topic of each message since the last tick
        self._other_tick: object = None  # the last answered tick that was not the current one
        self._is_due, self._next_time = False, math.inf
        self._n_ticks = self._n_calls = 0
        self._run = secrets.token_hex(8)  # identifies the simulation; not in any result

    @property
    def name(self) -> str:
        """The name of the client."""
        return self._name

    def start(self, node: Node) -> None:
        """Wait until the client has joined, and subscribe to its topics.

        Raises:
            NeverStarted: the client did not join within the limit.
        """
        self._node = node
        bridge = self._bridge
        bridge.step()
        if bridge.traits.needs_invitation:
            invitation = {"client": self._name, "tick": 0, "run": self._run}
            bridge.send(TICK, String(data=json.dumps(invitation)))
        join = self._wait_for_join()
        self._store_next_time(join)
        self._connect(join)
        node.create_timer(self._timestep, self._barrier)

    def _wait_for_join(self) -> dict[str, Any]:
        """Wait for a valid join; refuse invalid joins.

        Raises:
            NeverStarted: there was no valid join within the limit.
        """
        deadline, error = time.monotonic() + self._limit, None
        while self._bridge.wait_for(lambda: bool(self._joins), deadline - time.monotonic()):
            content, sender = self._joins.popleft()
            leave = {"client": content["client"], "left": True}
            if content.get("left") or (leave, sender) in self._joins:
                continue  # the sender left before it could take part
            error = join_error(content, self._bridge.bus)
            if error is None:
                self._id, self._sender, self._has_joined = content.get("id"), sender, True
                if self._bridge.admission is not None:
                    self._bridge.admission.admit(sender)
                for other, other_sender in tuple(self._joins):
                    if self._is_other(other, other_sender):
                        self._reject_other(JOIN, other, other_sender)
                return content
            self._refuse("join", error, sender, content.get("id"))
        raise NeverStarted(
            f"No client {self._name!r} has joined within {self._limit:g} s of wall time "
            f"(--client-limit){f'; its join was refused: {error}' if error else ''}."
        )

    def _refuse(self, kind: str, error: str, sender: str, client_id: object) -> None:
        """Report a refusal to the sender and to the log.

        If the transport cannot send to one program only, the awaited program receives the refusal,
        too, and recognizes by the ``id`` that it is for another program.
        """
        text = f"its {kind} was refused: {error}"
        self._bridge.log.report(f"client {self._name!r}{f' ({sender})' if sender else ''}: {text}")
        address = {"client": self._name, "run": self._run}
        if isinstance(client_id, str):
            address["id"] = client_id[:MAX_ID_LENGTH]
        self._bridge.send_to(sender, TICK, String(data=json.dumps({**address, "error": text})))
        self._bridge.report_error(sender, f"client {self._name!r}: {text}")

    def _connect(self, join: dict[str, Any]) -> None:
        """Subscribe to the topics that the client reads, and to those that it will publish."""
        bridge, topics = self._bridge, names_in(join, "topics")
        publications = object_in(join, "publishes")
        for topic, kind in publications.items():
            bridge.read_all(topic)
            bridge.bus.subscribe(topic, message_class(kind), _ignore_message)
        for name, kind in object_in(join, "services").items():
            offer = service(kind)
            self._node.serve(name, offer.request, partial(self._call_client, name, offer))
        bridge.step()
        # the client need not receive the messages that it publishes itself
        own_topics = {topic.lstrip("/") for topic in (*publications, *names_in(join, "own"))}
        read_topics = (topic.lstrip("/") for topic in topics if topic.lstrip("/") not in own_topics)
        awaited_topics = [TICK, *filter(self._is_sent, read_topics)]
        if not bridge.wait_for(
            lambda: (
                not bridge.traits.needs_discovery
                or all(map(bridge.subscribers.is_read, awaited_topics))
            ),
            self._limit,
        ):
            raise NeverStarted(
                f"Client {self._name!r} has joined, and does not subscribe to all of its topics."
            )
        for topic in topics:
            self._node.subscribe(topic, object, self._make_counter(topic))

    def _is_sent(self, topic: str) -> bool:
        endpoints = self._bridge.bus.endpoints(topic, ignored_owner=self._bridge)
        return endpoints is not None and endpoints.is_published

    @property
    def parameters(self) -> dict[str, float | str]:
        """The parameters, which are empty: the client has its own parameters."""
        return {}

    def pop_refusals(self) -> tuple[Refusal, ...]:
        """Return the refusals since the last call: programs that do not take part have tried to."""
        admission = self._bridge.admission
        return () if admission is None else admission.pop_refusals()

    def receive(self, topic: str, content: dict[str, Any], sender: str) -> None:
        """Accept a message of the client on a topic of lock-step. May be called from any thread.

        Messages of another ``sender`` with the same name, and answers before the join, are ignored.
        """
        if content.get("run", self._run) != self._run:
            return  # a message to an earlier simulation
        if self._is_other(content, sender):
            self._reject_other(topic, content, sender)
        elif topic == JOIN:
            if not content.get("left") and not self._has_secret(content):
                self._refuse("join", SECRET_ERROR, sender, content.get("id"))
            elif not self._takes_part or content.get("left"):
                self._joins.append((content, sender))
        elif not self._has_joined:
            self._bridge.log.report(f"client {self._name!r}: an answer before its join is ignored")
        elif "call" in content:
            if content["call"] == self._n_calls or reply_error(content):
                self._replies[self._n_calls] = content
        else:
            self._acks.append(content)

    def _is_other(self, content: dict[str, Any], sender: str) -> bool:
        """Return whether the sender is another program than the one that has joined."""
        if sender and self._sender and sender != self._sender:
            return True
        client_id, is_from_connection = content.get("id"), bool(sender) and content.get("left")
        return self._id is not None and client_id != self._id and not is_from_connection

    def _has_secret(self, content: dict[str, Any]) -> bool:
        if self._secret is None:
            return True
        secret = content.get("secret")
        is_text = isinstance(secret, str)
        return is_text and hmac.compare_digest(str(secret).encode(), self._secret.encode())

    def _reject_other(self, topic: str, content: dict[str, Any], sender: str) -> None:
        """Report, to the program and the log, that another program of the name is ignored."""
        if not content.get("left"):
            if self._bridge.admission is not None:
                self._bridge.admission.refuse(sender, f"/{topic}")
            owner, other = self._sender or "another program", sender or "a second one"
            text = f"client {self._name!r} is {owner} already; {other} is ignored"
            self._bridge.log.report(text)
            self._bridge.report_error(sender, text)

    def _make_counter(self, topic: str) -> Any:
        def count(message: object) -> None:
            self._n_sent[topic] += 1
            self._order.append(topic)
            self._is_due = True

        return count

    def _barrier(self) -> None:
        """Send a tick if one is due, and wait for the answer."""
        if self._node.now - self._next_time >= -1e-9 * self._timestep:
            self._is_due, self._next_time = True, math.inf
        for _ in range(MAX_TICKS):
            if not self._is_due:
                return
            self._is_due = False
            self._tick()
        raise ClientLost(
            f"Client {self._name!r} causes its own ticks without end: more than {MAX_TICKS} in one "
            "step."
        )

    def _tick(self) -> None:
        bridge, now = self._bridge, self._node.now
        self._n_ticks += 1
        number = self._n_ticks
        address = {"client": self._name, "run": self._run}
        order, self._order, self._other_tick = self._order, [], None
        tick = {**address, "tick": number, "time": now, "sent": dict(self._n_sent), "order": order}
        bridge.send(TICK, String(data=json.dumps(tick)))
        if not bridge.wait_for(lambda: self._is_answered(number), self._limit):
            raise ClientLost(
                f"Client {self._name!r} did not answer the tick at {now:g} s within "
                f"{self._limit:g} s of wall time (--client-limit){self._describe_other(number)}: "
                "the run is invalid."
            )
        answer = self._acks.popleft()
        self._takes_part = True
        self._store_next_time(answer)
        self._call_services(answer)
        bridge.step()

    def _call_services(self, answer: dict[str, Any]) -> None:
        for name in names_in(answer, "calls"):
            if self._bridge.bus.services.is_offered(name):
                self._node.call(name, Empty())
            else:
                self._bridge.log.report(
                    f"client {self._name!r} calls {name}, but no program offers it"
                )

    def _call_client(self, name: str, kind: Service, request: object) -> object:
        """Call a service that the client offers over the topics of lock-step.

        Raises:
            ClientLost: the client did not answer within the limit.
            BadMessage: the answer is not a response of that service.
        """
        self._n_calls += 1
        number = self._n_calls
        address = {"client": self._name, "run": self._run}
        call = {"call": number, "service": name, "args": to_json(to_ros_time(request))}
        self._bridge.send(TICK, String(data=json.dumps({**address, **call})))
        if not self._bridge.wait_for(lambda: self._is_replied(number), self._limit):
            raise ClientLost(
                f"Client {self._name!r} did not answer the call of {name} within "
                f"{self._limit:g} s of wall time (--client-limit): the run is invalid."
            )
        answer = self._replies.pop(number)
        self._check_answer(reply_error(answer), f"answer to the call of {name}")
        self._call_services(answer)
        try:
            response: object = to_sim_time(from_json(kind.response, answer.get("values") or {}))
        except BadMessage as error:
            raise BadMessage(f"Client {self._name!r}: service {name}: {error}") from None
        return response

    def _store_next_time(self, content: dict[str, Any]) -> None:
        """Store the latest time at which the client requests its next tick."""
        next_time = content.get("next")
        if next_time is not None:
            self._next_time = min(next_time, sys.float_info.max)

    def _is_answered(self, number: int) -> bool:
        """Return whether the ack of a tick has come, and all messages that it announces."""
        while self._acks:
            self._check_answer(answer_error(self._acks[0]), "answer")
            if self._acks[0]["tick"] == number:
                break
            self._other_tick = self._acks.popleft()["tick"]  # an ack of an earlier tick
        if self._acks and self._has_arrived(self._acks[0]):
            return True
        self._check_presence()
        return False

    def _check_presence(self) -> None:
        """Raise ClientLost if the client has left."""
        has_left = any(
            join.get("left") and not self._is_other(join, client)
            for join, client in tuple(self._joins)
        )
        if has_left or (
            self._bridge.traits.detects_leaving and not self._bridge.subscribers.is_read(TICK)
        ):
            now = self._node.now
            raise ClientLost(f"Client {self._name!r} left at {now:g} s: the run is invalid.")

    def _check_answer(self, error: str | None, kind: str) -> None:
        """Refuse an invalid answer; raise ClientLost."""
        if error is not None:
            self._refuse(kind, error, self._sender, self._id)
            raise ClientLost(
                f"Client {self._name!r}: at {self._node.now:g} s its {kind} was refused: {error}: "
                "the run is invalid."
            )

    def _describe_other(self, number: int) -> str:
        """Describe which answer came in place of a complete answer to a tick; "" if none."""
        if self._acks:
            counts = object_in(self._acks[0], "published")
            n_arrived = self._bridge.arrivals.n_arrived
            missing_messages = [
                f"{n} messages on {topic}, of which {n_arrived[topic.lstrip('/')]} have come"
                for topic, n in counts.items()
                if not self._has_arrived({"published": {topic: n}})
            ]
            return f"; its answer announces {', '.join(missing_messages)}"
        if self._other_tick is not None:
            return f"; this was tick {number}, and it answered {self._other_tick!r:.40}"
        return ""

    def _is_replied(self, number: int) -> bool:
        """Return whether the answer to a call has come, and all messages that it announces."""
        if number not in self._replies:
            self._check_presence()
            return False
        return bool(reply_error(self._replies[number])) or self._has_arrived(self._replies[number])

    def _has_arrived(self, answer: dict[str, Any]) -> bool:
        """Return whether all messages that an answer announces have come."""
        return all(
            self._bridge.arrivals.n_arrived[topic.lstrip("/")] >= n
            for topic, n in object_in(answer, "published").items()
        )


def lockstep_clients(
    bridges: Sequence[Bridge],
    names: Sequence[str],
    *,
    timestep: float,
    limit: float,
    secret: str | None = None,
) -> tuple[LockStepClient, ...]:
    """Make a client for each name, in the order in which they must be attached.

    Args:
        bridges: the bridges of the simulation: exactly one, which the clients use.
        names: the names of the clients.
        timestep: the step of the simulation [s].
        limit: the time limit for joining, and for answering a tick [s of wall time].
        secret: the secret that each join must have; None: no secret.

    Raises:
        BadSetting: there is no transport, or more than one.
    """
    if len(bridges) != 1:
        raise BadSetting(
            "--client: expected one of --web, --ros1 and --ros2, by which the client connects."
        )
    (bridge,) = bridges
    clients = {
        name: LockStepClient(bridge, name, timestep=timestep, limit=limit, secret=secret)
        for name in sorted(dict.fromkeys(names))
    }

    def receive(topic: str, message: object, sender: str) -> None:
        content = _read_object(message)
        n_letters = len(message.data) if isinstance(message, String) else 0
        client = clients.get(str(content.get("client")))
        if client is not None:
            client.receive(topic, content, sender)
            return
        if n_letters > MAX_LENGTH:
            error = f"/{topic}: a message has {n_letters} letters; at most {MAX_LENGTH} are read"
        elif "client" not in content:
            error = f"/{topic}: a message is no JSON object with a 'client'"
        else:
            error = f"/{topic}: no client of this run: {str(content.get('client'))[:100]!r}"
        bridge.log.report(error)
        bridge.report_error(sender, error)

    for topic in (JOIN, ACK):
        bridge.read_all(topic)
        bridge.bus.subscribe(topic, String, _ignore_message)  # makes transports subscribe
        bridge.arrivals.tap(topic, partial(receive, topic))
    bridge.bus.publisher(TICK, String)
    return tuple(clients.values())


def _ignore_message(message: object) -> None:
    """Ignore a message, which `Arrivals.tap` has passed on already."""


def _read_object(message: object) -> dict[str, Any]:
    if not isinstance(message, String) or len(message.data) > MAX_LENGTH:
        return {}
    try:
        content = read_peer_json(message.data)
    except ValueError:
        return {}
    return content if isinstance(content, dict) else {}
