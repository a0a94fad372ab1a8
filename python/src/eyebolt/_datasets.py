"""Labelled frames, for networks to learn from."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _native
from ._calibration import Calibration, named_text
from ._call import Progress, call
from ._options import BagOptions, PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ._options import Unpack


@dataclass(frozen=True)
class Labelled:
    """What became of a recording.

    Attributes:
        recording: Its path.
        labelled: How many of its frames are labelled.
        known: How many of all frames were there before.
        left_out: How many frames were left out, by the reason.
        pixels: How many pixels are of each class.
        refused: Why it was not labelled: reasons of its calibration; empty if it was.
    """

    recording: str
    labelled: int
    known: int
    left_out: dict[str, int]
    pixels: dict[str, int]
    refused: list[str]


def label(
    recordings: Union[PathLike, Sequence[PathLike]],
    output: PathLike,
    *,
    calibration: Union[Calibration, PathLike, None] = None,
    check: Optional[PathLike] = None,
    force: bool = False,
    shard: Optional[str] = None,
    robot: Optional[PathLike] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    no_masks: bool = False,
    depth_unit: Union[str, float, None] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> list[Labelled]:
    """Labels every frame of recordings: arm, end-effector, keypoints, pose. A run that was ended goes on with the same call.

    Args:
        recordings: Paths of recordings.
        output: Folder of the data set, which NumPy opens; frames are added to those that are there.
        calibration: Label by this one, of the same camera in the same place; otherwise each recording is calibrated.
        check: Draw each frame that is labelled, as PNG files in this folder.
        force: Replace pictures that exist; labelled frames are never replaced.
        shard: Label only shard `I/N` of the frames, counted from 0: one for each machine.
        robot, base, end_effector, package_path, xacro_arg, joint, joint_prefix, allow_outside_files: As of `calibrate`.
        no_masks, depth_unit, seed, threads, cache, no_cache, progress, bag: As of `calibrate`.

    Returns:
        What became of each recording, in their order.

    Raises:
        Error: Recordings, robot or calibration cannot be read, or do not fit. A refused calibration is none.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(bag)
    paths = [recordings] if isinstance(recordings, (str, os.PathLike)) else list(recordings)
    known = None if calibration is None else named_text(calibration)
    lines = _native.label(words("label", told, *paths), known, call(progress, threads))
    return [_labelled(json.loads(line)) for line in lines]


# Arguments that are no flags of the program, or not as they are.
_NO_FLAGS = frozenset(["recordings", "calibration", "threads", "progress", "bag"])


def _labelled(told: dict[str, Any]) -> Labelled:
    if "refused" in told:
        return Labelled(told["recording"], 0, 0, {}, {}, told["refused"])
    return Labelled(told["recording"], told["labelled"], told["known"], told["left_out"], told["pixels"], [])
