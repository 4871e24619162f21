"""Consoles without Unicode, full disks, settings of matplotlib: words, and the same figures."""

import os
import subprocess
import sys

import pytest

from surrogate.cli.main import main

TABLE = "wire_diameter_mm,force_per_thickness_N_per_m\n0.1,2.9\n0.2,4.7\n0.4,7.8\n0.8,13.7\n"
CONSOLES = {
    "ascii": {"PYTHONIOENCODING": "ascii"},
    "C": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "Latin-2": {"PYTHONIOENCODING": "iso8859-2:strict"},
}
STRANGE = """\
text.usetex: True
font.size: 24
font.family: serif
axes.grid: True
axes.facecolor: yellow
lines.linewidth: 7
savefig.bbox: tight
figure.dpi: 33
axes.formatter.use_mathtext: True
axes.prop_cycle: cycler("color", ["r", "g"])
"""


def run(*arguments, env=None, **options):
    return subprocess.run(
        [sys.executable, "-m", "surrogate.cli.main", *arguments],
        env={**os.environ, **(env or {})},
        stderr=subprocess.PIPE,
        timeout=120,
        check=False,
        **options,
    )


@pytest.mark.parametrize("console", CONSOLES.values(), ids=CONSOLES)
def test_letters_that_the_console_does_not_know(console, tmp_path):
    file = tmp_path / "Messung µ 線 é.csv"
    file.write_text("Drahtdurchmesser [µm],F/T [N/m],線\n100,2.9,é\n200,4.7,é\n400,7.8,é\n")
    given = str(file), "--shear-modulus", "685Pa"
    for arguments, code in (
        (["identify", *given], 0),
        (["identify", *given, "--json"], 0),
        (["identify", str(file) + "ø", *given[1:]], 2),
        (["force", "--shear-modulus", "1µ"], 2),
    ):
        done = run(*arguments, env=console, stdout=subprocess.PIPE)
        assert done.returncode == code
        assert b"Traceback" not in done.stderr + done.stdout
        assert done.stdout if code == 0 else done.stderr.startswith(b"wirecut: ")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize(
    "arguments", ["identify --example", "identify --example --json", "models", "force --help"]
)
def test_a_full_disk_is_said_in_one_line(arguments, unbuffered):
    with open("/dev/full", "w") as full:
        done = run(*arguments.split(), env={"PYTHONUNBUFFERED": unbuffered}, stdout=full)
    assert done.returncode == 2
    assert done.stderr.startswith(b"wirecut: what is printed cannot be written")
    assert done.stderr.count(b"\n") == 1
    assert b"No space left" in done.stderr


OUTPUTS = {
    "identify": ["{cuts}", "--shear-modulus", "685Pa", "--plot", "{picture}"],
    "map": ["--preset", "gel", "--nodes", "11", "--out", "{picture}"],
    "steady": ["{record}", "--plot", "{picture}"],
}


@pytest.fixture
def files(tmp_path):
    rows = "".join(f"{0.1 * i:.2f},{0.08 if i > 50 else i / 500:.4f}\n" for i in range(200))
    record, cuts = tmp_path / "record.csv", tmp_path / "cuts.csv"
    record.write_text("displacement_mm,force_N\n" + rows)
    cuts.write_text(TABLE)
    return {"record": record, "cuts": cuts}


def filled(command, files, picture):
    return [command, *(one.format(**files, picture=picture) for one in OUTPUTS[command])]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
@pytest.mark.parametrize("command", OUTPUTS)
def test_a_picture_on_a_full_disk(command, files, tmp_path, capsys):
    pytest.importorskip("matplotlib")
    for ending in ("png", "pdf", "svg"):
        picture = tmp_path / f"full.{ending}"
        picture.symlink_to("/dev/full")
        assert main(filled(command, files, picture)) == 2
        assert "No space left on device" in capsys.readouterr().err


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
@pytest.mark.parametrize("command", OUTPUTS)
def test_pictures_are_the_same_whatever_the_settings(command, ending, files, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    (tmp_path / "matplotlibrc").write_text(STRANGE)
    pictures = []
    for name in ("plain", "strange"):
        picture = tmp_path / f"{name}.{ending}"
        rc = matplotlib.rc_params_from_file(tmp_path / "matplotlibrc", use_default_template=False)
        with matplotlib.rc_context(rc if name == "strange" else {}):
            assert main(filled(command, files, picture)) == 0
            assert matplotlib.rcParams["text.usetex"] == (name == "strange")  # left as it was
        pictures.append(picture.read_bytes())
    assert pictures[0] == pictures[1]
