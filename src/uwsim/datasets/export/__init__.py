"""Exports of recordings: CSV tables, LeRobot data sets (version 3), Minari data sets."""
