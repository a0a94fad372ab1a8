"""How long work is called."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Optional, Protocol, Union, runtime_checkable

from ._errors import wrong

Callback = Callable[[int, int, str], object]


@runtime_checkable
class Bar(Protocol):
    """A bar of tqdm, or what is like it."""

    n: float
    total: Optional[float]

    def set_description(self, desc: Optional[str] = None, refresh: Optional[bool] = True) -> None: ...

    def refresh(self) -> object: ...


Progress = Union[Callback, Bar, None]


@dataclass(frozen=True)
class Call:
    """Who hears of the work, and on how many threads it is done."""

    progress: Optional[Callback] = None
    threads: Optional[int] = None


def call(progress: Progress = None, threads: Optional[int] = None) -> Call:
    """Checks both: `progress(done, total, what)`, or a bar of tqdm."""
    if threads is not None and not 1 <= threads <= 1024:
        raise wrong("threads", f"it is {threads}", "Give a number from 1 to 1024")
    if progress is None:
        return Call(None, threads)
    if isinstance(progress, Bar):
        return Call(_on_bar(progress), threads)
    if callable(progress):
        return Call(progress, threads)
    raise wrong("progress", f"it is {type(progress).__name__}", "Give a function, or a bar of tqdm")


def _on_bar(bar: Bar) -> Callback:
    def show(done: int, total: int, what: str) -> None:
        bar.set_description(what, refresh=False)
        bar.n, bar.total = done, total or None
        bar.refresh()

    return show
