"""Procedural models and textures, from formulas and named random streams."""
