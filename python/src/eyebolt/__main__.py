"""The program, as it is without Python."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> int:
    """Runs `eyebolt` on the words of the command line; its exit status."""
    # The program listens for Ctrl-C itself, and is ended by it where it does not.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    started_by = [sys.executable, "-m", "eyebolt"]
    return _native.program(started_by, ["eyebolt", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
