"""Modems: the devices, and the channels they share."""
