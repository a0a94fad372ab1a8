"""Reads an MCAP that `eyebolt calibrate RECORDING --viewer-mcap OUT.mcap` wrote with two independent readers, as a viewer does.

    pip install mcap mcap-ros2-support rosbags numpy
    python check_viewer_mcap.py OUT.mcap OUT.layout.json CALIBRATION.json

Every message is decoded by `mcap-ros2-support`, from the definitions in the file, and by `rosbags`, from its own, and compared
field by field. Then the scene is put together: each frame has one parent, the camera is where the calibration has it, and the
residual of each point is its distance from the robot's triangles, posed by the transforms of its time.
"""

import json
import sys
from pathlib import Path

import numpy as np
from check_written_mcap import plain
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.typesys import Stores, get_typestore

NEAR_MM = 50.0
GREY = (112, 116, 124)


def matrix(transform):
    t, q = transform.translation, transform.rotation
    x, y, z, w = q.x, q.y, q.z, q.w
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = t.x, t.y, t.z
    return pose


def moved(pose, points):
    return points @ pose[:3, :3].T + pose[:3, 3]


def distances(points, triangles):
    """Unsigned distances of points to the nearest of many triangles (Ericson, Real-Time Collision Detection, 5.1.5)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ab, ac = b - a, c - a
    nearest = np.full(len(points), np.inf)
    for index, p in enumerate(points):
        candidates = []
        for start, edge in ((a, ab), (a, ac), (b, c - b)):
            length = np.maximum((edge * edge).sum(1), 1e-18)
            along = np.clip(((p - start) * edge).sum(1) / length, 0, 1)
            candidates.append(np.linalg.norm(p - start - along[:, None] * edge, axis=1).min())
        normal = np.cross(ab, ac)
        area = np.maximum((normal * normal).sum(1), 1e-24)
        v = (np.cross(p - a, ac) * normal).sum(1) / area
        w = (np.cross(ab, p - a) * normal).sum(1) / area
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        if inside.any():
            height = np.abs(((p - a) * normal).sum(1)) / np.sqrt(area)
            candidates.append(height[inside].min())
        nearest[index] = min(candidates)
    return nearest


def main():
    path, layout, calibration = Path(sys.argv[1]), json.load(open(sys.argv[2])), json.load(open(sys.argv[3]))
    store = get_typestore(Stores.ROS2_HUMBLE)
    messages = []
    with path.open("rb") as file:
        for schema, channel, message, decoded in make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages():
            theirs = store.deserialize_cdr(message.data, schema.name)
            assert plain(decoded) == plain(theirs), channel.topic
            assert bytes(store.serialize_cdr(theirs, schema.name)) == message.data, channel.topic
            messages.append((channel.topic, message.log_time, decoded))
    times = [time for _, time, _ in messages]
    assert times == sorted(times)

    parents, told = {}, []
    for topic, time, decoded in messages:
        if topic in ("/tf", "/tf_static"):
            for each in decoded.transforms:
                parent, child = each.header.frame_id, each.child_frame_id
                assert parents.setdefault(child, parent) == parent, child
                told.append((each.header.stamp.sec * 10**9 + each.header.stamp.nanosec, child, matrix(each.transform)))
    frames = calibration["frames"]
    base, camera = frames["base"], frames["camera"]
    assert set(parents.values()) == {base} and base not in parents
    poses = {camera: next(pose for _, child, pose in told if child == camera)}
    off = np.abs(poses[camera] - np.array(calibration["base_from_camera"]["matrix"])).max()
    assert off < 1e-12, off

    robot = [marker for topic, _, decoded in messages if topic == "/eyebolt/robot" for marker in decoded.markers]
    corners = {m.header.frame_id: np.array([[p.x, p.y, p.z] for p in m.points]) for m in robot}
    checked = 0
    for topic, time, cloud in messages:
        if topic != "/eyebolt/points":
            continue
        at = {child: pose for stamp, child, pose in told if stamp <= time}
        posed = [moved(at.get(name, np.eye(4)), points) for name, points in corners.items()]
        triangles = np.concatenate(posed).reshape(-1, 3, 3)
        kind = np.dtype([("at", "<f4", 3), ("bgr0", "u1", 4), ("residual_mm", "<f4")])
        points = np.frombuffer(bytes(cloud.data), kind)
        assert len(points) == cloud.width
        red, green, blue = (points["bgr0"][:, channel].astype(int) for channel in (2, 1, 0))
        residual = points["residual_mm"]
        grey = (red == GREY[0]) & (green == GREY[1]) & (blue == GREY[2])
        assert np.isfinite(residual[~grey]).all() and (~grey).sum() > 500
        farther, nearer = ~grey & (residual > 1), ~grey & (residual < -1)
        assert (red[farther] > blue[farther]).all() and (blue[nearer] > red[nearer]).all()
        some = np.flatnonzero(~grey & (np.abs(residual) < NEAR_MM))[::37]
        off_mm = np.abs(1e3 * distances(moved(poses[camera], points["at"][some]), triangles) - np.abs(residual[some]))
        # Triangles within others are surface to this script, and none to a field of signed distances.
        assert np.median(off_mm) < 0.5 and (off_mm < 3).mean() > 0.9, (np.median(off_mm), (off_mm < 3).mean())
        checked += len(some)

    topics = {topic for topic, _, _ in messages}
    panels = layout["configById"].values()
    named = {topic for panel in panels for topic in panel.get("topics", {})}
    named |= {panel["imageMode"]["imageTopic"] for panel in panels if panel.get("imageMode", {}).get("imageTopic")}
    assert named and named <= topics, named - topics
    print(f"{len(messages)} messages for viewers: the same in both readers; {checked} residuals are distances from the posed triangles")


main()
