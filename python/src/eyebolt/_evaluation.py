"""How far off an answer is, where the truth is known."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _native
from ._calibration import Calibration, named_text
from ._call import Progress, call
from ._options import PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


@dataclass(frozen=True)
class Evaluation:
    """How far a calibration is from the truth.

    Attributes:
        trusted: Whether it was trusted.
        translation_mm, rotation_deg: Of `camera_from_base`; `None` where no pose was found.
        camera_position_mm: How far the camera is from where the base is said to have it.
        after_bump: Against each pose that the camera had later, if it was bumped.
    """

    trusted: bool
    translation_mm: Optional[float]
    rotation_deg: Optional[float]
    camera_position_mm: Optional[float]
    after_bump: tuple[Evaluation, ...] = ()


@dataclass(frozen=True)
class Table:
    """A table of figures, with those of the paper beside; `data` is what `eyebolt evaluate --json` says."""

    data: dict[str, Any]


def evaluate(
    recording: PathLike,
    calibration: Union[Calibration, PathLike],
    *,
    progress: Progress = None,
) -> Evaluation:
    """Holds a calibration of a simulated recording against the truth.

    Args:
        recording: A recording that `simulate` wrote, or its `truth.json`.
        calibration: A calibration of it, or the file that it is in. Refused ones are evaluated too.
        progress: Called with parts done, parts in all and what they are parts of; or a bar of tqdm.

    Raises:
        Error: There is no truth, or the calibration is of another base.
    """
    text = _native.evaluate(words("evaluate", {}, recording), named_text(calibration), call(progress))
    told = json.loads(text)
    trusted = bool(told["trusted"])
    after = tuple(Evaluation(trusted=trusted, **later) for later in told.pop("after_bump", []))
    return Evaluation(after_bump=after, **told)


def evaluate_models(
    recordings: Union[PathLike, Sequence[PathLike]],
    model: Union[PathLike, Sequence[PathLike]],
    *,
    calibration: Union[PathLike, Sequence[PathLike], None] = None,
    marker: Optional[str] = None,
    marked: Union[PathLike, Sequence[PathLike], None] = None,
    robot: Optional[PathLike] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
) -> list[Table]:
    """The tables of Sefercik and Akgun (CoRL 2022) for labels, poses and calibrations that the networks of models make.

    Args:
        recordings: Recordings that `simulate` wrote; others with `calibration`.
        model: Folder of a model, one that comes with eyebolt, or `NAME=` and either; several are compared.
        calibration: What to take for the truth of recordings that have none, one for each.
        marker, marked: A marker, and recordings with it on the hand, that are calibrated by it.
        robot, base, end_effector, package_path, xacro_arg, joint, joint_prefix, allow_outside_files: As of `calibrate`.
        threads, cache, no_cache, progress: As of `calibrate`.

    Raises:
        Error: A recording or a model cannot be read, or they do not fit.
    """
    told = {name: value for name, value in locals().items() if name not in ("recordings", "threads", "progress")}
    paths = [recordings] if isinstance(recordings, (str, os.PathLike)) else list(recordings)
    text = _native.evaluate(words("evaluate", told, *paths), None, call(progress, threads))
    return [Table(table) for table in json.loads(text)]
