"""Arguments of functions as the words of the program's flags, so that both mean the same."""

from __future__ import annotations

import numbers
import os
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Optional, TypedDict, Union

from . import _native
from ._errors import wrong

PathLike = Union[str, "os.PathLike[str]"]

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack


class BagOptions(TypedDict, total=False):
    """How a bag is read, where that is not clear by itself (`eyebolt calibrate --help`, *Bags*)."""

    depth_topic: Optional[str]
    camera_info_topic: Optional[str]
    camera_info: Optional[PathLike]
    joint_topic: Optional[str]
    description_topic: Optional[str]
    color_topic: Optional[str]
    mask_topic: Optional[str]
    background_topic: Optional[str]
    cloud_frame: Optional[str]
    max_motion_deg: Optional[float]
    partial: bool


@lru_cache(maxsize=None)
def known(command: str) -> dict[str, tuple[bool, bool, Optional[str]]]:
    """Options of a command: whether each has a value, whether it may be repeated, and what it is if not told."""
    return _native.options(command)


def words(command: str, options: Mapping[str, object], *paths: PathLike) -> list[str]:
    """`options` and `paths` as words of `command`."""
    flags: list[str] = []
    for name, value in options.items():
        if name not in known(command):
            raise TypeError(f"{command}() got an unexpected keyword argument {name!r}")
        if value is not None and value is not False:
            flags += _flag(command, name, value)
    return [*flags, "--", *(os.fspath(path) for path in paths)] if paths else flags


def _flag(command: str, name: str, value: object) -> list[str]:
    flag = "--" + name.replace("_", "-")
    takes_value, repeats, _ = known(command)[name]
    if not takes_value:
        if value is not True:
            raise wrong(name, f"it is {value!r}", "Give True or False")
        return [flag]
    if value is True:
        raise wrong(name, "it has no value", "Give one")
    return [f"{flag}={text}" for text in (_each(name, value) if repeats else [_text(name, value)])]


def _each(name: str, value: object) -> list[str]:
    if isinstance(value, Mapping):
        return [f"{key}={_text(name, item)}" for key, item in value.items()]
    if isinstance(value, (str, os.PathLike)) or not isinstance(value, Iterable):
        return [_text(name, value)]
    return [_text(name, item) for item in value]


def _text(name: str, value: object) -> str:
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        # The shortest text that is read as the same number.
        return repr(float(value))
    if isinstance(value, (tuple, list)):
        return ",".join(_text(name, item) for item in value)
    raise wrong(name, f"it is {type(value).__name__}", "Give text, a path or a number")
