"""What models there are, where they hold, what they cost and how far they may be off."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from surrogate.costs import BULK, ONE, read_costs
from surrogate.errors import InputError
from surrogate.fitted import shipped
from surrogate.force_models import FITTED_NAMES, FORCE_MODELS, ForceModel
from surrogate.paths import models_folder
from surrogate.records import Record

__all__ = ["ModelInfo", "models"]


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


def models() -> tuple[ModelInfo, ...]:
    """Return all models with domain, cost and error: closed forms first, then the fitted ones.

    Returns
    -------
    tuple of ModelInfo
        One for each name that `cutting_force` takes, but "auto", which chooses among those with
        an error.

    Raises
    ------
    InputError
        If a shipped file is damaged.

    Notes
    -----
    Costs are those of the machine that measured them, to be compared with each other.

    References
    ----------
    arXiv:2412.02021, Eqs. (9) to (15), for the closed forms.

    Examples
    --------
    >>> [model.name for model in models() if model.name.startswith("eq")]
    ['eq13', 'eq9']
    """
    try:
        fitted = shipped()
    except InputError:
        if (models_folder() / "surrogates.npz").exists():
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


def _by_name(known: Mapping[str, ForceModel]) -> dict[str, ForceModel | None]:
    return {name: known.get(name) for name in (*FORCE_MODELS, *FITTED_NAMES)}
