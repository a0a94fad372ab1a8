#!/usr/bin/env python3
"""`eyebolt live` against CycloneDDS: a recording is published as drivers would, and the session has to come to what the
recording says.

    check_live.py EYEBOLT RECORDING.mcap WORK [--domain D]

Checked are: that every message that was published is in the session, or was said to be lost; that the calibration is the
one of the session, and the recording's within what the clock of another recorder does; that it does not matter who
was there first; that a session that is killed is calibrated like any other; that a publisher may be restarted;
what is published on /tf_static and /eyebolt/status, to whoever comes late; that malformed packets change nothing; and
that the monitor finds the calibration true while it is, tells so on /diagnostics, and finds out a camera that was turned.
"""

import argparse
import json
import math
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from mcap.reader import NonSeekingReader

HERE = Path(__file__).parent
# Only the loopback: what is checked is none of the network's business.
os.environ["CYCLONEDDS_URI"] = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='default'/></Interfaces>"
    "</General></Domain></CycloneDDS>"
)
PATIENCE_S = 240
# Which links are meant is in the simulated recording's own metadata, and in no message.
ARM = ["--base", "link0", "--end-effector", "hand"]


def publish(recording, domain, *more):
    command = [sys.executable, HERE / "publish_mcap.py", recording, str(domain), *map(str, more)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def published(publisher):
    out = publisher.communicate(timeout=PATIENCE_S)[0]
    assert publisher.returncode == 0, publisher.returncode
    lines = [line.split() for line in out.splitlines() if line.startswith("published")]
    return {topic: int(count) for _, count, topic in lines}, out.splitlines()[-1]


def in_session(path):
    counts = Counter()
    with open(path, "rb") as stream:
        for _, channel, _ in NonSeekingReader(stream).iter_messages(log_time_order=False):
            counts[channel.topic] += 1
    return dict(counts)


def pose(path):
    answer = json.loads(Path(path).read_text())
    return answer["base_from_camera"]


def apart(a, b):
    position = max(abs(x - y) for x, y in zip(a["translation_m"], b["translation_m"]))
    turn = max(abs(x - y) for x, y in zip(a["rotation_xyzw"], b["rotation_xyzw"]))
    return position, turn


def panned(answer, degrees):
    """The calibration of a camera that was turned by so much about its own y axis since."""
    half = math.radians(degrees) / 2
    s, c = math.sin(half), math.cos(half)

    def times(a, b):
        (ax, ay, az, aw), (bx, by, bz, bw) = a, b
        return [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ]

    def rotated(q, v):
        return times(times(q, [*v, 0.0]), [-q[0], -q[1], -q[2], q[3]])[:3]

    by = [0.0, s, 0.0, c]
    base, camera = answer["base_from_camera"], answer["camera_from_base"]
    base["rotation_xyzw"] = times(base["rotation_xyzw"], by)
    back = [0.0, -s, 0.0, c]
    camera["rotation_xyzw"] = times(back, camera["rotation_xyzw"])
    camera["translation_m"] = rotated(back, camera["translation_m"])
    for pose in (base, camera):
        columns = [rotated(pose["rotation_xyzw"], axis) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
        columns.append(pose["translation_m"])
        pose["matrix"] = [[column[row] for column in columns] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    return answer


class Live:
    def __init__(self, checks, name, *more):
        self.folder = checks.work / name
        self.folder.mkdir()
        self.said = self.folder / "said"
        command = [checks.eyebolt, "live", "--ros-domain", str(checks.domain), "--localhost-only", "-o", "calibration.json"]
        command += ["--goal", "0.001mm,0.001deg", "--cache", checks.work / "cache", *ARM, *more]
        with open(self.said, "wb") as said:
            self.process = subprocess.Popen(command, cwd=self.folder, stdin=subprocess.PIPE, stdout=said, stderr=subprocess.STDOUT)
        # It is on the bus when it says so.
        self.wait_for("listening to domain")

    def text(self):
        return self.said.read_text(errors="replace")

    def wait_for(self, words, patience_s=PATIENCE_S):
        end = time.monotonic() + patience_s
        while words not in self.text():
            assert self.process.poll() is None, f"it ended:\n{self.text()}"
            assert time.monotonic() < end, f"no {words!r} in:\n{self.text()}"
            time.sleep(0.05)

    def type(self, key):
        self.process.stdin.write(f"{key}\n".encode())
        self.process.stdin.flush()

    def end(self):
        self.type("q")
        code = self.process.wait(timeout=PATIENCE_S)
        assert code == 0, f"{code}:\n{self.text()}"


class Checks:
    def __init__(self, eyebolt, recording, work, domain):
        self.eyebolt, self.recording, self.work, self.domain = eyebolt, recording, work, domain
        self.offline = work / "offline.json"
        self.calibrate(recording, self.offline)

    def calibrate(self, recording, output):
        command = [self.eyebolt, "calibrate", recording, "-o", output, "--cache", self.work / "cache", *ARM]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

    def compare(self, live, limit_m=2e-4, limit=2e-4):
        """The session's answer is its file's to the last digit, and about the recording's."""
        again = live.folder / "again.json"
        self.calibrate(live.folder / "session.mcap", again)
        assert apart(pose(again), pose(live.folder / "calibration.json")) == (0.0, 0.0)
        metres, turn = apart(pose(self.offline), pose(again))
        print(f"  {metres * 1e6:.3f} micrometres and {turn:.2e} (quaternion) from the recording's answer")
        assert metres < limit_m and turn < limit, (metres, turn)

    def listener_first(self, *how):
        print("the listener first", *how)
        live = Live(self, "first" + "".join(how), "--no-tf")
        publisher = publish(self.recording, self.domain, *how)
        sent, late = published(publisher)
        live.end()
        came = in_session(live.folder / "session.mcap")
        lost = [line for line in live.text().splitlines() if "LOST" in line]
        print(f"  {sum(came.values())} of {sum(sent.values())} messages in the session, {len(lost)} said to be lost; publisher {late}")
        assert came == sent and not lost, (came, sent, lost)
        self.compare(live)

    def publisher_first_and_tf(self):
        print("the publisher first, and what is published at the end")
        publisher = publish(self.recording, self.domain, "--linger", 1)
        publisher.stdout.readline()
        live = Live(self, "late")
        published(publisher)
        live.type("q")
        live.wait_for("is published below")
        self.hear_tf(live)
        live.end()
        self.compare(live, 5e-3, 5e-3)

    def hear_tf(self, live):
        from cyclonedds.core import Policy, Qos
        from cyclonedds.domain import DomainParticipant
        from cyclonedds.sub import DataReader
        from cyclonedds.topic import Topic
        from cyclonedds.util import duration

        import ros_types

        latched = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal, Policy.History.KeepLast(9))
        participant = DomainParticipant(self.domain)
        transforms = DataReader(participant, Topic(participant, "rt/tf_static", ros_types.TFMessage, qos=latched), qos=latched)
        status = DataReader(participant, Topic(participant, "rt/eyebolt/status", ros_types.String, qos=latched), qos=latched)
        told, said, end = [], [], time.monotonic() + 20
        while time.monotonic() < end and not (told and said):
            told += [t for message in transforms.take(9) for t in message.transforms]
            said += status.take(9)
            time.sleep(0.05)
        assert len(told) == 1, told
        placed = told[0].transform.translation
        print(f"  /tf_static: {told[0].header.frame_id} -> {told[0].child_frame_id} at {placed.x:.4f} {placed.y:.4f} {placed.z:.4f}")
        export = [self.eyebolt, "export", live.folder / "calibration.json", "--as", "csv"]
        rows = subprocess.run(export, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.split()
        exported = [float(row.split(",")[3]) for row in rows[:3]]
        off = max(abs(a - b) for a, b in zip([placed.x, placed.y, placed.z], exported))
        assert off < 1e-9, off
        assert json.loads(said[-1].data)["configurations"] >= 3

    def killed(self):
        print("a session that is killed")
        live = Live(self, "killed", "--no-tf")
        publisher = publish(self.recording, self.domain)
        live.wait_for("configuration 5 taken")
        live.process.send_signal(signal.SIGKILL)
        live.process.wait()
        publisher.kill()
        publisher.wait()
        self.calibrate(live.folder / "session.mcap", live.folder / "calibration.json")
        metres, turn = apart(pose(self.offline), pose(live.folder / "calibration.json"))
        print(f"  {metres * 1e3:.3f} mm and {turn:.1e} from the answer of the whole")
        assert metres < 5e-3 and turn < 5e-3

    def restarted(self):
        print("a publisher that is killed and started again")
        live = Live(self, "restarted", "--no-tf")
        publisher = publish(self.recording, self.domain, "--stamp-now")
        live.wait_for("configuration 2 taken")
        publisher.send_signal(signal.SIGKILL)
        publisher.wait()
        sent, _ = published(publish(self.recording, self.domain, "--stamp-now"))
        live.end()
        came = in_session(live.folder / "session.mcap")
        depth = max(sent, key=lambda topic: "image" in topic)
        print(f"  {came[depth]} images, {sent[depth]} of them from the second one")
        assert came[depth] > sent[depth] and "LOST" not in live.text(), live.text()
        self.compare(live, 2e-3, 2e-3)

    def monitored(self):
        print("a calibration that is watched")
        assert self.watch("true", self.offline) == (0, 0)
        turned = self.work / "turned.json"
        turned.write_text(json.dumps(panned(json.loads(self.offline.read_text()), 2.0)))
        assert self.watch("turned", turned) == (3, 2)

    def watch(self, name, calibration):
        """How the monitor ended, and the last level on /diagnostics."""
        from cyclonedds.core import Policy, Qos
        from cyclonedds.domain import DomainParticipant
        from cyclonedds.sub import DataReader
        from cyclonedds.topic import Topic
        from cyclonedds.util import duration

        import ros_types

        # As whoever shows diagnostics asks for them.
        qos = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(100))
        participant = DomainParticipant(self.domain)
        topic = Topic(participant, "rt/diagnostics", ros_types.DiagnosticArray, qos=qos)
        diagnostics = DataReader(participant, topic, qos=qos)
        command = [self.eyebolt, "monitor", calibration, "--ros-domain", str(self.domain), "--localhost-only", "--json"]
        said = open(self.work / f"monitor_{name}", "wb")
        monitor = subprocess.Popen([*command, "--cache", self.work / "cache", *ARM], stdout=said, stderr=subprocess.STDOUT)
        end, told = time.monotonic() + PATIENCE_S, []
        try:
            while not told:
                assert monitor.poll() is None and time.monotonic() < end, (self.work / f"monitor_{name}").read_text()
                told += diagnostics.take(100)
                time.sleep(0.05)
            published(publish(self.recording, self.domain, "--stamp-now", "--linger", 8))
            told += diagnostics.take(100)
            monitor.send_signal(signal.SIGINT)
            code = monitor.wait(timeout=PATIENCE_S)
        finally:
            monitor.kill()
        last = told[-1].status[0]
        seen = {value.key: value.value for value in last.values}
        print(f"  {name}: exit {code}; {len(told)} messages on /diagnostics, the last: level {last.level}, {last.message!r}, {seen}")
        return code, last.level

    def rubbish(self):
        print("malformed packets meanwhile")
        live = Live(self, "rubbish", "--no-tf")
        spoiler = subprocess.Popen([sys.executable, HERE / "rtps_rubbish.py", str(self.domain), "600"], stdout=subprocess.PIPE, text=True)
        publisher = publish(self.recording, self.domain, "--reliable")
        sent, _ = published(publisher)
        spoiler.kill()
        live.end()
        came = in_session(live.folder / "session.mcap")
        said = sum(int(line.split()[1]) for line in live.text().splitlines() if line.startswith("LOST"))
        restarts = live.text().count("the transport broke")
        print(f"  {sum(came.values())} of {sum(sent.values())} messages came, {said} said to be lost, {restarts} restarts")
        # The publisher hears the rubbish too: what it never sent, or sent before it was found again, nobody can count.
        assert sum(came.values()) > 0.25 * sum(sent.values())
        self.compare(live, 5e-3, 5e-3)


def main():
    parse = argparse.ArgumentParser()
    parse.add_argument("eyebolt", type=Path)
    parse.add_argument("recording", type=Path)
    parse.add_argument("work", type=Path)
    parse.add_argument("--domain", type=int, default=73)
    parse.add_argument("--only")
    arguments = parse.parse_args()
    checks = Checks(arguments.eyebolt.resolve(), arguments.recording.resolve(), arguments.work.resolve(), arguments.domain)
    all_checks = {
        "first": checks.listener_first,
        "reliable": lambda: checks.listener_first("--reliable"),
        "late": checks.publisher_first_and_tf,
        "killed": checks.killed,
        "restarted": checks.restarted,
        "rubbish": checks.rubbish,
        "monitored": checks.monitored,
    }
    for name, check in all_checks.items():
        if arguments.only in (None, name):
            check()


if __name__ == "__main__":
    sys.exit(main())
