"""Regime maps: which term of the force dominates, over any two quantities or groups."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import SMALLEST, Quantity, mapping, one_number, shown
from surrogate.basics.records import ReadOnly, html_table, number
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import of_law
from surrogate.contact.base import ForceModel
from surrogate.cutting.force import force_of
from surrogate.cutting.regimes import DOMINANT_SHARE, THRESHOLD, regime_of, term_shares
from surrogate.errors import ImplausibleInputWarning, InputError
from surrogate.maps.axes import coordinate, map_axis
from surrogate.maps.boundaries import LIMITS, boundaries, limit_names
from surrogate.maps.record import MapRecord, scene_of
from surrogate.maps.scenes import resolve

if TYPE_CHECKING:
    import xarray

__all__ = ["RegimeMap", "html_of_map", "regime_map"]

Array = NDArray[np.float64]

MISS = Quantity("miss", "", "give 0.1 for 10 %", lower=SMALLEST, upper=1.0 - 2.0**-53)
_FEWEST_NODES, _MOST_NODES = 3, 4001


@dataclass(frozen=True, eq=False)
class RegimeMap(MapRecord):
    """A regime map; see `regime_map`. Its arrays have the shape (nodes of y, nodes of x).

    Parameters
    ----------
    x, y : MapAxis
        The axes with their nodes.
    fixed : mapping of str to float
        What else was given [SI].
    model : str, ForceModel or AnyLaw
        The force model that was asked for, under its law.
    units : tuple of str
        Quantities that are 1 because only dimensionless groups were given: the units of the map.
    scene : Scene
        What is cut at each node.
    force : CuttingForce
        The force at each node with its parts, the model's relative error, None where nobody knows
        one, and `in_domain`, whether the model's own condition holds [N/m, or `force_unit`].
    regime : Regime
        What `classify` answers at each node, with the threshold.
    term_shares : mapping of str to ndarray
        Share of the force of each term that can dominate, by the names of the regime [-].
    miss : float
        Share by which a limit formula misses the model on its boundary [-].
    boundaries : tuple of Boundary
        Where terms are equal, where one begins to dominate, where limit formulas end to hold, and
        where the wire begins to touch the crack tip.
    quantities : mapping of str to Monomial
        The scene's quantities as functions c x^p y^q of the map's coordinates.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> gel = {"shear_modulus": 685.0, "wear_strength": 7750.0}
    >>> made = regime_map("wire_radius", "toughness", ((1e-5, 1e-3), (0.1, 10.0)), gel, nodes=3)
    >>> made.regime.dominant[0].tolist()
    ['wear', 'wear', 'wear']
    >>> made.wear_share.round(3)[:, 1]
    array([0.969, 0.756, 0.237])
    """

    def _repr_html_(self) -> str:
        """What notebooks show."""
        return html_of_map(self)

    def to_csv(self, file: str | PathLike[str]) -> None:
        """Write one line a node: coordinates, force, shares and regime, with units in the header.

        Raises
        ------
        InputError
            If the file cannot be written.
        """
        from surrogate.maps.tables import write_map

        write_map(self, file)

    def boundaries_to_csv(self, file: str | PathLike[str]) -> None:
        """Write one line a point of the boundaries, with units in the header.

        Raises
        ------
        InputError
            If the file cannot be written.
        """
        from surrogate.maps.tables import write_boundaries

        write_boundaries(self, file)

    def to_xarray(self) -> xarray.Dataset:
        """Return the map as a labelled data set with units.

        Raises
        ------
        WirecutError
            If xarray is not installed.
        """
        from surrogate.maps.tables import map_dataset

        return map_dataset(self)


def regime_map(
    x: str,
    y: str,
    ranges: Sequence[Sequence[float]],
    fixed: Mapping[str, float] | None = None,
    model: str | ForceModel = "eq13",
    *,
    rtol: float | None = None,
    law: str = AUTO,
    scales: Sequence[str] = ("log", "log"),
    nodes: int = 201,
    threshold: float = DOMINANT_SHARE,
    limits: Sequence[str] = LIMITS,
    miss: float = 0.1,
    notch_radius: float | None = None,
) -> RegimeMap:
    """Return a map of regimes, forces and shares over two quantities or groups.

    Parameters
    ----------
    x, y : str
        What the axes show: "wire_radius", "toughness", "shear_modulus", "wear_strength",
        "friction_coefficient", "stiffening_exponent", or a group, "g", "R_w/l_e", "R_w/l_w",
        "tau_w/mu" or "tau_w/(xi mu)". The paper's letters will do: "R_w", "Gamma_o", "mu",
        "tau_w", "xi", "alpha".
    ranges : pair of pairs of float
        Lowest and highest value of x, and of y [SI].
    fixed : mapping of str to float, optional
        What else is known, quantities and groups [SI]. The rest is solved for; xi and tau_w are 0
        and alpha is 2 where nothing says otherwise. Where only dimensionless groups are given, mu
        and R_w are the units of the map.
    model : str, default "eq13"
        The force model, as in `cutting_force`. Outside its domain a fitted model is continued by
        its asymptotes; `in_domain` says where.
    rtol : float, optional
        Relative error of the force that has to be met with "auto" [-]; by default 0.02 where it can
        be had.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; the closed
        forms, the default model among them, are of the law "projected". With "auto" each node has
        a law of its own, `force.laws`, and is "projected" where no solution with friction and wear
        is near: figures mark where, and boundaries between terms jump there.
    scales : pair of str, default ("log", "log")
        "log" or "linear", of x and of y.
    nodes : int, default 201
        Nodes of each axis, from 3 to 4001 [-].
    threshold : float, default 2/3
        Share of the force from which a term dominates, as in `classify` [-].
    limits : sequence of str, optional
        Models whose limits are wanted: all of Eqs. (10), (12), (13) and (15) by default.
    miss : float, default 0.1
        Share by which a limit formula misses the model on its boundary [-].
    notch_radius : float, optional
        Radius of the crack's tip [m], with law="slip", as in `cutting_force`; in wire radii where
        only dimensionless groups are given. It has to be known at every node.

    Returns
    -------
    RegimeMap
        Regimes, forces, shares, error and validity at each node, and the boundaries as polylines.

    Raises
    ------
    InputError
        If a coordinate is unknown, given twice, missing or out of range, or an argument of another
        kind than is asked for.
    UnknownModelError
        If there is no such model, or limit.
    DomainError
        If the model has no answer at a node.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.
    WirecutError
        If the model has no closed form and contourpy, which comes with matplotlib, is missing.

    Warns
    -----
    ImplausibleInputWarning
        If what is fixed, or all of an axis, is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of the model, see `in_domain` of the map's force.

    There are two kinds of boundary between regimes. On "equal-terms" two terms of the force are
    equal: the classical transition, for instance R_w = l_w/4 without friction. On "limit" a
    formula that leaves terms out, or Eq. (13) beside a fitted model, misses the map's model by
    `miss`: there the formula ceases to be good enough, which may be far from where terms are equal.
    "dominance" is where `classify` changes its answer, and "contact", a layer of its own, where it
    changes from far-field to indentation cutting. Closed forms give exact lines; other models
    contours between the nodes.

    References
    ----------
    arXiv:2412.02021, Eqs. (5) and (10) to (15).

    Examples
    --------
    >>> made = regime_map("R_w/l_e", "R_w/l_w", ((1e-4, 10.0), (1e-2, 100.0)), {"xi": 0.1})
    >>> made.units, made.force_unit
    (('shear_modulus', 'wire_radius'), 'mu R_w')
    >>> [one.equation for one in made.boundaries if one.kind == "equal-terms"][0]
    '(1 + xi) Gamma_o = 4 tau_w R_w'
    >>> y = [one.lines for one in made.boundaries if one.kind == "equal-terms"][0][0][:, 1]
    >>> print(f"R_w/l_w = {y[0]:.4f}")
    R_w/l_w = 0.2750
    """
    number = _number_of_nodes(nodes)
    axes = [
        map_axis(coordinate(name).name, *pair, number)
        for name, pair in zip((x, y), _pairs(ranges, scales), strict=True)
    ]
    given = _given(fixed)
    quantities, units = resolve(axes[0].name, axes[1].name, given)
    scene = scene_of(quantities, axes[0].values, axes[1].values[:, np.newaxis])
    share, wanted = one_number(MISS, miss), limit_names(limits)
    model = of_law(model, law, True, notch_radius)
    force = force_of(scene, model, rtol, extrapolate=True)
    regime = regime_of(scene, force, one_number(THRESHOLD, threshold), model)
    shares = term_shares(scene, force, model)
    plain = RegimeMap(
        axes[0],
        axes[1],
        ReadOnly(given),
        model,
        units,
        scene,
        force,
        regime,
        ReadOnly(dict(zip(shares, map(np.asarray, shares.values()), strict=True))),
        share,
        (),
        ReadOnly(quantities),
    )
    made = replace(plain, boundaries=boundaries(plain, wanted))
    for sentence in made.warnings:
        warnings.warn(f"{sentence}.", ImplausibleInputWarning, stacklevel=2)
    return made


def _number_of_nodes(nodes: object) -> int:
    if isinstance(nodes, (int, np.integer)) and _FEWEST_NODES <= nodes <= _MOST_NODES:
        return int(nodes)
    raise InputError(
        f"nodes must be a whole number from {_FEWEST_NODES} to {_MOST_NODES}, but is "
        f"{shown(nodes)}; give 201 for a figure."
    )


def _pairs(ranges: object, scales: object) -> list[tuple[Any, Any]]:
    """Return range and scale of each axis."""
    try:
        both: tuple[Any, Any] = ranges, scales
        (x_range, y_range), (x_scale, y_scale) = both
    except (TypeError, ValueError):
        raise InputError(
            f"ranges and scales must be pairs, one for x and one for y, but are {shown(ranges)} "
            f"and {shown(scales)}; give for instance ((1e-5, 1e-3), (0.1, 10.0)) and "
            "('log', 'log')."
        ) from None
    return [(x_range, x_scale), (y_range, y_scale)]


def _given(fixed: object) -> dict[str, float]:
    if fixed is None:
        return {}
    given: dict[str, float] = {}
    for name, value in mapping("fixed", fixed, "{'shear_modulus': 685.0}").items():
        one = coordinate(name)
        if one.name in given:
            raise InputError(f"{one.name} must be given once, but is fixed twice; drop one.")
        given[one.name] = one_number(one.quantity, value)
    return given


def html_of_map(made: MapRecord) -> str:
    """Return a map's regimes and boundaries, and its picture where matplotlib is installed."""
    from importlib.util import find_spec

    from surrogate.maps.axes import COORDINATES
    from surrogate.maps.tables import map_summary

    told = map_summary(made)
    rows = [
        ("model", told["model"], ""),
        *(
            (axis, f"{told[axis]['name']} {_pair(told[axis])}", told[axis]["unit"])
            for axis in ("x", "y")
        ),
        *((name, number(value), COORDINATES[name].unit) for name, value in told["fixed"].items()),
        *(
            (name, f"{100.0 * share:.1f} % of the map", "")
            for name, share in told["regimes"].items()
        ),
        *((one["kind"], one["equation"], "") for one in told["boundaries"]),
    ]
    table = html_table("RegimeMap", rows)
    return table + _picture(made) if find_spec("matplotlib") else table


def _pair(axis: Mapping[str, Any]) -> str:
    return f"{number(axis['low'])} to {number(axis['high'])}"


def _picture(made: MapRecord) -> str:
    from io import StringIO

    from surrogate.basics.figures import new_figure, style, write_svg
    from surrogate.maps.figure import plot_regime_map

    stream = StringIO()
    with style():
        figure = new_figure((3.4, 3.5))
        plot_regime_map(made, figure.add_subplot())
        write_svg(figure, stream)
    return stream.getvalue()[stream.getvalue().index("<svg") :]
