"""Makers: models and textures that uwsim makes itself, from formulas and named chance."""
