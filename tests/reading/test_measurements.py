"""Reading files: what is right is read to the last digit, what is wrong is named with its place."""

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from surrogate.basics.files import model_file
from surrogate.errors import InputError
from surrogate.reading.material import PROPERTIES, Material, read_material
from surrogate.reading.measurements import COLUMNS, read_measurements
from surrogate.reading.units import LENGTH, NUMBER, STRESS, parse_quantity

HEADER = "wire_radius_mm,force_per_thickness_N_per_m\n"
in_tmp_path = settings(
    max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def write(tmp_path):
    def write(content):
        file = tmp_path / "cuts.csv"
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    return write


def test_paper_experiment_is_the_published_line():
    measurements = read_measurements(model_file("paam-wire-cutting.csv"))
    radius = [0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3]
    assert measurements.wire_radius.tolist() == radius
    np.testing.assert_allclose(
        measurements.force, 1.6 + 31e3 * measurements.wire_radius, rtol=1e-15
    )
    assert measurements.force_std is None


def test_paper_material():
    assert read_material(model_file("paam-material.json")) == Material(
        shear_modulus=685.0,
        shear_modulus_std=30.0,
        pure_shear_toughness=2.6,
        pure_shear_toughness_std=0.2,
        work_of_fracture=6973.0,
        work_of_fracture_std=500.0,
        friction_coefficient=0.0,
        stiffening_exponent=2.0,
    )


@pytest.mark.parametrize(
    ("header", "row", "expected"),
    [
        ("wire_radius_m,force_per_thickness_J_per_m2", "2e-4,3", (2e-4, 3.0)),
        ("wire_radius_um,force_per_thickness_mN_per_mm", "210,3.5", (210e-6, 3.5)),
        ("wire_radius_µm,force_per_thickness_kN_per_m", "210,0.0035", (210e-6, 3.5)),
        ("wire_diameter_mm,force_per_thickness_N_per_cm", "0.42,0.035", (210e-6, 3.5)),
        ("force_per_thickness_N/m,wire_diameter_cm", "3.5,0.042", (210e-6, 3.5)),
        (' "wire_radius_mm" , force_per_thickness_N_per_m', ' "0.21" , +3.5e0', (210e-6, 3.5)),
    ],
)
def test_units_and_column_order(write, header, row, expected):
    measurements = read_measurements(write(f"{header}\n{row}\n"))
    assert (measurements.wire_radius[0], measurements.force[0]) == expected


def test_comments_empty_lines_byte_order_mark_and_windows_line_ends(write):
    text = (
        "\ufeff# a, b; c\r\n\r\n" + HEADER.strip() + ",force_std_N_per_m\r\n# x\r\n0.1,2,0.25\r\n"
    )
    measurements = read_measurements(write(text))
    assert measurements.wire_radius.tolist() == [1e-4]
    assert measurements.force_std.tolist() == [0.25]


@pytest.mark.parametrize(
    ("content", "place", "reason"),
    [
        ("", "cuts.csv", "is empty"),
        ("# only a comment\n\n", "cuts.csv", "is empty"),
        (HEADER, "line 1", "without measurements"),
        ("wire_radius_mm,force_N\n1,2\n", "line 2, column 2 (force_N)", "thickness is missing"),
        ("wire_radius_mm,,\n1,2,3\n", "line 1", "column 2 ()"),
        ("wire_radius_ell,force_std_N_per_m\n", "line 1, column 1", "end with a unit"),
        ("wire_radius,force_std_N_per_m\n", "line 1, column 1", "wire_radius_mm"),
        ("wire_radius_Pa,force_std_N_per_m\n", "line 1, column 1", "end with a unit"),
        ("#\n" + HEADER.strip() + ",wire_radius_um\n", "line 2, column 3", "again after column 1"),
        (HEADER.strip() + ",wire_radius_mm\n", "line 1, column 3", "again after column 1"),
        (HEADER.strip() + ",wire_diameter_mm\n", "line 1", "both a radius and a diameter"),
        ("force_per_thickness_N_per_m\n1\n", "line 1", "no wire radius"),
        ("wire_radius_mm\n1\n", "line 1", "divide the steady force"),
        (HEADER + "1,\n", "line 2, column 2 (force_per_thickness_N_per_m)", "is empty"),
        (HEADER + "1,2\n1\n", "line 3", "1 value where the header names 2 columns"),
        (HEADER + "0,1,2,5\n", "line 2", "decimal comma"),
        (HEADER + "abc,2\n", "line 2, column 1", "'abc' is not a number"),
        (HEADER + "1,NaN\n", "line 2, column 2", "'NaN' is not a number"),
        (HEADER + "1,inf\n", "line 2, column 2", "not a number"),
        (HEADER + "1_000,2\n", "line 2, column 1", "not a number"),
        (HEADER + "1,2 N\n", "line 2, column 2", "not a number"),
        (HEADER + "1,1e999\n", "line 2, column 2", "not a positive number"),
        (HEADER + "1e-999,1\n", "line 2, column 1", "not a positive number"),
        (HEADER + "0,1\n", "line 2, column 1", "not a positive number"),
        (HEADER + "1,-2\n", "line 2, column 2", "turn the sign"),
        (HEADER + "-1,2\n", "line 2, column 1", "correct it or delete the line"),
        (HEADER.strip() + ",force_std_N_per_m\n1,2,0\n", "line 2, column 3", "delete the column"),
        ("radius,force\n1,2\n", "line 1, column 1 (radius)", "wire_radius_mm"),
        (HEADER.encode() + b"\xb5,1\n", "line 2, column 1", "not a number"),
        (HEADER + "1," * 6000 + "\n", "line 2", "is it a table"),
        (HEADER.encode() + b"\x00,1\n", "line 2, column 1", "not a number"),
    ],
)
def test_error_names_place_and_reason(write, content, place, reason):
    with pytest.raises(InputError) as caught:
        read_measurements(write(content))
    message = str(caught.value)
    assert message.startswith(str(write(content)))
    assert place in message
    assert reason in message
    assert "\n" not in message


@pytest.mark.parametrize("read", [read_measurements, read_material])
@pytest.mark.parametrize("path", [None, 3, [], np.zeros((3, 3))])
def test_what_is_no_path_is_refused(read, path):
    with pytest.raises(InputError, match=r"^a file must be named by text or a path, but is .*$"):
        read(path)


@pytest.mark.parametrize("read", [read_measurements, read_material])
@pytest.mark.parametrize("name", ["missing.csv", ".", "nul\0byte"])
def test_unreadable_file(tmp_path, read, name):
    with pytest.raises(InputError, match=r"cannot be read|not a file name"):
        read(f"{tmp_path}/{name}")


cell = st.text(alphabet="0123456789.eE+-,;#\"' \t\r\n_µNnaif\0\ufeff", max_size=12)
name = st.sampled_from([f"{column}_{unit}" for column in COLUMNS for unit in ("mm", "N_per_m")])


@in_tmp_path
@given(
    header=st.lists(st.one_of(name, cell), max_size=4), body=st.lists(st.lists(cell, max_size=4))
)
def test_any_text_is_read_or_refused(write, header, body):
    text = "\n".join(",".join(row) for row in [header, *body])
    read_or_refuse(read_measurements, write(text))


@in_tmp_path
@given(body=st.binary(max_size=300), with_header=st.booleans())
def test_any_bytes_are_read_or_refused(write, body, with_header):
    read_or_refuse(read_measurements, write(HEADER.encode() * with_header + body))


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda child: st.lists(child, max_size=2) | st.dictionaries(st.text(max_size=3), child),
    max_leaves=5,
)
json_keys = st.sampled_from(["schema", "name", "shear_modulus_Pa", *PROPERTIES]) | st.text()


@in_tmp_path
@given(st.one_of(st.dictionaries(json_keys, json_values, max_size=4), json_values))
def test_any_json_is_read_or_refused(write, value):
    read_or_refuse(read_material, write(json.dumps(value)))


def read_or_refuse(read, file):
    try:
        result = read(file)
    except InputError:
        return
    for value in vars(result).values():
        assert value is None or isinstance(value, tuple) or np.all(np.isfinite(value))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("[1]", "not a JSON object"),
        ("{", "not JSON"),
        ("[" * 90_000, "not JSON"),
        ('{"shear_modulus_Pa": 1, "shear_modulus_kPa": 1}', "again"),
        ('{"shear_modulus_psi": 1}', "end with a unit"),
        ('{"hardness_Pa": 1}', "not known"),
        ('{"shear_modulus_Pa": "685"}', "not a number"),
        ('{"shear_modulus_Pa": NaN}', "not a number"),
        ('{"shear_modulus_Pa": true}', "not a number"),
        ('{"shear_modulus_Pa": -1}', "not a number of 0 or more"),
        ('{"shear_modulus_Pa": 1e999}', "not a number of 0 or more"),
        ('{"schema": "wirecut-material-2"}', "wirecut-material-1"),
    ],
)
def test_material_error_names_reason(write, content, reason):
    with pytest.raises(InputError, match=r"cuts\.csv") as caught:
        read_material(write(content))
    assert reason in str(caught.value)


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("0.2mm", LENGTH, 0.2e-3),
        (" 200 um ", LENGTH, 200e-6),
        ("200µm", LENGTH, 200e-6),
        ("2e-4", LENGTH, 2e-4),
        ("7.75kPa", STRESS, 7750.0),
        ("0.1", NUMBER, 0.1),
    ],
)
def test_quantity_with_unit(text, dimension, expected):
    assert parse_quantity(text, dimension) == expected


@pytest.mark.parametrize("text", ["", "0,2mm", "0.2 ell", "0.2mm2", "0.2 mm mm", "1e9999999m"])
def test_quantity_refused(text):
    with pytest.raises(InputError, match="one of m, cm, mm, um"):
        parse_quantity(text, LENGTH)


def test_a_unit_alone_is_answered_with_its_number():
    with pytest.raises(InputError, match=r"'mm' is a unit without its number; .* such as 1\.5mm"):
        parse_quantity("mm", LENGTH)


def test_number_takes_no_unit():
    with pytest.raises(InputError, match="no unit"):
        parse_quantity("0.1Pa", NUMBER)


def test_the_sign_of_the_exponent_plays_no_part(tmp_path):
    file = tmp_path / "gel.json"
    file.write_text('{"schema": "wirecut-material-1", "stiffening_exponent": -3.5}')
    assert read_material(file).stiffening_exponent == 3.5
