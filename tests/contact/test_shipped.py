"""The file of fitted models: what is refused, and that nothing is lost in it."""

import dataclasses
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
from surrogate.contact.closed_forms import FORCE_MODELS
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
        ({"tip": [3.0, 0.2, 4.0]}, {}),
        ({}, {"points": np.zeros((5, 2))}),
        ({}, {"distance.rows": np.zeros(5)}),
    ],
)
def test_an_incomplete_file_is_refused(file, about, arrays):
    changed(file, about, **arrays)
    with pytest.raises(InputError, match=r"must be complete, but .* was met"):
        read(str(file))


def test_without_a_file_it_is_said_what_to_do(monkeypatch, tmp_path):
    monkeypatch.setattr(surrogate.contact.shipped, "models_folder", lambda: tmp_path)
    words = r"among the models in use, but .* has none; make it with regen-surrogate"
    for model in ("power-law", "table", "gp"):
        with pytest.raises(InputError, match=words):
            contact_functions(1.0, 2.0, model=model)
    with pytest.raises(InputError, match=r"must have the file surrogates\.npz"):
        cutting_force(surrogate.Scene(685.0, 1.6, 1e-4, 0.1), "auto")
    assert contact_functions(1.0, 2.0, model="eq13").arc == 2.0


def test_models_of_ones_own_are_used_everywhere_until_they_are_given_back(file, capsys):
    surrogate.load_models()
    before = contact_functions(1.0, 3.0).normal_load
    try:
        told = {info.name: info for info in surrogate.load_models(file.parent)}
        assert told["table"].domain == "g from 0.005 to 60, alpha from 2 to 9"
        own = contact_functions(1.0, 3.0)
        assert own.normal_load != before
        assert own.normal_load == surrogate.contact.shipped.read(str(file)).models[
            "table"
        ].normal_load(1.0, 3.0)
        with pytest.raises(InputError, match="cannot be"):
            surrogate.load_models(file.with_name("none.npz"))
        assert contact_functions(1.0, 3.0).normal_load == own.normal_load
    finally:
        surrogate.load_models()
    assert contact_functions(1.0, 3.0).normal_load == before


def test_the_environment_names_models_too(file, monkeypatch):
    before = contact_functions(1.0, 3.0).normal_load
    monkeypatch.setenv("WIRECUT_MODELS", str(file))
    assert contact_functions(1.0, 3.0).normal_load != before


class Doubled(type(FORCE_MODELS["eq13"])):
    """A model of one's own: twice the arc of Eq. (13)."""

    def arc(self, g, alpha):
        return 2.0 * super().arc(g, alpha)

    def terms(self, mu, gamma, radius, xi, wear, alpha):
        friction, worn = super().terms(mu, gamma, radius, xi, wear, alpha)
        return friction, 2.0 * worn


def test_a_model_of_ones_own_is_taken_where_a_name_is():
    eq13 = FORCE_MODELS["eq13"]
    own = Doubled(*(getattr(eq13, field.name) for field in dataclasses.fields(eq13)))
    scene = surrogate.Scene(685.0, 1.6, 0.5e-3, wear_strength=7750.0)
    assert cutting_force(scene, model=own).wear == 2.0 * cutting_force(scene, model="eq13").wear
    assert contact_functions(1.0, 2.0, model=own).arc == 4.0
    assert surrogate.force_gradient(scene, model=own).model == "eq13"
    with pytest.raises(surrogate.UnknownModelError, match="ForceModel of one's own"):
        cutting_force(scene, model=object())


def tampered(arrays, name, change):
    values = np.array(arrays[name])
    with np.errstate(all="ignore"):
        changed = {
            "emptied": values[:0],
            "doubled": 2 * values,
            "negated": -values,
            "huge": values * values.dtype.type(1e300) if values.dtype.kind == "f" else values * 7,
        }[change]
    return {**arrays, name: changed}


@pytest.mark.parametrize("change", ["emptied", "doubled", "negated", "huge"])
def test_arrays_that_were_changed_are_refused_whatever_the_checksum_says(file, change):
    content = file.read_bytes()
    members = dict(np.load(io.BytesIO(content)))
    told = members.pop("about")
    for name in members:
        buffer = io.BytesIO()
        np.savez(buffer, about=told, **tampered(members, name, change))
        rewrite(file, buffer.getvalue())
        with pytest.raises(InputError, match=r"changed since|finite numbers|complete|decoded"):
            fitted_from(*read_fitted(file))


@pytest.mark.parametrize("name", ["table", "power-law"])
def test_other_answers_than_the_stored_ones_are_refused(file, name):
    told, arrays = read_fitted(file)
    told["answers"][name][0][1] *= 1.0 + 1e-6
    rewrite(file, content_of(told, arrays))
    with pytest.raises(InputError, match=f"other answers of '{name}'"):
        fitted_from(*read_fitted(file))
