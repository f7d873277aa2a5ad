"""A program outside as an algorithm of the simulation: it is waited for at the end of each step."""

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
from ..stamps import to_ros_clock, to_simulation_time
from ..types import message_class, service
from .contract import given, names, wrong_in_answer, wrong_in_join, wrong_in_reply
from .topics import ACK, JOIN, TICK

MAX_WAITING = 100
"""Joins and answers that wait; of more, the newest."""
MAX_TEXT = 2**20
"""Letters of one."""
MAX_ID = 100
"""Letters of an ``id`` that are repeated in a refusal."""
WRONG_SECRET = "secret is missing or another; expected that of UWSIM_CLIENT_SECRET"
MAX_ROUNDS = 1000
"""Ticks of one step: a client that answers its own messages without end goes no further."""


class LockStepClient:
    """One client; an algorithm in the sense of `uwsim.bus.Algorithm`.

    Args:
        bridge: to the transport by which it comes.
        name: under which it joins.
        timestep: of the simulation [s].
        limit: how long it may take to join, and to answer a tick [s of wall time].
        secret: that its join has to have; None: none.
    """

    def __init__(
        self,
        bridge: Bridge,
        name: str,
        *,
        timestep: float,
        limit: float,
        secret: str | None = None,
    ) -> None:
        self._bridge, self._name, self._timestep, self._limit = bridge, name, timestep, limit
        self._secret = secret
        self._joins: deque[tuple[dict[str, Any], str]] = deque(maxlen=MAX_WAITING)
        self._by = ""  # who has joined, where the transport can tell
        self._id: object = None  # what it calls itself, if it does
        self._has_joined = self._takes_part = False
        self._acks: deque[dict[str, Any]] = deque(maxlen=MAX_WAITING)
        self._replies: dict[int, dict[str, Any]] = {}
        self._sent: Counter[str] = Counter()
        self._order: list[str] = []  # topics of the messages since the last tick
        self._other: object = None  # the last tick that was answered and was not asked
        self._is_due, self._next_time = False, math.inf
        self._n_ticks = self._n_calls = 0
        self._run = secrets.token_hex(8)  # what tells simulations apart; not in any result

    @property
    def name(self) -> str:
        """Its name."""
        return self._name

    def start(self, node: Node) -> None:
        """Wait until the client has joined, and subscribe for it.

        Raises:
            NeverStarted: it did not join within the limit.
        """
        self._node = node
        bridge = self._bridge
        bridge.step()
        if bridge.traits.needs_invitation:
            invitation = {"client": self._name, "tick": 0, "run": self._run}
            bridge.send(TICK, String(data=json.dumps(invitation)))
        joined = self._joined()
        self._wish(joined)
        self._connect(joined)
        node.create_timer(self._timestep, self._barrier)

    def _joined(self) -> dict[str, Any]:
        """Wait for a join that is as it should be; others are refused.

        Raises:
            NeverStarted: there was none within the limit.
        """
        end, wrong = time.monotonic() + self._limit, None
        while self._bridge.wait_for(lambda: bool(self._joins), end - time.monotonic()):
            said, sender = self._joins.popleft()
            if (
                said.get("left")
                or ({"client": said["client"], "left": True}, sender) in self._joins
            ):
                continue  # who left before it could take part
            wrong = wrong_in_join(said, self._bridge.bus)
            if wrong is None:
                self._id, self._by, self._has_joined = said.get("id"), sender, True
                if self._bridge.admission is not None:
                    self._bridge.admission.admit(sender)
                for other, its in tuple(self._joins):
                    if self._is_other(other, its):
                        self._turn_away(JOIN, other, its)
                return said
            self._refuse("join", wrong, sender, said.get("id"))
        raise NeverStarted(
            f"No client {self._name!r} has joined within {self._limit:g} s of wall time "
            f"(--client-limit){f'; its join was refused: {wrong}' if wrong else ''}."
        )

    def _refuse(self, what: str, wrong: str, sender: str, its: object) -> None:
        """Tell who said something, and the log, that it is not heard.

        The program that is waited for may read it, too: it tells by its ``id`` that another is
        meant, where the transport does not send to one alone.
        """
        text = f"its {what} was refused: {wrong}"
        self._bridge.log.report(f"client {self._name!r}{f' ({sender})' if sender else ''}: {text}")
        who = {"client": self._name, "run": self._run}
        if isinstance(its, str):
            who["id"] = its[:MAX_ID]
        self._bridge.send_to(sender, TICK, String(data=json.dumps({**who, "error": text})))
        self._bridge.report_error(sender, f"client {self._name!r}: {text}")

    def _connect(self, joined: dict[str, Any]) -> None:
        """Subscribe for the client, and read what it will publish."""
        bridge, topics = self._bridge, names(joined, "topics")
        publishes = given(joined, "publishes")
        for topic, kind in publishes.items():
            bridge.read_all(topic)
            bridge.bus.subscribe(topic, message_class(kind), _nothing)
        for name, kind in given(joined, "services").items():
            of = service(kind)
            self._node.serve(name, of.request, partial(self._ask, name, of))
        bridge.step()
        # what the client publishes itself it has from itself
        own = {topic.lstrip("/") for topic in (*publishes, *names(joined, "own"))}
        read = [topic.lstrip("/") for topic in topics]
        met = [TICK, *(topic for topic in read if topic not in own and self._is_sent(topic))]
        if not bridge.wait_for(
            lambda: (
                not bridge.traits.needs_discovery
                or all(map(bridge.external_subscribers.is_read, met))
            ),
            self._limit,
        ):
            raise NeverStarted(
                f"Client {self._name!r} has joined, and does not subscribe to all of its topics."
            )
        for topic in topics:
            self._node.subscribe(topic, object, self._counter(topic))

    def _is_sent(self, topic: str) -> bool:
        """Whether the simulation publishes a topic."""
        ends = self._bridge.bus.ends(topic, besides=self._bridge)
        return ends is not None and ends.is_published

    @property
    def parameters(self) -> dict[str, float | str]:
        """Those of the client are its own."""
        return {}

    def take_refusals(self) -> tuple[Refusal, ...]:
        """Return what was refused since the last call of programs that do not take part."""
        admission = self._bridge.admission
        return () if admission is None else admission.take_refusals()

    def hear(self, topic: str, content: dict[str, Any], sender: str) -> None:
        """Take in what the client says on one of the topics of lock-step. Any thread.

        ``sender`` is who says it, where the transport can tell: another program of the same name is
        not heard, nor an answer before the join.
        """
        if content.get("run", self._run) != self._run:
            return  # to a simulation before this one
        if self._is_other(content, sender):
            self._turn_away(topic, content, sender)
        elif topic == JOIN:
            if not content.get("left") and not self._has_secret(content):
                self._refuse("join", WRONG_SECRET, sender, content.get("id"))
            elif not self._takes_part or content.get("left"):
                self._joins.append((content, sender))
        elif not self._has_joined:
            self._bridge.log.report(
                f"client {self._name!r}: an answer before its join is not heard"
            )
        elif "call" in content:
            if content["call"] == self._n_calls or wrong_in_reply(content):
                self._replies[self._n_calls] = content
        else:
            self._acks.append(content)

    def _is_other(self, content: dict[str, Any], sender: str) -> bool:
        """Whether another program than the one that has joined says something."""
        if sender and self._by and sender != self._by:
            return True
        its, is_from_connection = content.get("id"), bool(sender) and content.get("left")
        return self._id is not None and its != self._id and not is_from_connection

    def _has_secret(self, content: dict[str, Any]) -> bool:
        """Whether a join has the secret, if one is needed."""
        if self._secret is None:
            return True
        given = content.get("secret")
        is_text = isinstance(given, str)
        return is_text and hmac.compare_digest(str(given).encode(), self._secret.encode())

    def _turn_away(self, topic: str, content: dict[str, Any], sender: str) -> None:
        """Tell another program of the same name, and the log, that it is not heard."""
        if not content.get("left"):
            if self._bridge.admission is not None:
                self._bridge.admission.refuse(sender, f"/{topic}")
            first, second = self._by or "another program", sender or "a second one"
            text = f"client {self._name!r} is {first} already; {second} is not heard"
            self._bridge.log.report(text)
            self._bridge.report_error(sender, text)

    def _counter(self, topic: str) -> Any:
        def count(message: object) -> None:
            self._sent[topic] += 1
            self._order.append(topic)
            self._is_due = True

        return count

    def _barrier(self) -> None:
        """Tick the client if something is due for it, and wait until it has answered."""
        if self._node.now - self._next_time >= -1e-9 * self._timestep:
            self._is_due, self._next_time = True, math.inf
        for _ in range(MAX_ROUNDS):
            if not self._is_due:
                return
            self._is_due = False
            self._tick()
        raise ClientLost(f"Client {self._name!r} answers its own messages without end.")

    def _tick(self) -> None:
        bridge, now = self._bridge, self._node.now
        self._n_ticks += 1
        number = self._n_ticks
        who = {"client": self._name, "run": self._run}
        order, self._order, self._other = self._order, [], None
        tick = {**who, "tick": number, "time": now, "sent": dict(self._sent), "order": order}
        bridge.send(TICK, String(data=json.dumps(tick)))
        if not bridge.wait_for(lambda: self._is_answered(number), self._limit):
            raise ClientLost(
                f"Client {self._name!r} did not answer the tick at {now:g} s within "
                f"{self._limit:g} s of wall time (--client-limit){self._instead(number)}: the run "
                "is invalid."
            )
        answer = self._acks.popleft()
        self._takes_part = True
        self._wish(answer)
        self._call(answer)
        bridge.step()

    def _call(self, answer: dict[str, Any]) -> None:
        """Call the services of std_srvs/Empty that an answer names."""
        for name in names(answer, "calls"):
            if self._bridge.bus.services.serves(name):
                self._node.call(name, Empty())
            else:
                self._bridge.log.report(f"client {self._name!r} calls {name}: nobody offers it")

    def _ask(self, name: str, of: Service, request: object) -> object:
        """Call a service that the client offers by the topics of lock-step.

        Raises:
            ClientLost: it did not answer within the limit.
            BadMessage: its answer is no response of that service.
        """
        self._n_calls += 1
        number = self._n_calls
        who = {"client": self._name, "run": self._run}
        asked = {"call": number, "service": name, "args": to_json(to_ros_clock(request))}
        self._bridge.send(TICK, String(data=json.dumps({**who, **asked})))
        if not self._bridge.wait_for(lambda: self._is_replied(number), self._limit):
            raise ClientLost(
                f"Client {self._name!r} did not answer the call of {name} within "
                f"{self._limit:g} s of wall time (--client-limit): the run is invalid."
            )
        answer = self._replies.pop(number)
        self._check(wrong_in_reply(answer), f"answer to the call of {name}")
        self._call(answer)
        try:
            response: object = to_simulation_time(
                from_json(of.response, answer.get("values") or {})
            )
        except BadMessage as error:
            raise BadMessage(f"Client {self._name!r}: service {name}: {error}") from None
        return response

    def _wish(self, said: dict[str, Any]) -> None:
        """Take note of when the client wants its next tick at the latest."""
        wish = said.get("next")
        if wish is not None:
            self._next_time = min(wish, sys.float_info.max)

    def _is_answered(self, number: int) -> bool:
        """Whether the ack of a tick is there, and all that it announces."""
        while self._acks:
            self._check(wrong_in_answer(self._acks[0]), "answer")
            if self._acks[0]["tick"] == number:
                break
            self._other = self._acks.popleft()["tick"]  # an earlier one
        if self._acks and self._has_arrived(self._acks[0]):
            return True
        self._check_presence()
        return False

    def _check_presence(self) -> None:
        """Raise ClientLost if the client has left."""
        has_said = any(
            said.get("left") and not self._is_other(said, sender)
            for said, sender in tuple(self._joins)
        )
        if has_said or (
            self._bridge.traits.detects_leaving
            and not self._bridge.external_subscribers.is_read(TICK)
        ):
            now = self._node.now
            raise ClientLost(f"Client {self._name!r} left at {now:g} s: the run is invalid.")

    def _check(self, wrong: str | None, what: str) -> None:
        """Refuse an answer in which something is wrong; raises ClientLost."""
        if wrong is not None:
            self._refuse(what, wrong, self._by, self._id)
            raise ClientLost(
                f"Client {self._name!r}: at {self._node.now:g} s its {what} was refused: {wrong}: "
                "the run is invalid."
            )

    def _instead(self, number: int) -> str:
        """Say what came in the place of the answer to a tick."""
        if self._acks:
            said = given(self._acks[0], "published")
            n_arrived = self._bridge.arrivals.n_arrived
            late = [
                f"{n} messages on {topic}, of which {n_arrived[topic.lstrip('/')]} have come"
                for topic, n in said.items()
                if not self._has_arrived({"published": {topic: n}})
            ]
            return f"; its answer announces {', '.join(late)}"
        if self._other is not None:
            return f"; this was tick {number}, and it answered {self._other!r:.40}"
        return ""

    def _is_replied(self, number: int) -> bool:
        """Whether the answer to a call is there, and all that it announces."""
        if number not in self._replies:
            self._check_presence()
            return False
        return bool(wrong_in_reply(self._replies[number])) or self._has_arrived(
            self._replies[number]
        )

    def _has_arrived(self, answer: dict[str, Any]) -> bool:
        """Whether all messages that an answer announces are there."""
        return all(
            self._bridge.arrivals.n_arrived[topic.lstrip("/")] >= n
            for topic, n in given(answer, "published").items()
        )


def lockstep_clients(
    bridges: Sequence[Bridge],
    names: Sequence[str],
    *,
    timestep: float,
    limit: float,
    secret: str | None = None,
) -> tuple[LockStepClient, ...]:
    """Return the clients of these names, in the order of the names; attach them in it.

    Args:
        bridges: the transports; one, by which the clients come.
        names: of the clients.
        timestep: of the simulation [s].
        limit: how long one may take to join, and to answer a tick [s of wall time].
        secret: that the join of each has to have; None: none.

    Raises:
        BadSetting: there is no transport, or more than one.
    """
    if len(bridges) != 1:
        raise BadSetting("--client: expected one of --web, --ros1 and --ros2, by which it comes.")
    (bridge,) = bridges
    clients = {
        name: LockStepClient(bridge, name, timestep=timestep, limit=limit, secret=secret)
        for name in sorted(dict.fromkeys(names))
    }

    def hear(topic: str, message: object, sender: str) -> None:
        content = _object_in(message)
        n_letters = len(message.data) if isinstance(message, String) else 0
        client = clients.get(str(content.get("client")))
        if client is not None:
            client.hear(topic, content, sender)
            return
        if n_letters > MAX_TEXT:
            wrong = f"/{topic}: a message has {n_letters} letters; at most {MAX_TEXT} are read"
        elif "client" not in content:
            wrong = f"/{topic}: a message is no JSON object with a 'client'"
        else:
            wrong = f"/{topic}: no client of this run: {str(content.get('client'))[:100]!r}"
        bridge.log.report(wrong)
        bridge.report_error(sender, wrong)

    for topic in (JOIN, ACK):
        bridge.read_all(topic)
        bridge.bus.subscribe(topic, String, _nothing)  # so that transports subscribe outside
        bridge.arrivals.tap(topic, partial(hear, topic))
    bridge.bus.publisher(TICK, String)
    return tuple(clients.values())


def _nothing(message: object) -> None:
    """Read by a tap."""


def _object_in(message: object) -> dict[str, Any]:
    if not isinstance(message, String) or len(message.data) > MAX_TEXT:
        return {}
    try:
        found = read_peer_json(message.data)
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}
