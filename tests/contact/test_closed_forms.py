"""The slopes of A and B: against finite differences, and at the ends of the numbers."""

import numpy as np
import pytest

from surrogate.contact.closed_forms import FORCE_MODELS

G = np.array([1e-3, 0.07, 0.9, 1.1, 13.0, 400.0])
ALPHAS = [2.5, 3.0, 4.7, 5.2, 7.4, 8.9]
FUNCTIONS = [("arc", "arc_slopes"), ("normal_load", "normal_load_slopes")]

every_model = pytest.mark.parametrize("model", FORCE_MODELS.values(), ids=FORCE_MODELS)
every_function = pytest.mark.parametrize(("function", "slopes"), FUNCTIONS)


def difference(function, at, step):
    return (function(at + step) - function(at - step)) / (2.0 * step)


@every_model
@every_function
@pytest.mark.parametrize("alpha", ALPHAS)
def test_slopes_are_those_of_finite_differences(model, function, slopes, alpha):
    value = getattr(model, function)
    in_g, in_alpha = getattr(model, slopes)(G, alpha)
    # Central differences of step h err by about h^2 f''' and rounding/h of their values.
    scale = np.abs(value(G, alpha))
    in_g_expected = difference(lambda g: value(g, alpha), G, 1e-5 * G)
    in_alpha_expected = difference(lambda x: value(G, x), alpha, 1e-5)
    assert np.all(np.abs(in_g - in_g_expected) <= 1e-9 * scale / G)
    assert np.all(np.abs(in_alpha - in_alpha_expected) <= 1e-9 * scale)


@every_model
@every_function
def test_slopes_of_arrays_are_those_of_numbers(model, function, slopes):
    g, alpha = np.meshgrid(np.append(G, [0.0, 5e-324, 1e300]), [*ALPHAS, 5.0])
    together = [np.broadcast_to(s, g.shape) for s in getattr(model, slopes)(g, alpha)]
    for index in np.ndindex(g.shape):
        alone = getattr(model, slopes)(float(g[index]), float(alpha[index]))
        assert alone == tuple(each[index] for each in together)


@pytest.mark.parametrize(
    ("alpha", "g", "in_g", "in_alpha"),
    [
        (2.0, 0.0, 0.0, 0.0),
        (9.0, 0.0, np.inf, 0.0),
        (7.4, 0.0, 0.5, 0.0),  # n = 1
        (9.0, 1.0, 0.5 * 0.96, 0.0),
        (2.0, 1e300, 0.59e54, -np.inf),
        (2.0, 5e-324, 0.0, 0.0),
    ],
)
def test_slopes_of_the_power_law_at_its_limits(alpha, g, in_g, in_alpha):
    slopes = FORCE_MODELS["eq9"].normal_load_slopes(g, alpha)
    assert slopes[0] == pytest.approx(in_g, rel=1e-12, abs=1e-50)
    assert slopes[1] == pytest.approx(in_alpha, rel=1e-12, abs=1e-300)


def test_the_power_law_bends_at_the_middle_of_table_1():
    """Its slopes there are those above; below, n falls faster."""
    slopes = FORCE_MODELS["eq9"].normal_load_slopes
    below, at, above = (slopes(10.0, alpha)[1] for alpha in (5.0 - 1e-9, 5.0, 5.0 + 1e-9))
    assert at == pytest.approx(above, rel=1e-7)
    assert below == pytest.approx(at * (0.12 / 3) / (0.10 / 4), rel=1e-7)
