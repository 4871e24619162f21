"""kappa fitted to made-up rows, its file and its card, by the command."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_coupled import log_kappa, rows_of_base

from fe_training.coupled.__main__ import main
from fe_training.coupled.card import CARD, most_wear
from fe_training.coupled.dataset import write_coupled
from fe_training.coupled.fit import fit_amplification
from fe_training.coupled.loads import LOAD_UNIT
from fe_training.coupled.rows import rows_of
from surrogate import DomainError, InputError
from surrogate.choosing.laws import require_known_load
from surrogate.contact.archive import read_fitted
from surrogate.coupling.amplification import load_of
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification_of

RNG = np.random.default_rng(21)


@pytest.fixture(scope="module")
def kappa(fitted_folder):
    return amplification_of(*read_fitted(str(fitted_folder.path / AMPLIFICATION_FILE)))


def unseen(kappa, count=400):
    """Return places within the axes, and loads that are known there."""
    x, y = (RNG.uniform(axis[0], axis[-1], count) for axis in kappa.axes[:2])
    direction, part = RNG.uniform(0.0, 1.0, count), RNG.uniform(0.05, 0.999, count)
    reach = part * kappa.reach_at(x, y, direction)
    xi = reach * LOAD_UNIT[0] * np.minimum(1.0, 2.0 * (1.0 - direction))
    wear = reach * LOAD_UNIT[1] * np.minimum(1.0, 2.0 * direction)
    g = np.exp(x + np.polynomial.polynomial.polyval(y, kappa.touch))
    known = (g >= kappa.lowest) & (g <= kappa.highest)
    assert known.sum() > 0.5 * count
    at = g, np.exp(y), xi, wear
    return (x[known], y[known]), tuple(each[known] for each in at)


def test_errors_at_rows_that_no_fit_saw_are_within_its_bounds(densely_fitted):
    kappa = amplification_of(*read_fitted(str(densely_fitted.path / AMPLIFICATION_FILE)))
    (x, y), at = unseen(kappa)
    bound = kappa.error(*at)
    error = np.abs(kappa.log_factor(*at) - log_kappa(x, y, at[2], np.log1p(at[3])))
    assert np.isfinite(bound).all()
    assert (error <= bound).all()
    assert error.max() > 0.0


def test_the_growth_bounds_what_the_load_does(kappa):
    at = unseen(kappa)[1]
    assert (np.abs(kappa.log_factor(*at)) <= kappa.most(*at)).all()


def test_the_reach_goes_no_further_than_the_rows(kappa, made_up, touch):
    rows = rows_of(made_up, touch)
    rows = rows.taken(~rows.held_out)
    size, _ = load_of(rows.inputs[:, 2], np.expm1(rows.inputs[:, 3]), LOAD_UNIT)
    assert 0.0 < kappa.reach.max() <= size.max() * (1.0 + 1e-9)
    x, y, _ = kappa.axes
    assert x[0] >= rows.inputs[:, 0].min()
    assert x[-1] <= min(rows.inputs[:, 0].max(), 0.0)
    assert y[[0, -1]] == pytest.approx([rows.inputs[:, 1].min(), rows.inputs[:, 1].max()])
    assert kappa.share(1e-12, 5.0, 1e-3, 0.0) == np.inf


def test_rows_that_do_not_tell_kappa_are_left_out(made_up, touch):
    assert len(rows_of(made_up, touch)) == len(made_up)
    for name, value in (
        ("touches_tip", True),  # the size of the tip decides there
        ("slip_power", 0.0),  # off balance
        ("slip_arc", np.nan),
        ("steady_force", np.nan),
    ):
        columns = {each: values.copy() for each, values in made_up.columns.items()}
        columns[name][3] = value
        assert len(rows_of(type(made_up)(columns, made_up.attributes), touch)) == len(made_up) - 1


def test_an_equilibrium_that_stands_for_several_loads_counts_once(made_up, touch):
    columns = {name: values.copy() for name, values in made_up.columns.items()}
    for name in columns:
        if name not in ("target_friction", "target_wear", "outcome"):
            columns[name][2] = columns[name][1]
    assert len(rows_of(type(made_up)(columns, made_up.attributes), touch)) == len(made_up) - 1


def test_held_out_rows_do_not_change_the_fit_of_the_others(made_up, touch):
    rows = rows_of(made_up, touch)
    assert rows.held_out.sum() == 27
    assert set(rows.base[rows.held_out].tolist()) == {4, 9, 14}


def test_too_few_rows_are_refused(made_up, touch):
    rows = rows_of(made_up, touch)
    few = rows.taken(rows.base < 6)  # base 4 is held out
    with pytest.raises(InputError, match="45 rows of 5; go on with the campaign"):
        fit_amplification(few, touch, {})


def test_the_command_refuses_a_short_data_set_in_one_line(touch, tmp_path, capsys):
    from made_up_coupled import data_of

    write_coupled(data_of(list(rows_of_base(0, (0.5, 0.5, 0.5), touch))), tmp_path / "coupled.h5")
    assert main(["models/coupled.toml", "--fit", str(tmp_path)]) == 2
    assert "go on with the campaign" in capsys.readouterr().err
    assert not (tmp_path / AMPLIFICATION_FILE).exists()


def test_the_file_is_small_and_carries_its_data(fitted_folder, kappa):
    assert (fitted_folder.path / AMPLIFICATION_FILE).stat().st_size < 150_000
    assert kappa.about["data"]["design"] == "made up"
    assert kappa.load_unit == LOAD_UNIT
    assert fitted_folder.printed == f"{fitted_folder.path / CARD}\n"


def test_the_card_says_what_was_used_and_how_far_it_is_off(fitted_folder, kappa):
    card = fitted_folder.text(CARD)
    assert "| CONVERGED | 135 |" in card
    assert "Used: 135 equilibria of 15 bases" in card
    assert "27 of them are of bases that no fit sees" in card
    for i in range(len(kappa.edges[0]) - 1):
        cells = " | ".join(f"{value:.3g}" for value in kappa.errors[i])
        assert f"| {cells} |" in card
    assert "not known" not in card


def test_a_second_fit_writes_the_same_bytes(fitted_folder, kappa):
    from surrogate.coupling.shipped import content_of_amplification

    content = (fitted_folder.path / AMPLIFICATION_FILE).read_bytes()
    assert content_of_amplification(kappa) == content


def test_the_largest_wear_is_told_of_alphas_at_which_all_paths_ended(made_up):
    alpha, wanted = made_up["alpha"], made_up["target_wear"]
    assert not most_wear(made_up)  # made-up paths reach all loads
    low = alpha <= 3.0
    ended = made_up.columns | {"wear": np.where(low, np.minimum(wanted, 0.4), wanted)}
    ((first, last, wear),) = most_wear(type(made_up)(ended, made_up.attributes))
    assert (first, last, wear) == (alpha.min(), 3.0, 0.4)


def test_a_load_that_no_solution_carried_is_refused_with_the_largest_that_one_did(kappa):
    told = replace(kappa, about={"most_wear": [[2.0, 3.0, 0.4]]})
    model = SimpleNamespace(
        law="coupled",
        amplification=told,
        require_known=lambda values: None,
        in_domain=lambda *values: False,
    )
    for alpha, wear, said in ((2.5, 9e3, True), (2.5, 3e3, False), (4.0, 9e3, False)):
        with pytest.raises(DomainError, match="load that coupled solutions reach") as raised:
            require_known_load(model, (1e4, 1.0, 1e-3, 0.0, wear, alpha))
        assert ("no wire slid steadily above tau_w/mu = 0.4" in str(raised.value)) is said
