"""Algorithms for several vehicles that know of one another by messages alone.

An algorithm under test commands all vehicles. Here each vehicle has an object of its own, which
reads the topics of its own sensors and of its own modem, and no other.
"""
