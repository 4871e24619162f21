"""Many scenes that share law and model: as if each had been looked at."""

import numpy as np
import pytest

from surrogate import Scene, cutting_force
from surrogate.choosing.auto_law import LawfulTerms, common_terms
from surrogate.choosing.common_choice import MANY
from surrogate.coupling.coverage import is_beyond
from surrogate.coupling.shipped import amplification
from surrogate.cutting.force import _summed
from surrogate.scene import NAMES

KINDS = {("projected", "eq13"), ("projected", "table"), ("slip", "table")}


def scenes(number):
    """Return scenes of many radii, from the far field to past the touch."""
    random = np.random.default_rng(20)
    for _ in range(number):
        mu, radius = 10.0 ** random.uniform((2.5, -4.0), (5.0, -3.0))
        gamma = 10.0 ** random.uniform(-1.5, 1.5) * mu * radius
        xi, wear = 10.0 ** random.uniform((-3.0, -3.0), (-0.5, 1.0)) * random.integers(0, 2, 2)
        factor = 10.0 ** random.uniform(0.0, 0.5)
        radii = radius * np.geomspace(1.0 / factor, factor, MANY)
        alpha = float(random.uniform(2.0, 9.0))
        yield Scene(mu, gamma, radii, xi, wear * mu, alpha)


@pytest.fixture(scope="module")
def pairs():
    """Scenes with what all their points share, or None."""
    return [(scene, common_terms(scene.values(), None)) for scene in scenes(60)]


def test_every_point_would_have_chosen_what_all_share(pairs):
    met = set()
    for scene, common in pairs:
        if common is None:
            continue
        lawful = LawfulTerms(scene.values(), None)
        sums = _summed(lawful.values, lawful, lawful.dtypes)
        _, _, friction, wear, holds, number, law, fit, of_law = sums
        assert set(lawful.names(number)) == {common.model.name}
        assert set(lawful.laws(law)) == {common.model.law}
        assert fit.max() <= common.bound * (1.0 + 1e-12)
        force = cutting_force(scene)
        assert np.array_equal(force.friction, friction)
        assert np.array_equal(force.wear, wear)
        assert np.array_equal(force.in_domain, holds)
        assert np.array_equal(force.law_error, of_law, equal_nan=True)
        assert np.array_equal(force.fit_error, fit)
        assert len(force.doubts) == bool(np.isnan(of_law).any())
        met.add((common.model.law, common.model.name))
    assert met == KINDS


def test_points_that_differ_share_nothing(pairs):
    shared = [common is not None for _, common in pairs]
    assert 0.3 < np.mean(shared) < 1.0
    radii = np.geomspace(1e-5, 1e-2, MANY)
    for wear in (500.0, 7750.0):
        scene = Scene(10e3, 5.0, radii, 0.01, wear, 6.0)
        assert common_terms(scene.values(), None) is None
        assert len(np.unique(cutting_force(scene).laws)) > 1


def test_an_error_that_is_asked_for_is_met_point_by_point(pairs):
    scene = next(scene for scene, common in pairs if common and common.model.law == "slip")
    assert common_terms(scene.values(), 0.02) is None
    assert np.all(cutting_force(scene, rtol=0.02).relative_error <= 0.02)


def test_what_is_beyond_all_solutions_is_known_nowhere():
    kappa, seen = amplification(), {True: 0, False: 0}
    for scene in scenes(100):
        ends = [(np.min(value), np.max(value)) for value in scene.values()]
        beyond = is_beyond(kappa, dict(zip(NAMES, ends, strict=True)))
        relative = scene.wear_strength / scene.shear_modulus
        at = scene.dimensionless_toughness, scene.stiffening_exponent
        known = kappa.place(*at, scene.friction_coefficient, relative).known
        assert not (beyond and np.any(known))
        seen[beyond] += 1
    assert min(seen.values()) > 5
