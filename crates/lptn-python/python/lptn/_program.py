"""The program `lptn` of the wheel: the same as the native one, from the module."""

import os
import signal
import sys


def main() -> None:
    """Does what the command line says, and ends the process."""
    from . import _lptn

    # the program listens to Ctrl-C itself; a closed pipe ends it as it ends others
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    code = _lptn.program(sys.argv)
    # nothing of Python is left to do
    os._exit(code)
