"""Plots, reports and comparisons of results, made from the files of the results alone."""
