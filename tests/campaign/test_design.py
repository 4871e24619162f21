"""Designs: what is read, what is refused, what the hash sees, and how tasks are made."""

import json
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from designs import SMALL

from fe_training.campaign.design import BLUNT, STRATEGIES, CampaignDesign
from fe_training.campaign.design_file import read_design
from fe_training.fitting.fit import FEWEST_ALPHAS, FEWEST_POINTS
from fe_training.solver.cut import Settings
from surrogate.basics.files import model_file
from surrogate.errors import InputError


@pytest.fixture
def full():
    return read_design(model_file("campaign.toml"))


def test_the_full_design_holds_what_the_paper_studies(full):
    assert {2.0, 5.0, 9.0} <= set(full.alpha)
    assert len(full.alpha) >= 9
    assert (full.alpha[0], full.alpha[-1]) == (2.0, 9.0)
    for alpha in full.alpha:
        g = full.g(alpha)
        assert len(g) >= 40
        top = 100.0 if alpha < 3 else 300.0 if alpha < 5 else 1000.0
        assert (g[0], g[-1]) == (2.5e-3, top)
        assert 100.0 in g


def test_alpha_nodes_are_clustered_at_the_ends(full):
    gaps = np.diff(full.alpha)
    middle = np.argmax(gaps)
    assert 0 < middle < len(gaps) - 1
    assert max(gaps[0], gaps[-1]) < 0.3 * gaps[middle]


@pytest.mark.parametrize(("alpha", "touch"), [(2.0, 1.6), (5.0, 20.0)])
def test_g_nodes_are_densest_at_the_touch(full, alpha, touch):
    g = np.array(replace(full, touching=None).g(alpha))
    densest = np.argmin(np.diff(np.log(g)))
    assert g[densest] == pytest.approx(touch, rel=0.3)


def test_the_quick_design_is_just_large_enough_for_models():
    quick = read_design(model_file("campaign-quick.toml"))
    assert len(quick.alpha) == FEWEST_ALPHAS
    assert FEWEST_POINTS < quick.points < 1.5 * FEWEST_POINTS
    assert quick.path_from <= quick.lowest


def test_the_hash_sees_numbers_not_formatting(small, tmp_path):
    other = tmp_path / "same.toml"
    text = SMALL.replace("alpha = [2, 5]", "# nothing\nalpha = [\n 2.0, 5.00]", 1)
    other.write_text(text.replace("highest = 10", "highest = 1e1"))
    assert read_design(other).hash == small.hash


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("[2, 5]", "[2, 5.01]"),
        ("count = 6", "count = 7"),
        ("peak = 2", "peak = 2.5"),
        ("path_from = 0.7", "path_from = 0.8"),
        ("sectors = 16", "sectors = 17"),
        ("contact_spacing = 0.2", "contact_spacing = 0.2\nbulk = 2.0"),
        ("levels.coarse", "levels.rough"),
    ],
)
def test_the_hash_sees_every_number(small, tmp_path, old, new):
    other = tmp_path / "other.toml"
    other.write_text(SMALL.replace(old, new, 1))
    assert read_design(other).hash != small.hash


def test_a_design_comes_back_from_its_numbers(small):
    numbers = json.loads(json.dumps(small.as_dict()))
    assert CampaignDesign.from_dict(numbers) == small


BAD = [
    ("wirecut-campaign-1", "wirecut-campaign-9", "schema"),
    ("alpha = [2, 5]", "", "alpha is missing"),
    ("alpha = [2, 5]", "alpha = 2", "list of rising numbers"),
    ("alpha = [2, 5]", "alpha = [5, 2]", "does not rise"),
    ("alpha = [2, 5]", "alpha = [2, 500]", "1 to 20"),
    ("alpha = [2, 5]", "alpha = [2, nan]", "1 to 20"),
    ("lowest = 0.1", "lowest = 20", "not above g.lowest"),
    ("lowest = 0.1", 'lowest = "low"', "a number from"),
    ("lowest = 0.1", "lowest = true", "a number from"),
    ("count = 6", "count = 6.5", "whole number"),
    ("count = 6", "count = 9000", "coincide"),
    ("touch = [1.6, 100]", "touch = [1.6]", "one for each alpha"),
    ("peak = 2", "peek = 2", "peak is missing"),
    ("width = 0.5", "width = 0.5\ncolour = 1", "g.denser.colour is unknown"),
    ("sectors = 16", "sektors = 16", "levels.less-coarse.sektors is unknown"),
    ("sectors = 16", "sectors = 16.0", "sectors is 16.0"),
    ("sectors = 16", "sectors = -16", "from 0 on"),
    ("sectors = 16", "sectors = 12", "not finer"),
    ("levels.coarse", 'levels."../x"', "names a level"),
    ("[levels.less-coarse]", "[levels.coarse.deeper]", "deeper is unknown"),
    ("[g]", "[g", "no TOML"),
]


@pytest.mark.parametrize(("old", "new", "words"), BAD)
def test_an_unusable_design_is_refused_in_words(tmp_path, old, new, words):
    file = tmp_path / "bad.toml"
    assert old in SMALL
    file.write_text(SMALL.replace(old, new, 1))
    with pytest.raises(InputError, match=r"bad\.toml.*") as caught:
        read_design(file)
    assert words in str(caught.value)


def test_one_level_is_refused(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text(SMALL[: SMALL.index("[levels.less-coarse]")])
    with pytest.raises(InputError, match="give two"):
        read_design(file)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_design(tmp_path / "none.toml")


def test_tasks_are_paths_first_and_hold_every_configuration_once(full):
    wanted = full.configurations()
    tasks = full.tasks((one, 0) for one in wanted)
    assert sorted(one for task in tasks for one in task.configurations) == sorted(wanted)
    on_path = [task.configurations[0].target >= full.path_from for task in tasks]
    assert on_path == sorted(on_path, reverse=True)
    assert sum(on_path) == len(full.alpha) * len(full.names)
    for task in tasks:
        assert len({(one.alpha, one.level) for one in task.configurations}) == 1
        assert all(a.target < b.target for a, b in pairwise(task.configurations))
        if task.configurations[0].target < full.path_from:
            assert len(task.configurations) == 1


def test_attempts_are_tasks_of_their_own(small):
    path = [one for one in small.configurations() if one.target >= small.path_from][:4]
    tasks = small.tasks([(path[0], 0), (path[1], 1), (path[2], 0), (path[3], 1)])
    assert [(task.attempt, len(task.configurations)) for task in tasks] == [(0, 2), (1, 2)]


def test_every_strategy_is_finer_than_the_one_before():
    tried = [strategy(Settings()) for strategy in STRATEGIES]
    assert tried[0] == Settings()
    for coarse, fine in pairwise(tried):
        assert fine.sectors > coarse.sectors
        assert fine.contact_spacing < coarse.contact_spacing
        assert fine.notch_radius <= coarse.notch_radius


def test_the_full_design_is_the_one_that_was_run(full):
    """The store of the finished rows belongs to this hash: no field may be added to it."""
    assert full.hash == "7d93006af3a098ae"


def test_the_design_off_the_grid_is_what_its_comment_says():
    design = read_design(model_file("off-grid.toml"))
    random, others, near_it = (np.random.default_rng(seed) for seed in (20412, 20413, 20414))
    alpha = np.sort(random.uniform(2, 9, 12)).round(3)
    assert design.alpha == tuple(alpha)

    def drawn(generator, low, high, count):
        return np.sort(np.exp(generator.uniform(np.log(low), np.log(high), count))).tolist()

    for value in design.alpha:
        g = drawn(random, 2.5e-3, 100, 6)
        top = 100 if value < 3 else 300 if value < 5 else 1000
        if top > 100:
            g += drawn(others, 100, top, 2)
        here = np.array(design.g(value))
        assert {float(f"{each:.4g}") for each in g} <= set(here)
        more = here[~np.isin(here, [float(f"{each:.4g}") for each in g])]
        near = more[more < top]
        offsets = [*near_it.uniform(-0.12, -0.02, 2), *near_it.uniform(0.02, 0.12, 1)]
        if near.size:  # of four digits, each off by up to 5e-4
            assert np.diff(np.log(near)) == pytest.approx(np.diff(np.sort(offsets)), abs=1.1e-3)
        assert np.all(more[len(near) :] > top)
        assert near.size == (3 if value < 7 else 0)


def test_the_design_off_the_grid_shares_meshes_but_no_point_with_the_campaign(full):
    design = read_design(model_file("off-grid.toml"))
    for name, settings in full.levels.items():
        larger = 100.0 * settings.outer_radius
        assert design.levels[name] == replace(settings, outer_radius=larger)
    assert not set(design.alpha) & set(full.alpha)


def test_listed_nodes_survive_the_store(tmp_path):
    design = read_design(model_file("off-grid.toml"))
    again = CampaignDesign.from_dict(json.loads(json.dumps(design.as_dict())))
    assert again == design
    assert again.hash == design.hash


@pytest.mark.parametrize(
    ("nodes", "message"),
    [
        ("[[1, 2]]", "g.nodes has 1 lists and alpha 2 values"),
        ("[[1, 2], [3, 2]]", "does not rise"),
        ("[[1, 2], []]", "give a list"),
        ("[[1, 2], [3, 1e9]]", "give"),
        ("[1, 2]", "give a list"),
    ],
)
def test_listed_nodes_that_cannot_be_are_refused(tmp_path, nodes, message):
    file = tmp_path / "listed.toml"
    begin, end = SMALL.index("[g]"), SMALL.index("[levels.coarse]")
    file.write_text(f"{SMALL[:begin]}[g]\nnodes = {nodes}\n\n{SMALL[end:]}")
    with pytest.raises(InputError, match=message):
        read_design(file)


def test_the_nodes_go_on_above_the_highest_where_the_design_says_so(full):
    shared = replace(full, touching=None)
    assert len(shared.g(2.5)) == 44
    for alpha, top, more in ((3.12, 300.0, 4), (5.0, 1000.0, 8)):
        beyond = shared.g(alpha)[44:]
        assert len(beyond) == more
        assert beyond[-1] == top
        steps = np.diff(np.log((100.0, *beyond)))
        assert steps == pytest.approx(steps.mean(), rel=1e-2)


def test_the_blunt_level_is_the_coarser_mesh_with_its_notch(full):
    first = next(iter(full.levels.values()))
    blunt = full.settings(BLUNT, 0)
    assert blunt.notch_radius == full.blunt.notch_radius > first.notch_radius
    assert replace(blunt, notch_radius=first.notch_radius) == first
    for alpha in full.alpha:
        solved = [c.target for c in full.configurations() if (c.level, c.alpha) == (BLUNT, alpha)]
        lowest = full.blunt.share * full.denser.at(alpha)
        assert solved == [g for g in full.g(alpha) if g >= lowest]


def test_nodes_that_coincide_are_refused_where_others_go_on_above_them_too(tmp_path):
    file = tmp_path / "bad.toml"
    # twelve of the nodes coincide, and more than as many follow above
    beyond = "[g.beyond]\nalpha = [2]\nhighest = [100]\nper_decade = 99"
    file.write_text(SMALL.replace("count = 6", "count = 3600") + f"\n{beyond}\n")
    with pytest.raises(InputError, match="coincide"):
        read_design(file)


def test_nodes_near_the_touch_stand_among_the_others(full):
    near = full.touching
    for alpha in full.alpha:
        nodes = full.g(alpha)
        assert list(nodes) == sorted(set(nodes))
        more = set(nodes) - set(replace(full, touching=None).g(alpha))
        if alpha not in near.alpha:
            assert not more
            continue
        touch = near.touch[near.alpha.index(alpha)]
        offsets = np.log(sorted(more)) - np.log(touch)
        assert offsets == pytest.approx(near.offsets, abs=1e-3)  # of nodes rounded to four digits


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (
            "[g.touching]\nalpha = [2, 9]\ntouch = [1]\noffsets = [0.1]",
            "g.touching.touch has 1 numbers",
        ),
        (
            "[g.touching]\nalpha = [2]\ntouch = [1]\noffsets = [0.1, 0.1]",
            "g.touching.offsets",
        ),
        ("[g.beyond]\nalpha = [3]\nhighest = [3.9]\nper_decade = 8", "g.beyond.highest"),
        (
            "[g.beyond]\nalpha = [3]\nhighest = [30, 40]\nper_decade = 8",
            "for each of g.beyond.alpha",
        ),
        ("[g.beyond]\nalpha = [3]\nhighest = [30]", "g.beyond.per_decade is missing"),
        ("[blunt]\nnotch_radius = 2.0\nshare = 0.5", "blunt.notch_radius"),
        ("[blunt]\nnotch_radius = 0.01\nshare = 0.5\nx = 1", "blunt.x is unknown"),
    ],
)
def test_what_goes_beyond_is_checked(tmp_path, lines, message):
    file = tmp_path / "bad.toml"
    file.write_text(f"{SMALL}\n{lines}\n")
    with pytest.raises(InputError, match=message):
        read_design(file)
