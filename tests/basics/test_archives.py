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


@pytest.mark.parametrize(
    "header",
    [
        "{'descr': '<f8', 'shape': (1,\n",  # numpy reads it with tokenize, which has its own error
        "{'descr': '|O', 'fortran_order': False, 'shape': (1,)}\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (10**9,)}\n",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}\n",
        "((((((((((\n",
        "",
    ],
)
def test_a_damaged_header_is_an_error(header):
    with pytest.raises(ValueError, match="no archive of arrays"):
        read_archive(member(header))
