"""A third-party algorithm in a process of its own, in lock-step: it gets messages and no more."""
