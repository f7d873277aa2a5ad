"""The search for an object on the bottom by an imaging sonar and a camera."""

from .object_search import Search, SearchCamera, SearchSonar, SearchTruth

__all__ = ["Search", "SearchCamera", "SearchSonar", "SearchTruth"]
