"""Manoeuvres and tank experiments of a vehicle, and their report."""
