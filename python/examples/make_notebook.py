"""Writes and runs calibrate.ipynb: python make_notebook.py, where eyebolt, nbformat, nbclient and ipykernel are installed."""

from pathlib import Path

import nbformat
from nbclient import NotebookClient

CELLS = [
    ("markdown", "# Where is the camera?\n\nA simulated arm and depth camera, so that the truth is known: depth, joint positions and "
                 "the robot description in, the camera's pose out. With frames of your own, only the first cell changes."),
    ("code", "import eyebolt\n\nsimulation = eyebolt.simulate(robot=\"shackle\", sensor=\"d435\", seed=7, configurations=6, frames=3)\n"
             "simulation.depth.shape, simulation.depth.dtype, simulation.joints.shape, simulation.camera"),
    ("markdown", "Depth is `(frames, rows, columns)` in metres here (`uint16` would be millimetres), joints are in radians. Nothing "
                 "else is needed: no marker, no initial guess, no mask."),
    ("code", "calibration = eyebolt.calibrate(\n    simulation.depth,\n    simulation.camera,\n    simulation.joints,\n"
             "    joint_names=simulation.joint_names,\n    robot=\"shackle\",\n)\ncalibration"),
    ("markdown", "How far off is it really, and how far did it expect to be?"),
    ("code", "truth = simulation.evaluate(calibration)\n"
             "print(f\"off by {truth.translation_mm:.2f} mm and {truth.rotation_deg:.3f} degrees\")\n"
             "print(f\"expected {calibration.expected_error}\")"),
    ("markdown", "A camera that was bumped by 30 mm after half of the configurations is found out: the calibration is no longer true."),
    ("code", "later = eyebolt.simulate(\n    robot=\"shackle\", sensor=\"d435\", seed=7, configurations=6, frames=3, bump=(30, 2)\n)\n"
             "watch = eyebolt.monitor(\n    calibration, later.depth, later.camera, later.joints,\n"
             "    joint_names=later.joint_names, robot=\"shackle\",\n)\nwatch.alarm, watch.moved[0].what"),
    ("markdown", "What goes wrong is an `eyebolt.Error` that says what to do."),
    ("code", "try:\n    eyebolt.calibrate(1000 * simulation.depth, simulation.camera, simulation.joints,\n"
             "                      joint_names=simulation.joint_names, robot=\"shackle\")\n"
             "except eyebolt.Error as error:\n    print(error)"),
]


def main() -> None:
    notebook = nbformat.v4.new_notebook()
    makers = {"markdown": nbformat.v4.new_markdown_cell, "code": nbformat.v4.new_code_cell}
    notebook.cells = [makers[kind](text) for kind, text in CELLS]
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    for cell in notebook.cells:
        # When it was run is nobody's business.
        cell.metadata.pop("execution", None)
    notebook.metadata = {"language_info": {"name": "python"}, "kernelspec": {"name": "python3", "display_name": "Python 3"}}
    nbformat.write(notebook, Path(__file__).with_name("calibrate.ipynb"))


if __name__ == "__main__":
    main()
