"""Errors with a sentence for the user."""


class ScantroveError(Exception):
    """Says what happened, to which file, and what to do."""
