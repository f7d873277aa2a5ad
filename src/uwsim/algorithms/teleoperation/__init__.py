"""Models of human operators who command a vehicle over a link with a delay.

They use the topics of the operator's end of a ``<u:topicLink>`` only.
"""
