"""Prepared forces on arrays of another library that follows the Array API to the letter."""

import numpy as np
import pytest

from surrogate import DomainError, Scene, prepare

strict = pytest.importorskip("array_api_strict")

GEL = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 2.5)
BOX = {"wire_radius": (1e-4, 1e-3), "stiffening_exponent": (2.0, 4.0)}
VALUES = {"wire_radius": np.geomspace(1e-4, 1e-3, 40), "stiffening_exponent": np.linspace(2, 4, 40)}


@pytest.mark.parametrize("model", ["table", "eq13"])
@pytest.mark.parametrize("varying", [("wire_radius",), ("stiffening_exponent",), tuple(BOX)])
def test_the_forces_are_those_of_numpy_and_stay_in_the_library(varying, model):
    force = prepare(GEL, varying, {name: BOX[name] for name in varying}, model)
    values = [VALUES[name] for name in varying]
    result = force(*map(strict.asarray, values))
    assert isinstance(result, type(strict.asarray(1.0)))
    np.testing.assert_allclose(np.asarray(result), force(*values), rtol=1e-13)
    beyond = [strict.asarray(np.append(value, 9.0)) for value in values]
    some = np.asarray(force(*beyond, outside="nan"))
    assert (np.isnan(some[-1]), np.isnan(some[:-1]).any()) == (True, False)
    with pytest.raises(DomainError, match=rf"{varying[0]}\[40\] = 9.0"):
        force(*beyond)
