"""Models fitted once to a made-up contact, and installed in the place of the shipped ones."""

import numpy as np
import pytest

import surrogate.choosing.auto_law
import surrogate.choosing.candidates
import surrogate.choosing.catalogue
import surrogate.choosing.costs
import surrogate.contact.shipped
from fe_training.fitting import process as fit_gp
from fe_training.fitting.fit import fit, write_fitted
from surrogate.basics.files import checksum_line
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.polynomial import Polynomial
from surrogate.coupling.shipped import AMPLIFICATION_FILE, content_of_amplification


@pytest.fixture(scope="session", autouse=True)
def one_start():
    """Fit hyperparameters from one start, for the time that it takes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fit_gp, "_RESTARTS", 0)
        yield


@pytest.fixture(scope="session")
def fitted_file(tmp_path_factory):
    """The file of models fitted to the made-up points."""
    from made_up import points

    return write_fitted(tmp_path_factory.mktemp("models"), fit(points(), {"origin": "made up"}))


@pytest.fixture(scope="session")
def made_up_kappa(fitted_file):
    """A made-up kappa beside the models, for x from -9 to 0 and all of their alphas."""
    from surrogate.contact.shipped import read

    touch = read(str(fitted_file)).limits.touch
    powers = np.array([[0, 0, 1, 0], [1, 0, 1, 0], [0, 1, 0, 1], [0, 0, 2, 0], [0, 0, 1, 1]])
    kappa = Amplification(
        touch,
        Polynomial(powers, np.array([2.0, 0.1, 0.05, 1.5, -0.3])),
        (np.linspace(-9.0, 0.0, 4), np.linspace(np.log(2.0), np.log(9.0), 3), np.linspace(0, 1, 5)),
        0.1 + 0.2 * np.random.default_rng(1).random((4, 3, 5)),
        (0.5, 10.0),
        ((-9.0, -3.0, 0.0), (np.log(2.0), np.log(9.0))),
        np.array([[0.004], [0.008]]),
        np.array([[2.5], [3.5]]),
        {"origin": "made up"},
    )
    content = content_of_amplification(kappa)
    file = fitted_file.with_name(AMPLIFICATION_FILE)
    file.write_bytes(content)
    file.with_name(f"{AMPLIFICATION_FILE}.sha256").write_bytes(
        checksum_line(AMPLIFICATION_FILE, content)
    )
    surrogate.choosing.auto_law._at.cache_clear()  # which may know that there was none
    return kappa


@pytest.fixture
def coupled(made_up_kappa, installed):
    """The made-up kappa in use with the made-up models."""
    return made_up_kappa


@pytest.fixture
def installed(fitted_file, monkeypatch):
    """The fitted models as this installation's own, which never measured what they cost."""
    for module in (
        surrogate.choosing.candidates,
        surrogate.choosing.catalogue,
        surrogate.choosing.costs,
        surrogate.contact.shipped,
    ):
        monkeypatch.setattr(module, "models_folder", lambda: fitted_file.parent)
    return surrogate.contact.shipped.shipped()
