"""What several tests need: the shared recording as files and as arrays, a simulated one, and the program."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import eyebolt

JOINTS = [f"lbr_A{number}" for number in range(1, 8)]


@dataclass(frozen=True)
class Recorded:
    """A recording as a folder and as arrays."""

    folder: Path
    camera: Path
    depth: Any
    joints: Any
    masks: Any
    robot: Path

    def told(self) -> dict[str, Any]:
        """The arrays as arguments."""
        return {
            "depth": self.depth,
            "camera": self.camera,
            "joints": self.joints,
            "joint_names": JOINTS,
            "robot": self.robot,
            "base": "lbr_link_0",
            "end_effector": "lbr_link_7",
        }


@pytest.fixture(scope="session")
def shared() -> Path:
    """The shared data."""
    folder = Path(os.environ.get("EYEBOLT_SHARED") or Path(__file__).parents[3] / "shared")
    if not (folder / "data/recordings/lbr_med7_zed2i").is_dir():
        pytest.skip("SKIPPED: set EYEBOLT_SHARED to the folder of shared data")
    return folder


@pytest.fixture(scope="session")
def recorded(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    """The shared recording of a KUKA LBR Med7 before a ZED 2i."""
    data, robot = shared / "data/recordings/lbr_med7_zed2i", shared / "data/robots/lbr_med7/lbr_med7.urdf"
    folder = tmp_path_factory.mktemp("recording")
    for number in range(5):
        shutil.copy(data / f"depth_{number}.npy", folder)
        shutil.copy(data / f"joint_states_{number}.npy", folder)
        shutil.copy(data / f"mask_sam2_left_image_{number}.png", folder / f"mask_{number}.png")
    (folder / "recording.toml").write_text(
        f'[camera]\ninfo = "{data}/left_camera_info.yaml"\n[frames]\ndepth = "depth_{{}}.npy"\ndepth_unit = "m"\n'
        f'mask = "mask_{{}}.png"\njoints = "joint_states_{{}}.npy"\njoint_names = {JOINTS}\n'
        f'[robot]\nurdf = "{robot}"\nbase = "lbr_link_0"\nend_effector = "lbr_link_7"\n'
    )
    return Recorded(
        folder,
        data / "left_camera_info.yaml",
        np.stack([np.load(folder / f"depth_{number}.npy") for number in range(5)]),
        np.stack([np.load(folder / f"joint_states_{number}.npy") for number in range(5)]),
        np.stack([np.asarray(Image.open(folder / f"mask_{number}.png").convert("L")) > 0 for number in range(5)]),
        robot,
    )


@pytest.fixture(scope="session")
def simulated() -> eyebolt.Simulation:
    """A small simulated recording."""
    return eyebolt.simulate(seed=3, configurations=5, frames=2, backgrounds=2)


@pytest.fixture(scope="session")
def calibration(simulated: eyebolt.Simulation) -> eyebolt.Calibration:
    """A calibration of it."""
    return eyebolt.calibrate(**arrays_of(simulated))


def arrays_of(simulated: eyebolt.Simulation) -> dict[str, Any]:
    """A simulated recording as arguments."""
    return {
        "depth": simulated.depth,
        "camera": simulated.camera,
        "joints": simulated.joints,
        "joint_names": simulated.joint_names,
        "names": simulated.names,
        "backgrounds": simulated.backgrounds,
        "robot": "shackle",
    }


def program(*words: object, **run: Any) -> subprocess.CompletedProcess[str]:
    """The program of the wheel."""
    found = Path(sys.executable).with_name("eyebolt")
    return subprocess.run([str(found), *map(str, words)], capture_output=True, text=True, check=False, **run)
