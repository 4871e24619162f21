"""The lines of a text file, whatever its encoding: what machines and spreadsheets write."""

from __future__ import annotations

import codecs

from surrogate.basics.files import opened
from surrogate.errors import InputError

__all__ = ["LARGEST_FILE", "read_lines"]

LARGEST_FILE = 30_000_000
"""Half a million rows of three numbers; reading takes some fifteen times as much memory [bytes]."""

LONGEST_LINE = 10_000
_CHUNK = 100_000
_CONTROL = bytes(set(range(32)) - set(b"\t\n\v\f\r\x1a"))
_FEWEST_ODD = 5

_ACCENTED = ("épaisseur", "Épaisseur", "iamètre", "éplacement", "Prüf", "für", "iámetro", "Ø")
_WORDS = {
    ("cp932", "Shift-JIS"): ("試験力", "荷重", "変位", "ストローク", "線径", "厚さ"),
    ("gb18030", "GB18030"): ("位移", "时间", "载荷", "负荷", "线径", "直径", "厚度"),
    ("euc_jp", "EUC-JP"): ("試験力", "荷重", "変位", "ストローク", "線径", "厚さ"),
    ("cp949", "CP949"): ("직경", "지름", "하중", "변위", "두께", "시간"),
    ("cp1250", "CP1250"): ("siła", "Siła", "średnica", "Średnica", "grubość", "Grubość"),
    ("cp1251", "CP1251"): ("иаметр", "олщина", "Сила", "сила", "силие", "агрузка", "еремещение"),
    ("mac_roman", "Mac Roman"): _ACCENTED,
    ("cp850", "CP850"): _ACCENTED,
}
"""Encodings that are told from CP1252 by a word that a table has in them."""

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig", "UTF-8"),
    (codecs.BOM_UTF16_LE, "utf-16", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16", "UTF-16"),
)


def read_lines(file: str, encoding: str | None = None) -> tuple[list[str], str]:
    """Read a text file.

    Parameters
    ----------
    file : str
        Its name.
    encoding : str, optional
        Name of its encoding. By default a byte-order mark tells it, then the zeros that UTF-16
        has in every second place; then it is UTF-8 where the bytes are; then another, such as
        Shift-JIS, GB18030, CP1251 or Mac Roman, where a word of a table shows it, and else CP1252,
        which differs from Latin-1 in no letter.

    Returns
    -------
    lines : list of str
        The lines without their ends.
    encoding : str
        Which one it was.

    Raises
    ------
    InputError
        If the file cannot be read, is no text, or has a line of 10 000 characters.
    """
    raw = _content(file)
    codec, name = (encoding, encoding) if encoding else _encoding_of(raw)
    if not codec.lower().startswith(("utf-16", "utf-32")):
        _refuse_binary(file, raw[:_CHUNK])
    lines = _decoded(file, raw, codec, name).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for number, line in enumerate(lines, start=1):
        if len(line) >= LONGEST_LINE:
            raise InputError(
                f"{file}, line {number} has {LONGEST_LINE} characters or more; is it a table?"
            )
    return lines, name


def _content(file: str) -> bytes:
    raw = bytearray()
    with opened(file) as stream:
        try:
            while chunk := stream.read(_CHUNK):  # what a pipe will give is not known before
                raw += chunk
                if len(raw) > LARGEST_FILE:
                    raise InputError(
                        f"{file} has more than {LARGEST_FILE // 10**6} megabytes; is it a table? "
                        "Export fewer points."
                    )
        except OSError as error:
            raise InputError(
                f"{file} cannot be read ({error.strerror}); give the path of a file."
            ) from None
    return bytes(raw)


def _refuse_binary(file: str, start: bytes) -> None:
    """Refuse pictures, archives and the like, whose bytes any table of letters would read."""
    odd = len(start) - len(start.translate(None, _CONTROL))
    if odd >= _FEWEST_ODD and odd > 0.01 * len(start):
        raise InputError(
            f"{file} is no text ({odd} of its first {len(start)} bytes are of no letter); export "
            "the table as CSV, or as .xlsx with that ending."
        )


def _encoding_of(raw: bytes) -> tuple[str, str]:
    for mark, codec, name in _MARKS:
        if raw.startswith(mark):
            return codec, name
    start = raw[:2000]
    if len(start) >= 4 and start.count(0) > 0.3 * len(start):
        odd = start[1::2].count(0) > start[::2].count(0)
        return ("utf-16-le", "UTF-16 LE") if odd else ("utf-16-be", "UTF-16 BE")
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return next(filter(lambda one: _shows(raw, one), _WORDS), ("cp1252", "CP1252"))
    return "utf-8", "UTF-8"


def _shows(raw: bytes, encoding: tuple[str, str]) -> bool:
    """Whether a file is text in an encoding, with one of the words that tell it."""
    try:
        text = raw.decode(encoding[0])
    except UnicodeDecodeError:
        return False
    return any(word in text for word in _WORDS[encoding])


def _decoded(file: str, raw: bytes, codec: str, name: str) -> str:
    try:
        return raw.decode(codec).removeprefix("\ufeff")
    except (LookupError, ValueError, TypeError) as error:
        if not isinstance(error, UnicodeError):
            raise InputError(
                f"{codec!r} is no encoding; give one such as utf-8, utf-16 or cp1252."
            ) from None
        line = raw[: getattr(error, "start", 0)].count(b"\n") + 1
        raise InputError(
            f"{file}, line {line} is no text in {name} (byte {getattr(error, 'start', 0) + 1} of "
            "the file); name its encoding by --encoding (encoding= in Python) or save it as 'CSV "
            "UTF-8'."
        ) from None
