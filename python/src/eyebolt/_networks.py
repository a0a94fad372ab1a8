"""Networks that know arms: taught, and asked."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _native
from ._arrays import Images, Joints, recording_or_arrays
from ._call import Progress, call
from ._camera import CameraLike
from ._errors import wrong
from ._options import BagOptions, PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ._calibration import Size
    from ._options import Unpack

# Arguments that are no flags of the program.
_NO_FLAGS = frozenset(
    ["depth", "camera", "joints", "joint_names", "names", "threads", "progress", "bag"]
)
# Joints do not matter to networks that look at depth alone.
_SOME_JOINT = "none"


@dataclass(frozen=True)
class Segmentation:
    """Which pixels are what.

    Attributes:
        labels: `(frames, rows, columns)`: 0 background, 1 arm, 2 end-effector, 255 no depth.
        names: Names of these frames.
        damaged: Names of frames that could not be read, and are left out.
    """

    labels: NDArray[np.uint8]
    names: list[str]
    damaged: list[str]

    @property
    def arm(self) -> NDArray[np.bool_]:
        """Pixels of the whole arm with its end-effector, as masks for `calibrate`."""
        return np.isin(self.labels, (1, 2))


def segment(
    depth: Union[PathLike, Images],
    camera: Optional[CameraLike] = None,
    *,
    model: PathLike,
    robot: Optional[PathLike] = None,
    names: Optional[Sequence[str]] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    networks_alone: bool = False,
    depth_unit: Union[str, float, None] = None,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> Segmentation:
    """Tells of each pixel whether it is the arm.

    Args:
        depth, camera, names, depth_unit: A recording or frames, as of `calibrate`.
        model: Model that `train` made: its folder, or one that comes with eyebolt (`any-arm`, `panda`, `shackle`).
        robot, base, end_effector, package_path, xacro_arg, joint, joint_prefix, allow_outside_files: As of `calibrate`; with them, the
            pose that explains what networks say decides which pixels are the end-effector's.
        networks_alone: What the networks say, without that.
        threads, cache, no_cache, progress, bag: As of `calibrate`.

    Raises:
        Error: Frames or model cannot be read.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(bag)
    frames = None if camera is None else [{_SOME_JOINT: 0.0} for _ in depth]  # type: ignore[union-attr]
    where, arrays = recording_or_arrays(depth, camera, frames, names=names, depth_unit=depth_unit)
    labels, found, damaged = _native.segment(words("segment", told, where), arrays, call(progress, threads))
    return Segmentation(labels, found, damaged)


@dataclass(frozen=True)
class EndEffectorPose:
    """Where the end-effector is in one frame.

    Attributes:
        frame: Name of the frame.
        answered: Whether the pose is to be relied on.
        camera_from_end_effector: `(4, 4)`, metres; `None` where nothing was found.
        expected_error: How far off it is likely to be.
        alternatives: Other poses that explain the frame as well, `(4, 4)` each.
        reason: Why it is not to be relied on.
    """

    frame: str
    answered: bool
    camera_from_end_effector: Optional[NDArray[np.float64]]
    expected_error: Optional[Size]
    alternatives: list[NDArray[np.float64]]
    reason: Optional[str]


def pose(
    depth: Union[PathLike, Images],
    camera: Optional[CameraLike] = None,
    joints: Optional[Joints] = None,
    *,
    model: PathLike,
    robot: Optional[PathLike] = None,
    joint_names: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    method: str = "fused",
    no_icp: bool = False,
    joint_states: bool = False,
    depth_unit: Union[str, float, None] = None,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> list[EndEffectorPose]:
    """Tells where the end-effector is in each frame: no calibration, and no joint states unless `joint_states`.

    Args:
        depth, camera, joints, joint_names, names, depth_unit: A recording or frames, as of `calibrate`; arrays need no joints.
        model: Model that `train` made for this end-effector: its folder, or one that comes with eyebolt.
        robot, base, end_effector, package_path, xacro_arg, joint, joint_prefix, allow_outside_files: As of `calibrate`.
        method: How the pose comes about, as the program has it: `fused`...
        no_icp: Leave the pose as the networks have it.
        joint_states: Take the positions of fingers from the joints; otherwise the likeliest opening is found.
        threads, cache, no_cache, progress, bag: As of `calibrate`.

    Raises:
        Error: Frames, robot or model cannot be read, or do not fit. A frame that does not tell is none.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(bag)
    if joints is None and camera is not None:
        joints = [{_SOME_JOINT: 0.0} for _ in depth]  # type: ignore[union-attr]
    where, arrays = recording_or_arrays(
        depth, camera, joints, joint_names=joint_names, names=names, depth_unit=depth_unit
    )
    if arrays is not None and robot is None:
        raise wrong("robot", "it is missing", "Give a URDF or xacro file, or the name of a robot")
    lines = _native.pose(words("pose", told, where), arrays, call(progress, threads))
    return [_pose(json.loads(line)) for line in lines]


def _pose(told: dict[str, Any]) -> EndEffectorPose:
    from ._calibration import Size

    found, error = told["camera_from_end_effector"], told["expected_error"]
    return EndEffectorPose(
        told["frame"],
        told["answered"],
        None if found is None else _matrix(found),
        None if error is None else Size(error["translation_mm"], error["rotation_deg"]),
        [_matrix(other) for other in told["alternatives"]],
        told["reason"],
    )


def _matrix(pose: dict[str, list[float]]) -> NDArray[np.float64]:
    """Of a translation and a unit quaternion, as a homogeneous matrix."""
    x, y, z, w = pose["rotation_xyzw"]
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = pose["translation_m"]
    return matrix


@dataclass(frozen=True)
class TrainedNetwork:
    """A network of a model.

    Attributes:
        name: `segmentation`, `end_effector`, `rotation` or `keypoints`.
        folder: Where its weights are.
        reports: What was measured while it learned: steps, loss and scores, as in its `log.jsonl`.
    """

    name: str
    folder: Path
    reports: list[dict[str, Any]]


def train(
    output: PathLike,
    *,
    what: str = "all",
    robot: PathLike = "shackle",
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    any_arm: bool = False,
    data: Union[PathLike, Sequence[PathLike], None] = None,
    simulated: Optional[float] = None,
    also: Union[PathLike, Sequence[PathLike], None] = None,
    minutes: Optional[float] = None,
    steps: Optional[int] = None,
    from_: Optional[PathLike] = None,
    from_nothing: bool = False,
    preset: str = "default",
    seed: int = 1,
    force: bool = False,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
) -> list[TrainedNetwork]:
    """Teaches networks to know an arm from its description alone, or any arm. A run that was ended goes on with the same call.

    Args:
        output: Folder of the model; begun networks in it are gone on with, ready ones are left as they are.
        what: `segmentation`, `rotation`, `keypoints` or `all`.
        robot, base, end_effector, package_path, xacro_arg: The arm, as of `calibrate`.
        any_arm: Teach to know any arm instead of one.
        data: Data sets of `label` to learn from too, of this robot.
        simulated: With `data`, share of the steps with simulated images, 0 to 1.
        also: With `any_arm`, URDFs of real arms to know too.
        minutes, steps: How long each network is taught; the same steps give the same bytes.
        from_: Begin with the weights of another model, as far as they fit (`--from`); otherwise, of one robot, those of `any-arm`.
        from_nothing: Begin with weights that are drawn at random.
        preset: Which networks, as the program has them.
        seed: Seed of all random choices.
        force: Begin anew, whatever is there.
        threads, cache, no_cache, progress: As of `calibrate`.

    Raises:
        Error: The arm or a data set cannot be read; files cannot be written.
        KeyboardInterrupt: Ctrl-C; what was learned up to the last checkpoint is kept.
    """
    told = {name: value for name, value in locals().items() if name not in ("what", "from_", "threads", "progress")}
    told["from"] = from_
    if any_arm:
        # The robot that is meant where none is told is not meant here.
        del told["robot"]
    taught = _native.train(words("train", told, what), call(progress, threads))
    return [_network(Path(output), name) for name in taught]


def _network(model: Path, name: str) -> TrainedNetwork:
    log = model / name / "log.jsonl"
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return TrainedNetwork(name, model / name, [json.loads(line) for line in lines])
