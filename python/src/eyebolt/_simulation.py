"""Recordings of an arm and a depth camera that are not there."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Optional, TypedDict, Union, overload

import numpy as np

from . import _native
from ._camera import Camera
from ._call import Progress, call
from ._errors import wrong
from ._options import PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ._calibration import Calibration
    from ._evaluation import Evaluation
    from ._options import Unpack

Range = Union[float, tuple[float, float]]


class SimulationOptions(TypedDict, total=False):
    """Options of `eyebolt simulate`, which tells what each means; ranges are pairs, or one number for both."""

    base: Optional[str]
    end_effector: Optional[str]
    package_path: Union[PathLike, Sequence[PathLike], None]
    xacro_arg: Optional[Mapping[str, object]]
    distance_m: Optional[Range]
    azimuth_deg: Optional[Range]
    elevation_deg: Optional[Range]
    moving_frames: int
    marker: Optional[str]
    depth_scale: float
    depth_offset_mm: float
    focal_scale: float
    centre_px: Optional[tuple[float, float]]
    joint_offset_deg: float
    joint_offset_sigma_deg: float
    backlash_deg: float
    time_skew_ms: float
    one_joint_offset_deg: float
    link_length_mm: float
    base_lower_mm: float
    wrist_only: bool
    occlusion: float
    bump: Optional[tuple[float, float]]
    gloss: float
    far_room: bool
    wander_mm: float
    tool_mm: float
    cable: bool
    cover: bool
    passers_by: int
    other_rooms: float
    second_arm: Optional[str]
    fixed_pattern: float


@dataclass(frozen=True)
class Simulation:
    """Frames of a resting arm, with the truth.

    Attributes:
        depth: `(frames, rows, columns)`, metres, 0 where there is none.
        camera: Intrinsics, as the camera states them.
        joints: `(frames, joints)`, radians, metres where they slide: as the arm states them.
        joint_names: Names of their columns.
        names: Names of the frames: configuration, then frame.
        backgrounds: `(backgrounds, rows, columns)`, metres: the scene without the arm.
        urdf: The robot description.
        base, end_effector: Its links.
        camera_from_base: Where the camera really is: `(4, 4)`, metres.
        camera_from_base_after: Where it is after it was bumped, if it is.
        joint_offsets_rad: How much farther each joint stands than it says.
    """

    depth: NDArray[np.float32]
    camera: Camera
    joints: NDArray[np.float64]
    joint_names: list[str]
    names: list[str]
    backgrounds: NDArray[np.float32]
    urdf: str
    base: str
    end_effector: str
    camera_from_base: NDArray[np.float64]
    camera_from_base_after: Optional[NDArray[np.float64]]
    joint_offsets_rad: dict[str, float]

    def evaluate(self, calibration: Calibration) -> Evaluation:
        """How far `calibration` is from the truth."""
        from ._evaluation import Evaluation

        later = [] if self.camera_from_base_after is None else [self.camera_from_base_after]
        found = calibration.camera_from_base
        if found is None:
            return Evaluation(calibration.trusted, None, None, None)
        first, *after = [_difference(found, truth, calibration.trusted) for truth in [self.camera_from_base, *later]]
        return Evaluation(
            first.trusted, first.translation_mm, first.rotation_deg, first.camera_position_mm, tuple(after)
        )


def _difference(found: NDArray[np.float64], truth: NDArray[np.float64], trusted: bool) -> Evaluation:
    from ._evaluation import Evaluation

    between = found[:3, :3].T @ truth[:3, :3]
    # By the chord, which does not lose small angles as the cosine does.
    chord = np.linalg.norm(between - np.eye(3)) / (2 * np.sqrt(2))
    positions = [-matrix[:3, :3].T @ matrix[:3, 3] for matrix in (found, truth)]
    return Evaluation(
        trusted,
        1e3 * float(np.linalg.norm(found[:3, 3] - truth[:3, 3])),
        float(np.degrees(2 * np.arcsin(min(1.0, chord)))),
        1e3 * float(np.linalg.norm(positions[0] - positions[1])),
    )


@overload
def simulate(
    output: None = None,
    *,
    robot: PathLike = "shackle",
    sensor: str = "kinect-v1",
    preset: Optional[str] = None,
    configurations: int = 6,
    frames: int = 10,
    backgrounds: int = 10,
    clutter: int = 8,
    seed: int = 1,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **options: Unpack[SimulationOptions],
) -> Simulation: ...
@overload
def simulate(
    output: PathLike,
    *,
    robot: PathLike = "shackle",
    sensor: str = "kinect-v1",
    preset: Optional[str] = None,
    configurations: int = 6,
    frames: int = 10,
    backgrounds: int = 10,
    clutter: int = 8,
    seed: int = 1,
    force: bool = False,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **options: Unpack[SimulationOptions],
) -> Path: ...


def simulate(
    output: Optional[PathLike] = None,
    *,
    robot: PathLike = "shackle",
    sensor: str = "kinect-v1",
    preset: Optional[str] = None,
    configurations: int = 6,
    frames: int = 10,
    backgrounds: int = 10,
    clutter: int = 8,
    seed: int = 1,
    force: bool = False,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **options: Unpack[SimulationOptions],
) -> Union[Simulation, Path]:
    """Records an arm and a depth camera that are not there, to try everything without a robot.

    Args:
        output: An MCAP file to write the recording to; without one the frames at rest come back as arrays.
        robot: A robot of `robots()`, a URDF or xacro file, or one that is installed for ROS.
        sensor: The depth camera: `kinect-v1`, `d435`... (`eyebolt simulate --help`).
        preset: Where the camera stands, by name; otherwise the seed chooses.
        configurations: How many configurations the arm rests in.
        frames: Frames of each.
        backgrounds: Frames without the arm.
        clutter: Things that stand about.
        seed: Seed of all random choices; the same seed gives the same bytes on any number of threads.
        force: Replace an existing file.
        threads, cache, no_cache, progress: As of `calibrate`.
        options: See `SimulationOptions`.

    Returns:
        The frames with the truth, or the path of the file, whose truth `evaluate` reads.

    Raises:
        Error: The robot cannot be read; the camera would hardly see the end-effector; the file cannot be written.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(options)
    if output is not None:
        told.update(output=output, force=force)
        _native.record_simulation(words("simulate", told), call(progress, threads))
        return Path(output)
    if force:
        raise wrong("force", "there is no file to replace", "Leave it out, or name the output")
    found = _native.simulate(words("simulate", told), call(progress, threads))
    stated = found.pop("camera")
    camera = Camera.from_matrix(
        np.array(stated["k"]).reshape(3, 3),
        stated["d"],
        width=stated["width"],
        height=stated["height"],
        frame_id=found.pop("camera_frame"),
    )
    return Simulation(camera=camera, joint_offsets_rad=dict(found.pop("joint_offsets_rad")), **found)


# Arguments that are no flags of the program, or not as they are.
_NO_FLAGS = frozenset(["output", "force", "threads", "progress", "options"])


def robots() -> dict[str, str]:
    """The robots that come with eyebolt, each with what it is."""
    return _native.robots()
