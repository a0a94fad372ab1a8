"""Calibrating from arrays and recordings, against the program."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import eyebolt

from .conftest import JOINTS, Recorded, arrays_of, program


def pose(calibration: eyebolt.Calibration) -> Any:
    """Where the camera is said to be."""
    assert calibration.camera_from_base is not None
    return calibration.camera_from_base


def test_arrays_give_the_answer_of_the_program_to_the_last_bit(recorded: Recorded, tmp_path: Path) -> None:
    run = program("calibrate", recorded.folder, "-o", tmp_path / "calibration.json")
    assert run.returncode == 0, run.stderr
    of_arrays = eyebolt.calibrate(**recorded.told(), masks=recorded.masks)
    assert of_arrays.json == (tmp_path / "calibration.json").read_text()
    of_recording = eyebolt.calibrate(recorded.folder)
    assert of_recording.json == of_arrays.json
    assert of_arrays.trusted and len(of_arrays.configurations) == 5


def test_the_layout_of_arrays_does_not_matter(recorded: Recorded) -> None:
    once = eyebolt.calibrate(**recorded.told())
    # Rows are padded, columns interleaved with something else, frames a list.
    padded = np.zeros((5, 545, 960 * 2), recorded.depth.dtype)
    padded[:, 3:543, ::2] = recorded.depth
    view = padded[:, 3:543, ::2]
    assert not view.flags.c_contiguous
    told = {**recorded.told(), "depth": list(view), "joints": dict(zip(JOINTS, recorded.joints.T))}
    assert eyebolt.calibrate(**told).json == once.json
    rows = [dict(zip(JOINTS, row)) for row in recorded.joints]
    told = {**recorded.told(), "joints": rows, "joint_names": None, "depth": recorded.depth.astype(np.float64)}
    assert eyebolt.calibrate(**told).json == once.json


def test_cameras_may_be_told_in_several_ways(simulated: eyebolt.Simulation, calibration: eyebolt.Calibration) -> None:
    for camera in (simulated.camera.matrix, {"k": simulated.camera.matrix, "d": [], "distortion_model": "plumb_bob"}):
        found = eyebolt.calibrate(**{**arrays_of(simulated), "camera": camera})
        assert np.array_equal(pose(found), pose(calibration))


def test_millimetres(simulated: eyebolt.Simulation, calibration: eyebolt.Calibration) -> None:
    def millimetres(depth: object) -> object:
        return np.round(1e3 * np.asarray(depth)).astype(np.uint16)

    told = arrays_of(simulated)
    told.update(depth=millimetres(simulated.depth), backgrounds=millimetres(simulated.backgrounds))
    found = eyebolt.calibrate(**told)
    assert found.trusted
    assert np.allclose(pose(found), pose(calibration), atol=2e-4)
    # Tenths of millimetres.
    tenths = (10 * told["depth"].astype(np.uint32)).clip(max=65534).astype(np.uint16)
    told.update(depth=tenths, backgrounds=None, depth_unit=1e-4)
    assert eyebolt.calibrate(**told).trusted


def test_what_a_calibration_tells(simulated: eyebolt.Simulation, calibration: eyebolt.Calibration) -> None:
    assert calibration.trusted and calibration.verdict == "trusted" and calibration.reasons == []
    there, back = calibration.camera_from_base, calibration.base_from_camera
    assert there is not None and back is not None
    assert np.allclose(there @ back, np.eye(4), atol=1e-12)
    covariance = calibration.covariance
    assert covariance is not None and covariance.shape == (6, 6)
    assert np.all(np.linalg.eigvalsh(covariance) > 0)
    assert calibration.expected_error is not None and calibration.expected_error.translation_mm < 10
    assert {frame.configuration for frame in calibration.configurations} == set(range(5))
    found = simulated.evaluate(calibration)
    assert found.translation_mm is not None and found.translation_mm < 5
    assert "trusted" in repr(calibration)
    page = calibration._repr_html_()
    assert "TRUSTED" in page and f"{there[0, 3]:.6f}" in page


def test_files(calibration: eyebolt.Calibration, tmp_path: Path) -> None:
    path = calibration.save(tmp_path / "calibration.json")
    assert path == tmp_path / "calibration.json" and path.read_text() == calibration.json
    with pytest.raises(eyebolt.Error, match="`force`"):
        calibration.save(path)
    loaded = eyebolt.Calibration.load(path)
    assert loaded.json == calibration.json
    assert np.array_equal(pose(loaded), pose(calibration))
    page = calibration.report(tmp_path / "report.html")
    assert page.startswith("<!DOCTYPE html>") or page.startswith("<!doctype html>")
    assert (tmp_path / "report.html").read_text() == page
    layout = calibration.viewer(tmp_path / "viewer.mcap")
    assert layout == tmp_path / "viewer.layout.json" and "configById" in json.loads(layout.read_text())
    assert (tmp_path / "viewer.mcap").read_bytes().startswith(b"\x89MCAP")
    with pytest.raises(eyebolt.Error, match="`force`"):
        calibration.viewer(tmp_path / "viewer.mcap")
    pictures = calibration.overlays()
    assert len(pictures) == 5
    assert {picture.shape for picture in pictures.values()} == {(480, 640, 3)}
    with pytest.raises(eyebolt.Error, match="Calibrate again"):
        loaded.report()


def test_exports(calibration: eyebolt.Calibration, tmp_path: Path) -> None:
    path = calibration.save(tmp_path / "calibration.json")
    for form in ("tf2", "ros2-launch", "csv"):
        assert calibration.export(form).decode() == program("export", path, "--as", form).stdout
    with pytest.raises(eyebolt.Error) as told:
        calibration.export("no such format")
    assert told.value.field == "as" and "tf2" in str(told.value.remedy)


def test_a_refusal_says_why_and_goes_beside(simulated: eyebolt.Simulation, tmp_path: Path) -> None:
    told = arrays_of(simulated)
    few = {name: told[name][:4] for name in ("depth", "joints", "names")}
    refused = eyebolt.calibrate(**{**told, **few})
    assert not refused.trusted and refused.reasons and refused.remedies
    assert refused.save(tmp_path / "calibration.json") == tmp_path / "calibration.rejected.json"
    assert not (tmp_path / "calibration.json").exists()
    assert json.loads(refused.json)["verdict"] == "refused"
