"""Writes the messages of a ROS 2 bag as a ROS 1 bag with PyPI `rosbags`, to compare the answers.

    pip install rosbags
    python ros1_from_ros2.py ROS2_BAG OUT.bag [none|bz2|lz4]
"""

import sys
from pathlib import Path

from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore


def main():
    source, target = Path(sys.argv[1]), Path(sys.argv[2])
    compression = sys.argv[3] if len(sys.argv) > 3 else "none"
    ros1 = get_typestore(Stores.ROS1_NOETIC)
    writer = Writer(target)
    if compression != "none":
        writer.set_compression(Writer.CompressionFormat[compression.upper()])
    with AnyReader([source], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader, writer:
        connections = {
            c.id: writer.add_connection(c.topic, c.msgtype, typestore=ros1) for c in reader.connections
        }
        for connection, stamp, data in reader.messages():
            cdr = reader.deserialize(data, connection.msgtype)
            message = to_ros1(cdr, connection.msgtype, ros1)
            writer.write(connections[connection.id], stamp, ros1.serialize_ros1(message, connection.msgtype))


def to_ros1(message, kind, store):
    """The message with the fields of ROS 1: a sequence number, capitals in CameraInfo."""
    cls = store.types[kind]
    fields = {}
    for name, definition in store.fielddefs[kind][1]:
        if name == "seq":
            fields[name] = 0
            continue
        source = name if hasattr(message, name) else name.lower()
        value = getattr(message, source)
        nested = definition[1] if definition[0] == 2 or str(definition[0]).endswith("NAME") else None
        fields[name] = to_ros1(value, nested, store) if nested else value
    return cls(**fields)


main()
