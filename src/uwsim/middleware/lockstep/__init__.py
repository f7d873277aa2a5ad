"""Lock-step with external programs: simulation time waits for them, over any transport.

A program (the client) and the simulation exchange messages on three topics of std_msgs/String. The
text of each message is a JSON object:

.. code-block:: text

    /uwsim/lockstep/join   from the client, once, after it has subscribed and advertised
        {"client": NAME, "topics": ["/odom", ...], "next": 0.0}
    /uwsim/lockstep/tick   to the client
        {"client": NAME, "tick": 5, "time": 0.1, "sent": {"/odom": 6}}
    /uwsim/lockstep/ack    from the client, after it has done everything that the tick causes
        {"client": NAME, "tick": 5, "published": {"/cmd": 5}, "next": 0.2}

A tick is sent at the end of each step in which a message on one of the client's ``topics`` was
published. For the client's timers, it is also sent at the simulation time ``next`` [s] of the
client's last answer.

A join may also list the topics that the client publishes, with their types:
``"publishes": {"/cmd": "geometry_msgs/Twist"}``. A transport then subscribes to them before the bus
does, as ROS drops messages without subscribers. An ack may have ``"calls": ["startBench"]``:
services of type std_srvs/Empty that the simulation calls for a client whose transport has no
services. Ticks, and the invitation (tick 0) before the join, have a field ``run``, which identifies
the simulation; a join or ack with another ``run`` is ignored.

``sent`` counts the messages on each topic since the join: topics are not ordered relative to each
other in ROS, so the client waits until it has received as many. ``published`` counts the client's
own messages in the same way; it may be left out if the transport keeps the order of messages on all
topics, as WebSocket does.

Simulation time does not advance until the ack has come. Meanwhile, calls of services are answered
at once, also calls from the simulation to services of the client. After the ack, in the same step,
the client's messages are published on the bus, by topic name and then in their order. A client that
does not acknowledge within a limit of wall time, or that leaves, ends the run as invalid. Several
clients receive ticks one after the other, in the order of their names. The connection is closed at
the end of a trial: the client joins each trial anew.
"""

from __future__ import annotations
