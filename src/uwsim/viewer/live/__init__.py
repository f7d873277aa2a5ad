"""The live view: a running simulation in a browser, and a pilot who acts on it."""
