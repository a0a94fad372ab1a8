"""What a notebook shows of a calibration."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Optional

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._calibration import Calibration

_COLOURS = {"trusted": "#1a7f37", "refused": "#cf222e"}


def calibration_html(calibration: Calibration) -> str:
    """Verdict, reasons, transform and errors."""
    verdict = calibration.verdict
    used = sum(frame.used for frame in calibration.configurations)
    parts = [
        f"<b style='color:{_COLOURS.get(verdict, 'inherit')}'>{escape(verdict.upper())}</b> "
        f"({used} of {len(calibration.configurations)} frames used)"
    ]
    if calibration.reasons:
        parts.append("<ul>" + "".join(f"<li>{escape(reason)}</li>" for reason in calibration.reasons) + "</ul>")
    position = calibration.camera_position_error_mm
    rows: list[tuple[str, object]] = [
        ("expected error", calibration.expected_error),
        ("the camera's own position", None if position is None else f"{position:.1f} mm"),
        ("worst when one is left out", calibration.leave_one_out),
        ("surfaces against outlines", calibration.disagreement),
    ]
    told = "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows if value is not None)
    parts.append(f"<table>{told}</table>" if told else "")
    parts.append(_matrix("camera_from_base (m)", calibration.camera_from_base))
    return "<div>" + "".join(parts) + "</div>"


def _matrix(name: str, matrix: Optional[NDArray[np.float64]]) -> str:
    if matrix is None:
        return ""
    cells = ["".join(f"<td style='text-align:right'>{value:.6f}</td>" for value in row) for row in matrix.tolist()]
    return f"<table><caption>{name}</caption>" + "".join(f"<tr>{row}</tr>" for row in cells) + "</table>"
