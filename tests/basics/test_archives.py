"""Archives of arrays: what numpy and zipfile raise for damage comes out as one kind of error."""

import io
import struct
import zipfile

import numpy as np
import pytest

from surrogate.basics.files import read_archive


def member(header):
    """Return an archive with one array whose header is a text."""
    text = header.encode()
    content = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("x.npy", content + bytes(8))
    return buffer.getvalue()


def test_a_sound_header_is_read():
    sound = "{'descr': '<f8', 'fortran_order': False, 'shape': (1,)}\n"
    np.testing.assert_array_equal(read_archive(member(sound))["x"], [0.0])


ARRAYS = {
    "numbers": np.arange(3),
    "single": np.linspace(0.0, 1.0, 6, dtype=np.float32).reshape(2, 3),
    "alone": np.array(2.5),
    "empty": np.zeros((0, 3)),
    "other ends first": np.array([1, 515], ">u2"),
    "columns first": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
    "words": np.array(["a", "bc"]),
    "truth": np.array([True, False]),
}


def test_arrays_of_all_kinds_come_back():
    buffer = io.BytesIO()
    np.savez(buffer, **ARRAYS)
    read = read_archive(buffer.getvalue())
    assert read.keys() == ARRAYS.keys()
    for name, array in ARRAYS.items():
        assert (read[name].dtype, read[name].shape) == (array.dtype, array.shape)
        np.testing.assert_array_equal(read[name], array)


@pytest.mark.parametrize(
    "header",
    [
        "{'descr': '<f8', 'shape': (1,\n",  # numpy reads it with tokenize, which has its own error
        "{'descr': '|O', 'fortran_order': False, 'shape': (1,)}\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (10**9,)}\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1x,), }\n",
        "{'descr': '<f7', 'fortran_order': False, 'shape': (1,), }\n",
        "((((((((((\n",
        "",
    ],
)
def test_a_damaged_header_is_an_error(header):
    with pytest.raises(ValueError, match="no archive of arrays"):
        read_archive(member(header))
