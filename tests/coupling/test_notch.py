"""What the radius of the tip adds to A* and B*: its derivatives, its errors, where it is known."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from fe_training.campaign.dataset import load_campaign
from fe_training.fitting.notch import CASES, fit_notch, missing, read_rows
from surrogate import (
    DomainError,
    InputError,
    Scene,
    classify,
    contact_functions,
    cutting_force,
    force_gradient,
    propagate,
)
from surrogate.basics.files import models_folder
from surrogate.cli.main import main
from surrogate.contact.shipped import shipped
from surrogate.coupling.notched import notch_slip
from surrogate.scene import NAMES

FOLDER = Path(models_folder())
TIP = notch_slip()
GEL = Scene(685.0, 1.6, 0.25e-3, 0.05, 500.0, 2.0)
NOTCH = 1.25e-7
ALPHAS = (2.0, 2.0 + 1e-9, 2.06, 2.12, 2.3, 2.5)


def rows():
    """Yield the solutions of other notches, each with that of the models' notch."""
    known = read_rows(FOLDER)
    assert known["reached"].all()
    for i, notch in enumerate(known["notch"]):
        g, alpha = known["g"][i], known["alpha"][i]
        same = (known["alpha"] == alpha) & (known["notch"] == TIP.radius)
        beside = np.flatnonzero(same & (np.abs(known["g"] / g - 1.0) < 3e-3))
        yield {name: values[i] for name, values in known.items()}, known, beside[0], notch


def test_all_of_the_design_is_solved():
    assert not list(missing(read_rows(FOLDER)))
    assert len(CASES) > 20


@pytest.mark.parametrize("model", ["table", "gp", "power-law"])
def test_no_solution_is_off_by_more_than_its_bound(model):
    seen = 0
    for row, *_ in rows():
        if not TIP.known(row["g"], row["alpha"], row["notch"]):
            continue
        seen += 1
        scene = Scene(1.0, row["g"], 1.0, 0.0, 1.0, row["alpha"])
        for name, strength in (("slip_arc", (0.0, 1.0)), ("slip_load", (1.0, 0.0))):
            one = dataclasses.replace(
                scene, friction_coefficient=strength[0], wear_strength=strength[1]
            )
            force = cutting_force(one, model, law="slip", notch_radius=float(row["notch"]))
            truth = row["g"] + 2.0 * row[name]
            assert abs(force.total / truth - 1.0) <= force.fit_error < 0.15
    assert seen > 40


def test_the_file_is_what_its_own_fit_makes():
    campaigns = (load_campaign(FOLDER / f"{name}.h5") for name in ("campaign", "off-grid"))
    about = fit_notch(shipped(), *campaigns, read_rows(FOLDER))
    np.testing.assert_allclose(about["stretch"], TIP.stretch, rtol=1e-6)
    np.testing.assert_allclose(about["pressure"], TIP.pressure, rtol=1e-6)
    for model, errors in about["errors"].items():
        np.testing.assert_allclose(errors, TIP.errors[model], rtol=1e-4)


def test_at_alpha_2_a_tip_sharper_by_e_adds_g_over_pi():
    g = np.array([1.8, 5.0, 99.0])
    arc, _ = TIP.added(g, 2.0, TIP.radius / np.e)
    np.testing.assert_allclose(arc, g / np.pi, rtol=1e-14)
    other, _ = TIP.added(g, 2.0 + 1e-12, TIP.radius / np.e)
    np.testing.assert_allclose(other, arc, rtol=1e-10)


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("relative", [6e-5, 1e-3, 2.9e-3])
def test_the_derivatives(alpha, relative):
    g, step = np.array([2.9, 20.0, 99.0]), 1e-5
    slopes = np.array(TIP.slopes(g, alpha, relative))
    moves = ((step, 0.0, 0.0), (0.0, step, 0.0), (0.0, 0.0, step))
    for k, (in_g, in_alpha, in_size) in enumerate(moves):

        def at(sign, in_g=in_g, in_alpha=in_alpha, in_size=in_size):
            moved = g * np.exp(sign * in_g), alpha + sign * in_alpha
            return np.array(TIP.added(*moved, relative * np.exp(-sign * in_size)))

        if in_alpha and not 2.0 + step < alpha < 2.5 - step:  # one-sided at the ends of the range
            way = 1.0 if alpha < 2.3 else -1.0
            by_steps = way * (4.0 * at(way) - 3.0 * at(0.0) - at(2.0 * way)) / (2.0 * step)
        else:
            by_steps = (at(1.0) - at(-1.0)) / (2.0 * step)
        np.testing.assert_allclose(slopes[:, k], by_steps, rtol=1e-5, atol=1e-9)


def test_the_gradient_is_that_of_the_force():
    values = np.array([*GEL.values()[:5], 2.2])
    options = {"model": "table", "law": "slip", "notch_radius": NOTCH}
    gradient = force_gradient(Scene(*values), **options)
    for k, name in enumerate(NAMES):
        step = 1e-6 * values[k]
        up, down = values.copy(), values.copy()
        up[k] += step
        down[k] -= step
        by_steps = (
            cutting_force(Scene(*up), **options).total
            - cutting_force(Scene(*down), **options).total
        ) / (2.0 * step)
        assert getattr(gradient, name) == pytest.approx(by_steps, rel=1e-5)


def test_without_it_and_with_the_models_own_notch_nothing_moves():
    radii = np.geomspace(3e-5, 5e-3, 40)
    gel = dataclasses.replace(GEL, wire_radius=radii)
    plain = cutting_force(gel, law="slip")
    far = gel.dimensionless_toughness < shipped().models["table"].touch(2.0)
    assert 0 < np.count_nonzero(far) < 40
    sharp = cutting_force(gel, law="slip", notch_radius=NOTCH, outside="nan")
    np.testing.assert_array_equal(sharp.total[far], plain.total[far])
    np.testing.assert_array_equal(sharp.fit_error[far], plain.fit_error[far])
    own = dataclasses.replace(GEL, wire_radius=0.25e-3)
    same = cutting_force(own, law="slip", notch_radius=TIP.radius * 0.25e-3)
    assert same.total == pytest.approx(cutting_force(own, law="slip").total, rel=1e-14)


def test_arrays_and_numbers_have_the_same_bits():
    radii = np.geomspace(3e-5, 5e-3, 23)
    options = {"law": "slip", "notch_radius": NOTCH, "outside": "nan"}
    many = cutting_force(dataclasses.replace(GEL, wire_radius=radii), **options)
    slopes = force_gradient(
        dataclasses.replace(GEL, wire_radius=radii[8:]), law="slip", notch_radius=NOTCH
    )
    for i, radius in enumerate(radii):
        one = cutting_force(dataclasses.replace(GEL, wire_radius=float(radius)), **options)
        for name in ("total", "friction", "wear", "fit_error", "in_domain"):
            np.testing.assert_array_equal(getattr(one, name), getattr(many, name)[i])
        if i >= 8:
            of_one = force_gradient(
                dataclasses.replace(GEL, wire_radius=float(radius)), law="slip", notch_radius=NOTCH
            )
            assert of_one.wire_radius == slopes.wire_radius[i - 8]


def test_a_sharper_tip_costs_more_and_its_error_is_known():
    sharp, blunt = (cutting_force(GEL, law="slip", notch_radius=r) for r in (2e-8, 2e-6))
    plain = cutting_force(GEL, law="slip")
    assert sharp.total > plain.total > blunt.total
    assert np.isnan(plain.fit_error)
    assert sharp.fit_error < 0.02
    assert np.isnan(sharp.law_error)  # no coupled solution has its tip in contact
    assert np.isnan(sharp.relative_error)
    std = propagate(GEL, {"toughness": 0.1}, law="slip", notch_radius=NOTCH)
    assert 0.0 < std.model_std < 0.02 * std.total
    gel = Scene(685.0, 1.6, 0.25e-3, 0.0, 300.0, 2.0)
    for radius, dominant in ((NOTCH, "wear"), (7e-6, "transition")):
        assert classify(gel, law="slip", notch_radius=radius).dominant == dominant


def test_other_solids_and_sizes_are_refused_or_nan():
    with pytest.raises(DomainError, match=r"from 5e-05 to 0\.03 of the wire's radius"):
        cutting_force(GEL, law="slip", notch_radius=1e-4)
    with pytest.raises(DomainError, match=r"g = 23\.36, .* from 5e-05 to 0\.0128 of"):
        cutting_force(dataclasses.replace(GEL, wire_radius=1e-4), law="slip", notch_radius=2e-6)
    stiff = dataclasses.replace(GEL, stiffening_exponent=2.7)
    for function in (cutting_force, force_gradient):
        with pytest.raises(DomainError, match=r"alpha from 2 to 2\.5 .*leave notch_radius out"):
            function(stiff, law="slip", notch_radius=NOTCH, extrapolate=True)
    answer = cutting_force(stiff, law="slip", notch_radius=NOTCH, outside="nan")
    assert np.isnan(answer.total)
    assert not answer.in_domain
    bare = Scene(685.0, 1.6, 1e-5)
    assert cutting_force(bare, law="slip", notch_radius=1.0).total == 1.6
    for wrong in (0.0, -1.0, np.nan, np.inf, "small", [1e-7, 1e-6], True):
        with pytest.raises(InputError, match="notch_radius must be"):
            cutting_force(GEL, law="slip", notch_radius=wrong)
    for law in ("auto", "projected", "coupled"):
        with pytest.raises(InputError, match="notch_radius must be given with law='slip'"):
            cutting_force(GEL, law=law, notch_radius=NOTCH)
    with pytest.raises(InputError, match="law='slip' must have a model"):
        cutting_force(GEL, "eq13", law="slip", notch_radius=NOTCH)


def test_the_card_of_the_contact_stays_that_of_the_models_notch():
    arc = contact_functions(5.0, 2.0).slip_arc
    force = cutting_force(Scene(1.0, 5.0, 1.0, 0.0, 1.0), "table", law="slip", notch_radius=1e-3)
    added = float(TIP.added(5.0, 2.0, 1e-3)[0])
    assert force.wear == pytest.approx(2.0 * (arc + added), rel=1e-12)


def test_the_command_line(capsys):
    gel = ["--shear-modulus", "685Pa", "--toughness", "1.6J/m2", "--wear-strength", "500Pa"]
    wire = ["--wire-diameter", "0.5mm", "--law", "slip"]
    assert main(["force", *gel, *wire, "--notch-radius", "0.1um", "--json"]) == 0
    assert '"notch_radius": 1e-07' in capsys.readouterr().out
    assert main(["force", *gel, *wire, "--notch-radius", "0.1um"]) == 0
    assert "tip of 0.0001 mm" in capsys.readouterr().out
    assert main(["regime", *gel, *wire, "--notch-radius", "0.1um"]) == 0
    capsys.readouterr()
    assert main(["force", *gel, *wire, "--notch-radius", "0.1mm"]) == 2
    assert "give another radius" in capsys.readouterr().err
    assert main(["force", *gel, "--wire-diameter", "1mm", "--notch-radius", "1um"]) == 2
    assert "--law slip" in capsys.readouterr().err
    assert main(["force", *gel, *wire, "--notch-radius", "1um", "--plot", "x.png"]) == 2
    assert "--plot must stand without" in capsys.readouterr().err
