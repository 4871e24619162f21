"""What a column's name means where it is put together of known words, in several languages.

No list holds every name: Drahtdurchmesser, Durchmesser des Drahtes and wire diameter (cut) say the
same. A name means something only if every word of it is known, so that "wire length", "peak force"
and "sample diameter" mean nothing here.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from surrogate.reading.words.spelling import plain

__all__ = ["Phrase", "is_scatter", "record_phrase", "table_phrase"]


class Phrase(NamedTuple):
    """A quantity, "" where a name is not understood, and whether it is one of several trials."""

    quantity: str = ""
    trial: bool = False


_LISTS = {
    "wire": "wire wires draht drahts drahtes nadel fil fils alambre hilo filo fio arame draad drut "
    "drutu tråd needle fiber fibre blade проволока проволоки нить нити струна струны 와이어 철사 "
    "ワイヤ ワイヤー 線 丝 线 钢丝 金属丝",
    "diameter": "diameter diam dia durchmesser durchm diametre diametro srednica ø ⌀ dw диаметр "
    "직경 지름 直径 径",
    "radius": "radius halbmesser rayon radio raggio raio straal promien rw радиус 반경 반지름 半径",
    "force": "force forces load kraft krafte last charge effort fuerza carga forza carico forca "
    "kracht belasting siła kraften сила усилие нагрузка 힘 하중 력 力 荷重 载荷 负荷 負荷 試験力 f",
    "cut": "cutting cut cuts schnitt schneid schneide schneiden coupe decoupe corte taglio ciecia "
    "snij skär резания резки 절단 切断 切割",
    "steady": "steady state steadystate plateau mean average avg mittel mittlere mittlerer "
    "mittelwert stationare stationar konstante moyenne moyen media medio medie promedio constante "
    "estable stazionaria stabile srednia gemiddelde medelvärde средняя среднее установившаяся "
    "стационарная 평균 平均 定常 稳态 ss",
    "thickness": "thickness dicke starke epaisseur espesor spessore espessura dikte grubosc "
    "tjocklek tykkelse толщина толщины 두께 厚度 厚さ 厚み 厚",
    "width": "width breite largeur ancho larghezza largura breedte szerokosc bredd ширина 幅 宽度",
    "sample": "sample specimen gel hydrogel probe proben prufkorper eprouvette echantillon muestra "
    "probeta campione provino amostra monster proefstuk probki prov prøve образца образец геля "
    "시료 "
    "시편 試料 試験片 サンプル 试样 样品",
    "per": "per pro je par por / over на 当たり 每",
    "unit": "unit einheit unite unidad unitaria unitario einheits",
    "of": "of the de des du del della dello dell der die das la le el do da di van von för af av "
    "の の",
    "scatter": "sd stdev dev deviation standardabweichung abweichung streuung scatter ecart "
    "desviacion desv desvio deviazione standaardafwijking odchylenie standardavvikelse отклонение "
    "標準偏差 标准差 표준편차",
    "error": "std se sem stderr error err uncertainty fehler standardfehler unsicherheit erreur "
    "incertitude incertidumbre errore incertezza erro incerteza standaardfout blad ± +/- ошибка "
    "погрешность 標準誤差 误差 표준오차",
    "standard": "standard st type est estandar padrao standardowe стандартное стандартная",
    "trial": "trial run repeat rep replicate replica test measurement messung versuch wiederholung "
    "wdh essai ensayo prova meting repetition repeticion ripetizione mess lauf proef pomiar meas "
    "опыт измерение 試行 測定 시험 试验",
    "travel": "gap spalt displacement extension distance position crosshead stroke travel depth "
    "penetration "
    "disp deformation weg traversenweg verschiebung verlangerung stauchung verformung deplacement "
    "traverse course enfoncement desplazamiento carrera corsa spostamento deslocamento curso "
    "verplaatsing slag przemieszczenie droga forskjutning перемещение ход 변위 스트로크 位移 行程 "
    "変位 ストローク",
    "time": "time zeit temps tiempo tempo tijd czas tid время 시간 时间 時間",
    "machine": "machine maschinen axial axiale compressive compression druck kompressions normal "
    "primary actuator kolben absolute absolut relative corrected korrigiert prüf pruef "
    "elapsed total preload vorkraft from ab "
    "compresion compressione kolbenweg траверсы 圧縮 試験 压缩 试验 压头",
}
_KINDS = {plain(word): kind for kind, words in _LISTS.items() for word in words.split()}
_WIRES = {plain(word) for word in _LISTS["wire"].split()}
_SIZES = {"d": "diameter", "r": "radius"}
"""Letters that are sizes behind a wire."""
_BESIDE_FORCE = frozenset(("force", "cut", "steady", "of"))
_PER = re.compile(r"(?:force )(?:(?:force|cut|steady|of) )*per (?:(?:unit|of|sample) )*")
_PER_SIZE = ("thickness", "width", "thickness of sample", "letter")
_PER_WHAT = {"t", "w", "b", "e", "s"}
"""Letters of thickness and width behind a force and a stroke."""
_ORDINAL = re.compile(r"(?:n[°ºr]?|no|№)?[0-9]{1,3}(?:st|nd|rd|th|ere?|e|eme|[°ºªoa])?")
_NUMBER_MARK = {"n", "n°", "nº", "no", "nr", "№"}
_LETTER = re.compile(r"[a-h]|i{1,3}|iv|v")
_ELISION = re.compile(r"\b(?:d|l|dell|nell|all|sull)['\u2019]")
_SHORTEST_PART = 3
"""Letters of a word within another; shorter ones would be seen everywhere."""


@lru_cache(maxsize=4096)
def table_phrase(name: str) -> Phrase:
    """Return what a name in a table of wires and forces means.

    Parameters
    ----------
    name : str
        Without its unit, as `plain` writes it.

    Examples
    --------
    >>> table_phrase("durchmesser des drahtes").quantity, table_phrase("wire length").quantity
    ('wire_diameter', '')
    >>> table_phrase("cutting force per unit thickness"), table_phrase("1st cut")
    (Phrase(quantity='force_per_thickness', trial=False), Phrase(quantity='trial', trial=True))
    """
    tokens, counted = _uncounted(_tokens(name))
    kinds = _kinds_of(tokens)
    if not kinds:
        return Phrase()
    if counted and {"trial", "cut"} & set(kinds) and set(kinds) <= {"trial", "cut"}:
        return Phrase("trial", True)
    quantity = _table_quantity([kind for kind in kinds if kind != "trial"])
    if counted and quantity not in ("force", "force_per_thickness"):
        return Phrase()
    if "trial" in kinds and not counted:
        return Phrase()
    return Phrase(quantity, counted)


def _table_quantity(kinds: list[str]) -> str:
    core = set(kinds) - {"of"}
    if core & {"scatter", "error"}:
        rest = core - {"scatter", "error", "standard", "cut", "steady"}
        return "force_std" if not rest or _force_of(kinds, spread=True) else ""
    if "wire" in core or core in ({"diameter"}, {"radius"}):
        return _wire_of(core)
    if core and core <= {"thickness", "sample"} and "thickness" in core:
        return "thickness"
    return _force_of(kinds)


def _wire_of(core: set[str]) -> str:
    if core in ({"wire", "radius"}, {"radius"}):
        return "wire_radius"
    # The thickness of a wire is its diameter.
    across = ({"wire", "diameter"}, {"diameter"}, {"wire", "thickness"})
    return "wire_diameter" if core in across else ""


def _force_of(kinds: list[str], spread: bool = False) -> str:
    """Return the quantity of a force by the order of the kinds of words, "" if it is none."""
    if spread:
        kinds = [kind for kind in kinds if kind not in ("scatter", "error", "standard")]
        while kinds and kinds[0] == "of":
            kinds = kinds[1:]
    words = " ".join(kinds) + " "
    start = re.sub(r"^(?:(?:cut|steady) )+force ", "force ", words)
    per = _PER.match(start)
    if per and start[per.end() :].strip() in _PER_SIZE:
        return "force_per_thickness"
    if "force" in kinds and set(kinds) <= _BESIDE_FORCE:
        return "force"
    return ""


@lru_cache(maxsize=4096)
def record_phrase(name: str) -> Phrase:
    """Return what a name in a record of a testing machine means.

    Parameters
    ----------
    name : str
        Without its unit, as `plain` writes it.

    Examples
    --------
    >>> record_phrase("compressive load"), record_phrase("peak load")
    (Phrase(quantity='force', trial=False), Phrase(quantity='', trial=False))
    """
    tokens, counted = _uncounted(_tokens(name))
    kinds = set(_kinds_of(tokens)) - {"of"}
    beside = {"machine", "standard", "cut", "sample", "trial"}
    for kind, quantity in (("travel", "displacement"), ("force", "force"), ("time", "time")):
        if kind in kinds and kinds - beside == {kind}:
            return Phrase(quantity, counted)
    return Phrase()


def is_scatter(name: str) -> bool:
    """Whether a name is that of a standard deviation, not of the error of a mean.

    Examples
    --------
    >>> is_scatter("Deviazione standard"), is_scatter("Standardfehler")
    (True, False)
    """
    kinds = _kinds_of(_tokens(plain(name)))
    return ("scatter" in kinds and "error" not in kinds) or plain(name) in ("dev std", "st dev")


def _tokens(name: str) -> list[str]:
    name = _ELISION.sub("", name).replace("+/ ", "± ").replace("/", " / ")
    tokens = [re.sub(r"^[()\[\]'\"*]+|[()\[\]'\"*]+$", "", token) for token in name.split()]
    return [token for token in tokens if token]


def _uncounted(tokens: list[str]) -> tuple[list[str], bool]:
    """Return the words without the number, or the letter, of a trial among them."""
    counted = [token for token in tokens if _ORDINAL.fullmatch(token)]
    rest = [
        token
        for token, after in zip(tokens, [*tokens, ""][1:], strict=True)
        if not _ORDINAL.fullmatch(token)
        and not (token in _NUMBER_MARK and _ORDINAL.fullmatch(after))
    ]
    if counted:
        return rest, len(counted) == 1
    if rest and len(tokens) > 1 and _LETTER.fullmatch(rest[-1]) and rest[-2] != "/":
        if _KINDS.get(rest[-2]) in ("trial", "cut"):
            return rest[:-1], True
    elif rest and (glued := re.fullmatch(r"(\D+)[0-9]{1,3}", rest[-1])):
        return [*rest[:-1], glued[1]], True
    return rest, False


def _kinds_of(tokens: list[str]) -> list[str]:
    """Return the kind of every word, nothing where one of them is not known."""
    kinds: list[str] = []
    for before, token in zip(["", *tokens], tokens, strict=False):
        if before == "/" and token in _PER_WHAT:
            kinds.append("letter")
        elif before == "f" and token == "c":
            kinds.append("cut")
        elif before in _WIRES and token in _SIZES:
            kinds.append(_SIZES[token])
        elif parts := _parts(token):
            kinds += [_KINDS[part] for part in parts]
        else:
            return []
    return kinds


@lru_cache(maxsize=4096)
def _parts(token: str) -> tuple[str, ...]:
    """Return the known words that a word is put together of, as Drahtdurchmesser is."""
    if token in _KINDS:
        return (token,)
    shortest = _SHORTEST_PART if token.isascii() else 1
    for end in range(len(token) - shortest, shortest - 1, -1):
        head = token[:end]
        tail = _parts(token[end:]) if head in _KINDS else ()
        if tail and all(len(part) >= shortest for part in (head, *tail)):
            return (head, *tail)
    return ()
