"""Protocols of autopilots and of the instruments of vehicles: bytes in, values out, and back.

The packages contain formats only. Devices (`devices`) open ports and read the simulation.
"""
