"""Intrinsics."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Union

import numpy as np

from ._errors import Error, wrong
from ._options import PathLike

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Camera:
    """A pinhole camera, as of depth images that are not rectified.

    Attributes:
        fx, fy: Focal lengths, pixels.
        cx, cy: Principal point, pixels, from the middle of the upper left pixel.
        width, height: Pixels in a row and number of rows; those of the depth, if not told.
        distortion: Coefficients in the order of OpenCV and ROS: k1, k2, p1, p2, k3 and, of `rational_polynomial`, k4, k5, k6.
        distortion_model: `plumb_bob` or `rational_polynomial`; by the number of coefficients, if not told.
        frame_id: Name of the optical frame in ROS, if it has one.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: Optional[int] = None
    height: Optional[int] = None
    distortion: tuple[float, ...] = ()
    distortion_model: Optional[str] = None
    frame_id: Optional[str] = None

    @classmethod
    def from_matrix(
        cls,
        k: ArrayLike,
        distortion: Sequence[float] = (),
        *,
        width: Optional[int] = None,
        height: Optional[int] = None,
        frame_id: Optional[str] = None,
    ) -> Camera:
        """From the `(3, 3)` matrix of OpenCV, `[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]`, pixels.

        Raises:
            Error: It is no such matrix.
        """
        matrix = np.asarray(k, dtype=np.float64)
        if matrix.shape != (3, 3):
            raise wrong("camera", f"a matrix of shape {matrix.shape}", "Give one of shape (3, 3)")
        (fx, skew, cx), (below, fy, cy), last = matrix.tolist()
        if skew != 0 or below != 0 or last != [0, 0, 1]:
            raise wrong("camera", "it is not [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]", "Write it without skew")
        return cls(fx, fy, cx, cy, width, height, tuple(distortion), None, frame_id)

    @property
    def matrix(self) -> NDArray[np.float64]:
        """`(3, 3)`, pixels."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def _info(self, size: tuple[int, int]) -> str:
        """What a `camera_info` would say of images of `size` (columns, rows), as JSON, which is YAML."""
        model = "rational_polynomial" if len(self.distortion) > 5 else "plumb_bob"
        info = {
            "width": size[0] if self.width is None else self.width,
            "height": size[1] if self.height is None else self.height,
            "distortion_model": self.distortion_model or model,
            "d": [float(value) for value in self.distortion],
            "k": [float(value) for value in self.matrix.ravel()],
        }
        if self.frame_id:
            info["header"] = {"frame_id": self.frame_id}
        return json.dumps(info)


CameraLike = Union[Camera, "ArrayLike", Mapping[str, object], PathLike]


def info(camera: CameraLike, size: tuple[int, int]) -> tuple[str, str]:
    """What `camera` says as a `camera_info` of images of `size` (columns, rows), and what that is called."""
    if isinstance(camera, Camera):
        return camera._info(size), "camera"
    if isinstance(camera, (str, os.PathLike)):
        path = Path(camera)
        try:
            return path.read_text(encoding="utf-8"), os.fspath(path)
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is no text"
            remedy = "Name a camera_info.yaml, or give the intrinsics"
            raise Error(f"{path}: `camera`: cannot read it: {reason}. {remedy}", str(path), "camera", remedy) from None
    if isinstance(camera, Mapping):
        told = {str(key): _plain(value) for key, value in camera.items()}
        return json.dumps({"width": size[0], "height": size[1], **told}), "camera"
    return Camera.from_matrix(camera)._info(size), "camera"


def _plain(value: object) -> object:
    """Arrays as lists, row by row, as messages have them."""
    if isinstance(value, np.ndarray):
        return value.ravel().tolist()
    if isinstance(value, np.generic):
        return value.item()
    return value
