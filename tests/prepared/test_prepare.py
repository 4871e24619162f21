"""Prepared forces: the numbers of the models, what is proven of them, and what is refused."""

from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pytest
from boxes import GEL as HERE
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
from surrogate.choosing.candidates import candidates
from surrogate.scene import NAMES

GEL = HERE.scene
ONES = [(name,) for name in NAMES]
SEVERAL = [
    ("toughness", "wire_radius"),
    ("wire_radius", "friction_coefficient"),
    ("shear_modulus", "stiffening_exponent"),
    NAMES,
]


def of(varying, model="table", fixed=GEL, **options):
    return prepare(fixed, varying, HERE.of(varying), model, **options)


@pytest.mark.parametrize("model", ["table", "eq13", "low-toughness"])
@pytest.mark.parametrize("varying", ONES + SEVERAL, ids=str)
def test_it_is_the_models_force_and_the_same_for_numbers(varying, model):
    force, values = of(varying, model), HERE.points(varying)
    expected = cutting_force(HERE.scene_of(varying, values), model, law="projected").total
    found = force(*values)
    np.testing.assert_allclose(found, expected, rtol=1e-13)
    for i in range(40):
        alone = force(*(float(value[i]) for value in values))
        assert type(alone) is float
        assert alone == found[i]
    assert np.array_equal(force(**dict(zip(varying, values, strict=True))), found)


@pytest.mark.parametrize("varying", ONES + SEVERAL, ids=str)
def test_derivatives_are_those_of_the_model(varying):
    force, values = of(varying), HERE.points(varying, 300)
    expected = force_gradient(HERE.scene_of(varying, values), "table", law="projected")
    found = force.gradient(*values)
    for name in varying:
        np.testing.assert_allclose(found[name], getattr(expected, name), rtol=1e-11, atol=1e-300)
    if len(varying) == 1:
        assert np.array_equal(force.derivative(*values), found[varying[0]])


@pytest.mark.parametrize("rtol", [1.0, 0.2, 0.02])
def test_auto_keeps_its_promise_beside_the_gp_whose_bounds_it_uses(rtol):
    """The error beside the process is at most the table's bound and the process's own."""
    for xi, wear in ((0.0, 7750.0), (0.2, 0.0), (0.1, 50.0), (1e-6, 7750.0)):
        gel = Scene(685.0, 1.6, 0.25e-3, xi, wear, 3.0)
        force = prepare(gel, ranges={"wire_radius": (5e-5, 2e-3)}, rtol=rtol, law="projected")
        assert force.fit_error <= rtol
        radius = np.geomspace(5e-5, 2e-3, 400)
        there = cutting_force(Scene(685.0, 1.6, radius, xi, wear, 3.0), "gp", law="projected").total
        own = max(
            float(np.max(candidates().error("gp", name)[:-1])) for name in ("arc", "normal_load")
        )
        assert np.max(np.abs(force(radius) / there - 1.0)) <= force.fit_error + own


@pytest.mark.parametrize("varying", ONES + SEVERAL, ids=str)
def test_under_the_law_of_slip_it_is_the_force_of_that_law(varying):
    force, values = of(varying, law="slip"), HERE.points(varying)
    scene = HERE.scene_of(varying, values)
    np.testing.assert_allclose(
        force(*values), cutting_force(scene, "table", law="slip").total, rtol=1e-13
    )
    assert np.array_equal(of(varying, "auto", law="slip")(*values), force(*values))
    assert (force.law, of(varying).law) == ("slip", "projected")
    assert "law of slip" in str(force)
    slopes, found = force_gradient(scene, "table", law="slip"), force.gradient(*values)
    for name in varying:
        np.testing.assert_allclose(found[name], getattr(slopes, name), rtol=1e-11, atol=1e-300)


def test_the_error_under_the_law_of_slip_is_known_short_of_the_touch():
    """It is at least that of the points, and none where one of them has none."""
    known = 0
    for alpha in (2.0, 2.7, 4.0, 9.0):
        for low, high in ((2e-4, 1e-2), (5e-3, 5e-2), (2e-4, 5e-2)):
            gel = Scene(685.0, 1.6, 1e-4, 0.1, 7750.0, alpha)
            force = prepare(gel, ranges={"wire_radius": (low, high)}, law="slip")
            radii = Scene(685.0, 1.6, np.geomspace(low, high, 300), 0.1, 7750.0, alpha)
            by_point = cutting_force(radii, "table", law="slip").fit_error
            if np.isnan(by_point).any():
                assert np.isnan(force.fit_error)
                with pytest.raises(AccuracyError, match="where the crack's tip touches the wire"):
                    prepare(gel, ranges={"wire_radius": (low, high)}, law="slip", rtol=1.0)
            else:
                known += 1
                assert np.max(by_point) <= force.fit_error < 0.3
    assert known > 4
    bare = prepare(Scene(685.0, 1.6, 1e-4), ranges={"wire_radius": (1e-6, 1.0)}, law="slip")
    assert (bare.relative_error, bare(0.5)) == (0.0, 1.6)


def test_a_table_of_ones_own_is_taken_and_its_error_unknown():
    table = candidates().fitted.models["table"]
    nodes = {n: tuple(2.0 * side for side in sides) for n, sides in table.table.nodes.items()}
    twice = replace(table, table=replace(table.table, nodes=nodes))
    force = prepare(GEL, ranges={"wire_radius": (1e-4, 1e-3)}, model=twice)
    usual = prepare(GEL, ranges={"wire_radius": (1e-4, 1e-3)}, model="table")
    assert force(3e-4) - 1.6 == pytest.approx(2.0 * (usual(3e-4) - 1.6), rel=1e-13)
    assert np.isnan(force.fit_error)


def test_the_whole_domain_of_an_alpha_can_be_prepared():
    limits = candidates().limits
    for alpha, highest in ((2.0, 100.0), (5.0, 1000.0)):
        gel = Scene(1.0, 1.0, 1.0, 0.1, 1.0, alpha)
        force = prepare(gel, ("toughness",), {"toughness": (limits.g[0], highest)}, "table")
        ends = np.array([limits.g[0], highest])
        there = cutting_force(
            Scene(1.0, ends, 1.0, 0.1, 1.0, alpha), "table", law="projected"
        ).total
        np.testing.assert_allclose(force(ends), there, rtol=1e-13)


def test_the_bound_is_not_below_that_of_any_point():
    random = np.random.default_rng(3)
    for _ in range(20):
        low = np.exp(random.uniform(np.log(5e-5), np.log(1e-3)))
        ends = low, low * random.uniform(1.01, 3.0)
        gel = Scene(685.0, 1.6, 1e-4, random.uniform(0.0, 0.3), 7750.0, random.uniform(2.0, 8.0))
        force = prepare(gel, ranges={"wire_radius": ends}, model="table", law="projected")
        by_point = cutting_force(
            Scene(*gel.values()[:2], np.geomspace(*ends, 50), *gel.values()[3:]),
            rtol=0.05,
            law="projected",
        )
        table = by_point.chosen == "table"
        assert np.all(by_point.fit_error[table] <= force.fit_error * (1.0 + 1e-9) + 0.02)


def test_what_the_scene_lacks_is_left_out():
    assert of(("wire_radius",), fixed=Scene(685.0, 1.6, 1e-4, 0.0, 7750.0)).terms == {
        "wear": "table"
    }
    assert of(("wire_radius",), fixed=Scene(685.0, 1.6, 1e-4, 0.1, 0.0)).terms == {
        "friction": "table"
    }
    bare = of(("wire_radius",), "auto", Scene(685.0, 1.6, 1e-4))
    assert (bare.terms, bare.relative_error, bare(2e-4)) == ({}, 0.0, 1.6)
    little = of(("wire_radius",), "auto", Scene(685.0, 1.6, 1e-4, 1e-6, 7750.0))
    assert little.terms == {"wear": "table", "friction": "eq13"}


@pytest.mark.parametrize("name", ["wire_radius", "toughness", "wear_strength"])
def test_monotonic_forces_are_inverted(name):
    force = of((name,))
    assert force.monotonic == "rising"
    (values,) = HERE.points((name,), 200)
    back = force.inverse(force(values))
    np.testing.assert_allclose(force(back), force(values), rtol=1e-14)
    np.testing.assert_allclose(back, values, rtol=1e-10)
    assert force.inverse(force(float(values[5]))) == pytest.approx(values[5])
    with pytest.raises(DomainError, match="force must be at most"):
        force.inverse(1e9)
    if name == "wire_radius":
        assert force.radius_for(7.0) == force.inverse(7.0)


def test_a_force_that_is_not_monotonic_is_not_inverted():
    """Friction alone falls, then rises with the radius where alpha is small."""
    gel = Scene(685.0, 1.6, 1e-4, 0.5, 0.0, 2.0)
    force = prepare(gel, ranges={"wire_radius": (3e-5, 0.5)}, model="table")
    radius = np.geomspace(3e-5, 0.5, 4000)
    slopes = np.sign(force.derivative(radius))
    assert (force.monotonic == "unknown") == (len(set(slopes)) > 1)
    alpha = of(("stiffening_exponent",))
    with pytest.raises(InputError, match="must be monotonic to be inverted"):
        alpha.inverse(7.0)
    with pytest.raises(InputError, match="one quantity that varies"):
        of(("toughness", "wire_radius")).inverse(7.0)
    with pytest.raises(InputError, match="radius_for must have a force"):
        of(("toughness",)).radius_for(7.0)


def test_where_slip_jumps_at_the_touch_there_is_no_inverse():
    gel = Scene(685.0, 1.6, 1e-4, 0.0, 7750.0, 3.0)
    for ends, known in (((1e-4, 5e-4), True), ((1e-4, 5e-3), False), ((1e-3, 5e-3), True)):
        force = prepare(gel, ranges={"wire_radius": ends}, law="slip")
        assert (force.monotonic == "rising") == known
    touch = 1.6 / (685.0 * candidates().fitted.models["table"].touch(3.0))
    assert 5e-4 < touch < 1e-3
    force = prepare(gel, ranges={"wire_radius": (5e-4, 1e-3)}, law="slip")
    beside = force(np.array([touch * (1.0 - 1e-9), touch * (1.0 + 1e-9)]))
    assert abs(beside[1] / beside[0] - 1.0) > 1e-3


def test_a_modulus_is_found_where_one_term_needs_it():
    gel = Scene(685.0, 1.6, 0.25e-3, 0.0, 7750.0, 2.5)
    force = prepare(gel, ("shear_modulus",), {"shear_modulus": HERE.ends["shear_modulus"]}, "table")
    values = np.linspace(*HERE.ends["shear_modulus"], 300)
    slopes = np.sign(force.derivative(values))
    assert {"falling": {-1.0}, "rising": {1.0}}.get(force.monotonic, {-1.0, 1.0}) == set(slopes)
    both = prepare(GEL, ("shear_modulus",), {"shear_modulus": HERE.ends["shear_modulus"]}, "table")
    assert both.monotonic == "unknown"


def test_outside_the_range():
    force = of(("wire_radius",))
    for bad in (2e-3, 5e-5, [2e-4, 2e-3]):
        with pytest.raises(DomainError, match=r"wire_radius must be at most 0.001 and at least"):
            force(bad)
    for bad in (np.nan, np.inf, -1.0, 0.0, 5e-324, 1e300):
        with pytest.raises(InputError):
            force(bad)
        assert np.isnan(force(bad, outside="nan"))
        mixed = force([2e-4, bad], outside="nan")
        assert (mixed[0], np.isnan(mixed[1])) == (force(2e-4), True)
    for bad in ("clip", None, np.array(["nan", "raise"]), 1):
        for value in (2e-4, np.array([2e-4, 3e-4])):
            with pytest.raises(InputError, match="outside must be"):
                force(value, outside=bad)


@pytest.mark.parametrize("varying", ONES, ids=str)
def test_buffers_and_single_precision(varying):
    force, ends = of(varying), HERE.ends[varying[0]]
    values = np.linspace(*ends, 20001)
    exact, buffer = force(values), np.empty(20001)
    assert force(values, out=buffer) is buffer
    assert np.array_equal(buffer, exact)
    strided = np.zeros((20001, 3))[:, 1]
    assert np.array_equal(force(values, out=strided), exact)
    assert np.array_equal(force(values[::-2]), exact[::-2])
    overlapping = np.append(values, 0.0)
    assert np.array_equal(force(overlapping[:-1], out=overlapping[1:]), exact)
    assert np.array_equal(force(values, out=values), exact)
    low, high = ends
    some = np.linspace(low + 0.01 * (high - low), 0.99 * high, 5000).astype(np.float32)
    single, further = force(some), force(some, out=np.empty(5000, np.float32))
    assert single.dtype == np.float32
    assert np.array_equal(single, further)
    assert np.array_equal(force(some, out=np.empty(5000)), force(some.astype(float)))
    np.testing.assert_allclose(single, force(some.astype(float)), rtol=2.0**-24)
    assert force(float(some[7]), out=np.empty(())).item() == force(float(some[7]))
    locked = np.empty(20001)
    locked.flags.writeable = False
    for bad in (np.empty(3), [1.0], np.empty(20001, int), locked):
        with pytest.raises(InputError, match="out must"):
            force(np.linspace(*ends, 20001), out=bad)


def test_single_precision_at_its_ends():
    """What is beyond the range of float32 is infinite, and no warning."""
    force = prepare(Scene(1.0, 1.0, 1.0), ("toughness",), {"toughness": (0.0, 1e60)})
    values = np.array([0.0, 1e-45, 1.0, 3e38], np.float32)
    assert np.array_equal(force(values), values)
    large = np.array([1.0, 1e60])
    assert np.array_equal(force(large, out=np.empty(2, np.float32)), [1.0, np.inf])
    for bad in (np.array([1.0, np.nan], np.float32), np.array([1.0, np.inf], np.float32)):
        with pytest.raises(DomainError, match="toughness must be"):
            force(bad)
        found = force(bad, outside="nan")
        assert (found.dtype, found[0], np.isnan(found[1])) == (np.float32, 1.0, True)


BOTH = """
import sys
import numpy as np
from surrogate import Scene, prepare
from surrogate.scene import NAMES
box = dict(zip(NAMES, {box}))
for law in ("projected", "slip"):
    for name in NAMES:
        for xi, wear in ((0.1, 7750.0), (0.1, 0.0), (0.0, 7750.0), (0.0, 0.0)):
            gel = Scene(685.0, 1.6, 0.25e-3, xi, wear, 2.5)
            force = prepare(gel, (name,), {{name: box[name]}}, "table", law=law)
            values = np.random.default_rng(1).uniform(*box[name], 20000)
            sys.modules.pop("numba", None)
            plain = force(values), force(values.astype(np.float32), outside="nan")
            import numba
            compiled = force(values), force(values.astype(np.float32), outside="nan")
            for one, other in zip(plain, compiled):
                assert np.array_equal(one, other, equal_nan=True), (name, law, xi, wear)
print("alike")
"""


@pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
def test_with_numba_the_digits_are_the_same():
    """In a process of its own, as numba changes how all tables are evaluated."""
    code = BOTH.format(box=[HERE.ends[name] for name in NAMES])
    assert prints_alike(code)


def test_arguments_are_given_once():
    force = of(("toughness", "wire_radius"))
    assert force(1.0, wire_radius=2e-4) == force(1.0, 2e-4)
    for values, named in (((1.0,), {}), ((1.0, 2e-4, 3.0), {}), ((1.0, 2e-4), {"toughness": 1.0})):
        with pytest.raises(InputError, match="must be asked for with toughness, wire_radius"):
            force(*values, **named)
    with pytest.raises(InputError, match="must broadcast"):
        force([1.0, 2.0], [2e-4, 3e-4, 4e-4])


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"varying": ()}, InputError, "varying must name"),
        ({"varying": ("radius",)}, InputError, "varying must name"),
        ({"ranges": None}, InputError, "ranges must have the two ends"),
        ({"ranges": {"wire_radius": (1e-4,)}}, InputError, "must be two numbers"),
        ({"ranges": {"wire_radius": (1e-3, 1e-4)}}, InputError, "must rise"),
        ({"ranges": {"wire_radius": (1e-3, np.nan)}}, InputError, "wire_radius must be"),
        ({"ranges": {"wire_radius": (1e-9, 1e-4)}}, DomainError, "all over the ranges"),
        ({"fixed": {"shear_modulus": 685.0}}, InputError, "toughness is missing"),
        ({"fixed": {"shear_modulus": 685.0, "toughness": 1.0, "mu": 3.0}}, InputError, "'mu'"),
        ({"fixed": Scene([685.0], 1.6, 1e-4)}, InputError, "must be one number"),
        ({"model": "gp"}, InputError, "neither the table nor a closed form"),
        ({"law": "greed"}, InputError, "law must be one of projected, slip"),
        ({"law": "coupled"}, DomainError, "reach before the tip touches the wire, all over"),
        ({"law": "coupled", "model": "eq13"}, InputError, "must have a model fitted"),
        ({"law": "coupled", "model": "gp"}, InputError, "neither the table nor a closed form"),
        ({"law": "auto", "rtol": 0.5}, AccuracyError, "is known to nobody, as at xi = 0.1"),
        ({"law": "auto", "model": "gp"}, InputError, "neither the table nor a closed form"),
        ({"law": "slip", "model": "eq13"}, InputError, "must have a model fitted"),
        ({"law": "slip", "model": "gp"}, InputError, "neither the table nor a closed form"),
        ({"model": "eq9"}, InputError, "neither the table nor a closed form"),
        ({"rtol": 1e-6, "law": "projected"}, AccuracyError, "all over the ranges"),
        ({"rtol": 0.02, "model": "low-toughness"}, AccuracyError, "known to nobody"),
        ({"rtol": 0.02, "model": "eq13"}, AccuracyError, "give rtol="),
    ],
)
def test_what_cannot_be_prepared_is_refused_in_words(change, error, words):
    good = {"fixed": GEL, "varying": ("wire_radius",), "ranges": {"wire_radius": (1e-4, 1e-3)}}
    prepare(**good)
    with pytest.raises(error, match=words):
        prepare(**{**good, **change})
