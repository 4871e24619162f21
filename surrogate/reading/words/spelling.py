"""How names are compared: without capitals, accents and marks."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

__all__ = ["plain"]


@lru_cache(maxsize=4096)
def plain(name: str) -> str:
    """Return a name in small letters without accents, its marks as blanks.

    Examples
    --------
    >>> plain(" Prüf-Kraft_F_ss/T: ")
    'pruf kraft f ss/t'
    """
    letters = unicodedata.normalize("NFKD", name)
    letters = "".join(one for one in letters if not unicodedata.combining(one)).casefold()
    return " ".join(re.sub(r"[_\-.:;,\s#|]+", " ", letters).split()).replace(" / ", "/")
