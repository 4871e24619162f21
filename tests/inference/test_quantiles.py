"""The quantiles against exact ones, over all degrees of freedom that change the method."""

import mpmath
import pytest

from surrogate.inference.quantiles import normal_quantile, student_quantile

CONFIDENCES = [0.01, 0.5, 0.6827, 0.9, 0.95, 0.99, 0.9999, 0.999999]
DOFS = [1, 2, 3, 4, 5, 6, 7, 29, 30, 999, 1000, 1001, 10**6]


@pytest.mark.parametrize("confidence", CONFIDENCES)
def test_normal_quantile_is_scipys(confidence):
    norm = pytest.importorskip("scipy.stats").norm
    assert normal_quantile(confidence) == pytest.approx(norm.isf(0.5 * (1 - confidence)), rel=1e-12)


@pytest.mark.parametrize("dof", DOFS)
@pytest.mark.parametrize("confidence", CONFIDENCES)
def test_student_quantile_is_exact_to_nine_digits(confidence, dof):
    """Against 30 digits, because old releases of scipy have eight."""
    with mpmath.workdps(30):
        n, t = mpmath.mpf(dof), mpmath.mpf(student_quantile(confidence, dof))
        outside = mpmath.betainc(n / 2, 0.5, 0, n / (n + t**2), regularized=True)
        density = 2 / mpmath.beta(n / 2, 0.5) / mpmath.sqrt(n) * (1 + t**2 / n) ** (-(n + 1) / 2)
        error = (1 - outside - mpmath.mpf(confidence)) / density
        assert abs(error) <= 1e-9 * t


def test_student_quantile_falls_towards_the_normal_one():
    quantiles = [student_quantile(0.95, dof) for dof in DOFS]
    assert quantiles == sorted(quantiles, reverse=True)
    assert quantiles[-1] == pytest.approx(normal_quantile(0.95), rel=1e-5)
