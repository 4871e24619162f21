"""The curves of an identification as tables and as a labelled data set."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import shown
from surrogate.basics.extras import require_extra
from surrogate.basics.files import write_csv
from surrogate.choosing.by_name import force_model
from surrogate.errors import InputError
from surrogate.identification.fit import Identification
from surrogate.inference.continuation import is_continued
from surrogate.inference.inputs import PREDICTED_RADIUS
from surrogate.inference.line_fit import is_linear
from surrogate.version import __version__

if TYPE_CHECKING:
    import xarray

__all__ = ["curve_dataset", "curve_radii", "require_identification", "write_curve", "write_profile"]

_POINTS = 201


def write_curve(
    identification: Identification,
    file: str | PathLike[str],
    wire_radius: ArrayLike | None = None,
) -> None:
    """Write the fitted force over the radius with its confidence band, one line a radius.

    Parameters
    ----------
    identification : Identification
        What `identify` returned.
    file : str or path-like
        Where to write; the header names quantity and unit.
    wire_radius : array_like, optional
        R_w [m]; radii up to the thickest wire, as far as the model reaches, by default.

    Raises
    ------
    InputError
        If `identification` is not one, a radius is out of range, or the file cannot be written.

    Examples
    --------
    >>> write_curve(1.6, "fit.csv")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: identification must be what identify returned, but is 1.6 \
(float); give identify(wire_radius, force, shear_modulus).
    """
    write_csv(file, _curve(identification, wire_radius), _about(identification))


def write_profile(identification: Identification, file: str | PathLike[str]) -> None:
    """Write the misfit over the toughness, one line a toughness.

    Parameters
    ----------
    identification : Identification
        What `identify` returned, with a `profile`.
    file : str or path-like
        Where to write; the header names quantity and unit.

    Raises
    ------
    InputError
        If `identification` is not one, has no profile, or the file cannot be written.
    """
    require_identification(identification)
    profile = identification.profile
    if profile is None:
        raise InputError(
            "the misfit over the toughness needs an identification with a profile, but Eq. (13) "
            "and other straight lines have none; give a bound, or another model."
        )
    unit = "N^2/m^2" if identification.force_std is None else ""
    columns = {("toughness", "J/m^2"): profile.toughness, ("misfit", unit): profile.misfit}
    write_csv(file, columns, _about(identification))


def curve_dataset(
    identification: Identification, wire_radius: ArrayLike | None = None
) -> xarray.Dataset:
    """Return the fitted force over the radius with its band as a labelled data set.

    Parameters
    ----------
    identification : Identification
        What `identify` returned.
    wire_radius : array_like, optional
        R_w [m]; radii up to the thickest wire, as far as the model reaches, by default.

    Raises
    ------
    InputError
        If `identification` is not one, or a radius is out of range.
    WirecutError
        If xarray is not installed.
    """
    columns = _curve(identification, wire_radius)
    require_extra("xarray", "a labelled data set", "tables")
    import xarray

    (radius, unit), values = next(iter(columns.items()))
    return xarray.Dataset(
        {name: (radius, each, {"units": u}) for (name, u), each in list(columns.items())[1:]},
        coords={radius: (radius, values, {"units": unit})},
        attrs={"about": "; ".join(_about(identification))},
    )


def curve_radii(fit: Identification, largest: float) -> NDArray[np.float64]:
    """Return the radii of the curve [m]: from 0 to the largest, or as far as the model reaches."""
    if fit.profile is None or is_linear(fit.model):
        return np.linspace(0.0, largest, _POINTS)
    toughness = np.append(fit.profile.admitted[0], fit.toughness)
    model = force_model(fit.model)
    if is_continued(model):
        return np.linspace(largest / _POINTS, largest, _POINTS)
    g = model.g
    first = max(largest / _POINTS, toughness.max() / (fit.shear_modulus * g.upper))
    if g.lower > 0.0:
        largest = min(largest, toughness.min() / (fit.shear_modulus * g.lower))
    return np.linspace(first * (1.0 + 1e-12), largest * (1.0 - 1e-12), _POINTS)


def _curve(fit: Identification, wire_radius: ArrayLike | None) -> dict[tuple[str, str], Any]:
    require_identification(fit)
    if wire_radius is None:
        wire_radius = curve_radii(fit, fit.wire_radius.max())
        wire_radius = wire_radius[wire_radius > 0.0]
    radius = np.atleast_1d(np.asarray(PREDICTED_RADIUS.checked(wire_radius)))
    low, high = fit.band(radius)
    return {
        ("wire_radius", "m"): radius,
        ("force_per_thickness", "N/m"): fit.predict(radius),
        ("band_low", "N/m"): low,
        ("band_high", "N/m"): high,
    }


def require_identification(value: object) -> None:
    """Refuse what is no identification."""
    if not isinstance(value, Identification):
        raise InputError(
            f"identification must be what identify returned, but is {shown(value)} "
            f"({type(value).__name__}); give identify(wire_radius, force, shear_modulus)."
        )


def _about(fit: Identification) -> list[str]:
    return [
        f"identification by model {fit.model}, wirecut {__version__}",
        f"toughness = {fit.toughness!r} J/m2, wear strength = {fit.wear_strength!r} Pa, "
        f"friction coefficient = {fit.friction_coefficient!r}",
        f"the band holds with probability {fit.confidence!r}",
    ]
