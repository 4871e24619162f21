"""The wedge, the cells, the processes: each by itself, against what it must agree with."""

import math
import sys

import numpy as np
import pytest
from made_up import points

from fe_training.fitting.process import (
    Hyperparameters,
    _calibrated,
    leave_out_errors,
    process_with,
)
from fe_training.fitting.scatter import Scatter, likeliest_scatter, smoothed
from fe_training.fitting.table import _function, fit_table
from surrogate.contact.coordinates import (
    coordinates,
    coordinates_of,
    log_touch,
    log_touch_slope,
    tip_coordinate,
    tip_slope,
    vertex,
)
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import toughness_of
from surrogate.contact.formula import BlendModel, distance_formula
from surrogate.contact.grid import Grid
from surrogate.contact.process import GaussianProcess
from surrogate.contact.shipped import shipped
from surrogate.contact.table import CellTable
from surrogate.contact.wedge import (
    wedge_functions,
    wedge_load,
    wedge_slope,
    wedge_slopes,
)

LOG_G = np.array([-740.0, -40.0, -6.0, -1.0, 0.0, 2.0, 5.0, 9.0])


def test_the_wedge_solves_its_equation():
    p = wedge_load(LOG_G)
    log_k = (2.0 / 3.0) * (math.log(32.0) + 0.5 * (1.0 - math.log(math.pi)) - LOG_G)
    # p ln(k p) = pi/3; near its root the left side changes by p (1 + ln(k p)) a unit of ln p
    assert p * (log_k + np.log(p)) == pytest.approx(math.pi / 3, rel=1e-13)


def test_the_wedge_at_the_ends_of_the_numbers():
    assert wedge_load(-math.inf) == 0.0
    at_zero = wedge_functions(-math.inf, 0.0)
    assert list(at_zero.values()) == [0.0, 0.0, math.inf, 0.0, 0.0]
    for log_g in LOG_G:
        alone = wedge_functions(float(log_g), wedge_load(float(log_g)))
        together = wedge_functions(LOG_G, wedge_load(LOG_G))
        for name, value in alone.items():
            assert type(value) is float
            assert value == together[name][list(LOG_G).index(log_g)]


def test_slopes_of_the_wedge():
    h = 1e-6
    low, high = (wedge_functions(x, wedge_load(x)) for x in (LOG_G[1:] - h, LOG_G[1:] + h))
    for name, slope in wedge_slopes(LOG_G[1:]).items():
        difference = (np.log(high[name]) - np.log(low[name])) / (2.0 * h)
        assert slope == pytest.approx(difference, abs=1e-9)
    assert wedge_slope(-40.0) > 0.0


def test_slope_of_the_touch():
    coefficients, h = (0.3, -1.0, 2.0, 0.5), 1e-6
    difference = (log_touch(coefficients, 1.2 + h) - log_touch(coefficients, 1.2 - h)) / (2.0 * h)
    assert log_touch_slope(coefficients, 1.2) == pytest.approx(difference, rel=1e-9)
    assert log_touch_slope((0.3,), 1.2) == 0.0


def test_the_coordinate_of_what_feels_the_tip_rises_and_jumps():
    x, h = np.array([-800.0, -2.0, -0.05, 0.4]), 1e-6
    difference = (tip_coordinate(x + h, x > 0.0) - tip_coordinate(x - h, x > 0.0)) / (2.0 * h)
    assert tip_slope(x) == pytest.approx(difference, abs=1e-8)
    before, past = (float(tip_coordinate(0.0, side)) for side in (False, True))
    assert before == 0.0 < past
    assert tip_coordinate(1e308, True) == 1e308
    for name in ("arc", "slip_load"):
        at = coordinates_of(name, x, 1.0, 0.0)
        np.testing.assert_array_equal(at, coordinates(x, 1.0, 0.0))


@pytest.mark.parametrize("share", [0.04, 0.5])
def test_the_scatter_is_found_again(share):
    random = np.random.default_rng(4)
    at = np.linspace(0.0, 6.0, 400)
    covariance = np.exp(-0.5 * (at[:, np.newaxis] - at) ** 2)
    differences = 10.0 ** random.uniform(-6.0, -3.0, len(at))
    values = np.sin(at) + random.normal(size=len(at)) * np.sqrt(share * differences)
    found = likeliest_scatter(covariance, values, differences, Scatter())
    # a variance from n numbers is known to sqrt(2/n) of it: 7 %, and three times that is allowed
    assert found.share == pytest.approx(share, rel=3.0 * np.sqrt(2.0 / len(at)))
    assert found.extra < share * np.median(differences)


def test_variances_are_averaged_over_neighbours_of_one_alpha():
    log_g = np.tile(np.linspace(0.0, 8.0, 9), 2)
    alpha = np.repeat([2.0, 3.0], 9)
    averaged = smoothed(log_g, alpha, np.where(alpha == 2.0, 1.0, np.eye(9)[4][np.r_[:9, :9]]))
    assert averaged[:9] == pytest.approx(1.0)
    assert np.argmax(averaged[9:]) == 4
    assert np.all(averaged > 0.0)


@pytest.mark.parametrize("g", [1e-300, 1e-9, 0.3, 0.999999])
def test_the_inverse_of_the_distance(g):
    def distance(at):
        return 1.0 + vertex(float(np.log(at))) / at if at else math.inf

    assert toughness_of(distance, float(distance(g)), 0.0) == pytest.approx(g, rel=1e-9)


GRID = Grid(-3.0, 4.0, (0.7, 2.2), (0.2, 1.1, 0.3), 5, 4, 3)


def cubic(u, v):
    return 1.0 + u * (0.5 + v) + u**3 * (0.2 - 0.1 * v**2) - v**3


@pytest.fixture(scope="module")
def table():
    """A table of a cubic polynomial in cells along g and in ln alpha, with a bend at the touch."""
    node, rows = GRID.nodes()
    u, v = np.meshgrid(node, rows, indexing="ij")
    values = cubic(u, v)
    steeper = values + 2.0 * u  # beyond the touch
    return CellTable(GRID, {"f": (values[:6], steeper[5:])})


def anywhere(size=400):
    random = np.random.default_rng(5)
    log_alpha = random.uniform(0.7, 2.2, size)
    return random.uniform(-3.0, log_touch(GRID.touch, log_alpha) + 4.0), log_alpha


def test_a_table_of_a_cubic_polynomial_is_that_polynomial(table):
    log_g, log_alpha = anywhere()
    place = GRID.place(log_g, log_alpha)
    u = place.along_g + place.in_g - GRID.short
    expected = cubic(u, log_alpha) + 2.0 * np.maximum(u, 0.0)
    assert table.at(("f",), log_g, log_alpha)[1][0] == pytest.approx(expected, rel=1e-12, abs=1e-11)


def test_nodes_are_where_the_grid_says():
    node, rows = GRID.nodes()
    for row in rows:
        place = GRID.place(GRID.log_g_of(node, row), np.full(len(node), row))
        assert place.along_g + place.in_g - GRID.short == pytest.approx(node, abs=1e-12)


def test_ways_of_evaluation_agree_to_the_last_bit(table, monkeypatch):
    monkeypatch.delitem(sys.modules, "numba", raising=False)
    log_g, log_alpha = anywhere()
    scattered = table.at(("f",), log_g, log_alpha)
    assert [a.tolist() for a in (scattered[0], *scattered[1])] == one_by_one(
        table, log_g, log_alpha
    )
    along = table.at(("f",), log_g, 1.3)[1][0]
    both = table.at(("f",), log_g, np.full(len(log_g), 1.3))[1][0]
    np.testing.assert_array_equal(along, both)


def test_compiled_cells_agree_to_the_last_bit(table):
    pytest.importorskip("numba")
    log_g, log_alpha = anywhere()
    x, values = table.at(("f",), log_g, log_alpha)
    assert [a.tolist() for a in (x, *values)] == one_by_one(table, log_g, log_alpha)


def one_by_one(table, log_g, log_alpha):
    """Return x and the function, each point computed as a float."""
    points = [
        table.at(("f",), *each) for each in zip(log_g.tolist(), log_alpha.tolist(), strict=True)
    ]
    return [[x for x, _ in points], [values[0] for _, values in points]]


def test_slopes_of_a_table(table):
    log_g, log_alpha = anywhere()
    h = 1e-6

    def at(x, y):
        return table.at(("f",), x, y)[1][0]

    x, value, by_g, by_alpha = table.slopes("f", log_g, log_alpha)
    np.testing.assert_array_equal(x, log_g - log_touch(GRID.touch, log_alpha))
    np.testing.assert_array_equal(value, at(log_g, log_alpha))
    far = np.abs(log_g - log_touch(GRID.touch, log_alpha)) > 1e-4  # differences across the bend
    difference = (at(log_g + h, log_alpha) - at(log_g - h, log_alpha)) / (2.0 * h)
    assert by_g[far] == pytest.approx(difference[far], rel=1e-6, abs=1e-6)
    difference = (at(log_g, log_alpha + h) - at(log_g, log_alpha - h)) / (2.0 * h)
    assert by_alpha[far] == pytest.approx(difference[far], rel=1e-6, abs=1e-6)


@pytest.fixture(scope="module")
def process():
    random = np.random.default_rng(2)
    at = random.uniform(0.0, 3.0, (60, 3))
    values = np.sin(at[:, 0]) + 0.3 * at[:, 1] ** 2 - 0.1 * at[:, 2]
    noise = random.uniform(1e-6, 1e-4, 60)
    return GaussianProcess(at, values, noise, np.arange(60), 0.4, 2.0, np.array([1.1, 1.6, 3.0]))


def test_a_process_with_all_points_is_that_of_scikit_learn(process):
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel

    kernel = ConstantKernel(2.0) * RBF(process.lengths)
    other = GaussianProcessRegressor(kernel, alpha=process.noise, optimizer=None)
    other.fit(process.inputs, process.values - 0.4)
    at = np.random.default_rng(3).uniform(0.0, 3.0, (130, 3))
    mean, std = process.predict(at)
    expected, expected_std = other.predict(at, return_std=True)
    # both invert matrices whose condition number is about 60 * 2/1e-6 = 1e8
    assert mean == pytest.approx(expected + 0.4, abs=1e-6)
    assert std == pytest.approx(expected_std, abs=2e-5)
    np.testing.assert_array_equal(process.predict_mean(at), mean)


def test_predictions_do_not_depend_on_how_many_are_asked_for(process):
    at = np.random.default_rng(4).uniform(0.0, 3.0, (70, 3))
    mean, std = process.predict(at)
    for some in (slice(0, 1), slice(5, 69), slice(64, 70)):
        alone = process.predict(at[some])
        np.testing.assert_array_equal(alone, (mean[some], std[some]))


def test_gradient_of_a_process(process):
    at, h = np.random.default_rng(6).uniform(0.5, 2.5, (20, 3)), 1e-5
    slopes = process.gradient(at)
    for i in range(3):
        step = h * np.eye(3)[i]
        difference = (process.predict_mean(at + step) - process.predict_mean(at - step)) / (2 * h)
        assert slopes[:, i] == pytest.approx(difference, abs=1e-5)


def test_leaving_out_is_what_fitting_without_gives(process):
    groups = np.arange(60) // 4
    error, std = leave_out_errors(process, groups)
    for group in (0, 7, 14):
        rest = groups != group
        without = GaussianProcess(
            process.inputs[rest],
            process.values[rest],
            process.noise[rest],
            np.arange(rest.sum()),
            process.mean,
            process.variance,
            process.lengths,
        )
        mean, spread = without.predict(process.inputs[~rest])
        assert error[~rest] == pytest.approx(mean - process.values[~rest], abs=1e-6)
        expected = np.sqrt(spread**2 + process.noise[~rest])
        assert std[~rest] == pytest.approx(expected, rel=1e-3)


def test_deviations_are_calibrated_at_points_left_out_and_the_mean_stays(process):
    at, values, noise = process.inputs, process.values, 4.0 * process.noise
    found = Hyperparameters(process.mean, 3.0, process.lengths, Scatter(2.0, 1e-7))
    calibrated = _calibrated(found, at, values, noise)
    before, after = (process_with(one, at, values, noise) for one in (found, calibrated))
    error, std = leave_out_errors(after, np.arange(len(values)))
    one, two = np.quantile(np.abs(error) / std, (0.683, 0.954))
    assert one * two / 2.0 == pytest.approx(1.0, rel=1e-6)
    assert after.predict_mean(at) == pytest.approx(before.predict_mean(at), abs=1e-6)


def test_the_table_of_what_feels_the_tip_follows_it_up_to_the_touch():
    process = shipped().models["gp"]
    table = fit_table(process)
    grid, (before, beyond) = table.grid, table.nodes["slip_arc"]
    place, alpha = np.linspace(-2.0, 0.0, 300)[:, np.newaxis], grid.nodes()[1]
    log_g = grid.log_g_of(place, alpha)
    log_alpha = np.broadcast_to(alpha, log_g.shape)
    x = log_g - process.limits.log_touch(log_alpha)
    known = (x < -2.0 * process.touch_error) & (np.exp(alpha) < 6.6)  # touched within the range
    exact = _function(process, "slip_arc", log_g, log_alpha, past=False)
    through = before.copy()
    through[-1] = exact[-1]  # as if the cubics went through the value at the touch itself

    def off(nodes):
        cells = CellTable(grid, {"slip_arc": (nodes, beyond)})
        values = cells.at(("slip_arc",), log_g[known] - 1e-12, log_alpha[known])[1][0]
        return np.max(np.abs(values / exact[known] - 1.0))

    assert off(before) < 0.5 * off(through)
    assert off(before) < 0.03


def test_the_formula_has_twelve_constants_and_the_limits_it_claims(installed):
    model = installed.models["power-law"]
    assert sum(len(model.constants[name]) for name in ("arc", "normal_load")) == 12
    wide = BlendModel(Domain((1e-12, 1e9), (2.0, 9.0), installed.limits.touch, {}), model.constants)
    wedge = wedge_functions(np.log(1e-12), wedge_load(np.log(1e-12)))
    assert wide.normal_load(1e-12, 3.0) == pytest.approx(wedge["normal_load"], rel=1e-3)
    k = np.sqrt(1.0 + 5.0 * model.constants["arc"][0])  # alpha = 3
    chord = 2.0 / k * np.sin(k * wedge["arc"] / 2.0)
    assert wide.arc(1e-12, 3.0) == pytest.approx(chord, rel=1e-3)
    n = model.constants["normal_load"][4] + model.constants["normal_load"][5] / 3.0  # alpha = 3
    steep = np.log(wide.normal_load(1e9, 3.0) / wide.normal_load(1e8, 3.0)) / np.log(10.0)
    assert steep == pytest.approx(n, abs=1e-2)
    assert wide.arc(1e9, 3.0) == pytest.approx(wide.arc(1e8, 3.0), rel=1e-2)


def test_points_can_be_taken():
    some = points().taken(slice(3, 7))
    assert len(some) == 4
    assert some.g[0] == points().g[3]


def test_the_formula_of_delta_next_to_the_touch():
    """Where 1 - exp(p x) rounds to 0, alone and in arrays."""
    constants = (0.3, 0.0, 2.0, 0.0)
    x = np.array([0.0, -1e-300, -1e-17, -1e-12, -1e-3])
    together = distance_formula(constants, x, 0.7, 0.0)
    assert together[0][:3].tolist() == [1.0, 1.0, 1.0]
    assert together[0][-1] > 1.0
    for i, one in enumerate(x.tolist()):
        alone = distance_formula(constants, one, 0.7, 0.0)
        assert [float(value) for value in alone] == [float(column[i]) for column in together]
    assert all(np.isfinite(column).all() for column in together)
