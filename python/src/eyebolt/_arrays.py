"""Arrays as the frames of a recording. No pixel is copied."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from ._camera import CameraLike, info
from ._errors import wrong
from ._options import PathLike

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

Images = Union["NDArray[Any]", Sequence["NDArray[Any]"]]
Joints = Union["ArrayLike", Mapping[str, "ArrayLike"], Sequence[Mapping[str, float]]]

DEPTH_TYPES = ("uint16", "float32", "float64")


@dataclass(frozen=True)
class Arrays:
    """Frames, as the native half takes them."""

    names: list[str]
    depth: list[NDArray[Any]]
    masks: list[NDArray[Any]]
    joints: list[dict[str, float]]
    backgrounds: list[NDArray[Any]]
    camera: str
    camera_name: str
    depth_unit: Optional[str]


def is_path(depth: object) -> bool:
    """Whether frames come from a recording."""
    return isinstance(depth, (str, os.PathLike))


def recording_or_arrays(
    depth: Union[PathLike, Images],
    camera: Optional[CameraLike],
    joints: Optional[Joints],
    *,
    joint_names: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    masks: Optional[Images] = None,
    backgrounds: Optional[Images] = None,
    depth_unit: Union[str, float, None] = None,
) -> tuple[PathLike, Optional[Arrays]]:
    """Path of a recording, or what stands for it in messages with the arrays."""
    if isinstance(depth, (str, os.PathLike)):
        beside = {"camera": camera, "joints": joints, "joint_names": joint_names, "names": names, "masks": masks}
        for name, value in {**beside, "backgrounds": backgrounds}.items():
            if value is not None:
                raise wrong(name, "the recording has its own", "Leave it out, or give the depth as an array")
        return depth, None
    if camera is None:
        raise wrong("camera", "it is missing", "Give the intrinsics of the depth camera")
    images = _images("depth", depth, DEPTH_TYPES)
    if not images:
        raise wrong("depth", "there is no frame in it", "Give one for each configuration of the arm, or more")
    rows, columns = images[0].shape
    text, camera_name = info(camera, (columns, rows))
    arrays = Arrays(
        names=_names(names, len(images)),
        depth=images,
        masks=[] if masks is None else _as_many("masks", _images("masks", masks, ("bool", "uint8")), len(images)),
        joints=_joints(joints, joint_names, len(images)),
        backgrounds=_images("backgrounds", backgrounds, (images[0].dtype.name,)),
        camera=text,
        camera_name=camera_name,
        depth_unit=None if depth_unit is None else str(depth_unit),
    )
    return "arrays", arrays


def _images(field: str, images: Optional[Images], types: tuple[str, ...]) -> list[NDArray[Any]]:
    """Views of single images, `(rows, columns)` each."""
    if images is None:
        return []
    if isinstance(images, np.ndarray) and images.ndim != 3:
        remedy = "Give an array of shape (frames, rows, columns), or a list of arrays (rows, columns)"
        raise wrong(field, f"its shape is {images.shape}", remedy)
    found = list(images)
    for number, image in enumerate(found):
        if not isinstance(image, np.ndarray) or image.ndim != 2:
            of = image.shape if isinstance(image, np.ndarray) else type(image).__name__
            raise wrong(field, f"number {number} is {of}", "Give arrays of shape (rows, columns)")
        if image.dtype.name not in types or not image.dtype.isnative or not image.flags.aligned:
            remedy = f"Give {' or '.join(types)} in the machine's own byte order"
            raise wrong(field, f"number {number} is of type {image.dtype}", remedy)
        if image.dtype != found[0].dtype:
            raise wrong(field, f"number {number} is of type {image.dtype}, others are not", "Give all of one type")
    return found


def _names(names: Optional[Sequence[str]], count: int) -> list[str]:
    if names is None:
        return [str(number) for number in range(count)]
    return _as_many("names", [str(name) for name in names], count)


def _as_many(field: str, found: list[Any], count: int) -> list[Any]:
    if len(found) != count:
        raise wrong(field, f"there are {len(found)} for {count} frames of depth", "Give one for each frame")
    return found


def _joints(joints: Optional[Joints], joint_names: Optional[Sequence[str]], count: int) -> list[dict[str, float]]:
    """Positions by name, for each frame."""
    if joints is None:
        raise wrong("joints", "they are missing", "Give the positions of the arm's joints in each frame")
    if isinstance(joints, Mapping):
        columns = {str(name): np.asarray(column, dtype=np.float64) for name, column in joints.items()}
        for name, column in columns.items():
            if column.shape != (count,):
                raise wrong("joints", f"{name} is of shape {column.shape}", f"Give ({count},): one for each frame")
        return [{name: float(column[at]) for name, column in columns.items()} for at in range(count)]
    if isinstance(joints, Sequence) and all(isinstance(row, Mapping) for row in joints):
        told = [{str(name): float(at) for name, at in row.items()} for row in joints if isinstance(row, Mapping)]
        return _as_many("joints", told, count)
    table = np.asarray(joints, dtype=np.float64)
    if table.ndim != 2 or len(table) != count:
        raise wrong("joints", f"its shape is {table.shape}", f"Give ({count}, joints): a row for each frame")
    if joint_names is None:
        raise wrong("joint_names", "they are missing", "Name the columns of joints as the URDF does")
    if len(joint_names) != table.shape[1]:
        problem = f"there are {len(joint_names)} for {table.shape[1]} columns of joints"
        raise wrong("joint_names", problem, "Name each column as the URDF does")
    return [dict(zip(map(str, joint_names), row)) for row in table.tolist()]
