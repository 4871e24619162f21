"""One bad point does not refuse a batch: nan for it alone, wherever a law is taken."""

from dataclasses import replace

import numpy as np
import pytest

from surrogate import (
    DomainError,
    InputError,
    Scene,
    classify,
    cutting_force,
    dissipative_force,
    force_gradient,
    propagate,
    transition_radius,
)
from surrogate.cutting.outside import spared

#: In the domain, below the lowest g, at an alpha that no model has, and beyond the coupled loads.
BATCH = Scene(
    10e3, [5.0, 1e-4, 5.0, 5.0], 0.5e-3, [0.01, 0.01, 0.01, 0.9], 1e3, [6.0, 6.0, 12.0, 6.0]
)
LAWS = {"auto": [True, False, False, True], "projected": [True, False, False, True]}
LAWS |= {"slip": [True, False, False, True], "coupled": [True, False, False, False]}

CALLS = {
    "cutting_force": lambda scene, **options: cutting_force(scene, **options).total,
    "force_gradient": lambda scene, **options: force_gradient(scene, **options).wire_radius,
    "propagate": lambda scene, **options: propagate(scene, {"toughness": 0.1}, **options).std,
    "classify": lambda scene, **options: classify(scene, **options).dominant,
    "dissipative_force": lambda scene, **options: dissipative_force(
        scene.dimensionless_toughness,
        scene.stiffening_exponent,
        scene.friction_coefficient,
        scene.wear_strength / scene.shear_modulus,
        **options,
    ),
}


def taken(scene, number):
    return Scene(*(float(np.broadcast_to(each, scene.shape)[number]) for each in scene.values()))


def is_known(value):
    return value != "unknown" if isinstance(value, str) else not np.isnan(value)


@pytest.mark.filterwarnings("ignore::surrogate.errors.UnknownErrorWarning")
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("model", ["auto", "table"])
def test_bad_points_alone_have_no_number(name, law, model):
    call, options = CALLS[name], {"law": law, "model": model}
    with pytest.raises(DomainError):
        call(BATCH, **options)
    found = call(BATCH, **options, outside="nan")
    known = LAWS[law]
    assert [is_known(each) for each in found.tolist()] == known
    for number, inside in enumerate(known):
        one = taken(BATCH, number)
        alone = call(one, **options, outside="nan")
        assert np.ndim(alone) == 0
        assert is_known(alone) == inside
        if inside:
            assert alone == found[number] == call(one, **options)
        elif law == "auto" and name == "cutting_force":
            with pytest.raises(DomainError):
                call(one, **options)


@pytest.mark.filterwarnings("ignore::surrogate.errors.UnknownErrorWarning")
@pytest.mark.parametrize("law", ["auto", "projected", "slip"])
def test_transition_radii_that_a_model_does_not_reach_are_nan(law):
    scenes = replace(BATCH, friction_coefficient=0.0, wear_strength=[1e3, 1e3, 1e3, 1e-9])
    with pytest.raises(DomainError):
        transition_radius(scenes, law=law)
    radius = transition_radius(scenes, law=law, outside="nan")
    assert np.isfinite(radius).tolist()[0]
    assert np.isnan(radius[2])
    for number in (0, 2):
        alone = transition_radius(taken(scenes, number), law=law, outside="nan")
        np.testing.assert_array_equal(alone, radius[number])
    assert radius[0] == transition_radius(taken(scenes, 0), law=law)
    nothing = Scene(685.0, 0.0, 1e-4)
    assert np.isnan(transition_radius(nothing, "eq13", outside="nan"))


@pytest.mark.parametrize("name", CALLS)
def test_another_word_is_refused(name):
    for wrong in ("ignore", None, 1):
        with pytest.raises(InputError, match="outside must be 'raise' or 'nan'"):
            CALLS[name](taken(BATCH, 0), outside=wrong)
    with pytest.raises(InputError, match="outside must be 'raise' or 'nan'"):
        transition_radius(taken(BATCH, 0), outside="ignore")


def test_closed_forms_answer_as_ever():
    for call in CALLS.values():
        usual, spare = (call(BATCH, model="eq13", outside=o) for o in ("raise", "nan"))
        np.testing.assert_array_equal(usual, spare)


def test_few_bad_rows_cost_few_calls():
    calls = []

    def roots(columns):
        calls.append(columns[0].size)
        if (columns[0] < 0.0).any():
            raise DomainError("negative")
        return (np.sqrt(columns[0]),)

    values = np.arange(1000.0)
    values[137] = -1.0
    (found,) = spared(roots, [values], 1)
    assert np.flatnonzero(np.isnan(found)).tolist() == [137]
    assert len(calls) < 30
