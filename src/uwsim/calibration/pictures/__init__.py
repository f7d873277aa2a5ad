"""Readings from pictures: frames, exposures, the discs around an LED, the squares of a board."""
