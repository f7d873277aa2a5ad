"""Lock-step with external programs: simulation time waits for them, over any transport.

The contract, on three topics of std_msgs/String with a JSON object as their text:

.. code-block:: text

    /uwsim/lockstep/join   from the client, once, when it has subscribed and advertised
        {"client": NAME, "topics": ["/odom", ...], "next": 0.0}
    /uwsim/lockstep/tick   to the client
        {"client": NAME, "tick": 5, "time": 0.1, "sent": {"/odom": 6}}
    /uwsim/lockstep/ack    from the client, when it has done all that follows from the tick
        {"client": NAME, "tick": 5, "published": {"/cmd": 5}, "next": 0.2}

A tick comes at the end of each step in which a message of one of the client's ``topics`` was
published. It also comes at the simulation time ``next`` [s] of the client's last answer, for its
timers.

A join may also state the client's publications, ``"publishes": {"/cmd": "geometry_msgs/Twist"}``. A
transport then reads them before the bus has a subscriber: ROS drops messages without subscribers.
An ack may have ``"calls": ["startBench"]``: services of std_srvs/Empty that are called for a client
whose transport has none. Ticks, and the invitation (tick 0) before the join, have ``run``, which
identifies the simulation; a join or ack with another ``run`` is ignored.

``sent`` counts the messages of each topic since the join: topics are not ordered relative to each
other in ROS, and a client waits until it has as many. ``published`` counts the client's own in the
same way, and may be left out where the transport keeps the order of topics (WebSocket does).

Simulation time does not advance until the ack has come. Calls of services are answered at once,
also those of the simulation to the client. After the ack, in the same step, the client's messages
are published on the bus, by topic name and then in their order. A client that has not acknowledged
within a limit of wall time, or has left, ends the run as invalid. Several clients are ticked one
after the other, in the order of their names. A new trial closes the connection: the client joins
again, as an algorithm that is created for each trial.
"""

from __future__ import annotations
