"""The reality gap: a log compared with the simulation of the same commands, window by window."""
