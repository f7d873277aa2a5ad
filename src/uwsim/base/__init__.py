"""The foundation of all packages: geometry, numerics, random streams, files, fields of messages.

Its modules import only `uwsim.errors` and each other from uwsim.
"""
