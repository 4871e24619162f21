"""The file of fitted models: what is refused, and that nothing is lost in it."""

import io
import json
import shutil
import zipfile

import numpy as np
import pytest

import surrogate
import surrogate.contact.shipped
from fe_training.validation.surrogates import LARGEST_FILE
from surrogate import InputError, contact_functions, cutting_force
from surrogate.basics.files import checksum_line
from surrogate.contact.shipped import (
    FILE,
    SCHEMA,
    content_of,
    fitted_from,
    read,
    read_fitted,
    to_file,
)


@pytest.fixture
def file(fitted_file, tmp_path):
    """A copy of the file and of its checksum, to be damaged."""
    for name in (FILE, f"{FILE}.sha256"):
        shutil.copy(fitted_file.with_name(name), tmp_path / name)
    return tmp_path / FILE


def rewrite(file, content):
    """Write a file with the checksum that belongs to it."""
    file.write_bytes(content)
    file.with_name(f"{FILE}.sha256").write_bytes(checksum_line(FILE, content))


def changed(file, about=None, **arrays):
    """Write the file anew with some entries changed."""
    told, kept = read_fitted(file)
    rewrite(file, content_of({**told, **(about or {})}, {**kept, **arrays}))


def test_what_is_written_is_read(file):
    told, arrays = read_fitted(file)
    assert told["schema"] == SCHEMA
    assert told["origin"] == "made up"
    assert told["domain"] == {"g": [5e-3, 60.0], "alpha": [2.0, 9.0], "highest": []}
    assert "R_w = 1" in told["units"]
    assert set(told["bounds"]["errors"]) == {"eq13", "power-law", "table", "gp"}
    again = content_of(*to_file(fitted_from(told, arrays)))
    assert again == file.read_bytes()
    assert len(again) < LARGEST_FILE


def test_arrays_cannot_be_written_to(file):
    _, arrays = read_fitted(file)
    assert not any(values.flags.writeable for values in arrays.values())


def test_a_tampered_file_is_refused(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)
    with pytest.raises(InputError, match=r"must match the checksum .* regen-surrogate"):
        read_fitted(file)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.999])
def test_a_truncated_file_is_refused(file, share):
    content = file.read_bytes()
    file.write_bytes(content[: int(share * len(content))])
    with pytest.raises(InputError, match="damaged or incomplete"):
        read_fitted(file)
    rewrite(file, file.read_bytes())  # even if the checksum says that it is whole
    with pytest.raises(InputError, match="cannot be decoded"):
        read_fitted(file)


def test_a_file_without_its_checksum_is_refused(file):
    file.with_name(f"{FILE}.sha256").unlink()
    with pytest.raises(InputError, match=r"sha256 cannot be \(No such file"):
        read_fitted(file)


@pytest.mark.parametrize(
    ("schema", "remedy"),
    [
        ("wirecut-surrogates-3", "upgrade wirecut"),
        ("wirecut-surrogates-10", "upgrade wirecut"),
        ("wirecut-surrogates-0", "regen-surrogate"),
        ("wirecut-campaign-data-1", "regen-surrogate"),
        (7, "regen-surrogate"),
    ],
)
def test_another_schema_is_refused(file, schema, remedy):
    changed(file, {"schema": schema})
    with pytest.raises(InputError, match=f"must have the schema .*{schema}.*{remedy}"):
        read_fitted(file)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_none_are_refused(file, bad):
    values = read_fitted(file)[1]["arc.values"].copy()
    values[3] = bad
    changed(file, **{"arc.values": values})
    with pytest.raises(InputError, match=r"finite numbers only, but arc\.values has others"):
        read_fitted(file)


def replaced_member(content, name, data):
    """Return an archive with one member replaced."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(buffer, "w") as new:
        for member in old.namelist():
            new.writestr(member, data if member == name else old.read(member))
    return buffer.getvalue()


def test_pickles_are_refused(file):
    pickled = io.BytesIO()
    np.save(pickled, np.array([{"any": "object"}], dtype=object), allow_pickle=True)
    rewrite(file, replaced_member(file.read_bytes(), "arc.values.npy", pickled.getvalue()))
    with pytest.raises(InputError, match="cannot be decoded"):
        read_fitted(file)


@pytest.mark.parametrize("word", ["NaN", "Infinity"])
def test_numbers_that_are_none_in_the_text_are_refused(file, word):
    told = json.dumps({**read_fitted(file)[0], "growth": ["here"]}).replace('"here"', word)
    member = io.BytesIO()
    np.save(member, np.frombuffer(told.encode(), dtype=np.uint8))
    rewrite(file, replaced_member(file.read_bytes(), "about.npy", member.getvalue()))
    with pytest.raises(InputError, match=f"{word} is no number"):
        read_fitted(file)


@pytest.mark.parametrize(
    ("about", "arrays"),
    [
        ({"domain": {"g": [1.0]}}, {}),
        ({"prior": {}}, {}),
        ({"grid": {"beyond": 1.0}}, {}),
        ({"constants": None}, {}),
        ({}, {"arc.short": np.zeros((3, 3, 4))}),
        ({}, {"distance.points": np.zeros(5)}),
    ],
)
def test_an_incomplete_file_is_refused(file, about, arrays):
    changed(file, about, **arrays)
    with pytest.raises(InputError, match=r"must be complete, but .* was met"):
        read(str(file))


def test_without_a_file_it_is_said_what_to_do(monkeypatch, tmp_path):
    monkeypatch.setattr(surrogate.contact.shipped, "models_folder", lambda: tmp_path)
    for model in ("power-law", "table", "gp"):
        with pytest.raises(InputError, match=r"not shipped with this version; .*regen-surrogate"):
            contact_functions(1.0, 2.0, model=model)
    with pytest.raises(InputError, match="not shipped with this version"):
        cutting_force(surrogate.Scene(685.0, 1.6, 1e-4, 0.1), "auto")
    assert contact_functions(1.0, 2.0, model="eq13").arc == 2.0
