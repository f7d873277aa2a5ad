"""Streams of bytes: sensors as real instruments send them, and commands to actuators.

`instrument_stream` sends, `actuator_stream` receives. The bytes of formats are in
`uwsim.autopilots.instruments`.
"""
