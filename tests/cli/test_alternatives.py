"""The same forces under other assumptions: rows, verdicts, and silence where there is nothing."""

import numpy as np
import pytest

from surrogate import Material, Scene, cutting_force, identify
from surrogate.cli.alternatives import alternatives_record, alternatives_text

RADII = np.array([0.1e-3, 0.2e-3, 0.3e-3, 0.4e-3, 0.5e-3])
GEL = Material(shear_modulus=3e4, pure_shear_toughness=5.0, work_of_fracture=7e3)
NOISE = np.array([0.2, -0.3, 0.1, 0.2, -0.2])


def fit(tau=7e3, **options):
    """Return what noisy forces of Gamma_o = 2 J/m2, short of the touch, say."""
    force = cutting_force(Scene(3e4, 2.0, RADII, wear_strength=tau), "table").total
    return identify(RADII, force + NOISE, 3e4, force_std=0.3, **options)


def test_the_rows_are_identifications_of_the_same_forces():
    free = fit()
    paper, slip, bounded, fixed = alternatives_record(free, GEL)["alternatives"]
    for row, options in (
        (paper, {"model": "eq13"}),
        (slip, {"law": "slip"}),
        (bounded, {"toughness_max": 5.0}),
        (fixed, {"wear_strength": 7e3}),
    ):
        other = fit(**options)
        assert row["model"] == str(other.model)
        assert row["law"] == other.law
        assert (row["toughness"], row["wear_strength"]) == (other.toughness, other.wear_strength)
        squares = ((other.residuals / 0.3) ** 2).sum()
        followed = squares if other.profile is None else other.profile.modes[0].misfit
        assert row["misfit"] == pytest.approx(followed)
        assert followed <= squares * (1.0 + 1e-9)  # shared errors only take from it
    assert paper["admitted"] is None
    assert slip["admitted"] is None
    assert fixed["misfit"] >= free.profile.modes[0].misfit
    assert fixed["admitted"] == (fixed["misfit"] <= free.profile.threshold)


def test_verdicts_agree_with_the_intervals():
    free = fit()
    low, high = free.toughness_interval
    for gamma, words in (
        (0.5 * low, "Gamma_o is above"),
        (free.toughness, "not decided"),
        (2.0 * high, "Gamma_o is below"),
    ):
        words_found = alternatives_record(free, Material(pure_shear_toughness=gamma))["verdicts"]
        assert len(words_found) == 1
        assert words in words_found[0]
    low, high = free.wear_strength_interval
    for work, words in ((0.5 * low, "is not among"), (free.wear_strength, "is among")):
        (verdict,) = alternatives_record(free, Material(work_of_fracture=work))["verdicts"]
        assert words in verdict
    excluded = alternatives_record(free, Material(work_of_fracture=2.0 * high))
    assert excluded["alternatives"][-1]["admitted"] is False
    assert f"{low / (2.0 * high):.3g} to 0.5 times W_f" in excluded["verdicts"][0]


def test_without_scatter_nothing_is_excluded_or_said():
    force = cutting_force(Scene(3e4, 2.0, RADII[:2], wear_strength=7e3), "table").total
    record = alternatives_record(identify(RADII[:2], force, 3e4), GEL)
    assert [row["admitted"] for row in record["alternatives"]] == [None] * 4
    assert record["verdicts"] == []
    assert "unknown" in alternatives_text(record | {"misfit": "sum of squares"})


@pytest.mark.parametrize(
    "options", [{"model": "eq13"}, {"toughness_max": 9.0}, {"toughness_prior": (2.0, 1.0)}]
)
def test_where_there_is_nothing_to_compare_with_it_is_silent(options):
    assert alternatives_record(fit(**options), GEL) == {}
    assert alternatives_text({}) == ""


def test_a_material_of_which_nothing_is_known_is_compared_with_the_paper_and_other_laws_alone():
    record = alternatives_record(fit(), Material())
    assert [row["assumption"] for row in record["alternatives"]] == ["Eq. (13)", "law slip"]
    assert record["verdicts"] == []
