"""The fit as an estimator of scikit-learn."""

import numpy as np
import pytest
from made_up import ALPHAS, G, points, truth
from sklearn.base import clone
from sklearn.exceptions import NotFittedError
from sklearn.model_selection import GroupKFold, cross_val_score

from fe_training.fitting.estimator import ContactRegressor
from surrogate.errors import InputError


@pytest.fixture(scope="module")
def data():
    made = points(alphas=ALPHAS[::2], g=G[::2])
    X = np.stack([made.g, made.alpha], axis=1)
    return X, np.stack([made.arc, made.normal_load, made.distance], axis=1)


@pytest.fixture(scope="module")
def fitted(data):
    return ContactRegressor().fit(*data)


def test_it_predicts_what_it_was_fitted_to(data, fitted):
    X, y = data
    assert fitted.score(X, y) > 0.999
    g, alpha = np.array([[0.03, 2.5], [0.8, 3.1], [20.0, 7.0]]).T
    found = fitted.predict(np.stack([g, alpha], axis=1))
    expected = np.stack(truth(g, alpha), axis=1)
    np.testing.assert_allclose(found[:, :2], expected[:, :2], rtol=2e-2)


def test_the_order_of_the_points_does_not_matter(data, fitted):
    X, y = data
    order = np.random.default_rng(1).permutation(len(X))
    shuffled = ContactRegressor().fit(X[order], y[order])
    np.testing.assert_allclose(shuffled.predict(X[:20]), fitted.predict(X[:20]), rtol=1e-12)


def test_whole_alphas_are_left_out_by_scikit_learn(data):
    X, y = data
    scores = cross_val_score(ContactRegressor(), X, y, groups=X[:, 1], cv=GroupKFold(4))
    assert len(scores) == 4
    assert np.all(np.isfinite(scores))


def test_parameters_and_copies(data):
    one = ContactRegressor(model="gp")
    assert clone(one).model == "gp"
    assert one.set_params(model="power-law").model == "power-law"
    with pytest.raises(NotFittedError):
        one.predict(data[0])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda X, y: (X[:, :1], y), "X must have 2 columns"),
        (lambda X, y: (-X, y), "positive numbers"),
        (lambda X, y: (X, y[:, :2]), "y must have 3 columns"),
        (lambda X, y: (X[:-1], y), "one row a point"),
        (lambda X, y: (X * np.nan, y), "X must be a table of numbers, but: .*NaN"),
        (lambda X, y: (X[:9], y[:9]), "30 points"),
    ],
)
def test_what_cannot_be_fitted_is_refused(change, words, data):
    with pytest.raises(InputError, match=words):
        ContactRegressor().fit(*change(*data))


def test_models_without_that_name_are_refused(data):
    with pytest.raises(InputError, match="model must be one of power-law, table, gp"):
        ContactRegressor(model="eq13").fit(*data)
