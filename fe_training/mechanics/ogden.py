r"""One-term incompressible Ogden solid in plane strain: energy, stress and tangent in closed form.

Everything is dimensionless (mu = 1).  Principal stretches enter through their half sum and half
difference.  With the displacement gradient ``H = F - I``, the two vectors

    (a, b) = (F11 + F22, F21 - F12),    length s = l1 + l2,
    (c, e) = (F11 - F22, F21 + F12),    length d = l1 - l2,

split F into a scaled rotation and a scaled reflection, so an isotropic energy is a function of the
lengths s and d alone: gradient and Hessian follow by the chain rule, without eigenvectors, and stay
smooth where the stretches coalesce (d = 0) or where an element is inverted (d > s, l2 < 0).

The energy carries the term ``-(2/alpha) (det F - 1)``, which vanishes for the incompressible solid
and makes the undeformed state stress-free at zero pressure:

    W = (2/alpha^2) (l1^alpha + l2^alpha - 2) - (2/alpha) (det F - 1) + (kappa/2) (det F - 1)^2.

Array arguments have any trailing shape; the first two axes of a gradient are its components.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Below this strain the energy is summed as a series, above it from powers.
_SERIES_STRAIN = 0.03
_SERIES_TERMS = 12

#: The second derivative of a power below 2 is unbounded at zero stretch; it is cut off here.
_TINY_STRETCH = 1e-12

#: Below this relative difference two stretches are equal to rounding.
_EQUAL = 1e-18


def volume_change(H: Array) -> Array:
    """Return det(I + H) - 1 without losing digits where H is small."""
    change: Array = H[0, 0] + H[1, 1] + H[0, 0] * H[1, 1] - H[0, 1] * H[1, 0]
    return change


def _strains(H: Array) -> tuple[Array, ...]:
    """Return the unit vectors of (a, b) and (c, e), s, d and the principal strains l - 1."""
    tr = H[0, 0] + H[1, 1]
    b = H[1, 0] - H[0, 1]
    c = H[0, 0] - H[1, 1]
    e = H[1, 0] + H[0, 1]
    s = np.hypot(2.0 + tr, b)
    d = np.hypot(c, e)
    s_minus_2 = (4.0 * tr + tr * tr + b * b) / (s + 2.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        sa, sb = np.where(s > 0, (2.0 + tr) / s, 1.0), np.where(s > 0, b / s, 0.0)
        dc, de = np.where(d > 0, c / d, 1.0), np.where(d > 0, e / d, 0.0)
    return sa, sb, dc, de, s, d, 0.5 * (s_minus_2 + d), 0.5 * (s_minus_2 - d)


def _power_remainder(e: Array, alpha: float) -> Array:
    """Return |1 + e|^alpha - 1 - alpha e, exact to rounding for small e."""
    series = np.zeros_like(e)
    for k in range(_SERIES_TERMS, 2, -1):
        series = (alpha - k + 1.0) / k * e * (1.0 + series)
    small = np.abs(e) < _SERIES_STRAIN
    stretch = np.maximum(np.abs(1.0 + e), 1e-300)
    direct = np.expm1(alpha * np.log(stretch)) - alpha * e
    return np.where(small, 0.5 * alpha * (alpha - 1.0) * e * e * (1.0 + series), direct)


def _power_strain(e: Array, m: float) -> Array:
    """Return sign(1 + e) |1 + e|^m - 1."""
    safe = np.maximum(e, -1.0 + _TINY_STRETCH)
    positive = np.expm1(m * np.log1p(safe))
    flipped = -(np.maximum(-1.0 - e, 0.0) ** m) - 1.0
    return np.where(e > -1.0, positive, flipped)


def energy(H: Array, alpha: float, kappa: float | Array = 0.0) -> Array:
    """Return the strain energy density W(H)/mu.

    Parameters
    ----------
    H : ndarray, shape (2, 2, ...)
        Displacement gradient [-].
    alpha : float
        Strain-stiffening exponent [-]; 2 is neo-Hookean.
    kappa : float or ndarray, shape (...)
        Bulk term [mu].

    Returns
    -------
    ndarray, shape (...)
        W/mu [-], zero in the undeformed state.

    Examples
    --------
    >>> import numpy as np
    >>> H = np.array([[1.0, 0.0], [0.0, -0.5]])  # stretch 2, incompressible
    >>> float(energy(H, alpha=2.0))  # (l - 1/l)^2 / 2
    1.125
    """
    e1, e2 = _strains(H)[-2:]
    iso = _power_remainder(e1, alpha) + _power_remainder(e2, alpha) - alpha * e1 * e2
    W: Array = 2.0 / alpha**2 * iso + 0.5 * kappa * volume_change(H) ** 2
    return W


def _coefficients(H: Array, alpha: float) -> tuple[Array, ...]:
    """Return the derivatives of the isotropic part with respect to s and d."""
    sa, sb, dc, de, s, d, e1, e2 = _strains(H)
    m = alpha - 1.0
    f1, f2 = _power_strain(e1, m), _power_strain(e2, m)
    # first derivatives less those of (2/alpha) det F, so that they vanish with the strain
    ws = (f1 - e1 + f2 - e2) / alpha
    l1 = np.maximum(np.abs(1.0 + e1), _TINY_STRETCH)
    l2 = np.maximum(np.abs(1.0 + e2), _TINY_STRETCH)
    h1, h2 = m / alpha * 2.0 * l1 ** (m - 1.0), m / alpha * 2.0 * l2 ** (m - 1.0)
    ratio = 2.0 / alpha * divided_difference(e1, e2, d, m)  # (f'(l1) - f'(l2)) / (l1 - l2)
    # (f'(l1) + f'(l2)) / (l1 + l2); where l2 < 0 it is the divided difference of l1 and -l2
    inverted = divided_difference(e1, np.maximum(-2.0 - e2, -1.0), s, m) / alpha
    upright = ws / np.maximum(s, _TINY_STRETCH) + 1.0 / alpha
    return sa, sb, dc, de, s, d, ws, np.where(e2 < -1.0, inverted, upright), ratio, h1, h2


def divided_difference(e1: Array, e2: Array, d: Array, m: float) -> Array:
    """Return (l1^m - l2^m)/(l1 - l2) for l = 1 + e and d = l1 - l2 >= 0, smooth at d = 0."""
    regular = 1.0 + e2 > 0.1 * (1.0 + e1)
    l2 = np.where(regular, 1.0 + e2, 1.0)
    t = np.log1p(np.where(regular, d, 0.0) / l2)
    equal = t < _EQUAL
    safe = np.where(equal, 1.0, t)
    quotient = np.where(equal, m, np.expm1(m * safe) / np.expm1(safe))
    far = (_power_strain(e1, m) - _power_strain(e2, m)) / np.where(regular, 1.0, d)
    return np.where(regular, l2 ** (m - 1.0) * quotient, far)


def stress(H: Array, pressure: Array, alpha: float, kappa: float | Array = 0.0) -> Array:
    """Return the first Piola stress dW/dF + p cof F, divided by mu.

    Parameters
    ----------
    H : ndarray, shape (2, 2, ...)
        Displacement gradient [-].
    pressure : ndarray, shape (...)
        Multiplier of det F - 1 [mu], tension positive.
    alpha, kappa : float
        As in :func:`energy`.

    Returns
    -------
    ndarray, shape (2, 2, ...)
        P/mu [-].

    Examples
    --------
    >>> import numpy as np
    >>> H = np.array([[1.0, 0.0], [0.0, -0.5]])
    >>> stress(H, np.array(0.0), alpha=2.0).diagonal().round(3)  # l - 1/l and its partner
    array([ 1.5, -1.5])
    """
    sa, sb, dc, de, s, d, ws, _, ratio, _, _ = _coefficients(H, alpha)
    q = pressure + kappa * volume_change(H)
    cs = ws + 0.5 * q * s
    cd = 0.5 * ratio * d + (1.0 / alpha - 0.5 * q) * d
    return _from_modes(cs * sa, cs * sb, cd * dc, cd * de)


def _from_modes(a: Array, b: Array, c: Array, e: Array) -> Array:
    """Return the gradient with respect to F of a function of (a, b, c, e)."""
    return np.array([[a + c, e - b], [b + e, a - c]])


def tangent(H: Array, pressure: Array, alpha: float, kappa: float | Array = 0.0) -> Array:
    """Return dP/dF at fixed pressure, divided by mu.

    Parameters
    ----------
    H, pressure, alpha, kappa
        As in :func:`stress`.

    Returns
    -------
    ndarray, shape (2, 2, 2, 2, ...)
        The tangent ``A[i, J, k, L] = dP[i, J]/dF[k, L]`` [-].

    Examples
    --------
    The undeformed solid has shear modulus 1 and, being incompressible, plane-strain modulus 4:

    >>> import numpy as np
    >>> A = tangent(np.zeros((2, 2)), np.array(0.0), alpha=9.0)
    >>> float(A[0, 1, 0, 1]), round(float(A[0, 0, 0, 0] - A[0, 0, 1, 1]), 12)
    (1.0, 2.0)
    """
    sa, sb, dc, de, s, d, _, s_over, ratio, h1, h2 = _coefficients(H, alpha)
    q = pressure + kappa * volume_change(H)
    det_part = q - 2.0 / alpha
    # second derivatives in (s, d); the factor of det F = (s^2 - d^2)/4 enters as det_part
    ss = 0.25 * (h1 + h2)
    sd = 0.25 * (h1 - h2)
    d_over = 0.5 * ratio
    one_s, one_d = s_over + 0.5 * det_part, d_over - 0.5 * det_part
    two_s, two_d = ss + 0.5 * det_part, ss - 0.5 * det_part
    u = np.array([sa, sb])
    v = np.array([dc, de])
    eye = np.eye(2).reshape((2, 2) + (1,) * s.ndim)
    uu, vv, uv = u[:, None] * u[None], v[:, None] * v[None], u[:, None] * v[None]
    M = np.empty((4, 4, *s.shape))
    M[:2, :2] = (two_s - one_s) * uu + one_s * eye
    M[2:, 2:] = (two_d - one_d) * vv + one_d * eye
    M[:2, 2:] = sd * uv
    M[2:, :2] = np.swapaxes(sd * uv, 0, 1)
    g = 0.5 * np.array([s * sa, s * sb, -d * dc, -d * de])  # gradient of det F in the modes
    M += kappa * g[:, None] * g[None]
    return _tensor_from_modes(M)


#: Rows: how F11, F12, F21, F22 enter the modes (a, b, c, e).
_MODES = np.array([[1, 0, 1, 0], [0, -1, 0, 1], [0, 1, 0, 1], [1, 0, -1, 0]], dtype=float)


def _tensor_from_modes(M: Array) -> Array:
    A: Array = np.einsum("ia,jb,ab...->ij...", _MODES, _MODES, M)
    return A.reshape((2, 2, 2, 2, *M.shape[2:]))


def cofactor(H: Array) -> Array:
    """Return the cofactor matrix of I + H, the gradient of its determinant."""
    return np.array([[1.0 + H[1, 1], -H[1, 0]], [-H[0, 1], 1.0 + H[0, 0]]])
