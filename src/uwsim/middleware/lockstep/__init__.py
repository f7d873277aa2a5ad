"""Lock-step with programs outside: simulation time waits for them, over whatever transport.

The contract, on three topics of std_msgs/String with a JSON object as their text:

.. code-block:: text

    /uwsim/lockstep/join   from the client, once, when it has subscribed and advertised
        {"client": NAME, "topics": ["/odom", ...], "next": 0.0}
    /uwsim/lockstep/tick   to the client
        {"client": NAME, "tick": 5, "time": 0.1, "sent": {"/odom": 6}}
    /uwsim/lockstep/ack    from the client, when it has done all that follows from the tick
        {"client": NAME, "tick": 5, "published": {"/cmd": 5}, "next": 0.2}

A tick comes at the end of each step in which a message of one of the client's ``topics`` was
published, or in which the simulation time ``next`` [s] is reached that the client named last, for
its timers.

A join may also say what the client will publish, ``"publishes": {"/cmd": "geometry_msgs/Twist"}``,
so that a transport reads it before anybody on the bus does: in ROS a message that nobody reads is
lost. An ack may have ``"calls": ["startBench"]``: services of std_srvs/Empty that are called for a
client whose transport has none. Ticks have ``run``, which tells simulations apart, and so has an
invitation, tick 0, that is sent before the join; a join or ack with another ``run`` is not heard.

``sent`` counts the messages of each topic since the join: topics are not ordered relative to each
other in ROS, and a client waits until it has as many. ``published`` counts the client's own in the
same way, and may be left out where the transport keeps the order of topics (WebSocket does).

Until the ack is there simulation time stands. Calls of services are answered at once, also those
that the simulation makes of the client; what the client has published is put on the bus after the
ack, by topic name and then in its order, in the same step. A client that has not acknowledged
within a limit of wall time, or has left, ends the run as invalid. Several clients are ticked one
after the other, in the order of their names. A trial that begins anew closes the connection: the
client joins again, as an algorithm that is created for each trial.
"""

from __future__ import annotations
