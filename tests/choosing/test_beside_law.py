"""Errors of the models under each law beside coupled solutions, over all loads that are known."""

import numpy as np
import pytest

from surrogate import InputError, Scene, cutting_force, models
from surrogate.choosing.beside_law import _scenes, errors_over_reach
from surrogate.choosing.by_name import force_model
from surrogate.coupling.shipped import amplification


@pytest.mark.parametrize("law", ["projected", "slip", "coupled"])
def test_they_are_those_that_forces_tell(law):
    scenes = _scenes(amplification())
    errors = cutting_force(Scene(*scenes), "table", law=law).relative_error
    worst, median = errors_over_reach(force_model("table"), law)
    assert len(scenes[0]) > 500
    assert (worst, median) == (np.max(errors), np.median(errors))
    assert [each.error for each in models(law) if each.name == "table"] == [worst]


def test_eq13_is_within_its_bound_of_the_coupled_force():
    scenes = _scenes(amplification())
    coupled = cutting_force(Scene(*scenes), "table", law="coupled")
    formula = cutting_force(Scene(*scenes), "eq13").total
    off = np.abs(formula / coupled.total - 1.0)
    worst, median = errors_over_reach(force_model("eq13"), "projected")
    assert np.max(off) <= worst + np.max(coupled.relative_error)
    assert median < worst
    assert errors_over_reach(force_model("eq9"), "projected") is None


def test_what_nobody_measured_is_left_empty():
    projected = {each.name: each for each in models("projected")}
    assert projected["high-toughness"].error is None
    assert projected["high-toughness"].domain == "Gamma_o >= 10 mu R_w"
    assert "tau_w/mu up to" in projected["eq13"].domain
    for wrong in ("auto", 3, ["slip"]):
        with pytest.raises(InputError, match="law must be one of projected, slip, coupled"):
            models(wrong)
