"""A force prepared once: the function that `prepare` returns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import FloatOrArray, Quantity, broadcast_shape, shown
from surrogate.basics.elementwise import AT_ONCE, apply
from surrogate.basics.records import number
from surrogate.contact.fitted import PROJECTED
from surrogate.errors import DomainError, InputError
from surrogate.prepared.inverse import inverse, is_monotonic
from surrogate.prepared.namespaces import evaluate_elsewhere, is_foreign
from surrogate.prepared.plan import ARC, LOAD, RUBBING, Plan
from surrogate.scene import NAMES, QUANTITIES

__all__ = ["OUTSIDE", "ForceFunction"]

RAISE, NAN = "raise", "nan"
OUTSIDE = (RAISE, NAN)


@dataclass(frozen=True, eq=False)
class ForceFunction:
    """The steady cutting force as a function of the quantities that vary; see `prepare`.

    A call takes them in the order of `varying`, or by their names, as floats or arrays that
    broadcast, in SI units. ``outside="nan"`` answers nan where a value is outside its range, and
    for nan, instead of refusing all. ``out=`` takes an array for the result, of float64 or
    float32, which may be the argument itself. Arrays of float32 are answered in float32: all is
    reckoned in float64 and rounded at the end, so that the result is off by a further 2**-24 of
    itself at most (6e-8; between 1.2e-38 and 3.4e38 N/m, beyond which it is infinite). Arrays of
    another library that follows the Array API are evaluated there, in their own precision.

    Parameters
    ----------
    plan : Plan
        How it is evaluated.
    relative_error : float
        Proven bound of the relative error anywhere in the ranges [-], beside finite elements on
        which the wire rubs: of the models and of the law together. nan where nobody knows it.
    data : mapping of str to str
        What the coefficients come from.
    fit_error : float
        The part of the models: beside finite elements of the force's own law [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (13) and (S2).

    Examples
    --------
    >>> from surrogate import Scene, prepare
    >>> gel = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    >>> force = prepare(gel, ranges={"wire_radius": (1e-4, 1e-3)})
    >>> print(f"{force(0.25e-3):.2f} N/m")
    7.35 N/m
    >>> force(np.array([1e-4, 5e-3]), outside="nan").round(2)
    array([3.68,  nan])
    """

    plan: Plan
    relative_error: float
    data: Mapping[str, str] = field(repr=False)
    fit_error: float

    @property
    def beside(self) -> str:
        """Beside which finite elements `relative_error` is: "on which the wire rubs"."""
        return RUBBING

    @property
    def varying(self) -> tuple[str, ...]:
        """Names of the quantities that vary, in the order of the arguments."""
        return self.plan.varying

    @property
    def fixed(self) -> dict[str, float]:
        """The quantities that do not vary, by name [SI]."""
        return dict(self.plan.fixed)

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """The ends of the quantities that vary, by name [SI]."""
        return {name: self.plan.ranges[name] for name in self.varying}

    @property
    def terms(self) -> dict[str, str]:
        """The model of each term that the scene has: "friction", "wear"."""
        names = {"wear": ARC, "friction": LOAD}
        strengths = {"wear": "wear_strength", "friction": "friction_coefficient"}
        return {
            term: "table" if names[term] in self.plan.of_table else self.plan.form.name
            for term in names
            if self.plan.ranges[strengths[term]][1] > 0.0
        }

    @property
    def law(self) -> str:
        """The law of dissipation: "projected", "slip" or "coupled"."""
        return self.plan.law

    @cached_property
    def quantities(self) -> tuple[Quantity, ...]:
        """The quantities that vary, with their ranges."""
        known = dict(zip(NAMES, QUANTITIES, strict=True))
        return tuple(
            replace(
                known[name],
                lower=self.plan.ranges[name][0],
                upper=self.plan.ranges[name][1],
                error=DomainError,
                remedy="prepare the force over a wider range, or give outside='nan'",
            )
            for name in self.varying
        )

    @cached_property
    def _one(self) -> Any:
        """The range, the function of floats and that of arrays, of one quantity; else no range."""
        if len(self.varying) != 1:
            return np.inf, -np.inf, None, None
        return *self.plan.ranges[self.varying[0]], self.plan.one_number, self.plan.straight

    def __call__(
        self, *values: ArrayLike, outside: str = RAISE, out: Any = None, **named: ArrayLike
    ) -> Any:
        """Return the force F_ss/T [N/m] of the quantities that vary.

        Raises
        ------
        InputError
            If an argument is missing, unknown or no number, or the shapes do not broadcast.
        DomainError
            If a value is outside its range and `outside` is not "nan".
        """
        if len(values) == 1:
            value = values[0]
            low, high, force, straight = self._one
            if type(value) is float:
                if (
                    out is None
                    and low <= value <= high
                    and (outside is RAISE or _is_known(outside))
                ):
                    return force(value)
            elif straight is not None and _is_inside(value, low, high) and _is_known(outside):
                return _filled(straight.of, value, out)
        return self._of_anything(values, named, outside, out)

    def _of_anything(self, values: Any, named: dict[str, Any], outside: str, out: Any) -> Any:
        arguments = self._arguments(values, named)
        if not _is_known(outside):
            raise InputError(
                f"outside must be 'raise' or 'nan', but is {shown(outside)}; give one of them."
            )
        if any(map(is_foreign, arguments)):
            if out is not None:
                raise InputError(
                    "out must be left out with arrays of another library, which has its own; "
                    "give arrays of numpy, or no out."
                )
            return evaluate_elsewhere(self, arguments, outside)
        single = _is_single(arguments)
        checked, wrong = self._checked(arguments, outside)
        broadcast_shape(self.varying, tuple(checked))
        result = self._evaluated(checked)
        if wrong is not False:
            result = np.where(wrong, np.nan, result)
            result = float(result) if result.ndim == 0 else result
        if out is None and not (single and isinstance(result, np.ndarray)):
            return result
        room = np.empty(result.shape, np.float32) if out is None else out
        return _put(result, room)

    def _arguments(self, values: tuple[Any, ...], named: dict[str, Any]) -> list[Any]:
        arguments = dict(zip(self.varying, values, strict=False))
        twice_or_unknown = [n for n in named if n in arguments or n not in self.varying]
        arguments |= named
        if (
            len(values) > len(self.varying)
            or twice_or_unknown
            or len(arguments) < len(self.varying)
        ):
            raise InputError(
                f"the force must be asked for with {', '.join(self.varying)}, but was with "
                f"{len(values)} values and {', '.join(named) or 'no names'}; give each once."
            )
        return [arguments[name] for name in self.varying]

    def _checked(self, arguments: list[Any], outside: str) -> tuple[list[FloatOrArray], Any]:
        if outside == RAISE:
            return [q.checked(v) for q, v in zip(self.quantities, arguments, strict=True)], False
        wrong: Any = np.False_
        inside = []
        for quantity, value in zip(self.quantities, arguments, strict=True):
            anything = replace(quantity, lower=-np.inf, upper=np.inf)
            plain = anything.checked(np.nan_to_num(np.asarray(value, float), nan=-np.inf))
            bad = np.logical_not((plain >= quantity.lower) & (plain <= quantity.upper))
            wrong = wrong | bad
            inside.append(quantity.checked(np.where(bad, quantity.lower, plain)))
        return inside, wrong

    def _evaluated(self, values: list[FloatOrArray]) -> Any:
        """Return the force of checked values."""
        fixed, names, plan = self.plan.fixed, self.varying, self.plan
        if plan.straight is not None and isinstance(values[0], np.ndarray):
            return plan.straight.of(values[0])
        if len(names) == 1 and isinstance(values[0], float):
            return plan.one_number(values[0])

        def kernel(*blocks: Any) -> Any:
            return plan.of(**fixed, **dict(zip(names, blocks, strict=True)))

        return apply(kernel, values, (float,), AT_ONCE)

    def gradient(self, *values: ArrayLike, **named: ArrayLike) -> dict[str, FloatOrArray]:
        """Return the derivatives of the force by the quantities that vary, by their names.

        Raises
        ------
        InputError
            As of a call.
        DomainError
            If a value is outside its range.
        """
        checked, _ = self._checked(self._arguments(values, named), RAISE)
        broadcast_shape(self.varying, tuple(checked))
        fixed, names = self.plan.fixed, self.varying

        def kernel(*blocks: Any) -> Any:
            slopes = self.plan.gradient(**fixed, **dict(zip(names, blocks, strict=True)))
            wanted = tuple(slopes[name] for name in names)
            return wanted if len(names) > 1 else wanted[0]

        found = apply(kernel, checked, (float,) * len(names), AT_ONCE)
        return dict(zip(names, found if len(names) > 1 else (found,), strict=True))

    def derivative(self, *values: ArrayLike, **named: ArrayLike) -> FloatOrArray:
        """Return the derivative of the force by the one quantity that varies.

        Raises
        ------
        InputError
            If several vary; take `gradient`.
        """
        self._require_one("derivative")
        return self.gradient(*values, **named)[self.varying[0]]

    @cached_property
    def monotonic(self) -> str:
        """Whether the force is proven "rising" or "falling" all over the range, or "unknown"."""
        return is_monotonic(self.plan) if len(self.varying) == 1 else "unknown"

    def inverse(self, force: ArrayLike) -> FloatOrArray:
        """Return the value of the one quantity that varies at which the force is as given [N/m].

        Raises
        ------
        InputError
            If several quantities vary, or the force is not proven to be monotonic.
        DomainError
            If no value in the range has this force.
        """
        self._require_one("inverse")
        return inverse(self.plan, self.monotonic, force)

    def radius_for(self, force: ArrayLike) -> FloatOrArray:
        """Return the wire radius R_w [m] at which the force is as given [N/m]; see `inverse`."""
        if self.varying != ("wire_radius",):
            raise InputError(
                f"radius_for must have a force of the wire's radius, but {', '.join(self.varying)} "
                "vary; prepare it with varying=('wire_radius',)."
            )
        return self.inverse(force)

    def source(self, language: str) -> str:
        """Return the force as a program of its own in "c", "javascript", "matlab" or "python".

        Raises
        ------
        InputError
            If there is no such language.
        """
        from surrogate.prepared.source import source_of

        return source_of(self, language)

    def _require_one(self, what: str) -> None:
        if len(self.varying) != 1:
            raise InputError(
                f"{what} must have one quantity that varies, but {', '.join(self.varying)} do; "
                "prepare the force again with the others fixed."
            )

    def __str__(self) -> str:
        ends = ", ".join(
            f"{name} from {number(low)} to {number(high)}"
            for name, (low, high) in self.ranges.items()
        )
        models = ", ".join(f"{term} by {model}" for term, model in self.terms.items())
        law = "" if self.law == PROJECTED else f", law of {self.law}"
        error = f"error {_percent(self.relative_error)}"
        if self.law == PROJECTED and self.terms:
            law = ", projected law"
            error += f", of the models alone {_percent(self.fit_error)}"
        return f"F_ss/T over {ends}; {models or 'cleavage alone'}{law}; {error}"


def _percent(error: float) -> str:
    return f"up to {100.0 * error:.2g} %" if error == error else "unknown"


def _is_known(outside: object) -> bool:
    return isinstance(outside, str) and outside in OUTSIDE


def _is_single(values: list[Any]) -> bool:
    kinds = [v.dtype for v in values if isinstance(v, np.ndarray)]
    return bool(kinds) and all(kind == np.float32 for kind in kinds)


def _is_inside(value: Any, low: float, high: float) -> bool:
    """Return whether a value is an array of floating-point numbers between the ends."""
    return (
        type(value) is np.ndarray
        and value.dtype in (np.float64, np.float32)
        and bool(value.ndim and value.size)
        and low <= float(value.min())
        and float(value.max()) <= high
    )


def _filled(function: Callable[..., Any], value: Any, out: Any) -> Any:
    """Return a function of an array with its own dtype, or put it into `out`."""
    if out is None:
        return function(value, np.empty(value.shape, value.dtype))
    _require_room(out, value.shape)
    if out.flags.c_contiguous and (out is value or not np.may_share_memory(out, value)):
        return function(value, out)
    return _put(function(value), out)


def _put(result: Any, out: Any) -> NDArray[Any]:
    _require_room(out, np.shape(result))
    with np.errstate(over="ignore", under="ignore"):
        np.copyto(out, result, casting="same_kind")
    return out  # type: ignore[no-any-return]


def _require_room(out: Any, shape: tuple[int, ...]) -> None:
    if not isinstance(out, np.ndarray) or out.dtype not in (np.float64, np.float32):
        raise InputError("out must be an array of float64 or float32; give one, or none.")
    if not out.flags.writeable:
        raise InputError("out must be an array to write to, but is read-only; give another.")
    if out.shape != shape:
        raise InputError(
            f"out must have the shape of the result, {shape}, but has {out.shape}; "
            "give such an array, or none."
        )
