"""Exported forces: compiled and run beside Python, over the range and at its ends."""

import json
import math
import shutil
import subprocess
import sys

import numpy as np
import pytest

from surrogate import InputError, Scene, cutting_force, prepare
from surrogate.choosing.candidates import candidates
from surrogate.coupling.amplification import edge_of
from surrogate.coupling.shipped import amplification
from surrogate.prepared.source import LANGUAGES
from surrogate.prepared.whole_table import whole_table

#: By which ln kappa is off in plain powers, as Python has it beside the centred ones of programs:
#: its terms, of which each loses some 2**-53, are up to 1e6 together.
PLAIN = 1e-9
GEL = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 2.5)
BOX = {
    "toughness": (0.8, 3.0),
    "wire_radius": (1e-4, 1e-3),
    "friction_coefficient": (0.0, 0.3),
    "stiffening_exponent": (2.0, 4.0),
}
USUAL = {"wire_radius": (1e-4, 1e-3)}
STIFF = {"toughness": (1.0, 51.0), "stiffening_exponent": (4.0, 9.0)}  # g up to 298
TISSUE = Scene(10e3, 5.0, 0.5e-3, 0.02, 2e3, 6.0)
LOADS = {
    "wear_strength": (0.0, 5e2),
    "shear_modulus": (8e3, 20e3),
    "toughness": (3.0, 9.0),
    "wire_radius": (4e-4, 2e-3),
    "friction_coefficient": (0.0, 0.01),
    "stiffening_exponent": (5.5, 7.0),
}
FORCES = {
    "radius": prepare(GEL, ranges={"wire_radius": (3e-5, 3e-3)}, model="table"),
    "wear alone": prepare(Scene(685.0, 1.6, 1e-4, 0.0, 7750.0), ranges=USUAL),
    "closed form": prepare(GEL, ranges={"wire_radius": (1e-6, 1.0)}, model="eq13"),
    "cleavage": prepare(Scene(685.0, 1.6, 1e-4), ranges=USUAL),
    "two models": prepare(Scene(685.0, 1.6, 1e-4, 1e-6, 7750.0, 3.0), ranges=USUAL),
    "several": prepare(GEL, tuple(BOX), BOX, "table"),
    "slip": prepare(GEL, ranges={"wire_radius": (3e-5, 3e-3)}, law="slip"),
    "slip, alpha": prepare(GEL, tuple(BOX), BOX, law="slip"),
    "coupled, radius": prepare(TISSUE, ranges={"wire_radius": (4e-4, 2e-3)}, law="coupled"),
    "coupled, wear": prepare(TISSUE, ("wear_strength",), {"wear_strength": (0.0, 2e3)}, rtol=0.025),
    "coupled, all": prepare(TISSUE, tuple(LOADS), LOADS, law="coupled"),
    "stiff": prepare(GEL, ("toughness", "stiffening_exponent"), STIFF, "table"),
    "alpha": prepare(GEL, ("stiffening_exponent",), {"stiffening_exponent": (2.0, 9.0)}, "table"),
}


def points(force, count=400):
    random = np.random.default_rng(2)
    ends = np.array(list(force.ranges.values()))
    inner = ends[:, 0] + (ends[:, 1] - ends[:, 0]) * random.uniform(size=(count, len(ends))) ** 3
    return np.vstack([ends.T, inner])


def needed(*programs):
    for program in programs:
        if shutil.which(program):
            return shutil.which(program)
    pytest.skip(f"{programs[0]} is not installed")


def run(*command, **options):
    return subprocess.run(
        list(map(str, command)), check=True, capture_output=True, text=True, **options
    ).stdout


def in_c(text, rows, tmp_path):
    compiler = needed("gcc", "cc")
    (tmp_path / "force.c").write_text(text)
    calls = "".join(
        f'  printf("%.17g %d\\n", wirecut_force({a}), wirecut_check({a}));\n'
        for a in (", ".join(map(repr_c, row)) for row in rows)
    )
    main = f'#include <stdio.h>\n#include "force.c"\nint main(void) {{\n{calls}'
    main += '  printf("%d\\n", wirecut_self_test());\n  return 0;\n}\n'
    (tmp_path / "main.c").write_text(main)
    strict = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", "-O1")
    run(compiler, *strict, tmp_path / "main.c", "-o", tmp_path / "main", "-lm")
    lines = run(tmp_path / "main").split()
    run(compiler, "-DWIRECUT_MAIN", tmp_path / "force.c", "-o", tmp_path / "alone", "-lm")
    assert run(tmp_path / "alone") == "all cases are met\n"
    return [float(x) for x in lines[:-1:2]], [int(x) for x in lines[1:-1:2]], int(lines[-1])


def repr_c(value):
    return {"nan": "NAN", "inf": "INFINITY"}.get(repr(value), repr(value))


def in_javascript(text, rows, tmp_path):
    node = needed("node")
    (tmp_path / "force.js").write_text(text)
    assert run(node, tmp_path / "force.js") == "all cases are met\n"
    (tmp_path / "rows.json").write_text(json.dumps(rows).replace("NaN", "null"))
    script = (
        "const w = require('./force.js'), rows = require('./rows.json')"
        ".map((r) => r.map((x) => x === null ? NaN : x));"
        "const f = rows.map((r) => w.force(...r)).map((x) => Number.isNaN(x) ? 'nan' : x);"
        "console.log(JSON.stringify([f, rows.map((r) => w.check(...r)), w.selfTest()]));"
    )
    forces, codes, wrong = json.loads(run(node, "-e", script, cwd=tmp_path))
    return [float(x) for x in forces], codes, wrong


def in_python(text, rows, tmp_path):
    (tmp_path / "force.py").write_text(text)
    assert run(sys.executable, tmp_path / "force.py") == "all cases are met\n"
    names = {"__name__": "exported"}
    exec(compile(text, "force.py", "exec"), names)
    forces, codes = ([names[n](*row) for row in rows] for n in ("force", "check"))
    return forces, codes, names["self_test"]()


def in_matlab(text, rows, tmp_path):
    octave = needed("octave-cli", "octave")
    (tmp_path / "wirecut_force.m").write_text(text)
    calls = "".join(
        f"[f, c] = wirecut_force({', '.join(map(repr, row))}); printf('%.17g %d\\n', f, c);\n"
        for row in rows
    )
    (tmp_path / "main.m").write_text(calls + "printf('%d\\n', wirecut_force());\n")
    lines = run(octave, "main.m", cwd=tmp_path).split()
    return [float(x) for x in lines[:-1:2]], [int(x) for x in lines[1:-1:2]], int(lines[-1])


RUNNERS = {"c": in_c, "javascript": in_javascript, "python": in_python, "matlab": in_matlab}


@pytest.mark.parametrize("name", FORCES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_numbers_are_pythons(language, name, tmp_path):
    force = FORCES[name]
    rows = points(force).tolist()
    forces, codes, wrong = RUNNERS[language](force.source(language), rows, tmp_path)
    assert wrong == 0
    assert set(codes) == {0}
    np.testing.assert_allclose(forces, force(*np.array(rows).T), rtol=1e-12)


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_out_of_range_has_a_number_and_no_force(language, tmp_path):
    force = FORCES["several"]
    middle = [0.5 * sum(ends) for ends in force.ranges.values()]
    rows, expected = [], []
    for i, (low, high) in enumerate(force.ranges.values()):
        for bad in (np.nextafter(low, -1.0), np.nextafter(high, math.inf), -1e300, 1e300, math.nan):
            rows.append([*middle[:i], float(bad), *middle[i + 1 :]])
            expected.append(i + 1)
    forces, codes, _ = RUNNERS[language](force.source(language), rows, tmp_path)
    assert codes == expected
    assert np.all(np.isnan(forces))


@pytest.mark.parametrize("law", ["projected", "slip"])
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_whole_table(language, law, tmp_path):
    limits = candidates().limits
    random = np.random.default_rng(4)
    alpha = random.uniform(*limits.alpha, 300)
    alpha[:7] = [*limits.alpha, *(a for a, _ in limits.highest), 3.5]
    highest = limits.highest_g(alpha)
    g = limits.g[0] * (highest / limits.g[0]) ** random.uniform(size=300)
    g[:7] = highest[:7]
    mu, radius, xi = 685.0 * np.ones(300), 1e-4 * np.ones(300), random.uniform(0.0, 1.0, 300)
    scene = Scene(mu, g * mu * radius, radius, xi, 10.0 * mu * random.uniform(size=300), alpha)
    rows = np.array(scene.values()).T
    above, below = rows[:7].copy(), rows[:7].copy()
    above[:, 1] = 1.000001 * highest[:7] * 685.0 * 1e-4
    below[:, 1] = 0.999999 * limits.g[0] * 685.0 * 1e-4
    text = whole_table(language, law)
    every = np.vstack([rows, above, below]).tolist()
    forces, codes, wrong = RUNNERS[language](text, every, tmp_path)
    assert (wrong, set(codes[:300]), set(codes[300:])) == (0, {0}, {7})
    there = cutting_force(scene, "table", law=law).total
    np.testing.assert_allclose(forces[:300], there, rtol=1e-12)
    if language == "javascript":
        assert len(text) < 250_000


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_whole_table_of_the_coupled_law_ends_where_its_solutions_do(language, tmp_path):
    random, kappa = np.random.default_rng(6), amplification()
    alpha, share = random.uniform(2.0, 9.0, 400), random.uniform(0.0, 1.5, 400)
    low, high = np.log(kappa.lowest), np.log(kappa.highest)
    g = np.exp(random.uniform(low - 0.3, high + 0.3, 400))
    direction = random.integers(0, 5, 400) / 4.0
    xi, relative = edge_of(direction, kappa.load_unit)
    reach = share / np.maximum(kappa.share(g, alpha, xi, relative), 1e-3)
    reach[:20] = 0.0
    mu, radius = random.uniform(300.0, 3000.0, 400), random.uniform(3e-5, 3e-3, 400)
    scene = Scene(mu, g * mu * radius, radius, reach * xi, reach * relative * mu, alpha)
    expected = cutting_force(scene, "table", law="coupled", outside="nan")
    rows = np.array(scene.values()).T.tolist()
    forces, codes, wrong = RUNNERS[language](whole_table(language, "coupled"), rows, tmp_path)
    assert wrong == 0
    known = expected.in_domain
    assert 100 < np.count_nonzero(known) < 300
    assert np.array_equal(np.array(codes) == 0, known)
    assert set(codes) == {0, 7, 8}  # 7 where g leaves the table as well
    assert np.array_equal(np.isnan(forces), ~known)
    np.testing.assert_allclose(np.array(forces)[known], expected.total[known], rtol=PLAIN)


def test_the_header_tells_what_it_is():
    force = prepare(GEL, ranges={"wire_radius": (3e-5, 3e-3)}, model="table", law="projected")
    for language in LANGUAGES:
        head = force.source(language)[:2000]
        for words in (
            "N/m",
            "MIT",
            "Eq. (S2)",
            "toughness = 1.6",
            "from 3e-05 to 0.003",
            "friction by table",
        ):
            assert words in head, (language, words)
        assert f"up to {force.fit_error:.3g}" in head
    head = FORCES["slip"].source("c")[:2000]
    for words in ("tau_w A* + xi mu B*", "unknown", "tip touches the wire", "wear by table"):
        assert words in head
    head = FORCES["radius"].source("javascript")[:2000]
    for words in ("on which the wire rubs: unknown.", "Eq. (S2)", "effective strengths"):
        assert words in head
    assert f"without shear on the wire: up to {force.fit_error:.3g}." in head
    force = FORCES["coupled, wear"]
    assert force.law == "coupled"
    head = force.source("matlab")[:2000]
    assert f"on which the wire rubs: up to {force.relative_error:.3g}." in head
    assert "B*) kappa" in head
    with pytest.raises(InputError, match="language must be one of"):
        force.source("fortran")
