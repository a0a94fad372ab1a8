"""What is said of arguments that cannot be used."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import eyebolt


def told(**changed: Any) -> dict[str, Any]:
    """Arguments that are good but for `changed`; nothing is calibrated where one is not."""
    good: dict[str, Any] = {
        "depth": np.full((3, 6, 8), 1000, np.uint16),
        "camera": np.array([[9.0, 0, 4], [0, 9.0, 3], [0, 0, 1]]),
        "joints": np.zeros((3, 7)),
        "joint_names": [f"joint{number}" for number in range(1, 8)],
        "robot": "shackle",
    }
    return {**good, **changed}


@pytest.mark.parametrize(
    ("field", "changed"),
    [
        ("depth", {"depth": np.zeros((6, 8), np.uint16)}),
        ("depth", {"depth": np.zeros((3, 6, 8), np.int32)}),
        ("depth", {"depth": np.zeros((3, 6, 8), ">u2")}),
        ("depth", {"depth": np.zeros((0, 6, 8), np.uint16)}),
        ("depth", {"depth": [np.zeros((6, 8), np.uint16), np.zeros((6, 8), np.float32), np.zeros((6, 8), np.uint16)]}),
        ("camera", {"camera": None}),
        ("camera", {"camera": np.eye(4)}),
        ("camera", {"camera": np.array([[9.0, 1, 4], [0, 9.0, 3], [0, 0, 1]])}),
        ("camera", {"camera": "/nowhere/camera_info.yaml"}),
        ("joints", {"joints": None}),
        ("joints", {"joints": np.zeros((2, 7))}),
        ("joints", {"joints": {"joint1": np.zeros(2)}}),
        ("joint_names", {"joint_names": None}),
        ("joint_names", {"joint_names": ["joint1"]}),
        ("names", {"names": ["a"]}),
        ("masks", {"masks": np.zeros((2, 6, 8), bool)}),
        ("robot", {"robot": None}),
        ("robot", {"robot": "no such robot"}),
        ("max_error_mm", {"max_error_mm": -1}),
        ("method", {"method": "guess"}),
        ("depth_unit", {"depth_unit": "cm"}),
        ("depth_unit", {"depth_unit": "m"}),
        ("threads", {"threads": 0}),
        ("progress", {"progress": 7}),
        ("seed", {"seed": True}),
        ("joint", {"joint": {"no such joint": 0.5}}),
    ],
)
def test_arguments_that_cannot_be_used(field: str, changed: dict[str, Any]) -> None:
    with pytest.raises(eyebolt.Error) as error:
        eyebolt.calibrate(**told(**changed))
    assert error.value.field == field, str(error.value)
    assert error.value.remedy, str(error.value)
    assert "--" not in str(error.value)


def test_frames_that_saw_nothing() -> None:
    with pytest.raises(eyebolt.Error, match="frame 0: no pixel has depth"):
        eyebolt.calibrate(**told(depth=np.zeros((3, 6, 8), np.uint16)))


def test_depth_in_another_unit() -> None:
    with pytest.raises(eyebolt.Error, match="looks like millimetres") as error:
        eyebolt.calibrate(**told(depth=np.full((3, 6, 8), 1250.0, np.float32)))
    assert "`depth_unit`" in str(error.value.remedy)


def test_recordings_that_are_not_there() -> None:
    with pytest.raises(eyebolt.Error) as error:
        eyebolt.calibrate("/nowhere/recording.mcap")
    assert error.value.file == "/nowhere/recording.mcap" and error.value.remedy
    with pytest.raises(eyebolt.Error, match="the recording has its own"):
        eyebolt.calibrate("/nowhere/recording.mcap", camera=np.eye(3))  # type: ignore[call-overload]


def test_unknown_arguments() -> None:
    with pytest.raises(TypeError, match="colour"):
        eyebolt.calibrate(**told(colour=1))


def test_errors_survive_pickling() -> None:
    error = eyebolt.Error("text", "file", "field", "remedy")
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.file, copy.field, copy.remedy) == ("text", "file", "field", "remedy")
    assert isinstance(error, ValueError)
