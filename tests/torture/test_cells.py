"""A part of the matrix of extreme values; `scripts/torture` runs the whole of it."""

import inspect
import sys

import surrogate

from .cases import cases
from .cells import corners, extremes
from .exact import close, mp
from .known import reason_of
from .part import Part


def test_every_public_function_is_in_the_matrix():
    tortured = {case.label.partition(":")[0] for case in cases()}
    functions = {n for n in surrogate.__all__ if inspect.isfunction(getattr(surrogate, n))}
    assert functions <= tortured | {"models"}  # which takes no argument


def test_cells_end_in_a_value_or_a_refusal_by_name():
    part = extremes(every=8)
    assert part.total > 3000
    assert not part.failures


def test_closed_forms_are_right_where_all_arguments_are_extreme():
    part = corners(number=40, seed=1)
    assert part.total > 1000
    assert not part.failures


def test_what_is_not_known_is_a_failure():
    part = Part("made-up", "A made-up part")
    part.fail("f", "other error", "f(x = None): TypeError")
    part.fail("contact_functions", "wrong value", "contact_functions: eq13(g = -0): -inf where inf")
    assert part.failures == ["f: other error: f(x = None): TypeError"]
    assert sum(part.known.values()) == 1
    assert reason_of(part.failures[0]) is None
    assert "FAILED" in part.text()


def test_only_the_result_can_overflow():
    for g, xi, n in ((1e300, 1e-300, 1.1), (1e-300, 1e300, 1.5), (0.0, 1.0, 5e-324)):
        value = surrogate.power_law_dissipation(g, xi, n)
        assert type(value) is float
        assert close(value, mp(xi) * mp(g) ** mp(n), 1e-13)
        assert surrogate.power_law_dissipation([g, 2.0], xi, n)[0] == value
    largest = sys.float_info.max
    assert surrogate.relative_force(1e-123, 1e177, largest, largest) == largest
