"""Progress, Ctrl-C, threads and memory."""

from __future__ import annotations

import gc
import os
import resource
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import eyebolt
from eyebolt import _native

from .conftest import Recorded, arrays_of
from .test_errors import told


def test_progress_is_told(simulated: eyebolt.Simulation) -> None:
    heard: list[tuple[int, int, str]] = []
    eyebolt.calibrate(**arrays_of(simulated), progress=lambda *parts: heard.append(parts))
    stages = list(dict.fromkeys(what for _, _, what in heard))
    assert stages[:5] == ["record", "label", "pose", "refine", "calibrate"]
    assert all(done <= total or total == 0 for done, total, _ in heard)


def test_a_bar_of_tqdm_will_do(simulated: eyebolt.Simulation) -> None:
    from tqdm import tqdm

    with tqdm(disable=False, file=open(os.devnull, "w")) as bar:
        eyebolt.calibrate(**arrays_of(simulated), progress=bar)
        assert bar.desc.startswith("calibrate")


def test_what_progress_raises_ends_the_work(simulated: eyebolt.Simulation) -> None:
    def stop(done: int, total: int, what: str) -> None:
        if what == "pose":
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        eyebolt.calibrate(**arrays_of(simulated), progress=stop)


def test_ctrl_c_ends_the_work(simulated: eyebolt.Simulation) -> None:
    def interrupt(done: int, total: int, what: str) -> None:
        if what == "refine":
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        eyebolt.calibrate(**arrays_of(simulated), progress=interrupt)
    # And the next is as if nothing had been.
    assert eyebolt.calibrate(**arrays_of(simulated)).trusted


def test_other_threads_go_on(simulated: eyebolt.Simulation) -> None:
    over, steps = threading.Event(), 0

    def count() -> None:
        nonlocal steps
        while not over.wait(0.001):
            steps += 1

    counter = threading.Thread(target=count)
    counter.start()
    eyebolt.calibrate(**arrays_of(simulated))
    over.set()
    counter.join()
    assert steps > 10


def test_threads_in_parallel_find_the_same(simulated: eyebolt.Simulation, calibration: eyebolt.Calibration) -> None:
    def again(number: int) -> str:
        return eyebolt.calibrate(**arrays_of(simulated), threads=1 + number % 3).json

    with ThreadPoolExecutor(4) as pool:
        assert set(pool.map(again, range(8))) == {calibration.json}


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_child_of_a_fork_has_threads_of_its_own(simulated: eyebolt.Simulation, calibration: eyebolt.Calibration) -> None:
    # The parent's pool is there, its threads are not.
    child = os.fork()
    if child == 0:
        found = eyebolt.calibrate(**arrays_of(simulated)).json == calibration.json
        os._exit(0 if found else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def resident_mib() -> float:
    """Memory of this process."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is not told here")
def test_calls_leak_nothing() -> None:
    good, bad = told(), told(depth=np.zeros((3, 6, 8), np.uint16))
    camera = eyebolt.Camera.from_matrix(good["camera"])

    def small() -> None:
        _native.options("calibrate")
        eyebolt.robots()
        camera.matrix
        with pytest.raises(eyebolt.Error):
            eyebolt.calibrate(**{**good, "max_error_mm": -1})

    def frames() -> None:
        # Arrays are borrowed, and an error is handed back.
        with pytest.raises(eyebolt.Error):
            eyebolt.calibrate(**bad)

    for call, times in ((small, 2000), (frames, 200)):
        for _ in range(times // 4):
            call()
        gc.collect()
        before, references = resident_mib(), sys.getrefcount(bad["depth"])
        for _ in range(times):
            call()
        gc.collect()
        # Not in the assertion itself: pytest keeps what it compares, which is one reference more.
        after = sys.getrefcount(bad["depth"])
        assert after == references
        assert resident_mib() - before < 8


@pytest.mark.skipif(sys.platform != "linux", reason="peak memory is told in another unit")
def test_depth_is_not_copied(recorded: Recorded, tmp_path: Path) -> None:
    """With the same five frames a hundred times over, memory does not follow the depth."""
    script = """
import resource, sys
import numpy as np
import eyebolt
data, camera, robot, times = sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])
depth = [np.load(f"{data}/depth_{number % 5}.npy", mmap_mode=None) for number in range(5 * times)]
joints = np.stack([np.load(f"{data}/joint_states_{number % 5}.npy") for number in range(5 * times)])
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
eyebolt.calibrate(depth, camera, joints, joint_names=[f"lbr_A{n}" for n in range(1, 8)], robot=robot, max_configurations=5)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 2**10)
"""
    path = tmp_path / "script.py"
    path.write_text(script)

    def growth_mib(times: int) -> float:
        words = [sys.executable, str(path), *map(str, (recorded.folder, recorded.camera, recorded.robot, times))]
        run = subprocess.run(words, capture_output=True, text=True, check=True)
        return float(run.stdout)

    # 100 frames are 198 MiB more than 5 frames; what is read of each configuration is bounded.
    few, many = growth_mib(5), growth_mib(25)
    assert many - few < 0.5 * 100 * recorded.depth[0].nbytes / 2**20
