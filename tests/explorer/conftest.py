"""A browser without a window, where one is installed; what it shows is kept below output/."""

import shutil
from pathlib import Path

import pytest

SHOTS = Path(__file__).resolve().parents[2] / "output" / "explorer"
ARGUMENTS = (
    *("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"),
    *("--hide-scrollbars", "--force-device-scale-factor=1", "--lang=en"),
)


def installed(*names):
    return next((path for name in names if (path := shutil.which(name))), None)


class Page:
    """The page in the browser: the address sets its state, what it shows gives its numbers."""

    def __init__(self, driver, address):
        self.driver, self.address = driver, address

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def open(self, state="", width=1300, height=900):
        narrow = width < 600
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": narrow},
        )
        self.driver.get("about:blank")
        self.driver.get(f"{self.address}#{state}")

    def set(self, state):
        self.run(
            "history.replaceState(null, '', '#' + arguments[0]);"
            "window.dispatchEvent(new HashChangeEvent('hashchange'));",
            state,
        )

    def numbers(self):
        """Return what the page shows, each number with all its digits."""
        return dict(
            self.run(
                "return [...document.querySelectorAll('data')]"
                ".map((one) => [one.dataset.name, one.value]);"
            )
        )

    def text(self, name):
        return self.run(f"return document.getElementById('{name}').textContent;")

    def wait(self, condition, seconds=60):
        """Wait until a condition of the page holds."""
        from selenium.webdriver.support.ui import WebDriverWait

        WebDriverWait(self.driver, seconds, 0.05).until(lambda _: self.run(f"return {condition};"))

    def element(self, name):
        return self.driver.find_element("id", name)

    def shot(self, name):
        SHOTS.mkdir(parents=True, exist_ok=True)
        height = self.run("return document.documentElement.scrollHeight;")
        width = self.run("return innerWidth;")
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        self.driver.save_screenshot(str(SHOTS / f"{name}.png"))

    def complaints(self):
        return self.driver.get_log("browser")


@pytest.fixture(scope="session")
def driver():
    webdriver = pytest.importorskip("selenium.webdriver")
    browser, control = installed("chromium", "google-chrome", "chrome"), installed("chromedriver")
    if not (browser and control):
        pytest.skip("no browser: install chromium and chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    for argument in ARGUMENTS:
        options.add_argument(argument)
    service = webdriver.ChromeService(executable_path=control)
    driver = webdriver.Chrome(options=options, service=service)
    yield driver
    driver.quit()


@pytest.fixture(scope="session")
def page(driver, tmp_path_factory):
    from surrogate import read_measurements, write_explorer
    from surrogate.basics.files import model_file

    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    write_explorer(file, cuts=read_measurements(model_file("paam-wire-cutting.csv")))
    return Page(driver, file.as_uri())
