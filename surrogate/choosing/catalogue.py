"""What models there are, where they hold, what they cost and how far they may be off."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace

from surrogate.basics.checks import shown
from surrogate.basics.files import models_folder
from surrogate.basics.records import Record
from surrogate.choosing.beside_law import errors_over_reach, reach_in_words
from surrogate.choosing.by_name import FITTED_NAMES, force_model
from surrogate.choosing.costs import BULK, ONE, read_costs
from surrogate.choosing.laws import LAWS, PROJECTED
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.shipped import shipped, use
from surrogate.errors import InputError

__all__ = ["ModelInfo", "load_models", "models"]


@dataclass(frozen=True, slots=True, eq=False)
class ModelInfo(Record):
    """A model as `models` lists it.

    Parameters
    ----------
    name : str
        What `model` is to be, in `cutting_force` and elsewhere.
    equation : str
        What it evaluates.
    domain : str
        Where it holds.
    available : bool
        Whether this installation has it: the fitted models need their file.
    cost : float or None
        Measured time for each of A, B and delta at each of many points [ns]; None if not measured.
    latency : float or None
        Measured time of one number by itself [us]; None if not measured.
    error : float or None
        Measured bound of the relative error of A and B over the domain [-]; None if not measured.
        Under a law that was asked for the largest bound of that of F_ss beside finite elements on
        which the wire rubs, at the largest loads that these reach.
    law : str
        The law of dissipation.
    median_error : float or None
        The median of that bound over these loads [-]; None where no law was asked for.

    Examples
    --------
    >>> print(models()[0].name)
    eq13
    """

    name: str
    equation: str
    domain: str
    available: bool
    cost: float | None
    latency: float | None
    error: float | None
    law: str = PROJECTED
    median_error: float | None = None


def models(law: str | None = None) -> tuple[ModelInfo, ...]:
    """Return all models with domain, cost and error: closed forms first, then the fitted ones.

    Parameters
    ----------
    law : str, optional
        "projected", "slip" or "coupled": only the models that have this law of dissipation, with
        the error of their forces under it beside finite elements on which the wire rubs. Without
        it the error is that of A and B beside finite elements without shear on the wire.

    Returns
    -------
    tuple of ModelInfo
        One for each name that `cutting_force` takes, but "auto", which chooses among those with
        an error.

    Raises
    ------
    InputError
        If a shipped file is damaged, or there is no such law.

    Notes
    -----
    Costs are those of the machine that measured them, to be compared with each other. The errors
    under a law are made of the bounds by cell on the cards of the models and of kappa,
    models/model-card.md and models/coupled-card.md, at the largest loads that coupled solutions
    reach; `domain` says over which. At smaller loads they are smaller: a force tells its own.

    References
    ----------
    arXiv:2412.02021, Eqs. (9) to (15), for the closed forms.

    Examples
    --------
    >>> [model.name for model in models() if model.name.startswith("eq")]
    ['eq13', 'eq9']
    >>> [model.name for model in models("coupled")]
    ['power-law', 'table', 'gp']
    """
    listed = _listed()
    if law is None:
        return listed
    if not isinstance(law, str) or law not in LAWS:
        raise InputError(f"law must be one of {', '.join(LAWS)}, but is {shown(law)}; choose one.")
    return tuple(
        _under(model, law) for model in listed if law == PROJECTED or model.name in FITTED_NAMES
    )


def _under(model: ModelInfo, law: str) -> ModelInfo:
    """Return a model under a law, with the errors of its forces beside coupled solutions."""
    errors = errors_over_reach(force_model(model.name), law) if model.available else None
    worst, median = (None, None) if errors is None else errors
    domain = model.domain if errors is None else reach_in_words()
    return replace(model, law=law, error=worst, median_error=median, domain=domain)


def _listed() -> tuple[ModelInfo, ...]:
    """Return all models with the errors of A and B."""
    try:
        fitted = shipped()
    except InputError:
        if os.path.exists(os.path.join(models_folder(), "surrogates.npz")):
            raise
        fitted = None
    costs = read_costs()
    known = fitted.models if fitted else {}
    bounds = fitted.bounds if fitted else None
    return tuple(
        ModelInfo(
            name,
            model.equation if model else "fitted to finite elements",
            model.domain if model else "made by regen-surrogate",
            model is not None,
            costs.get(name, {}).get(BULK),
            costs.get(name, {}).get(ONE),
            bounds.of_force(name) if bounds and name in bounds.errors else None,
        )
        for name, model in _by_name({**FORCE_MODELS, **known}).items()
    )


def load_models(path: object = None) -> tuple[ModelInfo, ...]:
    """Take fitted models from a file of one's own, in every call from now on.

    The models "power-law", "table", "gp" and "auto" are then those of the file, as
    ``regen-surrogate`` wrote it. On the command line ``--models PATH`` does the same, and for both
    the environment variable WIRECUT_MODELS.

    Parameters
    ----------
    path : str or path-like, optional
        The file, or the folder that holds its ``surrogates.npz``, with its checksum beside it;
        without it the shipped models are taken again.

    Returns
    -------
    tuple of ModelInfo
        All models, as `models` lists them. Costs are those measured with the shipped ones.

    Raises
    ------
    InputError
        If the file is missing, damaged, changed since it was fitted, or of a newer version; the
        models that were in use before stay.

    Notes
    -----
    Range of validity: that of the file's own domain, which `models` tells.

    References
    ----------
    arXiv:2412.02021, Eqs. (S1) and (S2), whose A and B the models are.

    Examples
    --------
    >>> len(load_models()) == len(models())
    True
    """
    use(path)
    return models()


def _by_name(known: Mapping[str, ForceModel]) -> dict[str, ForceModel | None]:
    return {name: known.get(name) for name in (*FORCE_MODELS, *FITTED_NAMES)}
