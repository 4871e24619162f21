"""Maps and their points can be pickled and deep-copied, as workers and notebooks do."""

import copy
import pickle

import numpy as np
import pytest

from surrogate import MapPoints, Scene, regime_map


@pytest.mark.parametrize("again", [copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_a_map_and_its_points_survive(again):
    made = regime_map("R_w/l_e", "R_w/l_w", ((0.01, 100.0), (0.01, 100.0)), {"xi": 0.0})
    other = again(made)
    np.testing.assert_array_equal(other.force.total, made.force.total)
    assert dict(other.fixed) == dict(made.fixed)
    points = MapPoints(Scene(685.0, 1.6, [1e-4, 2e-4]), "gel", std={"shear_modulus": 30.0})
    assert again(points).std["shear_modulus"] == 30.0
    with pytest.raises(TypeError):
        points.std["shear_modulus"] = 1.0
