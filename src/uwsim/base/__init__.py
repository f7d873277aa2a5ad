"""The foundation of all packages: geometry, numbers, random streams, files, messages' fields.

Its modules import nothing of uwsim but `uwsim.errors` and each other.
"""
