"""What is told of the paper's forces under each law."""

import numpy as np
import pytest

from fe_training.paper.laws import Verdict, laws_sentences, laws_table, verdicts
from surrogate import DomainError, Material, Scene, cutting_force, identify
from surrogate.inference.profile import Mode

RADII = np.geomspace(0.1e-3, 0.6e-3, 5)
FORCE = cutting_force(Scene(5e3, 1.0, RADII, 0.0, 1e3, 4.0), "table", law="projected").total


def identified(law):
    if law == "coupled":
        raise DomainError("coupled solutions do not reach; choose another.")
    law = "projected" if law == "auto" else law
    return identify(RADII, FORCE, 5e3, stiffening_exponent=4.0, relative_error=0.02, law=law)


def modes(fit):
    return [one for one in fit.profile.modes if one.admitted]


@pytest.mark.parametrize(
    ("gel", "work", "below"),
    [
        (Material(work_of_fracture=1e3, pure_shear_toughness=9.0), "admitted", "yes"),
        (Material(work_of_fracture=9e3, pure_shear_toughness=0.1), "excluded", "no"),
        (Material(work_of_fracture=1e3, pure_shear_toughness=1.0), "admitted", "open"),
        (Material(), "unknown", "unknown"),
    ],
)
def test_claims_are_looked_up_in_the_intervals(gel, work, below):
    projected, slip, coupled, auto = verdicts(identified, modes, gel)
    assert (projected.is_work, projected.is_below) == (work, below)
    assert projected.relative_wear == pytest.approx([0.2], rel=1e-3)
    assert slip.used == "slip"
    assert (coupled.used, coupled.reason) == ("", "coupled solutions do not reach")
    assert (auto.law, auto.used) == ("auto", "projected")
    assert auto.modes == projected.modes


def test_table_and_sentences_name_every_law():
    told = verdicts(identified, modes, Material(work_of_fracture=1e3, pure_shear_toughness=9.0))
    table, sentences = laws_table(told), laws_sentences(told)
    assert "| auto: projected | 1 | 1 | 0.2 | admitted | yes |" in table
    assert table.endswith(f"`auto` takes projected: {told[-1].reason}.")
    assert max(map(len, sentences.splitlines())) <= 100
    assert sentences.count(". ") + 1 == 2
    assert "there is no answer, as coupled solutions do not reach" in " ".join(sentences.split())


def test_what_differs_from_law_to_law_is_told_of_each():
    mode = Mode(1.0, 1e3, 0.0, True, False)
    told = [
        Verdict("projected", "projected", "", (mode,), (1.0,), "admitted", "yes"),
        Verdict("slip", "slip", "", (mode,), (1.0,), "excluded", "yes"),
        Verdict("auto", "slip", "it is so", (mode,), (1.0,), "excluded", "yes"),
    ]
    words = " ".join(laws_sentences(told).split())
    assert "tau_w = W_f is admitted under projected, excluded under slip" in words
    assert "Gamma_o < Gamma is affirmed under projected and slip" in words
    assert "effective" not in words
