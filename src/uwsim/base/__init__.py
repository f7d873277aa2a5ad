"""What everything is built on: geometry, numbers, random streams, files, messages' fields.

Its modules import nothing of uwsim but `uwsim.errors` and each other.
"""
