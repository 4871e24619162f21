"""A part of the matrix of extreme values; `scripts/torture` runs the whole of it."""

import inspect
import sys
import warnings

import numpy as np

import surrogate
from surrogate.scene import NAMES

from .cases import cases
from .cells import corners, extremes
from .exact import CONTACT, GRADIENT, RADIUS, close, mp
from .known import KNOWN, reason_of
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


def test_what_is_not_known_is_a_failure(monkeypatch):
    part = Part("made-up", "A made-up part")
    part.fail("f", "other error", "f(x = None): TypeError")
    known, reason = r"f: wrong value: .*\(x = -0\)", "its value at -0"
    monkeypatch.setitem(KNOWN, known, reason)
    part.fail("f", "wrong value", "f(x = -0): 1.0 where 2 is exact")
    assert part.failures == ["f: other error: f(x = None): TypeError"]
    assert part.known == {known: 1}
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


def test_closed_forms_leave_the_range_of_numbers_only_with_their_result():
    assert surrogate.contact_functions(-0.0, 2.0, model="eq13").delta == np.inf
    assert surrogate.contact_functions([-0.0], 2.0, model="eq13").delta[0] == np.inf
    for g in (1e300, largest := sys.float_info.max):
        load = surrogate.contact_functions(g, 3.0, model="eq9").normal_load
        assert load == surrogate.contact_functions([g], 3.0, model="eq9").normal_load[0]
        assert close(load, CONTACT["eq9"](g, 3.0)[1], 1e-13)
    scene = surrogate.Scene(1e-300, 1e76, 1.0, 1e-79, 0.0, 3.0)
    slopes = surrogate.force_gradient(scene, "eq9")
    for name, exactly in zip(NAMES, GRADIENT["eq9"](*scene.values()), strict=True):
        assert close(getattr(slopes, name), exactly, 1e-13), name
    for model in ("low-toughness", "friction-free"):
        for friction, wear in ((0.1, largest), (1e300, 1e200), (1e-300, 5e-324)):
            material = 1e100, 1e250, friction, wear, 3.0
            scene = surrogate.Scene(*material[:2], 1.0, *material[2:])
            radius = surrogate.transition_radius(scene, model)
            assert close(radius, RADIUS[model](*material), 1e-13)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", surrogate.ImplausibleInputWarning)
        scene = surrogate.Scene(1e200, 1.0, [1e-4], 1e200, 1.0, 3.0)
        assert surrogate.transition_radius(scene, "eq9") == np.inf
