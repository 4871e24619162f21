"""What the command lines have in common: complaints in one line, exit codes, early readers."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Callable, Collection
from typing import Any, NoReturn

from surrogate.errors import InputError, WirecutError

__all__ = ["OneLineParser", "complete", "run_command"]


class OneLineParser(argparse.ArgumentParser):
    """A parser whose complaints take one line, and to which -1.6J/m2 is a value and no option."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._negative_number_matcher = re.compile(r"-\.?[0-9]")

    def _print_message(self, message: str, file: Any = None) -> None:
        """Print a help or version; that it cannot be printed is not passed over in silence."""
        if message:
            (file or sys.stderr).write(message)

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments."""
        unit = re.fullmatch(r"unrecognized arguments: ([^\W\d_]{1,3}(?:[/^*²³\w]{0,5}))", message)
        hint = f" (a unit goes with its number, as in 685{unit[1]})" if unit else ""
        raise InputError(f"{message}{hint}; see '{self.prog} --help'.")


def complete(parser: argparse.ArgumentParser) -> None:
    """Answer the shell's question for completions by argcomplete, where it asks one.

    Examples
    --------
    >>> complete(OneLineParser(prog="wirecut"))
    """
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser)


def run_command(
    name: str,
    action: Callable[[], int],
    packages: Collection[str] = (),
    install: str = "",
) -> int:
    """Run a command and return its exit code.

    Parameters
    ----------
    name : str
        Begins every complaint.
    action : callable
        Does the work and returns the exit code.
    packages : collection of str
        Packages that may be missing; how to get them is then said in one line.
    install : str
        What to give to ``pip install`` for them.

    Returns
    -------
    int
        That of the action, or 2 after bad input, where a package is missing or the disk is full,
        with the reason in one line on the standard error stream, or 130 after an interruption.

    Examples
    --------
    >>> run_command("wirecut", lambda: 0)
    0
    """
    for stream in (sys.stdout, sys.stderr):
        _print_whatever_the_console(stream)
    try:
        try:
            return action()
        finally:
            sys.stdout.flush()  # here, where a reader that left early does no harm
    except WirecutError as error:
        return _refused(name, str(error))
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in packages:
            raise
        return _refused(name, f"{package} is not installed; get it with: pip install '{install}'")
    except BrokenPipeError:  # the reader, such as head, has seen enough
        _print_nothing_more()
        return 0
    except OSError as error:
        if error.filename is None:
            _print_nothing_more()
        what = "what is printed" if error.filename is None else str(error.filename)
        return _refused(name, f"{what} cannot be written or read ({error.strerror})")
    except KeyboardInterrupt:
        sys.stderr.write(f"\n{name}: interrupted\n")
        return 130


def _print_whatever_the_console(stream: Any) -> None:
    """Let letters that a console does not know be printed by their number, not end in an error."""
    if getattr(stream, "errors", None) in ("strict", "surrogateescape"):
        stream.reconfigure(errors="backslashreplace")


def _print_nothing_more() -> None:
    """Drop what waits to be printed, which would fail again when Python ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _refused(name: str, reason: str) -> int:
    sys.stderr.write(f"{name}: {' '.join(reason.split())}\n")
    return 2
