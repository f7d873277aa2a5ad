"""Metrics: numbers in, numbers out; what measures compute from what they have observed."""
