"""Whether a calibration is still true."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _native
from ._arrays import Images, Joints, recording_or_arrays
from ._calibration import Calibration, named_text
from ._call import Progress, call
from ._camera import CameraLike
from ._errors import wrong
from ._options import BagOptions, PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ._options import Unpack


@dataclass(frozen=True)
class Suspect:
    """What may have moved.

    Attributes:
        what: `camera`, `base`, `camera_or_base`, or the zero of a joint, by its name.
        probability: 0 to 1.
        data: What `eyebolt monitor --json` says of it.
    """

    what: str
    probability: float
    data: dict[str, Any]


@dataclass(frozen=True)
class View:
    """What one view says; `data` is what `eyebolt monitor --json` says of it.

    Attributes:
        frame: Name of the frame.
        counts: Whether it counted; a posture that was seen before tells nothing new.
        alarm: Whether something moved, by this view and those before it.
        residual_mm: Median distance of the arm's points from where the calibration has the arm.
    """

    frame: str
    counts: bool
    alarm: bool
    residual_mm: Optional[float]
    data: dict[str, Any]


@dataclass(frozen=True)
class Watch:
    """What all views say.

    Attributes:
        alarm: Whether something moved.
        views: One by one.
    """

    alarm: bool
    views: list[View]

    @property
    def moved(self) -> list[Suspect]:
        """What may have moved, the likeliest first; empty without an alarm."""
        if not self.alarm:
            return []
        return [Suspect(_what(found["what"]), found["probability"], found) for found in self.views[-1].data["moved"]]

    @property
    def proposed_camera_from_base(self) -> Optional[NDArray[np.float64]]:
        """Where the camera is now, as far as the views tell: `(4, 4)`, metres. It is proposed and not applied."""
        found = self.views[-1].data.get("proposed_camera_from_base") if self.views else None
        return None if found is None else np.array(found["matrix"], dtype=np.float64)


def _what(what: object) -> str:
    """A joint's zero is an object, all else a word."""
    return str(next(iter(what.values()))) if isinstance(what, dict) else str(what)


def monitor(
    calibration: Union[Calibration, PathLike],
    depth: Union[PathLike, Images],
    camera: Optional[CameraLike] = None,
    joints: Optional[Joints] = None,
    *,
    robot: Optional[PathLike] = None,
    joint_names: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    masks: Optional[Images] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    false_alarms_per_hour: Optional[float] = None,
    views_per_hour: Optional[float] = None,
    per_rest: int = 3,
    even_if_refused: bool = False,
    no_masks: bool = False,
    depth_unit: Union[str, float, None] = None,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> Watch:
    """Holds frames of the resting arm against a calibration, one by one, in their order.

    Args:
        calibration: A calibration, or the file that it is in.
        depth, camera, joints, joint_names, names, masks, depth_unit: A recording or frames, as of `calibrate`.
        robot, base, end_effector, package_path, xacro_arg, joint, joint_prefix, allow_outside_files: As of `calibrate`.
        false_alarms_per_hour: False alarms that are allowed in an hour, on average.
        views_per_hour: How many resting views there are in an hour.
        per_rest: How many frames of each rest are looked at.
        even_if_refused: Watch a calibration that was refused, too.
        no_masks: Find the arm's pixels without masks.
        threads, cache, no_cache, progress, bag: As of `calibrate`.

    Raises:
        Error: The calibration is refused, or of another base; frames or robot cannot be read, or do not fit.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(bag)
    where, arrays = recording_or_arrays(
        depth, camera, joints, joint_names=joint_names, names=names, masks=masks, depth_unit=depth_unit
    )
    if arrays is not None and robot is None:
        raise wrong("robot", "it is missing", "Give a URDF or xacro file, or the name of a robot")
    found = _native.monitor(words("monitor", told, where), named_text(calibration), arrays, call(progress, threads))
    alarm, lines = found
    views = [json.loads(line) for line in lines]
    return Watch(
        alarm,
        [View(view["frame"], view["counts"], view["alarm"], view.get("residual_mm"), view) for view in views],
    )


# Arguments that are no flags of the program.
_NO_FLAGS = frozenset(
    ["calibration", "depth", "camera", "joints", "joint_names", "names", "masks", "threads", "progress", "bag"]
)
