"""The program: ``python -m trilith run MODEL``, or ``trilith`` where the package is installed."""

from __future__ import annotations

import sys


def main() -> None:
    """Runs the program with the arguments of the process, and ends it."""
    import signal

    from ._native import program

    # The program has its own way with Ctrl-C, and the interpreter's would never come to its turn.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    program(["trilith", *sys.argv[1:]])


if __name__ == "__main__":
    main()
