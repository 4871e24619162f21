"""A made-up data set, and what the command makes of it."""

import contextlib
import io
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest
from made_up_coupled import data_of, rows_of_base

from fe_training.coupled.__main__ import main
from fe_training.coupled.dataset import write_coupled
from surrogate.contact.shipped import shipped

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def touch():
    return shipped().limits.touch


def bases(count, touch):
    """Return a data set of so many bases that fill space, every fifth of them held out."""
    from scipy.stats import qmc

    places = qmc.Sobol(3, seed=3).random_base2(5)[:count]
    return data_of([one for i, place in enumerate(places) for one in rows_of_base(i, place, touch)])


@pytest.fixture(scope="session")
def made_up(touch):
    return bases(15, touch)


@dataclass(frozen=True)
class Folder:
    """What the command wrote."""

    path: Path
    printed: str

    def text(self, name):
        return (self.path / name).read_text(encoding="utf-8")


@pytest.fixture(scope="session")
def fitted_folder(made_up, tmp_path_factory):
    """The folder after --fit: the data set and the shipped models, kappa and its card."""
    return _fitted(made_up, tmp_path_factory.mktemp("coupled"))


@pytest.fixture(scope="session")
def densely_fitted(touch, tmp_path_factory):
    """The same of as many bases as the bounds of cells need to be those of all loads."""
    return _fitted(bases(24, touch), tmp_path_factory.mktemp("dense"))


def _fitted(data, path):
    write_coupled(data, path / "coupled.h5")
    for name in ("surrogates.npz", "surrogates.npz.sha256"):
        shutil.copy(ROOT / "models" / name, path / name)
    with contextlib.redirect_stdout(io.StringIO()) as out:
        assert main([str(ROOT / "models" / "coupled.toml"), "--fit", str(path)]) == 0
    return Folder(path, out.getvalue())
