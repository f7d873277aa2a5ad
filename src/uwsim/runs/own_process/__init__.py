"""A third-party algorithm in a process of its own, in lock-step: it receives messages only."""
