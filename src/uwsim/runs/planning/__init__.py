"""The plan of a run, made from the options of a command line or of a Python call."""
