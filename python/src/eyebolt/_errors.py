"""What goes wrong."""

from __future__ import annotations

from typing import Optional


class Error(ValueError):
    """Something could not be read, written or used; the text names it and says what to do.

    Attributes:
        file: What was read, such as a path; `None` where it is an argument.
        field: The argument, or the part of the file, that is at fault; `None` where none can be told.
        remedy: What to do about it; `None` where that is in the text alone.
    """

    def __init__(
        self,
        text: str,
        file: Optional[str] = None,
        field: Optional[str] = None,
        remedy: Optional[str] = None,
    ) -> None:
        super().__init__(text)
        self.file = file
        self.field = field
        self.remedy = remedy

    def __reduce__(self) -> tuple[type[Error], tuple[object, ...]]:
        # Processes hand errors to each other.
        return type(self), (str(self), self.file, self.field, self.remedy)


def wrong(field: str, problem: str, remedy: str) -> Error:
    """An error of the argument `field`."""
    return Error(f"`{field}`: {problem}. {remedy}", None, field, remedy)
