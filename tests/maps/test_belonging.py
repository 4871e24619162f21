"""Points of another material than the map's are refused, not drawn."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure

from surrogate import InputError, MapPoints, Scene, plot_regime_map, regime_map
from surrogate.cli.main import main

RADII = np.array([1e-4, 4e-4])


def draw(points, **fixed):
    made = regime_map("R_w", "Gamma_o", ((1e-5, 1e-2), (0.05, 50.0)), fixed, nodes=11)
    return plot_regime_map(made, Figure().add_subplot(), [points])


def points(mu=685.0, tau=7750.0, xi=0.0, **std):
    return MapPoints(Scene(mu, 1.6, RADII, xi, tau), "gel", std)


@pytest.mark.parametrize(
    ("one", "words"),
    [
        (points(mu=10e3), r"its shear modulus is 1e\+04 Pa where the map fixes 685 Pa"),
        (points(tau=10e3), "its wear strength is 1e"),
        (points(tau=0.0), "its wear strength is 0 Pa"),
        (points(xi=0.3), "its friction coefficient is 0.3 where the map fixes 0"),
    ],
)
def test_another_material_is_refused(one, words):
    with pytest.raises(InputError, match=words):
        draw(one, mu=685.0, tau_w=7750.0, xi=0.0)


def test_one_of_several_points_is_enough():
    several = MapPoints(Scene([685.0, 900.0], 1.6, RADII, 0.0, 7750.0), "gels")
    with pytest.raises(InputError, match="is 900 Pa"):
        draw(several, mu=685.0, tau_w=7750.0)


def test_what_agrees_is_drawn():
    draw(points(), mu=685.0, tau_w=7750.0, xi=0.0)
    draw(points(mu=710.0), mu=685.0, tau_w=7750.0)  # 4 %
    draw(points(mu=750.0, shear_modulus=40.0), mu=685.0, tau_w=7750.0)  # within two errors
    with pytest.raises(InputError, match="is 750 Pa"):
        draw(points(mu=750.0, shear_modulus=30.0), mu=685.0, tau_w=7750.0)


def test_groups_are_compared_as_well():
    made = regime_map("R_w/l_e", "xi", ((1e-2, 1e2), (1e-2, 1e1)), {"tau_w/mu": 0.1}, nodes=11)
    with pytest.raises(InputError, match=r"is 11.31 where the map fixes 0\.1"):
        plot_regime_map(made, Figure().add_subplot(), [points(xi=0.1)])


@pytest.mark.parametrize(("fixed", "count"), [([], 0), (["--fix", "mu=10kPa"], 1)])
def test_the_presets_experiment_stays_off_a_map_of_another_gel(fixed, count, tmp_path, capsys):
    picture = tmp_path / "map.svg"
    assert main(["map", "--preset", "gel", "--nodes", "11", *fixed, "--out", str(picture)]) == 0
    printed = capsys.readouterr().out
    assert printed.count("the experiment is left out of the picture: PAAm") == count
    assert ("PAAm" in picture.read_text()) == (count == 0)
