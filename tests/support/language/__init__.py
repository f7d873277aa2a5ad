"""The language rules of the project: names, docstrings, messages and pages.

``python -m tests.support.language FOLDER...`` lists the violations in these folders. Without a
folder it prints a table of counts for each package; with ``--figures`` it prints four lines.
"""
