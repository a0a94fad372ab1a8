#!/usr/bin/env python3
"""Publishes an MCAP in real time with CycloneDDS, byte for byte, as its drivers would have.

    publish_mcap.py FILE DOMAIN [--reliable] [--namespace NS] [--skip-s S] [--repeat N] [--linger S] [--rate FACTOR] [--stamp-now]

Says `begun` when the first message is out and `published N` of each topic at the end. Depth goes out best-effort, as
drivers of cameras do by default, or reliable; descriptions and static transforms are kept for those who come late.
"""

import argparse
import collections
import struct
import sys
import time

from cyclonedds._clayer import ddspy_write
from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from mcap.reader import make_reader

import ros_types


def quality(kind, reliable):
    if kind in ros_types.LATCHED:
        return Qos(
            Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal, Policy.History.KeepLast(1)
        )
    if kind == "sensor_msgs/msg/Image" and not reliable:
        return Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(5))
    return Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))


STAMPED = {"sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/JointState"}


def later(data, by_ns):
    """The message with its stamp, the first field, so much later."""
    order = "<" if data[1] & 1 else ">"
    seconds, nanoseconds = struct.unpack_from(order + "iI", data, 4)
    stamp = seconds * 10**9 + nanoseconds + by_ns
    return data[:4] + struct.pack(order + "iI", stamp // 10**9, stamp % 10**9) + data[12:]


def main():
    parse = argparse.ArgumentParser()
    parse.add_argument("file")
    parse.add_argument("domain", type=int)
    parse.add_argument("--reliable", action="store_true")
    parse.add_argument("--namespace", default="")
    parse.add_argument("--skip-s", type=float, default=0.0)
    parse.add_argument("--repeat", type=int, default=1)
    parse.add_argument("--rate", type=float, default=1.0)
    parse.add_argument("--linger", type=float, default=2.0)
    parse.add_argument("--stamp-now", action="store_true")
    arguments = parse.parse_args()

    participant = DomainParticipant(arguments.domain)
    writers, counts, late = {}, collections.Counter(), 0.0
    with open(arguments.file, "rb") as stream:
        reader = make_reader(stream)
        for schema, channel, _ in reader.iter_messages():
            if channel.topic not in writers:
                name = f"rt{arguments.namespace}{channel.topic}"
                qos = quality(schema.name, arguments.reliable)
                topic = Topic(participant, name, ros_types.BY_NAME[schema.name], qos=qos)
                writers[channel.topic] = DataWriter(participant, topic, qos=qos)
        # Whoever listens already has found them by then.
        time.sleep(2.0)
        start, began_ns = time.monotonic(), time.time_ns()
        shift = 0.0
        for turn in range(arguments.repeat):
            first = last = None
            for schema, channel, message in reader.iter_messages():
                at = message.log_time * 1e-9
                first = at if first is None else first
                last = at
                # What is kept for those who come late is there whenever the rest begins.
                kept = schema.name in ros_types.LATCHED
                if at - first < arguments.skip_s and not kept:
                    continue
                due = start + shift + max(0.0, at - first - arguments.skip_s) / arguments.rate
                wait = due - time.monotonic()
                if wait > 0:
                    time.sleep(wait)
                late = max(late, -wait)
                data = message.data
                if arguments.stamp_now and schema.name in STAMPED:
                    data = later(data, began_ns - int(1e9 * first) + int(1e9 * shift))
                data = data.ljust((len(data) + 3) & ~3, b"\0")
                written = ddspy_write(writers[channel.topic]._ref, data)
                assert written >= 0, written
                if not counts:
                    print("begun", flush=True)
                counts[channel.topic] += 1
            shift += (last - first - arguments.skip_s) / arguments.rate + 0.5
    for topic, count in sorted(counts.items()):
        print(f"published {count} {topic}", flush=True)
    print(f"latest by {1e3 * late:.0f} ms", flush=True)
    time.sleep(arguments.linger)


if __name__ == "__main__":
    sys.exit(main())
