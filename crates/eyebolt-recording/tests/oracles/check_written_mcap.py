"""Reads an MCAP that `eyebolt convert FOLDER OUT.mcap` wrote with two independent readers.

    pip install mcap mcap-ros2-support rosbags numpy
    python check_written_mcap.py OUT.mcap [FOLDER_WITH_DEPTH_NPY [DEPTH_PATTERN [JOINTS_PATTERN]]]

Every message is decoded by `mcap-ros2-support`, from the definitions in the file, and by `rosbags`,
from its own, and compared field by field; depth, backgrounds and joints are compared with the
folder's arrays where one is given. Prints what was compared; ends with an error at the first difference.
"""

import sys
import tomllib
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore


def plain(value):
    """A message of either library as nested dictionaries, lists and bytes."""
    if isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, (bytes, bytearray, memoryview)):
        return bytes(value)
    if isinstance(value, np.ndarray):
        return value.tobytes() if value.dtype == np.uint8 else [plain(v) for v in value.tolist()]
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    names = getattr(value, "__dataclass_fields__", None) or value.__slots__
    # Constants of a type, which not every definition has, are in capitals.
    fields = {n: plain(getattr(value, n)) for n in names if not n.startswith("_") and not n.isupper()}
    fields.pop("__msgtype__", None)
    return fields


def main():
    path = Path(sys.argv[1])
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    depth_pattern = sys.argv[3] if len(sys.argv) > 3 else "depth_{}.npy"
    joints_pattern = sys.argv[4] if len(sys.argv) > 4 else "joint_states_{}.npy"
    store = get_typestore(Stores.ROS2_HUMBLE)

    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        first = [
            (c.topic, s.name, m.log_time, m.data, decoded)
            for s, c, m, decoded in reader.iter_decoded_messages()
        ]
        metadata = [m for m in reader.iter_metadata()]
        summary = reader.get_summary()

    second = {}
    with Reader(path) as other:
        for connection, stamp, data in other.messages():
            second.setdefault((connection.topic, stamp), []).append((connection.msgtype, bytes(data)))

    counts = {}
    for topic, kind, stamp, data, decoded in first:
        kinds = second[(topic, stamp)]
        assert (kind, data) in kinds, (topic, stamp)
        theirs = plain(store.deserialize_cdr(data, kind))
        ours = plain(decoded)
        assert ours == theirs, f"{topic} at {stamp}:\n{ours}\n{theirs}"
        # Written again by rosbags, it is the same bytes.
        assert bytes(store.serialize_cdr(store.deserialize_cdr(data, kind), kind)) == data, topic
        counts[topic] = counts.get(topic, 0) + 1
    assert sum(counts.values()) == summary.statistics.message_count == sum(map(len, second.values()))

    if folder:
        described = folder / "recording.toml"
        names = tomllib.loads(described.read_text())["frames"]["joint_names"] if described.exists() else None
        images = [(t, d) for t, k, _, _, d in first if k == "sensor_msgs/msg/Image" and d.encoding in ("32FC1", "16UC1")]
        background = [m.metadata.get("background_topic") for m in metadata if m.name == "eyebolt"][-1]
        depths = [d for t, d in images if t != background]
        stored = sorted(folder.glob("background_*.npy"), key=lambda path: int(path.stem.split("_")[-1]))
        backgrounds = [d for t, d in images if t == background]
        for image, path in zip(backgrounds, stored, strict=True):
            kind = np.float32 if image.encoding == "32FC1" else np.uint16
            seen = np.frombuffer(bytes(image.data), kind).reshape(image.height, image.width)
            values = np.load(path)
            assert np.array_equal(seen, np.where(np.isfinite(values) & (values > 0), values, 0)), path
        states = [d for _, k, _, _, d in first if k == "sensor_msgs/msg/JointState"]
        for index, (image, state) in enumerate(zip(depths, states, strict=True)):
            kind = np.float32 if image.encoding == "32FC1" else np.uint16
            seen = np.frombuffer(bytes(image.data), kind).reshape(image.height, image.width)
            stored = np.load(folder / depth_pattern.format(index))
            assert np.array_equal(seen, np.where(np.isfinite(stored) & (stored > 0), stored, 0)), index
            joints = np.load(folder / joints_pattern.format(index)).ravel()
            assert dict(zip(state.name, state.position)) == dict(zip(names or state.name, joints)), index
        print(f"{len(depths)} depth images and joint states and {len(backgrounds)} backgrounds are the folder's, bit for bit")
    print("metadata:", {m.name: m.metadata for m in metadata})
    print("the same in both readers, field by field:", counts)


if __name__ == "__main__":
    main()
