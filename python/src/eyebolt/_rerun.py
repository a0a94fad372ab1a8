"""A file for viewers as a recording of Rerun. Needs ``pip install 'eyebolt[rerun]'``.

Rerun reads the MCAP itself, but shows neither markers, which the robot and the outlines are, nor the colours of points.
"""

from __future__ import annotations

import hashlib
import io
import os
from bisect import bisect_right
from collections.abc import Iterable
from importlib import import_module
from typing import Any, Union

import numpy as np

from . import _native
from ._errors import Error

# What the messages of the viewer's file are, by their topics.
_POINTS = "/eyebolt/points"
_OUTLINE = "/eyebolt/outline"
_ROBOT = "/eyebolt/robot"
_CAPTION = "/eyebolt/caption"
_CAMERA = "/eyebolt/camera_info"
_OVERLAY = "/eyebolt/overlay/compressed"
_TRANSFORMS = ("/tf", "/tf_static")

# Field of a PointCloud2 that is three bytes of colour: blue, green, red, nothing.
_RGB = "rgb"


def write(viewer: bytes, path: Union[str, os.PathLike[str]], name: str, *, force: bool) -> None:
    """Writes what `viewer` shows, the bytes of a viewer's MCAP, to `path`, a `.rrd` file."""
    try:
        # By name: whoever checks types need not have them.
        rr, rrb = import_module("rerun"), import_module("rerun.blueprint")
        mcap, ros2 = import_module("mcap.reader"), import_module("mcap_ros2.decoder")
    except ModuleNotFoundError as error:
        remedy = "Install `eyebolt[rerun]`"
        raise Error(f"{name}: rerun: there is no module {error.name!r}. {remedy}", name, "rerun", remedy) from error
    # Without an identity of its own, older Rerun takes all of one process for one recording.
    stream = rr.RecordingStream("eyebolt", recording_id=hashlib.sha256(viewer).hexdigest()[:32])
    written = stream.binary_stream()
    view = rrb.Horizontal(
        rrb.Spatial3DView(origin="robot", name="in the base frame"),
        rrb.Spatial2DView(origin="overlay", name="what the camera saw"),
        column_shares=[3, 2],
    )
    stream.send_blueprint(rrb.Blueprint(view, rrb.TimePanel(state="collapsed")))
    reader = mcap.make_reader(io.BytesIO(viewer), decoder_factories=[ros2.DecoderFactory()])
    _Scene(rr, stream).log(reader.iter_decoded_messages())
    _native.write(os.fspath(path), written.read(), force)


class _Scene:
    """Entities are as the frames are: links and camera below the base, which is the root. What is seen in a frame is below that, by
    names that no link has."""

    def __init__(self, rr: Any, stream: Any) -> None:
        self.rr = rr
        self.stream = stream
        self.base = ""

    def log(self, messages: Iterable[tuple[Any, Any, Any, Any]]) -> None:
        """Schema, channel, message and what is in it, of each, in the order of their times."""
        self.stream.log("robot", self.rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        told = [(channel.topic, message.log_time, content) for _, channel, message, content in messages]
        # Each configuration has one caption.
        begun = [stamp_ns for topic, stamp_ns, _ in told if topic == _CAPTION]
        for topic, stamp_ns, content in told:
            self.stream.set_time("time", timestamp=np.datetime64(stamp_ns, "ns"))
            self.stream.set_time("configuration", sequence=max(bisect_right(begun, stamp_ns) - 1, 0))
            self._log_one(topic, content)

    def _log_one(self, topic: str, content: Any) -> None:
        if topic in _TRANSFORMS:
            self._transforms(content, static=topic == "/tf_static")
        elif topic == _ROBOT:
            self._robot(content)
        elif topic == _POINTS:
            self._points(content)
        elif topic == _OUTLINE:
            self._outline(content)
        elif topic == _CAMERA:
            self._camera(content)
        elif topic == _CAPTION:
            self._caption(content)
        elif topic == _OVERLAY:
            self._overlay(content)
        else:
            raise AssertionError(f"nothing is shown of {topic}")

    def _entity(self, frame: str) -> str:
        return "robot" if frame == self.base else f"robot/{self.rr.escape_entity_path_part(frame)}"

    def _transforms(self, content: Any, *, static: bool) -> None:
        for stamped in content.transforms:
            # All of them are of the base.
            self.base = stamped.header.frame_id
            moved, turned = stamped.transform.translation, stamped.transform.rotation
            pose = self.rr.Transform3D(
                translation=[moved.x, moved.y, moved.z],
                quaternion=self.rr.Quaternion(xyzw=[turned.x, turned.y, turned.z, turned.w]),
            )
            self.stream.log(self._entity(stamped.child_frame_id), pose, static=static)

    def _robot(self, content: Any) -> None:
        for marker in content.markers:
            corners = _corners(marker.points)
            sides = corners.reshape(-1, 3, 3)
            normals = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
            mesh = self.rr.Mesh3D(
                vertex_positions=corners,
                vertex_normals=np.repeat(normals, 3, axis=0),
                albedo_factor=_color(marker.color),
            )
            self.stream.log(f"{self._entity(marker.header.frame_id)}/shape", mesh, static=True)

    def _points(self, content: Any) -> None:
        offsets = {field.name: field.offset for field in content.fields}
        rows = np.frombuffer(bytes(content.data), dtype=np.uint8).reshape(-1, content.point_step)
        places = [rows[:, offsets[axis] : offsets[axis] + 4].copy().view("<f4") for axis in "xyz"]
        colors = rows[:, offsets[_RGB] : offsets[_RGB] + 3][:, ::-1]
        points = self.rr.Points3D(np.hstack(places), colors=colors, radii=0.0015)
        self.stream.log(f"{self._entity(content.header.frame_id)}/points", points)

    def _outline(self, content: Any) -> None:
        for marker in content.markers:
            pieces = _corners(marker.points).reshape(-1, 2, 3)
            lines = self.rr.LineStrips3D(pieces, colors=_color(marker.color), radii=0.5 * marker.scale.x)
            self.stream.log(f"{self._entity(marker.header.frame_id)}/outline", lines)

    def _camera(self, content: Any) -> None:
        camera = self.rr.Pinhole(
            image_from_camera=np.array(content.k).reshape(3, 3),
            resolution=[content.width, content.height],
            camera_xyz=self.rr.ViewCoordinates.RDF,
            image_plane_distance=0.25,
        )
        # Beside the points, which are no part of its image.
        self.stream.log(f"{self._entity(content.header.frame_id)}/image", camera)

    def _caption(self, content: Any) -> None:
        for marker in content.markers:
            at = marker.pose.position
            said = self.rr.Points3D([[at.x, at.y, at.z]], labels=[marker.text], radii=0.0, show_labels=True)
            self.stream.log(f"{self._entity(marker.header.frame_id)}/caption", said)

    def _overlay(self, content: Any) -> None:
        picture = self.rr.EncodedImage(contents=bytes(content.data), media_type=f"image/{content.format}")
        self.stream.log("overlay", picture)


def _corners(points: Any) -> np.ndarray[Any, np.dtype[np.float32]]:
    return np.array([[point.x, point.y, point.z] for point in points], dtype=np.float32).reshape(-1, 3)


def _color(color: Any) -> list[float]:
    return [color.r, color.g, color.b, color.a]
