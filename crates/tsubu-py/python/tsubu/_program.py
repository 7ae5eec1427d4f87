"""The program `tsubu`, as the package has it."""

import sys

from tsubu import _tsubu


def main() -> None:
    """Runs the program with the words of the command line; ends with its exit code."""
    sys.exit(_tsubu.main(["tsubu", *sys.argv[1:]]))
