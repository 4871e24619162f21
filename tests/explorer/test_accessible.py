"""The page for keyboards and screen readers: what the checker axe finds, the order of tabs."""

from pathlib import Path

import pytest

from tests.explorer.test_browser import GEL, LIGHT, address

WIDTHS = 1300, 390


@pytest.fixture(scope="session")
def axe():
    package = pytest.importorskip("axe_core_python")
    return Path(package.__file__).with_name("axe.min.js").read_text(encoding="utf-8")


def violations(page, axe):
    """Return what axe objects to, with the place and the reason of each."""
    page.run(axe)
    told = page.driver.execute_async_script(
        "const done = arguments[arguments.length - 1];"
        "axe.run(document, {resultTypes: ['violations']})"
        ".then((answer) => done(answer.violations), (error) => done([{id: String(error)}]));"
    )
    return [
        (one["id"], node["target"], node.get("failureSummary"))
        for one in told
        for node in one.get("nodes", [{"target": "the check itself"}])
    ]


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_has_no_objection(page, axe, width, scheme):
    feature = {"name": "prefers-color-scheme", "value": scheme}
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})
    try:
        for state in (
            address("auto"),
            address("coupled", **LIGHT),
            address("coupled", **LIGHT | {"xi": 0.9}),
            address(R_w=1e-6),
        ):
            page.open(state, width=width)
            assert violations(page, axe) == []
    finally:
        page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_axe_objects_to_a_field_without_a_name(page, axe):
    page.open()
    page.run("document.body.append(document.createElement('input'));")
    assert any(kind == "label" for kind, *_ in violations(page, axe))


def test_the_tab_key_goes_through_the_page_from_top_to_bottom(page):
    webdriver = pytest.importorskip("selenium.webdriver")
    page.open(address())
    order = []
    for _ in range(60):
        webdriver.ActionChains(page.driver).send_keys(webdriver.Keys.TAB).perform()
        name = page.run("return document.activeElement.id || document.activeElement.name;")
        if not name or name in order:
            break
        order.append(name)
    quantities = "mu", "Gamma_o", "tau_w", "xi", "alpha", "R_w"
    fields = [f"{kind}-{key}" for key in quantities for kind in ("field", "slider")]
    assert order == [
        *fields,
        *("diameters", "law", "reset", "point", "wire", "cuts-file", "cuts"),
        *("copy-link", "save-picture", "save-numbers"),
    ]
    assert GEL["mu"] == page.run("return state.mu;")  # which a look around does not change
