"""Calibrating, and what comes of it."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union, overload

import numpy as np

from . import _native
from ._arrays import Images, Joints, recording_or_arrays
from ._call import Progress, call
from ._camera import CameraLike
from ._errors import Error, wrong
from ._html import calibration_html
from ._options import BagOptions, PathLike, words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ._options import Unpack


@dataclass(frozen=True)
class Size:
    """Size of a deviation of a pose."""

    translation_mm: float
    rotation_deg: float

    def __str__(self) -> str:
        return f"{self.translation_mm:.1f} mm, {self.rotation_deg:.2f} degrees"


@dataclass(frozen=True)
class JointOffset:
    """How much farther a joint stands than it says: its true position is the recorded one plus this, degrees."""

    joint: str
    offset_deg: float
    sigma_deg: float


@dataclass(frozen=True)
class Configuration:
    """What became of one frame.

    Attributes:
        name: The frame's name.
        configuration: Number of its arm configuration; frames with the same joints share one.
        used: Whether nothing spoke against it.
        residual_mm: Median distance of the arm's points from the posed arm.
        reason: Why it did not take part.
    """

    name: str
    configuration: int
    used: bool
    residual_mm: Optional[float]
    reason: Optional[str]


class Calibration:
    """Where the camera is, how far that is to be trusted, and why.

    Every number is what `eyebolt calibrate` writes, to the last bit; all of them are in `data`.
    """

    def __init__(self, text: str, name: str = "calibration", _native_half: Optional[_native.Calibration] = None) -> None:
        self._text = text
        self._name = name
        self._half = _native_half
        #: What the calibration file says.
        self.data: dict[str, Any] = json.loads(text)

    @classmethod
    def load(cls, path: PathLike) -> Calibration:
        """Reads a calibration that `save`, or the program, wrote.

        Raises:
            Error: It cannot be read, or is no calibration.
        """
        try:
            text = Path(path).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is no text"
            remedy = "Name the file that eyebolt calibrate wrote"
            raise Error(f"{path}: cannot read it: {reason}. {remedy}", os.fspath(path), None, remedy) from None
        _native.check(os.fspath(path), text)
        return cls(text, os.fspath(path))

    @property
    def trusted(self) -> bool:
        """Whether the answer is to be relied on."""
        return self.verdict == "trusted"

    @property
    def verdict(self) -> str:
        """`trusted` or `refused`."""
        return str(self.data["verdict"])

    @property
    def reasons(self) -> list[str]:
        """Why it is refused; empty if it is trusted."""
        return list(self.data["reasons"])

    @property
    def remedies(self) -> list[str]:
        """What to do about the reasons; empty of a calibration that was loaded."""
        return self._half.remedies() if self._half else []

    @property
    def camera_from_base(self) -> Optional[NDArray[np.float64]]:
        """Maps coordinates in the base frame to the depth optical frame: `(4, 4)`, metres; `None` if nothing was found."""
        return _matrix(self.data["camera_from_base"])

    @property
    def base_from_camera(self) -> Optional[NDArray[np.float64]]:
        """The pose of the camera in the base frame: `(4, 4)`, metres; `None` if nothing was found."""
        return _matrix(self.data["base_from_camera"])

    @property
    def covariance(self) -> Optional[NDArray[np.float64]]:
        """Of `camera_from_base`, `(6, 6)`: translation (m), then rotation vector (rad), along the camera's axes; the rotation
        is about the base's origin."""
        found = self.data.get("covariance")
        return None if found is None else np.array(found, dtype=np.float64)

    @property
    def expected_error(self) -> Optional[Size]:
        """Error to expect, at the middle of where the end-effector was."""
        return _size(self.data.get("expected_error"))

    @property
    def camera_position_error_mm(self) -> Optional[float]:
        """Error to expect of the camera's own position in the base."""
        found: Optional[float] = self.data.get("camera_position_error_mm")
        return found

    @property
    def leave_one_out(self) -> Optional[Size]:
        """The largest change when one configuration is left out."""
        found = self.data.get("leave_one_out")
        return None if found is None else _size(found["worst"])

    @property
    def disagreement(self) -> Optional[Size]:
        """Difference between what surfaces alone and outlines alone would say; `None` if no outline was seen."""
        return _size(self.data.get("disagreement"))

    @property
    def joint_offsets(self) -> list[JointOffset]:
        """How much farther the joints stand than they say, from the base on; empty if nothing was found."""
        return [JointOffset(**found) for found in self.data["joint_offsets"]]

    @property
    def configurations(self) -> list[Configuration]:
        """What became of each frame, those of one configuration together."""
        return [Configuration(**found) for found in self.data["configurations"]]

    @property
    def json(self) -> str:
        """The text of the calibration file."""
        return self._text

    def save(self, path: PathLike, *, force: bool = False) -> Path:
        """Writes the calibration to `path`, a `.json` file; a refused one goes to `*.rejected.json` beside it.

        Returns:
            Where it is.

        Raises:
            Error: The file exists and `force` is not given, or cannot be written.
        """
        return Path(_native.save(os.fspath(path), self._text, self.trusted, force))

    def report(self, path: Optional[PathLike] = None, *, force: bool = False, progress: Progress = None) -> str:
        """A page for a browser, complete in one file: verdict, transform, where the error comes from, pictures, and the cloud
        with the robot to turn about. Written to `path` too, if that is given.

        Raises:
            Error: The calibration was loaded, and what it was made of is not known; the file exists, or cannot be written.
        """
        page = self._made_of("report").report(self._name, call(progress))
        if path is not None:
            _native.write(os.fspath(path), page.encode(), force)
        return page

    def viewer(self, path: PathLike, *, force: bool = False, progress: Progress = None) -> Path:
        """Writes what Foxglove, Lichtblick and RViz show to `path`, a `.mcap` file: the posed robot, points coloured by how far they
        lie from it, outlines, pictures and transforms. A layout for the first two goes beside it, to `*.layout.json`.

        Returns:
            Where the layout is.

        Raises:
            Error: No pose was found; the calibration was loaded, and what it was made of is not known; a file exists, or cannot be
                written.
        """
        made = self._shown("viewer", progress)
        layout = Path(path).with_suffix(".layout.json")
        if not force and layout.exists():
            raise Error(f"{layout}: the file exists. Give `force` to replace it", str(layout), "path", "Give `force` to replace it")
        _native.write(os.fspath(path), made[0], force)
        _native.write(os.fspath(layout), made[1].encode(), force)
        return layout

    def rerun(self, path: PathLike, *, force: bool = False, progress: Progress = None) -> None:
        """Writes what `viewer` has to `path` for Rerun, a `.rrd` file: ``rerun PATH`` shows it. Needs ``pip install 'eyebolt[rerun]'``.

        Raises:
            Error: Rerun is not installed; no pose was found; the calibration was loaded, and what it was made of is not known; the
                file exists, or cannot be written.
        """
        from . import _rerun

        _rerun.write(self._shown("rerun", progress)[0], path, self._name, force=force)

    def _shown(self, name: str, progress: Progress) -> tuple[bytes, str]:
        """What viewers show, as MCAP, and a layout, for the function of this name."""
        made = self._made_of(name).viewer(call(progress))
        if made is None:
            remedy = "See `reasons` for why"
            raise Error(f"{self._name}: {name}: there is no pose to show. {remedy}", self._name, name, remedy)
        return made

    def overlays(self, *, progress: Progress = None) -> dict[str, NDArray[np.uint8]]:
        """The posed arm over what the camera saw: for each configuration, by the name of its first frame, `(rows, columns, 3)`
        red, green, blue.

        Raises:
            Error: The calibration was loaded, and what it was made of is not known.
        """
        return dict(self._made_of("overlays").overlays(call(progress)))

    def export(
        self,
        format: str,
        *,
        name: str = "eyebolt",
        parent_frame: Optional[str] = None,
        child_frame: Optional[str] = None,
        optical_frame: Optional[str] = None,
        camera_tree: Optional[PathLike] = None,
        package_path: Union[PathLike, Sequence[PathLike], None] = None,
        even_if_refused: bool = False,
    ) -> bytes:
        """The calibration as another program reads it: `tf2`, `urdf`, `ros2-launch`, `moveit`, `csv`, `npy`...

        `eyebolt export --help` tells the formats and the other arguments; the hand-eye formats take their name from `name`.

        Raises:
            Error: No such format; a refused calibration without `even_if_refused`; frames that cannot be placed.
        """
        told = {
            "as": format,
            "parent_frame": parent_frame,
            "child_frame": child_frame,
            "optical_frame": optical_frame,
            "camera_tree": camera_tree,
            "package_path": package_path,
            "even_if_refused": even_if_refused,
        }
        return _native.export(words("export", told), self._text, name, call())

    def _made_of(self, what: str) -> _native.Calibration:
        if self._half is None:
            remedy = "Calibrate again, or with the program: eyebolt calibrate --report"
            raise Error(f"{self._name}: {what}: the file does not have what the camera saw. {remedy}", self._name, what, remedy)
        return self._half

    def __repr__(self) -> str:
        error = f", expected error {self.expected_error}" if self.expected_error else ""
        used = sum(frame.used for frame in self.configurations)
        return f"<eyebolt.Calibration {self.verdict}, {used} of {len(self.configurations)} frames used{error}>"

    def _repr_html_(self) -> str:
        return calibration_html(self)


def _matrix(pose: Optional[dict[str, Any]]) -> Optional[NDArray[np.float64]]:
    return None if pose is None else np.array(pose["matrix"], dtype=np.float64)


def _size(found: Optional[dict[str, float]]) -> Optional[Size]:
    return None if found is None else Size(found["translation_mm"], found["rotation_deg"])


def named_text(calibration: Union[Calibration, PathLike]) -> tuple[str, str]:
    """Name and text of a calibration, or of the file that it is in."""
    if not isinstance(calibration, Calibration):
        calibration = Calibration.load(calibration)
    return calibration._name, calibration.json


@overload
def calibrate(
    depth: PathLike,
    *,
    robot: Optional[PathLike] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    model: Optional[PathLike] = None,
    method: str = "best",
    no_icp: bool = False,
    labels: str = "predicted",
    no_masks: bool = False,
    max_configurations: int = 30,
    max_error_mm: Optional[float] = None,
    max_error_deg: Optional[float] = None,
    depth_unit: Union[str, float, None] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> Calibration: ...
@overload
def calibrate(
    depth: Images,
    camera: CameraLike,
    joints: Joints,
    *,
    robot: PathLike,
    joint_names: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    masks: Optional[Images] = None,
    backgrounds: Optional[Images] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    model: Optional[PathLike] = None,
    method: str = "best",
    no_icp: bool = False,
    labels: str = "predicted",
    no_masks: bool = False,
    max_configurations: int = 30,
    max_error_mm: Optional[float] = None,
    max_error_deg: Optional[float] = None,
    depth_unit: Union[str, float, None] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
) -> Calibration: ...


def calibrate(
    depth: Union[PathLike, Images],
    camera: Optional[CameraLike] = None,
    joints: Optional[Joints] = None,
    *,
    robot: Optional[PathLike] = None,
    joint_names: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    masks: Optional[Images] = None,
    backgrounds: Optional[Images] = None,
    base: Optional[str] = None,
    end_effector: Optional[str] = None,
    package_path: Union[PathLike, Sequence[PathLike], None] = None,
    xacro_arg: Optional[Mapping[str, object]] = None,
    joint: Optional[Mapping[str, float]] = None,
    joint_prefix: Optional[str] = None,
    allow_outside_files: bool = False,
    model: Optional[PathLike] = None,
    method: str = "best",
    no_icp: bool = False,
    labels: str = "predicted",
    no_masks: bool = False,
    max_configurations: int = 30,
    max_error_mm: Optional[float] = None,
    max_error_deg: Optional[float] = None,
    depth_unit: Union[str, float, None] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    cache: Optional[PathLike] = None,
    no_cache: bool = False,
    progress: Progress = None,
    **bag: Unpack[BagOptions],
) -> Calibration:
    """Finds the pose of the camera from frames of the arm in a few configurations.

    Args:
        depth: Path of a recording (a folder with a `recording.toml`, or a bag), or depth as `(frames, rows, columns)`, or a
            list of `(rows, columns)`: `uint16` in millimetres, `float32` or `float64` in metres; 0 and NaN are no depth. It is
            not copied, whatever its strides; nobody may write to it meanwhile.
        camera: Intrinsics of the depth: a `Camera`, a `(3, 3)` matrix in pixels, a mapping as `sensor_msgs/CameraInfo`
            has it, or the path of a `camera_info.yaml`.
        joints: Positions of the joints in each frame, radians (metres where they slide): `(frames, joints)` with
            `joint_names`, a mapping from names to `(frames,)`, or a mapping from names to numbers for each frame.
        robot: URDF or xacro file, a robot of `robots()`, or one that is installed for ROS; otherwise the recording's.
        joint_names: Names of the columns of `joints`, as the URDF has them.
        names: Names of the frames; otherwise their numbers from 0.
        masks: Pixels of the whole arm, `bool` or `uint8` of the shape of `depth`.
        backgrounds: Depth of the scene without the arm, as `depth`.
        base, end_effector: Links; otherwise the recording's, or guessed.
        package_path: Where `package://` leads: folders of packages, or `NAME=FOLDER`.
        xacro_arg: Arguments of a xacro file.
        joint: Positions of joints that are not recorded, such as fingers, radians or metres.
        joint_prefix: What the recorded names of joints have before the URDF's, or the other way round.
        allow_outside_files: Let a robot description that comes from a bag name files outside the package folders.
        model: Model that `train` made, its folder or one that comes with eyebolt: networks tell the arm's pixels, whatever else moves.
        method: `best`, `nothing` (from nothing, even with a model) or `paper`.
        no_icp, labels: Of the method `paper`, as the program has them.
        no_masks: Find the arm's pixels by what moved, even if there are masks.
        max_configurations: Of more configurations, use those that differ most.
        max_error_mm, max_error_deg: Expected error up to which an answer is trusted; 10 and 0.6 if not told.
        depth_unit: What one of the numbers of depth is: `m`, `mm`, or its metres.
        seed: Seed of the search; the same seed gives the same bytes on any number of threads.
        threads: Threads to use; otherwise one for each core.
        cache, no_cache: Where shapes of links are kept between runs, or that they are not.
        progress: Called with parts done, parts in all and what they are parts of; or a bar of tqdm.
        bag: How a bag is read, see `BagOptions`.

    Returns:
        The calibration; a refused one says why.

    Raises:
        Error: Frames or robot cannot be read, or do not fit.
        KeyboardInterrupt: Ctrl-C.
    """
    told = {name: value for name, value in locals().items() if name not in _NO_FLAGS}
    told.update(bag)
    where, arrays = recording_or_arrays(
        depth,
        camera,
        joints,
        joint_names=joint_names,
        names=names,
        masks=masks,
        backgrounds=backgrounds,
        depth_unit=depth_unit,
    )
    if arrays is not None and robot is None:
        raise wrong("robot", "it is missing", "Give a URDF or xacro file, or the name of a robot")
    half = _native.calibrate(words("calibrate", told, where), arrays, call(progress, threads))
    return Calibration(half.json(), os.fspath(where), half)


# Arguments that are no flags of the program.
_NO_FLAGS = frozenset(
    ["depth", "camera", "joints", "joint_names", "names", "masks", "backgrounds", "threads", "progress", "bag"]
)
