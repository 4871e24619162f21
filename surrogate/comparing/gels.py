"""Several gels beside each other: which of them differ, in toughness or in wear strength."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from surrogate.basics.checks import mapping, one_number, shown
from surrogate.basics.digits import rounded
from surrogate.basics.records import ReadOnly, html_table
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import PROJECTED
from surrogate.comparing.difference import Difference, alike, difference_of
from surrogate.comparing.evidence import QUANTITIES, evidence_of
from surrogate.errors import InputError
from surrogate.identification.fit import CONFIDENCE, Identification

__all__ = ["Comparison", "GelPair", "compare_gels", "p_in_words"]

SHOWN = {"toughness": ("Gamma_o", 1.0, "J/m2"), "wear_strength": ("tau_w", 1e-3, "kPa")}
"""Symbol, factor and unit in which people read a quantity."""

SMALLEST_SHOWN = 1e-4
"""Probability below which no digit is worth printing."""


@dataclass(frozen=True)
class GelPair:
    """Two gels beside each other; see `compare_gels`.

    Parameters
    ----------
    first, second : str
        Their names.
    toughness, wear_strength : Difference or None
        How they differ, the first less the second; None where that is not to be said: the pair has
        `objections`, or tau_w was given.
    p : float
        Probability of differences at least as clear, of both together, between equal gels [-]; that
        of the toughness where tau_w was given, nan where there are `objections`.
    p_adjusted : float
        The same for the clearest of all pairs that were compared, after Holm [-].
    objections : tuple of str
        Why the pair is not compared, in words; empty where it is.
    """

    first: str
    second: str
    toughness: Difference | None
    wear_strength: Difference | None
    p: float
    p_adjusted: float
    objections: tuple[str, ...] = ()

    def differs(self, significance: float, quantity: str | None = None) -> bool:
        """Return whether the gels differ, in one quantity if it is named, by closed testing.

        Only gels that differ at all differ in a quantity, so that a false claim about any of
        toughness, wear strength and both is no more frequent than the significance.

        Parameters
        ----------
        significance : float
            Probability of a false claim, all pairs together [-].
        quantity : str, optional
            "toughness" or "wear_strength".
        """
        if not self.p_adjusted < significance:
            return False
        one = None if quantity is None else getattr(self, quantity)
        return quantity is None or (one is not None and one.p_adjusted < significance)

    def words(self, confidence: float) -> str:
        """Return what is said of the pair in one sentence."""
        name = f"{self.first} and {self.second}"
        if self.objections:
            return f"{name} are not compared: {self.objections[0]}"
        parts = [
            _words(one, self.differs(1.0 - confidence, one.quantity))
            for one in (self.toughness, self.wear_strength)
            if one is not None
        ]
        verdict = "are not told apart"
        if self.differs(1.0 - confidence):
            verdict = "differ"
            if not any(self.differs(1.0 - confidence, quantity) for quantity in QUANTITIES):
                verdict = "differ, though in which quantity is open"
        return f"{name} {verdict} ({p_in_words(self.p_adjusted)}): {'; '.join(parts)}"


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several gels and every pair of them; see `compare_gels`.

    Parameters
    ----------
    gels : mapping of str to Identification
        What `identify` returned of each, by its name.
    pairs : tuple of GelPair
        Each with each, in their order.
    confidence : float
        Probability of the intervals; one less it is the significance of the verdicts [-].

    Examples
    --------
    >>> from surrogate import identify
    >>> radii, errors = [1e-4, 2e-4, 4e-4, 5e-4], [0.2, 0.2, 0.3, 0.3]
    >>> gels = {
    ...     name: identify(radii, forces, model="eq13", force_std=errors)
    ...     for name, forces in (("A", [4.7, 7.9, 13.9, 17.2]), ("B", [4.8, 7.7, 14.1, 17.1]))
    ... }
    >>> compared = compare_gels(gels)
    >>> compared.is_usable, compared.pairs[0].differs(0.05)
    (True, False)
    """

    gels: Mapping[str, Identification]
    pairs: tuple[GelPair, ...]
    confidence: float

    @property
    def is_usable(self) -> bool:
        """Whether every pair could be compared."""
        return not any(pair.objections for pair in self.pairs)

    @property
    def rests_on(self) -> tuple[str, ...]:
        """What the comparison takes for granted, in words."""
        return tuple(_rests_on(self))

    def summary(self) -> str:
        """Return a sentence a pair, and what they rest on."""
        pairs = [f"{pair.words(self.confidence)}." for pair in self.pairs]
        return "\n".join([*pairs, *(f"{sentence}." for sentence in self.rests_on)])

    def __str__(self) -> str:
        """The same: what `print` shows."""
        return self.summary()

    def _repr_html_(self) -> str:
        """What notebooks show."""
        rows = [(f"{p.first}, {p.second}", p.words(self.confidence), "") for p in self.pairs]
        return html_table("Comparison", [*rows, *(("", one, "") for one in self.rests_on)])


def compare_gels(
    identifications: Mapping[str, Identification], confidence: float = 0.95
) -> Comparison:
    """Tell which gels differ in toughness or wear strength, each with each.

    Parameters
    ----------
    identifications : mapping of str to Identification
        What `identify` returned of each gel, by its name: two or more, under one model and law.
    confidence : float, default 0.95
        Probability of the intervals of the differences; gels differ where a probability is below
        one less it, Holm's correction for the number of pairs included [-].

    Returns
    -------
    Comparison
        Differences with intervals and probabilities, in words as well.

    Raises
    ------
    InputError
        If there are fewer than two, one is no identification, or their models or laws differ.

    Notes
    -----
    Likelihood ratios of the misfits that each identification followed: how much worse the best
    common toughness, or wear strength, meets all forces than one for each gel. Each gel has a
    scatter of its own; where it was estimated, the ratio is that of Welch's t with Satterthwaite's
    degrees of freedom. The probabilities hold as far as the scatter of forces is normal and
    independent from cut to cut.

    The error of the model, which is one for all gels, cancels from a difference as far as they are
    cut at the same g = Gamma_o/(mu R_w); what is left is part of it. What was stated as uncertain
    of mu, xi and alpha is taken as independent from gel to gel: if in truth it is shared, as that
    of a friction that nobody measured, equal gels are told apart less often than stated. If the
    gels in truth have different frictions, they differ in what is called toughness or wear here.

    Range of validity: that of the identifications.

    References
    ----------
    B. L. Welch, Biometrika 34 (1947) 28; F. E. Satterthwaite, Biometrics Bull. 2 (1946) 110;
    S. Holm, Scand. J. Statist. 6 (1979) 65; S. A. Murphy and A. W. van der Vaart, J. Am. Stat.
    Assoc. 95 (2000) 449.

    Examples
    --------
    >>> from surrogate import identify
    >>> radii = [1e-4, 2e-4, 4e-4, 5e-4]
    >>> soft = identify(radii, [4.7, 7.9, 13.9, 17.2], 685.0, model="eq13")
    >>> tough = identify(radii, [6.2, 9.3, 15.4, 18.8], 685.0, model="eq13")
    >>> print(compare_gels({"soft": soft, "tough": tough}).pairs[0].words(0.95))
    soft and tough differ (p = 0.00025): Gamma_o by -1.41 (-1.96 to -0.86 J/m2, p = 0.0021); tau_w \
not told apart, -0.08 (-0.48 to 0.33 kPa, p = 0.63)
    """
    gels = _checked(identifications)
    confidence = one_number(CONFIDENCE, confidence)
    evidence = {name: evidence_of(fit) for name, fit in gels.items() if not _against(name, fit)}
    pairs = []
    for first, second in combinations(gels, 2):
        against = (*_against(first, gels[first]), *_against(second, gels[second]))
        if against:
            pairs.append(GelPair(first, second, None, None, math.nan, math.nan, against))
            continue
        both = evidence[first], evidence[second]
        toughness, wear = (difference_of(*both, name, confidence) for name in QUANTITIES)
        p = alike(*both) if wear else toughness.p  # type: ignore[union-attr]
        pairs.append(GelPair(first, second, toughness, wear, p, p))
    return Comparison(ReadOnly(gels), tuple(_adjusted(pairs)), confidence)


def _checked(identifications: object) -> dict[str, Identification]:
    example = "{'gel A': fit_a, 'gel B': fit_b}"
    gels = dict(mapping("identifications", identifications, example))
    if len(gels) < 2:
        raise InputError(f"gels must be two or more, but are {len(gels)}; give {example}.")
    for name, fit in gels.items():
        if not isinstance(name, str) or not isinstance(fit, Identification):
            raise InputError(
                f"gels must be names with what identify returned, but one is {shown(name)} with "
                f"{shown(fit)}; give for instance {example}."
            )
    (first, one), *others = gels.items()
    for name, fit in others:
        for what, theirs in (
            ("model", [force_model(each.model).name for each in (one, fit)]),
            ("law", [each.law for each in (one, fit)]),
        ):
            if theirs[0] != theirs[1]:
                raise InputError(
                    f"gels must be identified under one {what}, but {first} is by {theirs[0]!r} "
                    f"and {name} by {theirs[1]!r}; identify all with "
                    f"{'law=' + repr(PROJECTED) if what == 'law' else 'the same'}."
                )
    return gels


def _against(name: str, fit: Identification) -> tuple[str, ...]:
    """Return why a gel is compared with no other."""
    against = [f"{name} should not be used ({sentence})" for sentence in fit.objections]
    if not against and not fit.has_scatter:
        against = [f"nothing tells the scatter of {name}: cut more often, or state the errors"]
    return tuple(against)


def _adjusted(pairs: list[GelPair]) -> list[GelPair]:
    """Return pairs with probabilities that take the number of pairs into account."""
    usable = [i for i, pair in enumerate(pairs) if not pair.objections]
    for i, p in zip(usable, _holm([pairs[i].p for i in usable]), strict=True):
        pairs[i] = replace(pairs[i], p_adjusted=p)
    for name in QUANTITIES:
        tested = [i for i in usable if getattr(pairs[i], name)]
        ps = _holm([getattr(pairs[i], name).p for i in tested])
        for i, p in zip(tested, ps, strict=True):
            of_pair = replace(getattr(pairs[i], name), p_adjusted=p)
            pairs[i] = replace(pairs[i], **{name: of_pair})
    return pairs


def _holm(ps: Sequence[float]) -> list[float]:
    """Return Holm's probabilities: the clearest times the number of tests, and so on.

    Examples
    --------
    >>> _holm([0.5, 0.25, 0.0625])
    [0.5, 0.5, 0.1875]
    """
    adjusted, largest = [0.0] * len(ps), 0.0
    for rank, i in enumerate(sorted(range(len(ps)), key=ps.__getitem__)):
        largest = max(largest, min(1.0, (len(ps) - rank) * ps[i]))
        adjusted[i] = largest
    return adjusted


def p_in_words(p: float) -> str:
    """Return a probability with two digits, or its bound.

    Examples
    --------
    >>> p_in_words(0.01234), p_in_words(1e-9)
    ('p = 0.012', 'p < 0.0001')
    """
    return f"p < {SMALLEST_SHOWN:.4f}" if p < SMALLEST_SHOWN else f"p = {p:.2g}"


def _words(one: Difference, differs: bool) -> str:
    symbol, factor, unit = SHOWN[one.quantity]
    low, high = (factor * end for end in one.interval)
    value = factor * one.value
    error = 0.5 * (high - low)
    if not math.isfinite(error):
        error = min(abs(value - low), abs(high - value))
    ends = f"{_end(low, error)} to {_end(high, error)} {unit}"
    verdict = "by" if differs else "not told apart,"
    return f"{symbol} {verdict} {rounded(value, error)} ({ends}, {p_in_words(one.p_adjusted)})"


def _end(value: float, error: float) -> str:
    if math.isinf(value):
        return "any" if value > 0.0 else "-any"
    return rounded(value, error)


def _rests_on(made: Comparison) -> Iterator[str]:
    compared = [pair for pair in made.pairs if not pair.objections]
    if not compared:
        return
    holm = f", after Holm's correction for {len(compared)} pairs" if len(compared) > 1 else ""
    yield (
        f"Differences are the first less the second, with {100.0 * made.confidence:.4g} % "
        f"intervals; p is the probability of one as clear between equal gels{holm}"
    )
    yield (
        "What all cuts of one gel share is no part of p: an error of its thickness or modulus that "
        "nobody stated, or one piece of gel for all of its cuts"
    )
    fits = made.gels.values()
    if any("friction_coefficient" in fit.assumed for fit in fits):
        yield (
            "A friction that nobody gave is taken as 0 for each gel: gels of different friction "
            "differ in what is called toughness and wear here"
        )
