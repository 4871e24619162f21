"""A part of `damage`, for every shipped file and a row of a campaign."""

from pathlib import Path

import pytest

pytest.importorskip("h5py", reason="the extra 'train' is not installed")

from .damage import damage, kinds


def test_damaged_files_are_refused_and_execute_nothing():
    part = damage(number=25)
    assert part.total > 100
    assert not part.failures


def test_every_shipped_file_that_has_a_checksum_is_damaged(tmp_path):
    from surrogate.basics.files import models_folder

    summed = {path.name.removesuffix(".sha256") for path in Path(models_folder()).glob("*.sha256")}
    assert summed <= {name for name, (*_, summed) in kinds(tmp_path).items() if summed}
