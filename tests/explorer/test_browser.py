"""The page in a browser: Python's numbers, a point that can be moved, and words for people."""

import itertools
import math
import random
import re
from itertools import product
from urllib.parse import parse_qs

import numpy as np
import pytest

from surrogate import DomainError, Scene, classify, cutting_force, transition_radius
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import LAWS
from surrogate.cutting.regimes import PARTS
from surrogate.explorer.numbers import KEYS
from surrogate.scene import NAMES

GEL = {"mu": 685.0, "Gamma_o": 1.6, "R_w": 0.25e-3, "xi": 0.0, "tau_w": 7750.0, "alpha": 2.0}
LAW_NAMES = ("auto", *LAWS)
LIGHT = GEL | {"alpha": 6.0, "xi": 0.004, "tau_w": 20.0, "R_w": 1e-3}
"""So little friction and wear that coupled solutions reach to it."""


def address(law="projected", **state):
    return "&".join(f"{key}={value!r}" for key, value in (GEL | state).items()) + f"&law={law}"


def scene_of(state):
    return Scene(**{name: state[KEYS[name]] for name in NAMES})


def random_state(dice, limits):
    alpha = dice.uniform(*limits.alpha)
    low, high = limits.g[0], float(limits.highest_g(alpha))
    g = math.exp(dice.uniform(math.log(low * 1.001), math.log(high * 0.999)))
    mu, radius = 10 ** dice.uniform(1, 6), 10 ** dice.uniform(-5, -2.5)
    return {
        **{"mu": mu, "Gamma_o": g * mu * radius, "R_w": radius, "alpha": alpha},
        "xi": dice.choice((0.0, 10 ** dice.uniform(-3, 0))),
        "tau_w": dice.choice((0.0, mu * 10 ** dice.uniform(-3, 1.5))),
    }


def expected(state, law):
    """Return Python's numbers of a state under a law; None where it has none."""
    scene = scene_of(state)
    force = cutting_force(scene, "table", law=law, outside="nan")
    if not force.in_domain:
        return None
    parts = force.cleavage, force.friction, force.wear
    bound = force.relative_error if law == "auto" else force.fit_error
    return {
        **{"total": force.total, "error": bound},
        **dict(zip(PARTS[1:], parts, strict=True)),
    }


@pytest.mark.filterwarnings("ignore")
def test_the_numbers_are_pythons(page):
    dice, limits = random.Random(21), force_model("table").limits
    page.open()
    transitions = unknown = without = 0
    for _ in range(200):
        state, law = random_state(dice, limits), dice.choice(LAW_NAMES)
        page.set(address(law, **state))
        shown = page.numbers()
        for one in LAW_NAMES:
            told = expected(state, one)
            if told is None:
                assert one == "coupled"
                assert not any(name.startswith("coupled.") for name in shown)
                without += 1
                continue
            numbers = [float(shown[f"{one}.{name}"]) for name in told]
            np.testing.assert_allclose(numbers, list(told.values()), rtol=1e-6, err_msg=str(state))
            unknown += math.isnan(told["error"])
        if f"{law}.total" not in shown:
            assert "total" not in shown
            continue
        scene = scene_of(state)
        assert float(shown["total"]) == float(shown[f"{law}.total"])
        regime = classify(scene, model="table", law=law)
        assert shown["dominant"] == regime.dominant
        touch = state["Gamma_o"] / (state["mu"] * force_model("table").touch(state["alpha"]))
        assert float(shown["touch"]) == pytest.approx(touch, rel=1e-6)
        assert (regime.contact == "indentation") == (state["R_w"] < touch)
        try:
            radius = transition_radius(scene, "table", law=law)
        except DomainError:
            assert shown["transition"] in ("below", "above", "beyond")
            continue
        if math.isinf(radius):
            assert shown["transition"] == "never"
            continue
        transitions += 1
        assert float(shown["transition"]) == pytest.approx(radius, rel=1e-6)
    assert transitions > 50
    assert unknown > 2
    assert 40 < without < 160
    assert page.complaints() == []


@pytest.mark.filterwarnings("ignore")
def test_the_transition_of_coupled_is_pythons_or_beyond_the_solutions(page):
    dice, limits, page_says = random.Random(5), force_model("table").limits, []
    page.open()
    while len(page_says) < 60:
        state = random_state(dice, limits)
        state |= {
            "xi": 10 ** dice.uniform(-3, -1),
            "tau_w": state["mu"] * 10 ** dice.uniform(-2, 0),
        }
        page.set(address("coupled", **state))
        told = page.run("return transitionOf(lawOf('coupled'), state);")
        page_says.append(told.get("why", "radius"))
        try:
            radius = transition_radius(scene_of(state), "table", law="coupled")
        except DomainError as error:
            beyond = "coupled solutions" in str(error)
            assert told["why"] == "beyond" if beyond else told["why"] in ("below", "above")
            continue
        assert told["radius"] == pytest.approx(radius, rel=1e-6)
    assert page_says.count("radius") > 5
    assert page_says.count("beyond") > 5


def test_what_is_read_is_what_a_machine_reads(page):
    page.open(address())
    pairs = page.run(
        "return [...document.querySelectorAll('#laws data')]"
        ".map((one) => [one.textContent, one.value]);"
    )
    for text, value in pairs:
        if text.endswith("%"):
            assert float(value) <= float(text[:-2]) / 100 <= 1.1 * float(value)
        elif text != "unknown":
            assert float(text) == pytest.approx(float(value), rel=5e-3)
    assert page.text("number") == "7.19"
    assert "error up to 0.55 %" in page.text("may-be-off")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("law", LAW_NAMES)
def test_the_radii_between_which_a_part_dominates_are_where_classify_changes(page, law):
    state = (
        LIGHT if law in ("auto", "coupled") else GEL | {"alpha": 4.0, "xi": 0.3, "tau_w": 2000.0}
    )
    page.open(address(law, **state))
    stretches = page.run("return stretchesOf(lawOf(state.law), state);")
    assert len(stretches) >= 3
    for one in stretches:
        inside = np.geomspace(one["from"] * (1 + 1e-6), one["to"] * (1 - 1e-6), 9)
        scene = scene_of(state | {"R_w": inside})
        covered = cutting_force(scene, "table", law=law, outside="nan").in_domain
        assert set(covered) == {one["part"] is not None}
        if covered.all():
            assert set(classify(scene, model="table", law=law).dominant) == {one["part"]}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("law", "state"), [("projected", {"xi": 0.4}), *((law, LIGHT) for law in LAW_NAMES)]
)
def test_the_map_has_the_regions_of_classify(page, law, state):
    page.open(address(law, **state))
    at, columns = GEL | state, page.run("return regionsOf(state).columns;")
    assert len(columns) > 140
    edges = 0
    for column in columns[::9]:
        for pair in itertools.pairwise(column["stretches"]):
            edges += 1
            for side, factor in zip(pair, (1 - 1e-6, 1 + 1e-6), strict=True):
                wear = pair[1]["from"] * factor
                scene = Scene(column["x"], 1.0, 1.0, at["xi"], wear, at["alpha"])
                force = cutting_force(scene, "table", law=law, outside="nan")
                place = column["x"], wear, pair
                assert force.in_domain == (side["part"] is not None), place
                if force.in_domain:
                    assert classify(scene, model="table", law=law).dominant == side["part"], place
                if law == "auto":
                    assert math.isnan(force.relative_error) == (not side["known"]), place
    assert edges > 20


def test_beyond_the_coupled_solutions_the_page_says_so_and_draws_no_line(page):
    lines = "return document.querySelectorAll('#forces path.total').length;"
    others = "return document.querySelectorAll('#forces path.other-1').length;"
    page.open(address("coupled", **LIGHT))
    assert page.text("may-be-off").startswith("error up to")
    assert page.run(lines) >= 1
    page.set(address(**LIGHT))
    assert page.run(others) >= 1
    for state, words in (
        (LIGHT | {"xi": 0.9}, "more than the load that they reach"),
        (LIGHT | {"R_w": 1e-6}, "outside the table"),
        (LIGHT | {"R_w": 5e-6}, "before the tip touches the wire"),
    ):
        page.set(address("coupled", **state))
        assert words in page.text("says")
        assert page.text("number") == "no force"
        assert not any(name.startswith("coupled.") for name in page.numbers())
        if words != "outside the table":
            assert "projected.total" in page.numbers()
            assert "no coupled solution is near" in page.text("laws-unknown")
    page.set(address("coupled", **LIGHT | {"xi": 0.9}))
    assert page.run(lines) == 0
    page.set(address(**LIGHT | {"xi": 0.9}))
    assert page.run(others) == 0
    assert page.complaints() == []


def centre(page, name):
    return page.run(
        "const box = document.querySelector(arguments[0]).getBoundingClientRect();"
        "return [box.left + box.width/2, box.top + box.height/2];",
        f"#{name} .dot",
    )


def mouse(page, kind, x, y, buttons=1):
    page.driver.execute_cdp_cmd(
        "Input.dispatchMouseEvent",
        {"type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1},
    )


def finger(page, kind, *points):
    touches = [{"x": x, "y": y} for x, y in points]
    page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})


def state_of(page):
    return page.run("return {mu: state.mu, R_w: state.R_w, tau_w: state.tau_w, law: state.law};")


def test_a_mouse_drags_the_point(page):
    page.open(address(), height=1400)
    before, (x, y) = state_of(page), centre(page, "point")
    mouse(page, "mousePressed", x, y)
    for i in range(1, 6):
        mouse(page, "mouseMoved", x + 10 * i, y - 6 * i)
    mouse(page, "mouseReleased", x + 50, y - 30, buttons=0)
    after, at = state_of(page), centre(page, "point")
    assert after["R_w"] > 1.5 * before["R_w"]
    assert after["mu"] == before["mu"]
    assert at == pytest.approx([x + 50, y - 30], abs=1.0)
    mouse(page, "mouseMoved", x, y, buttons=0)  # and then it stays
    assert state_of(page) == after


def test_a_finger_drags_the_point(page):
    page.open(address(), width=390, height=3200)
    page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    try:
        x, y = centre(page, "point")
        finger(page, "touchStart", (x, y))
        for i in range(1, 6):
            finger(page, "touchMove", (x + 8 * i, y + 8 * i))
        assert centre(page, "point") == pytest.approx([x + 40, y + 40], abs=1.5)
        finger(page, "touchEnd")
        assert state_of(page)["R_w"] > 1.5 * GEL["R_w"]
    finally:
        page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


def test_keys_move_the_points_and_sliders(page):
    keys = pytest.importorskip("selenium.webdriver").Keys
    page.open(address())
    page.element("point").send_keys(keys.ARROW_RIGHT, keys.ARROW_UP)
    after = state_of(page)
    assert after["R_w"] == pytest.approx(1.02 * GEL["R_w"], rel=1e-3)
    assert after["tau_w"] == pytest.approx(1.02 * GEL["tau_w"], rel=1e-3)
    assert page.run("return document.activeElement.id;") == "point"
    page.element("wire").send_keys(keys.ARROW_LEFT)
    assert state_of(page)["R_w"] == pytest.approx(GEL["R_w"], rel=1e-3)
    page.element("slider-mu").send_keys(keys.ARROW_RIGHT)
    assert state_of(page)["mu"] == pytest.approx(GEL["mu"] * 10**0.01, rel=0.02)
    assert "kPa" in page.element("slider-mu").get_attribute("aria-valuetext")
    assert "N/m" in page.element("wire").get_attribute("aria-valuetext")


def typed(page, name, text):
    from selenium.webdriver import Keys

    page.element(f"field-{name}").send_keys(Keys.CONTROL, "a", Keys.NULL, text or Keys.BACKSPACE)


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("R_w", "0.001", "outside the table"),
        ("R_w", "5000", "outside the table"),
        ("alpha", "12", "outside the table"),
        ("mu", "-3", "must be a number above 0"),
        ("Gamma_o", "gel", "must be a number above 0"),
        ("xi", "", "must be 0 or a number above it"),
    ],
)
def test_what_is_out_of_range_is_said_in_words(page, name, text, words):
    page.open(address())
    typed(page, name, text)
    assert words in page.text("says")
    assert page.text("number") == "no force"
    assert "total" not in page.numbers()
    typed(page, name, repr(GEL[name] / {"mu": 1e3, "R_w": 1e-3}.get(name, 1.0)).replace(".", ","))
    assert page.text("number") == "7.19"
    assert page.complaints() == []


@pytest.mark.parametrize("name", GEL)
def test_extremes_are_answered_in_words(page, name):
    page.open()
    extremes = 0.0, 5e-324, 1e-300, 1e-30, 1e30, 1e300, 1.7e308, math.inf, math.nan, -1.0
    starts = ("projected", GEL), ("coupled", LIGHT)
    for value, (law, state) in product(extremes, starts):
        page.set(address(law, **state | {name: value}))
        shown = page.run("return document.querySelector('main').innerText;")
        assert not re.search(r"NaN|undefined|Infinity|null", shown), (value, shown)
        drawn = page.run("return document.querySelector('main').innerHTML;")
        assert not re.search(r'(?: d| x| y| transform| width)="[^"]*(?:NaN|Infinity)', drawn), value
        assert page.text("says")
    assert page.complaints() == []


def test_what_is_unknown_is_said_in_words(page):
    page.open(address("slip"))
    assert page.text("may-be-off") == "error unknown"
    assert "how sharp the tip is" in page.text("says")
    page.set(address("slip", R_w=5e-3))
    assert "error up to" in page.text("may-be-off")
    page.set(address(R_w=3e-2))
    assert "hardly that of a soft solid’s cut" in page.text("says")


def test_a_link_reproduces_the_page(page):
    page.open(address("slip", mu=1234.5, xi=0.25) + "&diameters=1&cuts=0.0002:5.5:0.25;0.0004:9")
    first = page.numbers(), page.text("says"), page.run("return addressOf(state);")
    assert page.run("return state.cuts;") == [[2e-4, 5.5, 0.25], [4e-4, 9, None]]
    page.open(first[2])
    assert (page.numbers(), page.text("says"), page.run("return addressOf(state);")) == first
    assert parse_qs(first[2])["mu"] == ["1234.5"]
    page.open("mu=&law=none&nonsense=1&cuts=a:b")
    assert "must be a number above 0" in page.text("says")
    assert page.complaints() == []


def test_own_cuts_are_drawn_and_typed(page):
    page.open()
    squares = "return document.querySelectorAll('#forces .cut').length;"
    assert page.run(squares) == 5
    page.run("document.getElementById('cuts').select();")
    page.element("cuts").send_keys("0,2  5.5\n0.4;9;0.5\n0.3,7.1\nnot a cut")
    assert page.run(squares) == 3
    assert "not a cut" in page.text("cuts-wrong")
    assert page.run("return document.querySelectorAll('#forces .bar').length;") == 1


def test_the_files_for_the_user(page):
    from xml.etree import ElementTree

    page.open(address(**LIGHT))
    picture = page.run("return pictureOf([plots.map, plots.forces], state);")
    root = ElementTree.fromstring(picture)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert "μ = 0.685 kPa" in "".join(root.itertext())
    lines = page.run("return tableOf(state);").splitlines()
    head = next(line for line in lines if not line.startswith("#")).split(",")
    rows = [dict(zip(head, line.split(","), strict=True)) for line in lines if line[:1] in "apsc"]
    for row in rows[::17]:
        scene = scene_of(LIGHT | {"R_w": float(row["wire_radius_m"])})
        force = cutting_force(scene, "table", law=row["law"])
        assert float(row["force_N_per_m"]) == pytest.approx(force.total, rel=1e-6)
    assert {row["law"] for row in rows} == set(LAW_NAMES)


def test_every_field_has_a_name_and_what_is_said_is_live(page):
    page.open()
    unnamed = page.run(
        "return [...document.querySelectorAll('input, textarea, button, [role=slider]')]"
        ".filter((one) => !one.labels?.length && !one.ariaLabel && !one.textContent)"
        ".map((one) => one.outerHTML);"
    )
    assert unnamed == []
    assert page.element("spoken").get_attribute("aria-live") == "polite"


@pytest.mark.parametrize("width", [1300, 820, 390])
def test_nothing_is_wider_than_the_window(page, width):
    page.open(width=width)
    assert page.run("return document.documentElement.scrollWidth;") <= width
    page.shot(f"gel-{width}")
    page.open(address("slip", xi=0.3, alpha=5.0, R_w=2e-3), width=width)
    page.shot(f"slip-{width}")
    page.open(address("coupled", **LIGHT), width=width)
    page.shot(f"coupled-{width}")
    page.set(address("coupled", **LIGHT | {"xi": 0.9}))
    page.shot(f"beyond-{width}")
    page.set(address(R_w=1e-6))
    page.shot(f"outside-{width}")
    assert page.complaints() == []
