"""From data sets to the shipped files in one command, on a made-up engine's rows."""

import hashlib
import json
import shutil
from types import SimpleNamespace

import numpy as np
import pytest
from made_up import ALPHAS, G, slip_truth, truth

from fe_training.campaign.dataset import Table, load_campaign, write_campaign
from fe_training.campaign.design import CampaignDesign, Configuration, Denser
from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import Row
from fe_training.fitting.fit import fit
from fe_training.fitting.points import ARC_FLOOR, points_of
from fe_training.regenerate import main
from fe_training.solver.observe import contact_ends
from fe_training.solver.record import Outcome, Record
from fe_training.validation.model_errors import Errors, calibration, summary
from fe_training.validation.surrogates import LARGEST_FILE, validation
from surrogate.basics.files import model_file
from surrogate.contact.bounds import Bounds
from surrogate.contact.coordinates import QUANTITIES
from surrogate.contact.shipped import read
from surrogate.errors import InputError

LEVELS = read_design(model_file("campaign.toml")).levels
BEYOND = 90.0
"""A g above all that the models are fitted to."""

SECTORS = {name: settings.sectors for name, settings in LEVELS.items()}


def record(level, alpha, g):
    """Return a record of the made-up contact on a mesh, whose errors fall with its sectors."""
    arc, load, distance = (float(value) for value in truth(g, alpha))
    slip_arc, slip_load = (float(value) for value in slip_truth(g, alpha))
    mesh = 1.0 + 0.1 / SECTORS[level] ** 2
    half = 0.5 * arc * mesh  # an arc from pi/2 - t to pi/2 + t has A = 2 sin t
    first, last = np.pi / 2 - np.arcsin(half), np.pi / 2 + np.arcsin(half)
    theta = np.linspace(first, last, 402)[1:-1]
    return Record(
        alpha=alpha,
        target=g,
        outcome=Outcome.CONVERGED,
        energy_release_rate=g * (1.0 + 1e-6),
        distance=1.0 + (distance - 1.0) * mesh,
        insertion=0.0,
        vertical_force=load * mesh,
        horizontal_force=0.5 * g,
        theta_1=first,
        theta_2=last,
        slip_arc=slip_arc * mesh,
        slip_load=slip_load * mesh,
        energy_release_rate_across=(g, g),
        residual=1e-11,
        iterations=5,
        solver="made-up",
        truncation_error=1e-5,
        wall_time=1.0,
        pressure_angle=theta,
        pressure=np.sqrt((theta - first) * (last - theta)),
    )


def write(file, design):
    rows = [
        Row(one, 0, 1, {"wirecut": "made up"}, record(one.level, one.alpha, one.target))
        for one in design.configurations()
    ]
    return write_campaign(file, design, rows)


def design_of(alpha, nodes):
    every = [node for each in nodes for node in each]
    nowhere = Denser((2.0,), (1.0,), 0.0, 1.0)
    count = max(map(len, nodes))
    return CampaignDesign(
        tuple(alpha), min(every), max(every), count, nowhere, 0.3, LEVELS, tuple(map(tuple, nodes))
    )


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """A folder with both data sets."""
    folder = tmp_path_factory.mktemp("data")
    grid = design_of(ALPHAS, [G.round(6).tolist()] * len(ALPHAS))
    write(folder / "campaign.h5", grid)
    random = np.random.default_rng(0)
    alpha = np.sort(random.uniform(2.0, 9.0, 12))
    nodes = [np.sort(np.exp(random.uniform(np.log(5e-3), np.log(60), 6))) for _ in alpha]
    nodes = [np.append(each, BEYOND) for each in nodes]
    write(folder / "off-grid.h5", design_of(alpha.tolist(), [n.tolist() for n in nodes]))
    return folder


@pytest.fixture(scope="module")
def made(data, tmp_path_factory):
    """A folder in which the command was run once."""
    folder = tmp_path_factory.mktemp("made")
    for file in data.iterdir():
        shutil.copy(file, folder)
    assert main(["--fit-only", "--out", str(folder)]) == 0
    return folder


def test_one_command_makes_all_files(made):
    names = {file.name for file in made.iterdir()} - {"campaign.h5", "off-grid.h5"}
    assert names == {
        "campaign.h5.sha256",
        "off-grid.h5.sha256",
        "surrogates.npz",
        "surrogates.npz.sha256",
        "model-card.md",
    }
    content = (made / "surrogates.npz").read_bytes()
    assert len(content) <= LARGEST_FILE
    digest = (made / "surrogates.npz.sha256").read_text().split()[0]
    assert hashlib.sha256(content).hexdigest() == digest


def test_the_file_tells_where_it_is_from(made):
    about = read(str(made / "surrogates.npz")).about
    assert about["provenance"]["points"] == len(ALPHAS) * len(G)
    assert about["provenance"]["single_mesh"] is False
    assert about["provenance"]["design_hash"] == load_campaign(made / "campaign.h5").design.hash
    off_grid = about["errors"]["off the grid"]
    assert off_grid["gp"]["force"]["count"] == 72 * 30
    json.dumps(about)


def test_what_continues_the_models_is_held_against_solutions_above_the_highest_g(made):
    fitted = read(str(made / "surrogates.npz"))
    above = fitted.about["beyond"]
    assert above["count"] == 12
    off_grid = points_of(load_campaign(made / "off-grid.h5"), single_mesh=True)
    beyond = off_grid.taken(off_grid.g == BEYOND)
    (load,) = fitted.models["table"].contact(("slip_load",), beyond.g, beyond.alpha)
    worst = np.max(np.abs(load / beyond.slip_load - 1.0) + beyond.slip_load_std)
    bounds = Bounds.from_dict(above)
    reached = BEYOND / G.max()
    first = bounds.at("table", "slip_load", np.array([1.01]), np.array([7.0]))
    assert bounds.g[1] <= reached * 1.001 < bounds.g[2]
    assert 0.0 < first <= worst + 1e-7  # of numbers rounded in the file
    cells = bounds.errors["table"]["slip_load"]
    assert np.max(cells[0][np.isfinite(cells[0])]) == pytest.approx(worst, rel=1e-5)
    assert np.all(np.isinf(cells[1:]))
    assert np.isinf(cells[0][0])  # up to alpha = 3 it depends on the size of the tip
    assert "| table | 5 to 9 | up to 1.5 |" in (made / "model-card.md").read_text()


def test_points_hardly_doubted_judge_models_with_their_doubts_in_their_errors(made):
    data = load_campaign(made / "off-grid.h5")
    points, reasons = dict(data.points.columns), np.array(data.points["reason"], dtype="U99")
    points["use"], points["force_mismatch"] = data.points["use"].copy(), np.zeros(len(reasons))
    points["use"][:4] = False
    points["force_mismatch"][:4] = 3e-3, 0.03, 3e-3, 3e-3
    reasons[:2] = "|J - 2 F_h|/J is above its bound (3.0e-03)"
    reasons[2] = reasons[0] + "; A differs between the meshes (0.02)"
    reasons[3] = "the path to the configuration stalled"
    doubted = SimpleNamespace(points=Table({**points, "reason": reasons}, {}, {}))
    used, judging = points_of(doubted), points_of(doubted, doubtful=0.01)
    assert len(judging) == len(used) + 1
    here = (judging.g == points["g"][0]) & (judging.alpha == points["alpha"][0])
    assert judging.normal_load_std[here] >= 3e-3
    assert judging.mesh_variance("normal_load")[here] < 1e-5


def test_the_card_has_every_table_and_no_gap(made):
    card = (made / "model-card.md").read_text()
    for heading in (
        "Goals",
        "The finite elements' own error bars",
        "Points off the grid",
        "Points left out one by one",
        "Points left out with their alpha",
        "The force by tau_w/(mu xi) and xi",
        "Standard deviations of `gp`",
        "What `auto` promises",
        "The formula",
        "Eq. (9) alpha by alpha",
        "Where the tip touches the wire",
    ):
        assert f"\n## {heading}\n" in card
    assert "nan" not in card
    assert "trying out" not in card
    assert "| forces of `auto` beyond rtol | 0 | 0 | yes |" in card
    assert "| points off the grid | 72 | 60 | yes |" in card


def test_refitting_reproduces_the_predictions_of_the_file(made):
    """Fitted again from the data set, and compared in what is predicted, not in coefficients."""
    again = fit(points_of(load_campaign(made / "campaign.h5")))
    file = read(str(made / "surrogates.npz"))
    random = np.random.default_rng(3)
    g, alpha = np.exp(random.uniform(np.log(5e-3), np.log(60), 300)), random.uniform(2, 9, 300)
    for name in ("power-law", "table", "gp"):
        values, others = (each.models[name].contact(QUANTITIES, g, alpha) for each in (file, again))
        for one, other in zip(values, others, strict=True):
            assert one == pytest.approx(other, rel=1e-5)  # single precision of what is written


def test_errors_off_the_grid_are_those_of_the_made_up_truth(made):
    found = read(str(made / "surrogates.npz")).about["errors"]["off the grid"]
    assert found["gp"]["normal_load"]["largest"] < 2e-3
    assert found["eq13"]["arc"]["largest"] > 0.3


def test_without_points_off_the_grid_the_card_says_so(data, tmp_path, capsys):
    for name in ("campaign.h5", "campaign.h5.sha256"):
        shutil.copy(data / name, tmp_path)
    assert main(["--fit-only", "--out", str(tmp_path)]) == 0
    assert "off-grid.h5 is not there" in capsys.readouterr().out
    card = (tmp_path / "model-card.md").read_text()
    assert "There are none yet: `regen-surrogate --off-grid` solves them." in card
    assert read(str(tmp_path / "surrogates.npz")).about["errors"]["off the grid"] is None


def test_points_of_one_mesh_are_taken_on_request_only(data, tmp_path, capsys):
    campaign = load_campaign(data / "campaign.h5")
    fine = list(LEVELS)[-1]
    rows = [
        Row(one, 0, 1, {}, record(fine, one.alpha, one.target))
        for one in campaign.design.configurations()
        if one.level == fine
    ]
    write_campaign(tmp_path / "campaign.h5", campaign.design, rows)
    assert main(["--fit-only", "--out", str(tmp_path)]) == 2
    assert "no point of the data set" in capsys.readouterr().err
    assert main(["--fit-only", "--single-mesh", "--out", str(tmp_path)]) == 0
    assert "**For trying out only:**" in (tmp_path / "model-card.md").read_text()


def test_a_folder_without_data_is_refused(tmp_path, capsys):
    assert main(["--fit-only", "--out", str(tmp_path)]) == 2
    assert "campaign.h5" in capsys.readouterr().err


def test_errors_of_the_points_are_those_of_the_meshes(data):
    campaign = load_campaign(data / "campaign.h5")
    points = points_of(campaign)
    coarse, fine = (0.1 / n**2 for n in SECTORS.values())
    loads = points.normal_load_std
    assert loads == pytest.approx(np.full(len(loads), max(coarse - fine, 1e-4)), rel=0.01)
    arc = truth(points.g, points.alpha)[0] * (1.0 + fine)
    assert points.arc == pytest.approx(arc, abs=ARC_FLOOR)


@pytest.mark.parametrize("nodes", [60, 96])
@pytest.mark.parametrize("shift", [0.1, 0.5, 0.9])
def test_ends_of_an_arc_between_nodes(nodes, shift):
    """Within a tenth of a node's distance, where the last node itself is off by up to one."""
    step = 1.4 / nodes
    theta = 0.8 + step * (shift + np.arange(nodes))
    theta = theta[theta < 2.2]
    pressure = np.sqrt((theta - 0.8) * (2.2 - theta))
    assert contact_ends(theta, pressure) == pytest.approx((0.8, 2.2), abs=0.1 * step)


def test_an_arc_of_one_node_has_no_ends():
    assert np.isnan(contact_ends(np.array([0.5]), np.array([1.0]))).all()
    assert contact_ends(np.array([0.5, 0.6]), np.zeros(2)) == (0.5, 0.6)


def test_summaries():
    assert summary(np.linspace(-1.0, 1.0, 201)) == Errors(201, 1.0, 0.95, 0.5)
    assert summary(np.zeros(0)).count == 0


def test_calibration_counts_with_both_error_bars():
    errors, std, own = np.array([0.5, 1.5, 4.0]), np.full(3, 0.6), np.full(3, 0.8)
    assert calibration(errors, std, own) == {"count": 3, "one": 1 / 3, "two": 2 / 3}
    assert calibration(np.zeros(0), np.zeros(0), np.zeros(0))["count"] == 0


def test_validation_without_any_other_points(made):
    fitted = read(str(made / "surrogates.npz"))
    points = points_of(load_campaign(made / "campaign.h5"))
    found = validation(fitted, points, None)
    assert found.off_grid is None
    assert set(found.strengths) == {"eq13", "power-law", "table", "gp"}
    zero = [errors for ratio, xi, errors in found.strengths["gp"] if xi == 0 and ratio < 1e9]
    assert all(errors.largest == 0.0 for errors in zero)


def test_too_few_points_are_refused(data):
    points = points_of(load_campaign(data / "campaign.h5"))
    with pytest.raises(InputError, match="30 points of 3 alphas or more, but there are 24 points"):
        fit(points.taken(points.alpha == 2.0))


def test_a_configuration_is_named_in_its_row():
    assert str(Configuration("fine", 2.0, 1.0)) == "alpha=2,g=1,level=fine"
