"""The calibration between a depth camera and a robot arm, without markers.

Depth is `(frames, rows, columns)`: `uint16` in millimetres, or `float32` or `float64` in metres; 0 is no depth. Joints are in
radians, metres where they slide. ``a_from_b`` is a `(4, 4)` matrix that maps coordinates in `b` to coordinates in `a`,
metres; the camera's frame is the depth *optical* frame (x right, y down, z forward).

    >>> import eyebolt
    >>> calibration = eyebolt.calibrate(depth, camera, joints, joint_names=names, robot="arm.urdf")  # doctest: +SKIP
    >>> calibration.trusted, calibration.camera_from_base                                           # doctest: +SKIP

Every function takes what the command of the same name takes, by the names of its flags. Long work tells `progress` how far
it is, lets other threads go on, and ends on Ctrl-C. What goes wrong is an `Error` that says what to do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._calibration import Calibration as Calibration
    from ._calibration import Configuration as Configuration
    from ._calibration import JointOffset as JointOffset
    from ._calibration import Size as Size
    from ._calibration import calibrate as calibrate
    from ._camera import Camera as Camera
    from ._datasets import Labelled as Labelled
    from ._datasets import label as label
    from ._errors import Error as Error
    from ._evaluation import Evaluation as Evaluation
    from ._evaluation import Table as Table
    from ._evaluation import evaluate as evaluate
    from ._evaluation import evaluate_models as evaluate_models
    from ._monitoring import Suspect as Suspect
    from ._monitoring import View as View
    from ._monitoring import Watch as Watch
    from ._monitoring import monitor as monitor
    from ._networks import EndEffectorPose as EndEffectorPose
    from ._networks import Segmentation as Segmentation
    from ._networks import TrainedNetwork as TrainedNetwork
    from ._networks import pose as pose
    from ._networks import segment as segment
    from ._networks import train as train
    from ._simulation import Simulation as Simulation
    from ._simulation import robots as robots
    from ._simulation import simulate as simulate

    __version__: str

# Where each name is: the program, which is in the package too, starts without NumPy.
_HOMES = {
    "_calibration": ("Calibration", "Configuration", "JointOffset", "Size", "calibrate"),
    "_camera": ("Camera",),
    "_datasets": ("Labelled", "label"),
    "_errors": ("Error",),
    "_evaluation": ("Evaluation", "Table", "evaluate", "evaluate_models"),
    "_monitoring": ("Suspect", "View", "Watch", "monitor"),
    "_networks": ("EndEffectorPose", "Segmentation", "TrainedNetwork", "pose", "segment", "train"),
    "_simulation": ("Simulation", "robots", "simulate"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME_OF)


if not TYPE_CHECKING:
    # Checkers know the names from above.
    def __getattr__(name: str) -> object:
        from importlib import import_module

        if name == "__version__":
            from ._native import version

            return version()
        if name not in _HOME_OF:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        found: object = getattr(import_module(f".{_HOME_OF[name]}", __name__), name)
        globals()[name] = found
        return found


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__, "__version__"])
