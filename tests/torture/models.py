"""The fitted models under torture: those shipped, or else some fitted to a made-up contact."""

import sys
from pathlib import Path

import surrogate.contact.shipped
from surrogate.errors import InputError

__all__ = ["install"]

HELPERS = Path(__file__).resolve().parent.parent


def install(folder):
    """Make fitted models available and return a sentence that says which.

    Parameters
    ----------
    folder : Path
        Where models fitted to a made-up contact are kept, if none are shipped.
    """
    try:
        surrogate.contact.shipped.shipped()
        return "the fitted models are those shipped"
    except InputError:
        pass
    surrogate.contact.shipped.models_folder = lambda: folder
    try:
        surrogate.contact.shipped.shipped()
    except InputError:  # none yet, or of an earlier version
        _made_up(folder)
        surrogate.contact.shipped.shipped()
    return "no fitted models are shipped: these were fitted to a made-up contact (tests/fit)"


def _made_up(folder):
    from fe_training.fitting.fit import fit, write_fitted

    sys.path.insert(0, str(HELPERS))
    from made_up import points

    folder.mkdir(parents=True, exist_ok=True)
    write_fitted(folder, fit(points(), {"origin": "made up"}))
