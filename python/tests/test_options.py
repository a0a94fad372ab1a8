"""Functions take what the commands of the same names take."""

from __future__ import annotations

import inspect
from typing import Any, Callable

import pytest

import eyebolt
from eyebolt._options import BagOptions, known
from eyebolt._simulation import SimulationOptions

# What writes files or prints in the program is returned here.
OUTPUT = {"output", "force", "json", "report", "save_overlay", "viewer_mcap", "timing", "overlay", "clouds", "csv", "help", "verbose"}
# Markers have an answer of their own, which is the program's alone.
MARKERS = {"marker", "eye_in_hand", "marker_only"}
# Arguments that stand for recordings.
FRAMES = {"depth", "camera", "joints", "joint_names", "names", "masks", "backgrounds"}


@pytest.mark.parametrize(
    ("function", "command", "besides"),
    [
        (eyebolt.calibrate, "calibrate", MARKERS),
        (eyebolt.segment, "segment", set()),
        # What is still being recorded is the program's.
        (eyebolt.pose, "pose", {"follow"}),
        (eyebolt.monitor, "monitor", {"calibration", "ros_domain", "localhost_only"}),
        (eyebolt.label, "label", {"recordings", "merge"}),
        (eyebolt.evaluate_models, "evaluate", {"recordings"}),
        (eyebolt.train, "train", {"what", "from", "from_"}),
        (eyebolt.simulate, "simulate", set()),
    ],
)
def test_options_are_the_flags(function: Callable[..., Any], command: str, besides: set[str]) -> None:
    parameters = inspect.signature(function).parameters
    named = {name for name, it in parameters.items() if it.kind is not inspect.Parameter.VAR_KEYWORD}
    if "bag" in parameters:
        named |= set(BagOptions.__annotations__)
    if "options" in parameters:
        named |= set(SimulationOptions.__annotations__)
    other = besides | OUTPUT | FRAMES | {"progress"}
    assert named - other == set(known(command)) - other


@pytest.mark.parametrize("function", [eyebolt.calibrate, eyebolt.pose, eyebolt.monitor, eyebolt.train, eyebolt.simulate])
def test_defaults_are_those_of_the_program(function: Callable[..., Any]) -> None:
    for name, parameter in inspect.signature(function).parameters.items():
        default = known(function.__name__).get(name, (False, False, None))[2]
        if default is not None and parameter.default is not None:
            assert str(parameter.default) == default, name


def test_everything_that_is_offered_is_there() -> None:
    for name in eyebolt.__all__:
        assert getattr(eyebolt, name).__doc__, name
    assert eyebolt.__version__
    assert set(dir(eyebolt)) >= set(eyebolt.__all__)
    assert {"shackle", "davit"} <= set(eyebolt.robots())
    with pytest.raises(AttributeError):
        eyebolt.nothing  # type: ignore[attr-defined]
