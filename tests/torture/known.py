"""What is found and not mended yet: each with a figure or a reason, and none of them silent.

An entry is a regular expression on `case: outcome: what`; entries that nothing matches any more are
named by a full run, so that they are dropped.
"""

import re

__all__ = ["KNOWN", "reason_of"]

KNOWN = {}


def reason_of(failure):
    """Return the entry that a failure matches, or None."""
    return next((p for p in KNOWN if re.match(p, failure, re.DOTALL)), None)
