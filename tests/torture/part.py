"""One part of the report: what was tried, how it ended, and what is wrong."""

from collections import Counter
from dataclasses import dataclass, field

from .known import KNOWN, reason_of

__all__ = ["Part"]

MOST_SHOWN = 20


@dataclass
class Part:
    """Counts of outcomes, and the failures one by one.

    Parameters
    ----------
    name : str
        Mark of the part on the page.
    title : str
        What was tried, in one sentence.
    counts : Counter
        How often each outcome came about, by (row, outcome).
    failures : list of str
        What must not be, and is not known.
    notes : list of str
        Figures and findings that are no failures.
    known : Counter
        How often each entry of `KNOWN` came about.
    """

    name: str
    title: str
    counts: Counter = field(default_factory=Counter)
    failures: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    known: Counter = field(default_factory=Counter)
    seconds: float = 0.0

    def count(self, row, outcome, number=1):
        """Count an outcome."""
        self.counts[row, outcome] += number

    def fail(self, row, outcome, what):
        """Count an outcome that must not be, and remember it."""
        failure = f"{row}: {outcome}: {what}"
        if pattern := reason_of(failure):
            self.counts[row, "known fault"] += 1
            self.known[pattern] += 1
            return
        self.counts[row, outcome] += 1
        self.failures.append(failure)

    @property
    def total(self):
        """How many trials there were."""
        return sum(self.counts.values())

    def table(self):
        """Return head and rows: one row for each kind of trial, one column for each outcome."""
        outcomes = list(dict.fromkeys(outcome for _, outcome in self.counts))
        rows = list(dict.fromkeys(row for row, _ in self.counts))
        body = [[row, *(str(self.counts.get((row, o), 0)) for o in outcomes)] for row in rows]
        if len(rows) > 1:
            sums = [sum(self.counts.get((row, o), 0) for row in rows) for o in outcomes]
            body.append(["all", *map(str, sums)])
        return ["tried on", *outcomes], body

    def text(self):
        """Return the part as lines for a terminal."""
        head, body = self.table()
        widths = [max(len(row[i]) for row in [head, *body]) for i in range(len(head))]
        lines = [f"{self.title} ({self.total} trials, {self.seconds:.0f} s)"]
        lines += [
            "  " + "  ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip()
            for row in [head, *body]
        ]
        lines += [f"  note: {note}" for note in self.notes]
        lines += [f"  known, {n} times: {KNOWN[one]}" for one, n in self.known.items()]
        lines += [f"  FAILED {failure}" for failure in self.failures[:MOST_SHOWN]]
        if len(self.failures) > MOST_SHOWN:
            lines.append(f"  and {len(self.failures) - MOST_SHOWN} failures more")
        return "\n".join(lines)
