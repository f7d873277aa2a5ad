"""Plots, reports and comparisons of results, made from their files alone."""
