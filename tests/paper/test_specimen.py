"""Blocks of finite height: their mesh, their sides, the large-body limit, the file of results."""

import math

import numpy as np
import pytest

from fe_training.mechanics.mesh import MeshSpec, block_mesh
from fe_training.paper import specimen
from fe_training.paper.specimen import Case, Result, Side, block_cut, solve_case
from fe_training.solver.cut import Settings
from surrogate.errors import InputError

COARSE = Settings(sectors=12, contact_spacing=0.16)


@pytest.fixture(scope="module")
def results():
    """A wire 3 R_w behind the tip of blocks and of the large body."""
    wanted = {
        "rollers": Case(2.0, 15.0, "rollers", 3.0),
        "free": Case(2.0, 15.0, "free", 3.0),
        "high": Case(2.0, 1e4, "free", 3.0),
        "none": Case(2.0, math.inf, "none", 3.0),
    }
    return {name: solve_case(case, COARSE) for name, case in wanted.items()}


def test_the_mesh_fills_the_half_block_less_the_notch():
    spec = MeshSpec(notch_radius=0.01, outer_radius=10.0, sectors=16, contact_spacing=0.2)
    mesh = block_mesh(spec, half_length=40.0)
    area = np.abs(np.linalg.det(np.diff(mesh.p[:, mesh.t], axis=1).transpose(2, 0, 1))).sum() / 2
    polygon = 0.5 * spec.sectors * np.sin(np.pi / spec.sectors) * spec.notch_radius**2
    assert area == pytest.approx(2 * 40.0 * 10.0 - polygon, rel=1e-12)
    assert mesh.p[1].min() == 0.0


@pytest.mark.parametrize("side", list(Side))
def test_what_is_held(side):
    body = block_cut(2.0, 10.0, side, 2.0, COARSE).body
    x, y = body.nodes.T
    inner = (y > 0) & (y < 10.0) & (x < x.max())
    assert not body.held[inner].any()
    top = (y == 10.0) & (x < x.max())
    assert body.held[top].all(axis=0).tolist() == [side is Side.GLUED, side is not Side.FREE]
    ligament = (y == 0) & (x > 0.1) & (x < x.max())
    assert body.held[ligament].all(axis=0).tolist() == [False, True]
    assert body.face[0] in np.flatnonzero(body.held[:, 1])  # the tip, in the symmetry plane
    assert not body.held[body.face[1:]].any()


def test_j_is_twice_the_force_in_every_block(results):
    # coarse meshes; J on a support free of contact
    for result in results.values():
        assert result.outcome == "CONVERGED" or result.force_mismatch < 0.01
        assert result.force_mismatch < 0.01


def test_a_high_block_is_the_large_body(results):
    """Half height 1e4: the side changes B by the order of delta/H = 3e-4; two meshes, 2e-3."""
    high, none = results["high"], results["none"]
    assert high.normal_load == pytest.approx(none.normal_load, rel=3e-3)
    assert high.arc == pytest.approx(none.arc, abs=0.01)


def test_rollers_press_the_wire_and_a_free_side_gives_way(results):
    free, none, rollers = (results[name].normal_load for name in ("free", "none", "rollers"))
    assert free < 0.95 * none
    assert rollers > 1.03 * none


def test_results_survive_in_a_file(tmp_path, monkeypatch, results):
    file = tmp_path / "specimens.csv"
    wanted = [result.case for result in results.values()]
    monkeypatch.setattr(specimen, "cases", lambda: wanted)
    assert list(specimen.missing(file)) == wanted
    for result in list(results.values())[:3]:
        specimen.add_result(file, result)
    assert specimen.read_results(file) == list(results.values())[:3]
    assert list(specimen.missing(file)) == wanted[3:]


def test_a_damaged_file_is_refused(tmp_path):
    file = tmp_path / "specimens.csv"
    result = Result(Case(2.0, 5.0, "free", 1.0), 0.1, 1.0, 1.0, 1.0, 1e-4, 9, "CONVERGED")
    specimen.add_result(file, result)
    whole = file.read_text()
    file.write_text(whole[: len(whole) - 14])
    with pytest.raises(InputError, match="line 2"):
        specimen.read_results(file)
    file.write_text("a,b\n")
    with pytest.raises(InputError, match="no file of specimens"):
        specimen.read_results(file)


def test_every_case_of_the_study_is_one_of_its_own_and_shallow_enough():
    found = specimen.cases()
    assert len(found) == len(set(found))
    assert all(case.depth <= 0.7 * case.half_height for case in found)
    assert {case.side for case in found} == {"none", "rollers", "free"}
