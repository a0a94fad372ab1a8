"""Simulating, watching, labelling, networks, and the program of the wheel."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import eyebolt

from .conftest import arrays_of, program


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated recording in a file."""
    return eyebolt.simulate(tmp_path_factory.mktemp("session") / "session.mcap", seed=3, configurations=5, frames=2)


def test_simulations_are_those_of_the_program(session: Path, simulated: eyebolt.Simulation, tmp_path: Path) -> None:
    run = program("simulate", "--seed=3", "--configurations=5", "--frames=2", "-o", tmp_path / "session.mcap")
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "session.mcap").read_bytes() == session.read_bytes()
    assert simulated.depth.shape == (10, 480, 640) and simulated.joints.shape == (10, len(simulated.joint_names))
    assert simulated.backgrounds.shape == (2, 480, 640)
    rotation = simulated.camera_from_base[:3, :3]
    assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    with pytest.raises(eyebolt.Error, match="`force`"):
        eyebolt.simulate(session, seed=3)
    with pytest.raises(eyebolt.Error) as error:
        eyebolt.simulate(sensor="no such camera")
    assert error.value.field == "sensor" and "kinect-v1" in str(error.value.remedy)


def test_how_far_off_it_is(session: Path, simulated: eyebolt.Simulation, tmp_path: Path) -> None:
    calibration = eyebolt.calibrate(session)
    path = calibration.save(tmp_path / "calibration.json")
    told = json.loads(program("evaluate", session, path, "--json").stdout)
    found = eyebolt.evaluate(session, calibration)
    assert (found.translation_mm, found.rotation_deg) == (told["translation_mm"], told["rotation_deg"])
    assert found == eyebolt.evaluate(session, path)
    # The truth is the same in memory.
    here = simulated.evaluate(calibration)
    assert here.translation_mm == pytest.approx(found.translation_mm, abs=1e-6)
    assert here.rotation_deg == pytest.approx(found.rotation_deg, abs=1e-6)


def test_a_bumped_camera_is_found_out(calibration: eyebolt.Calibration, simulated: eyebolt.Simulation) -> None:
    told: dict[str, Any] = arrays_of(simulated)
    del told["backgrounds"]
    still = eyebolt.monitor(calibration, **told)
    assert not still.alarm and still.views and still.moved == []
    # Bumped after half of the configurations; three views that agree may be needed.
    bumped = eyebolt.simulate(seed=3, configurations=9, frames=1, backgrounds=2, bump=(10, 1))
    told.update(depth=bumped.depth, joints=bumped.joints, names=bumped.names)
    watch = eyebolt.monitor(calibration, **told)
    assert watch.alarm and watch.moved
    assert watch.proposed_camera_from_base is not None and watch.proposed_camera_from_base.shape == (4, 4)


def test_labels(session: Path, tmp_path: Path) -> None:
    refused = eyebolt.label(session, tmp_path / "refused", max_motion_deg=None, seed=1)
    assert [labelled.refused for labelled in refused] == [[]]
    found = eyebolt.label([session], tmp_path / "dataset", calibration=eyebolt.calibrate(session))
    assert found[0].labelled == 10 and found[0].known == 0 and found[0].pixels["arm"] > 0
    again = eyebolt.label([session], tmp_path / "dataset", calibration=eyebolt.calibrate(session))
    assert again[0].known == 10


def test_networks_on_arrays_and_recordings(session: Path, simulated: eyebolt.Simulation) -> None:
    seen = eyebolt.segment(simulated.depth, simulated.camera, model="shackle", names=simulated.names)
    assert seen.labels.shape == simulated.depth.shape and seen.labels.dtype == np.uint8
    assert seen.names == simulated.names and seen.damaged == []
    assert set(np.unique(seen.labels)) <= {0, 1, 2, 255}
    assert 0.001 < seen.arm.mean() < 0.5
    of_file = eyebolt.segment(session, model="shackle", networks_alone=True)
    assert np.mean(of_file.labels == seen.labels) > 0.999
    poses = eyebolt.pose(simulated.depth[:2], simulated.camera, model="shackle", robot="shackle")
    assert [pose.frame for pose in poses] == ["0", "1"]
    for found in poses:
        if found.camera_from_end_effector is not None:
            rotation = found.camera_from_end_effector[:3, :3]
            assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    masked = eyebolt.calibrate(**{**arrays_of(simulated), "masks": seen.arm})
    assert masked.trusted


def test_training_goes_on_where_it_ended(tmp_path: Path) -> None:
    told: dict[str, Any] = {"what": "rotation", "robot": "shackle", "steps": 12, "preset": "default"}

    class Enough(Exception):
        pass

    def stop(done: int, total: int, what: str) -> None:
        if total and done >= 6:
            raise Enough

    with pytest.raises(Enough):
        eyebolt.train(tmp_path / "model", **told, progress=stop)
    (network,) = eyebolt.train(tmp_path / "model", **told)
    assert network.name == "rotation" and (network.folder / "weights.safetensors").exists()
    assert network.reports and network.reports[-1]["step"] == 12
    with pytest.raises(eyebolt.Error):
        eyebolt.train(tmp_path / "other", any_arm=True, what="rotation")


def test_the_program_is_in_the_wheel(tmp_path: Path) -> None:
    run = program("--version")
    assert (run.returncode, run.stdout) == (0, f"eyebolt {eyebolt.__version__}\n")
    assert program("calibrate", "--no-such-flag").returncode == 2
    run = program("calibrate", tmp_path / "nothing")
    assert run.returncode == 1 and run.stderr.startswith("error: ")
    run = program("calibrate", "--help")
    assert run.returncode == 0 and "Usage: eyebolt calibrate" in run.stdout
