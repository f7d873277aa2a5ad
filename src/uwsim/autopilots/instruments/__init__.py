"""Bytes of instruments: NMEA 0183 sentences, DVL formats, and commands to thrusters.

Each module has the messages of one kind of instrument. A message is a frozen dataclass with
``to_bytes``; ``read_...`` functions return the message of bytes, or raise BadMessage.
"""
