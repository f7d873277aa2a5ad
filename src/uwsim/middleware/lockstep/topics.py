"""Names of the topics of lock-step."""

JOIN = "uwsim/lockstep/join"
"""From the client: it takes part; from the bridge, when it has left."""
TICK = "uwsim/lockstep/tick"
"""To the client."""
ACK = "uwsim/lockstep/ack"
"""From the client."""
