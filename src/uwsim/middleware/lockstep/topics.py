"""Names of the topics of lock-step."""

JOIN = "uwsim/lockstep/join"
"""The topic on which the client joins, and on which the bridge reports that it has left."""
TICK = "uwsim/lockstep/tick"
"""The topic on which the simulation sends ticks to the client."""
ACK = "uwsim/lockstep/ack"
"""The topic on which the client acknowledges ticks."""
