"""Errors in the language of the command line: options by their names, no syntax of Python."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping

__all__ = ["in_options"]

_PYTHON_TOO = re.compile(
    r"\s*\((?:\w+=(?:, | and | )?)+in Python\)|, (?:\w+=(?: and )? ?)+in Python"
)
_ASSIGNED = re.compile(r"\b(\w+)=(True|None|'[^']*'|-?[0-9][0-9.eE+-]*(?<!\.)(?!\w))")
_GONE = "\0"
_CLAUSE = re.compile(rf"(?:, |; )?(?:or )?(?:give |choose )?{_GONE}[^,;]*?(?=, |; |\.$|$)")
_PLACE = re.compile(r"\b(\w+)\[([0-9]+)\]")
_WORDS = {
    "wire_radius(?= must| =)": "the wire's radius",
    "force_std": "a column force_std_N_per_m",
    "change the scene": "change the values",
}


def in_options(message: str, parser: argparse.ArgumentParser) -> str:
    """Return an error's message as the user of a command can act on it.

    Parameters
    ----------
    message : str
        As Python's callers read it, with ``name = value`` and remedies such as ``name=value``.
    parser : argparse.ArgumentParser
        Of the command: names become its options, and remedies that it has not are left out.

    Examples
    --------
    >>> parser = argparse.ArgumentParser()
    >>> action = parser.add_argument("--model")
    >>> in_options("alpha[0] = 1.0; give 2, or extrapolate=True, or model='eq13'.", parser)
    'alpha of wire 1 = 1.0; give 2, or --model eq13.'
    """
    options = {
        action.dest: max(action.option_strings, key=len)
        for action in parser._actions
        if action.option_strings
    }
    message = _PYTHON_TOO.sub("", message)
    message = _ASSIGNED.sub(lambda match: _option(match, options), message)
    message = _CLAUSE.sub("", message)
    if "1 of 1 values" in message:
        message = re.sub(r"\s*\(1 of 1 values\)|, 1 of 1 values", "", message)
        message = _PLACE.sub(r"\1", message)
    message = _PLACE.sub(lambda match: f"{match[1]} of wire {int(match[2]) + 1}", message)
    for name, option in options.items():
        behind = "" if "_" in name or name == "rtol" else r"(?= (?:must|=|is not known))"
        message = re.sub(rf"(?<![-\w<{{]){name}(?![\w>}}]){behind}", option, message)
    for words, others in _WORDS.items():
        message = re.sub(rf"(?<![-\w]){words}(?!\w)", others, message)
    return message


def _option(match: re.Match[str], options: Mapping[str, str]) -> str:
    option = options.get(match[1])
    if option is None:
        return _GONE
    return option if match[2] == "True" else f"{option} {match[2].strip(chr(39))}"
