"""What Rerun is given, where it is installed: `python/wheel.sh` tests it in a venv of its own."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

import eyebolt

INSTALLED = importlib.util.find_spec("rerun") is not None


@pytest.mark.skipif(not INSTALLED, reason="SKIPPED: Rerun is not installed")
def test_robot_points_and_pictures_of_each_configuration(calibration: eyebolt.Calibration, tmp_path: Path) -> None:
    path = tmp_path / "calibration.rrd"
    calibration.rerun(path)
    told = subprocess.run([sys.executable, "-m", "rerun", "rrd", "stats", path], capture_output=True, text=True, check=True).stdout
    # How many chunks of each entity there are; the time comes with each.
    entities = told.split("Num chunks per entity")[1].split("Num chunks per index")[0]
    optical = "robot/camera_depth_optical_frame"
    for entity in ("overlay", "robot/shape", "robot/hand/shape", f"{optical}/points", f"{optical}/image", f"{optical}/outline"):
        assert f"/{entity}: " in entities, entities
    for index in ("time", "configuration"):
        assert f"{index}: " in told.split("Num chunks per index")[1], told
    assert list(tmp_path.iterdir()) == [path]
    before = path.read_bytes()
    with pytest.raises(eyebolt.Error, match="`force`"):
        calibration.rerun(path)
    assert path.read_bytes() == before
    calibration.rerun(path, force=True)


@pytest.mark.skipif(not INSTALLED, reason="SKIPPED: Rerun is not installed")
def test_a_place_that_cannot_be_written_is_named(calibration: eyebolt.Calibration, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(eyebolt.Error, match="file"):
        calibration.rerun(tmp_path / "file" / "calibration.rrd")


@pytest.mark.skipif(INSTALLED, reason="Rerun is installed")
def test_without_rerun_it_says_what_to_install(calibration: eyebolt.Calibration, tmp_path: Path) -> None:
    with pytest.raises(eyebolt.Error) as told:
        calibration.rerun(tmp_path / "calibration.rrd")
    assert told.value.field == "rerun" and "eyebolt[rerun]" in str(told.value.remedy)
    assert not list(tmp_path.iterdir())
