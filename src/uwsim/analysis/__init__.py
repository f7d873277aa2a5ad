"""What results mean: plots, reports and comparisons, made from the files of results alone."""
