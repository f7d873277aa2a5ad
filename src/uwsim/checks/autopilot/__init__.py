"""Rules about vehicles that ArduPilot steers: ``uwsim check SCENE --ardupilot``."""
