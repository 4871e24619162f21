"""Names of the columns of a table of wires and forces, in several languages."""

from __future__ import annotations

import re

from surrogate.reading.headings import meaning, split_unit, vocabulary
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE, Dimension
from surrogate.reading.words.phrases import table_phrase

__all__ = ["COLUMNS", "COUNT", "DEVIATION", "SAMPLE", "WORDS", "is_force", "means"]

COLUMNS: dict[str, Dimension] = {
    "wire_radius": LENGTH,
    "wire_diameter": LENGTH,
    "force_per_thickness": LINE_FORCE,
    "force_std": LINE_FORCE,
    "force": FORCE,
    "thickness": LENGTH,
}
"""Quantities that a table of measurements may hold."""

_FORCES = (("force_per_thickness", LINE_FORCE), ("force", FORCE))
_SPREAD = (
    "std,stdev,std dev,st dev,sd,se,sem,stderr,std err,standard error,standard deviation,error,"
    "std error,uncertainty,+/-,±,fehler,standardfehler,standardabweichung,ecart type,erreur type,"
    "desviacion estandar,error estandar,deviazione standard,errore standard,desvio padrao,"
    "standaardafwijking,odchylenie standardowe,标准差,標準偏差,標準誤差"
)
WORDS = vocabulary(
    {
        "wire_radius": [("wire_radius", LENGTH)],
        "wire_diameter": [("wire_diameter", LENGTH)],
        "force_per_thickness": [("force_per_thickness", LINE_FORCE)],
        "force": [("force", FORCE), ("force_per_thickness", LINE_FORCE)],
        "force_std": [("force_std", LINE_FORCE), ("total_std", FORCE)],
        "thickness": [("thickness", LENGTH)],
        "trial": _FORCES,
    },
    {
        "wire_radius": "wire_radius,radius,r,r_w,rw,radius of wire,drahtradius,radius wire,"
        "needle radius,blade radius,fiber radius,fibre radius,rayon,rayon du fil,radio,"
        "radio del alambre,radio del hilo,raggio,raggio filo,raggio del filo,raio,raio do fio,"
        "straal,promien,promien drutu,半径",
        "wire_diameter": "wire_diameter,diameter,d,d_w,dw,dia,wire dia,wire diam,wire,wire size,"
        "2r,2r_w,2rw,2 r,2 r_w,2*r,"
        "diameter of wire,drahtdurchmesser,durchmesser,draht,needle diameter,ø,wire ø,draht ø,"
        "fiber diameter,fibre diameter,⌀,diametre,diametre du fil,diametre fil,fil,diametro,"
        "diametro del alambre,diametro alambre,diametro del hilo,diametro hilo,diametro filo,"
        "diametro del filo,diametro do fio,diametro fio,draaddiameter,diameter draad,srednica,"
        "srednica drutu,tråddiameter,线径,丝径,直径,线直径,線径,ワイヤ径,ワイヤー径",
        "force_per_thickness": "force_per_thickness,f_ss/t,fss/t,f/t,f_ss per t,force/thickness,"
        "steady force per thickness,cutting force per thickness,mean force per thickness,"
        "steady state force per thickness,force per width,line force,f/b,f/w,"
        "kraft pro dicke,kraft je dicke,kraft/dicke,linienkraft,force par epaisseur,"
        "force/epaisseur,f/e,fuerza por espesor,fuerza/espesor,forza per spessore,"
        "forza/spessore,f/s,forca/espessura,kracht/dikte,kracht per dikte,siła/grubosc",
        "force": "force,f,f_ss,fss,steady force,steady state force,cutting force,mean force,"
        "average force,steady_state_force,plateau force,load,mean load,steady load,kraft,"
        "schnittkraft,mittlere kraft,last,force mean,force de coupe,fuerza,fuerza de corte,carga,"
        "forza,forza di taglio,forca,forca de corte,kracht,snijkracht,siła,siła ciecia,skärkraft,"
        "力,切割力,切断力,荷重,切断荷重,載荷,载荷",
        "force_std": ",".join(
            f"{quantity}{words}"
            for words in _SPREAD.split(",")
            for quantity in ("", "force ", "load ", "f/t ", "f_ss/t ", "force per thickness ")
        ),
        "thickness": "thickness,sample thickness,specimen thickness,t,gel thickness,dicke,"
        "probendicke,thickness of sample,thickness of the sample,epaisseur,espesor,spessore,"
        "espessura,dikte,grubosc,tjocklek,厚度,厚さ,厚み",
        "trial": "trial n,run n,repeat n,rep n,replicate n,test n,measurement n,messung n,"
        "versuch n,cut n,schnitt n,wiederholung n,essai n,ensayo n,prova n,meting n",
    },
    table_phrase,
)
COUNT = {"n", "count", "number", "anzahl", "number of cuts", "number of tests", "repeats", "cuts"}
DEVIATION = re.compile(
    r"\b(sd|stdev|std dev|st dev|standard deviation|standardabweichung|ecart type|"
    r"desviacion estandar|deviazione standard|desvio padrao|standaardafwijking|"
    r"odchylenie standardowe|标准差|標準偏差)\b"
)
SAMPLE = {
    *("sample", "gel", "specimen", "material", "probe", "batch", "sample id", "charge", "hydrogel"),
    *(
        "echantillon",
        "eprouvette",
        "muestra",
        "campione",
        "provino",
        "amostra",
        "monster",
        "probka",
    ),
    *("试样", "样品", "試料", "試験片", "サンプル"),
}
"""What a column that names samples is called."""


def means(name: str, *quantities: str) -> bool:
    """Whether the name of a column, with its unit or without, may mean one of some quantities.

    Examples
    --------
    >>> means("wire diameter [mm]", "wire_diameter"), means("remark", *COLUMNS)
    (True, False)
    """
    meanings, _ = meaning(split_unit(name, WORDS)[0], WORDS)
    return any(quantity in quantities for quantity, _ in meanings)


def is_force(name: str) -> bool:
    """Whether the name of a column is that of a force.

    Examples
    --------
    >>> is_force("Kraft (mN)"), is_force("thickness")
    (True, False)
    """
    return means(name, "force", "force_per_thickness")
