"""Models fitted once to a made-up contact, and installed in the place of the shipped ones."""

import pytest

import surrogate.choosing.catalogue
import surrogate.contact.shipped
from fe_training.fitting import process as fit_gp
from fe_training.fitting.fit import fit, write_fitted


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


@pytest.fixture
def installed(fitted_file, monkeypatch):
    """The fitted models as this installation's own, which never measured what they cost."""
    monkeypatch.setattr(surrogate.choosing.catalogue, "models_folder", lambda: fitted_file.parent)
    monkeypatch.setattr(surrogate.contact.shipped, "models_folder", lambda: fitted_file.parent)
    return surrogate.contact.shipped.shipped()
