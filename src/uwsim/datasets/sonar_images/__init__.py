"""Sonar images of data sets, and their labels."""
