"""Prepared forces under the laws "coupled" and "auto": their numbers, promises and refusals."""

from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pytest
from boxes import TISSUE as HERE
from boxes import prints_alike

from surrogate import (
    AccuracyError,
    DomainError,
    InputError,
    Scene,
    cutting_force,
    force_gradient,
    prepare,
)
from surrogate.coupling.coverage import uncovered
from surrogate.coupling.shipped import amplification
from surrogate.scene import NAMES

TISSUE = HERE.scene
#: By which the polynomial of kappa is off where it is evaluated in plain powers: its terms, of
#: which each loses some 2**-53, are up to 1e6 together; about the middle of its range they are 500.
PLAIN = 1e-9
ONES = [(name,) for name in NAMES]
SEVERAL = [("toughness", "wire_radius"), ("wear_strength", "wire_radius"), NAMES]
ALONE = {"wear alone": (0.0, 1e3), "friction alone": (0.02, 0.0), "both": (0.01, 1e3)}


def of(varying, law="coupled", fixed=TISSUE, **options):
    return prepare(fixed, varying, HERE.of(varying), law=law, **options)


@pytest.mark.parametrize("load", ALONE.values(), ids=ALONE)
@pytest.mark.parametrize("varying", ONES + SEVERAL, ids=str)
def test_it_is_the_coupled_force_and_the_same_for_numbers(varying, load):
    fixed = replace(TISSUE, friction_coefficient=load[0], wear_strength=load[1])
    force, values = of(varying, fixed=fixed), HERE.points(varying)
    scene = HERE.scene_of(varying, values, fixed)
    found = force(*values)
    expected = cutting_force(scene, "table", law="coupled")
    np.testing.assert_allclose(found, expected.total, rtol=PLAIN)
    assert force.law == "coupled"
    assert np.max(expected.relative_error) <= force.relative_error < 0.1
    for i in range(20):
        assert force(*(float(value[i]) for value in values)) == found[i]
    slopes, own = force_gradient(scene, "table", law="coupled"), force.gradient(*values)
    for name in varying:
        np.testing.assert_allclose(own[name], getattr(slopes, name), rtol=PLAIN)


@pytest.mark.parametrize("load", ALONE.values(), ids=ALONE)
@pytest.mark.parametrize("name", NAMES[:5])
def test_what_is_proven_to_be_monotonic_is_inverted(name, load):
    fixed = replace(TISSUE, friction_coefficient=load[0], wear_strength=load[1])
    force, (values,) = of((name,), fixed=fixed), HERE.points((name,), 300)
    signs = set(np.sign(force.derivative(values)))
    if force.monotonic == "unknown":
        assert len(signs) == 2
        return
    assert signs == {1.0 if force.monotonic == "rising" else -1.0}
    back = force.inverse(force(values))
    np.testing.assert_allclose(force(back), force(values), rtol=1e-14)


def test_a_force_that_turns_is_not_inverted():
    """Friction makes the force rise with the modulus, wear makes it fall."""
    turns = {}
    for xi, tau in ((0.0, 1e3), (0.01, 500.0), (0.02, 0.0)):
        fixed = replace(TISSUE, friction_coefficient=xi, wear_strength=tau)
        force = of(("shear_modulus",), fixed=fixed)
        signs = set(np.sign(force.derivative(np.linspace(*HERE.ends["shear_modulus"], 2000))))
        turns[force.monotonic] = signs
    assert turns == {"falling": {-1.0}, "unknown": {-1.0, 1.0}, "rising": {1.0}}
    with pytest.raises(InputError, match="must be monotonic to be inverted"):
        of(("stiffening_exponent",)).inverse(6.0)


def test_where_solutions_end_is_proven_over_the_whole_range():
    """A range is accepted where all its points are within the reach, and refused with one."""
    random, accepted, refused = np.random.default_rng(4), 0, 0
    kappa = amplification()
    for _ in range(300):
        box = {}
        for name, (low, high) in (HERE.ends | {"stiffening_exponent": (3.0, 9.0)}).items():
            ends = np.sort(random.uniform(low, high, 2))
            box[name] = tuple(ends.tolist()) if random.uniform() < 0.4 else (ends[0], ends[0])
        for name, most in (("friction_coefficient", 0.3), ("wear_strength", 2e4)):
            scale = most * random.uniform() ** 2 / HERE.ends[name][1]
            box[name] = tuple(scale * end for end in box[name])
        shares = random.uniform(size=(6, 2000))
        low, high = np.array(list(box.values())).T[:, :, None]
        mu, gamma, radius, xi, wear, alpha = low + (high - low) * shares
        known = kappa.share(gamma / (mu * radius), alpha, xi, wear / mu) <= 1.0
        gap = uncovered(kappa, box)
        if gap is None:
            accepted += 1
            assert known.all()
        else:
            scene, share = gap
            refused += 1
            assert share > 1.0  # none is refused unproven
            inside = [box[name][0] <= scene[name] <= box[name][1] for name in NAMES]
            assert all(inside)
    assert min(accepted, refused) > 50


def test_beyond_the_reach_it_is_refused_with_where():
    much = replace(TISSUE, friction_coefficient=0.9)
    with pytest.raises(DomainError, match=r"xi = 0\.9.* times it; give narrower ranges"):
        of(("wire_radius",), fixed=much)
    with pytest.raises(DomainError, match="where no coupled solution is near"):
        of(("wire_radius",), fixed=replace(TISSUE, toughness=3e3))
    bare = of(("wire_radius",), fixed=Scene(685.0, 1.6, 1e-4))
    assert (bare.relative_error, bare(1e-3), bare.terms) == (0.0, 1.6, {})


LADDER = {
    (0.0, 1e-3): ("projected", 0.02),
    (0.001, 50.0): ("slip", 0.02),
    (0.02, 2e3): ("coupled", 0.05),
    (0.9, 1e3): ("projected", None),
}
"""By xi and tau_w: the law that "auto" takes, and what error will do."""


@pytest.mark.parametrize("load", LADDER)
def test_auto_is_one_law_whose_error_is_proven_or_said_to_be_unknown(load):
    law, rtol = LADDER[load]
    fixed = replace(TISSUE, friction_coefficient=load[0], wear_strength=load[1])
    force = of(("wire_radius",), "auto", fixed)
    assert force.law == law
    (radii,) = HERE.points(("wire_radius",))
    scene = HERE.scene_of(("wire_radius",), (radii,), fixed)
    model = "table" if force.terms["wear"] == "table" else "eq13"
    expected = cutting_force(scene, model, law=law).total
    np.testing.assert_allclose(force(radii), expected, rtol=PLAIN)
    if rtol is None:
        assert np.isnan(force.relative_error)
        assert force.fit_error <= 0.02
        assert "error unknown, of the models alone up to" in str(force)
        with pytest.raises(AccuracyError, match=r"is known to nobody, as at xi = 0\.9"):
            of(("wire_radius",), "auto", fixed, rtol=0.5)
        return
    assert force.relative_error <= rtol
    assert force.fit_error <= force.relative_error
    assert force.beside == "on which the wire rubs"
    best = cutting_force(scene, "table", law="coupled")
    apart = np.abs(force(radii) / best.total - 1.0)
    assert np.max(apart - best.relative_error) <= force.relative_error
    with pytest.raises(AccuracyError, match=r"best law, .* is up to .*; give rtol="):
        of(("wire_radius",), "auto", fixed, rtol=1e-9)


def test_auto_takes_the_most_exact_where_none_will_do():
    fixed = replace(TISSUE, friction_coefficient=0.0, wear_strength=5e3)
    force, coupled = of(("wire_radius",), "auto", fixed), of(("wire_radius",), fixed=fixed)
    assert 0.02 < force.relative_error <= coupled.relative_error
    met = of(("wire_radius",), "auto", fixed, rtol=1.01 * force.relative_error)
    assert met.relative_error <= 1.01 * force.relative_error


def test_a_named_model_has_a_law_chosen_too():
    table = of(("wire_radius",), "auto", model="table")
    assert (table.law, set(table.terms.values())) == (of(("wire_radius",), "auto").law, {"table"})
    formula = of(("wire_radius",), "auto", model="eq13")
    assert formula.law == "projected"
    assert formula(1e-3) == of(("wire_radius",), "projected", model="eq13")(1e-3)


def test_buffers_and_single_precision():
    for varying in (("wire_radius",), ("toughness",), ("friction_coefficient",)):
        force, (values,) = of(varying), HERE.points(varying, 20000)
        values[:] = np.clip(values, *HERE.ends[varying[0]])
        expected, room = force(values), np.empty(values.shape, np.float32)
        assert force(values, out=room) is room
        np.testing.assert_array_equal(room, expected.astype(np.float32))
        single = force(values.astype(np.float32), outside="nan")
        assert single.dtype == np.float32
        own = values.copy()
        assert force(own, out=own) is own
        np.testing.assert_array_equal(own, expected)


BOTH = """
import sys
import numpy as np
from surrogate import Scene, prepare

tissue = Scene(10e3, 5.0, 0.5e-3, 0.01, 1e3, 6.0)
box = {"wire_radius": (4e-4, 2e-3), "toughness": (3.0, 9.0), "wear_strength": (1.0, 2e3)}
rows = []
for name, ends in box.items():
    force = prepare(tissue, (name,), {name: ends}, law="coupled")
    values = np.linspace(*ends, 20001)
    rows.append((force, values, force(values)))
assert "numba" not in sys.modules
import numba
for force, values, before in rows:
    assert np.array_equal(force(values), before)
    assert force(float(values[777])) == before[777]
print("alike")
"""


@pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
def test_with_numba_the_digits_are_the_same():
    assert prints_alike(BOTH)


@pytest.mark.parametrize("load", ALONE.values(), ids=ALONE)
@pytest.mark.parametrize("model", ["auto", "table"])
@pytest.mark.parametrize("law", ["projected", "slip"])
def test_the_error_of_a_named_law_is_that_of_its_models_and_of_itself(law, model, load):
    fixed = replace(TISSUE, friction_coefficient=load[0], wear_strength=load[1])
    force = of(("wire_radius", "stiffening_exponent"), law, fixed, model=model)
    values = HERE.points(("wire_radius", "stiffening_exponent"), 300)
    scene = HERE.scene_of(("wire_radius", "stiffening_exponent"), values, fixed)
    coupled = cutting_force(scene, "table", law="coupled")
    apart = np.abs(force(*values) / coupled.total - 1.0)
    assert np.max(apart - coupled.relative_error) <= force.relative_error < 1.0
    assert force.fit_error < force.relative_error
    assert force.beside == "on which the wire rubs"
    much = replace(fixed, wear_strength=1e6)
    beyond = of(("wire_radius",), law, much, model=model)
    assert np.isnan(beyond.relative_error)
    assert beyond.fit_error < 0.1
