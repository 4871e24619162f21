"""A wire in a block of finite height: what the size of a specimen and its sides do to a cut.

The block has half height H above the cut, its length is many times that.  The end ahead of the tip
does not move along the cut, the end behind it is free.  Its side at Y = H

- slides on rollers (u_y = 0, no shear),
- is free, or
- is glued (u = 0).

With rollers and with a free side the cut is steady: the block looks the same from every tip.
"""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import astuple, dataclass
from enum import Enum
from pathlib import Path

import numpy as np
from skfem import Basis

from fe_training.markdown import markdown_table, plain
from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, block_mesh
from fe_training.paper.power_laws import fit_power, reached_from
from fe_training.solver.cut import Cut, Settings
from fe_training.solver.equilibrium import Control, State
from fe_training.solver.path import PathStalledError
from fe_training.solver.record import Record
from fe_training.solver.solve import far_field_cut
from surrogate.errors import InputError

__all__ = ["block_table", "evidence", "group", "interpolated", "size_table"]

#: Half length of a block over its half height, beyond the wire: end effects fall as
#: exp(-pi X/(2 H)) or faster.
_LENGTH = 5.0

#: Half width of the fine part of the mesh under the wire [R_w].
_WINDOW = 1.6


class Side(Enum):
    """How the side of a block at Y = H is held."""

    ROLLERS = "rollers"
    FREE = "free"
    GLUED = "glued"


class Block(Body):
    """The half block as a body; `hold` is the value of a :class:`Side`."""

    def _number_unknowns(self, basis: Basis, hold: str) -> None:
        facets = self.mesh.boundary_facets()
        middle = self.mesh.p[:, self.mesh.facets[:, facets]].mean(axis=1)
        height, end = self.mesh.p[1].max(), self.mesh.p[0].max()
        side = middle[1] > height * (1.0 - 1e-9)
        ahead, behind = (sign * middle[0] > end * (1.0 - 1e-9) for sign in (1.0, -1.0))
        ligament = (middle[1] == 0.0) & (middle[0] > 0.0)
        face = np.unique(
            basis.get_dofs(facets=facets[~(side | ahead | behind | ligament)]).flatten()
        )
        self.face = face[self._from_tip(face)]
        held = np.zeros((len(self.nodes), 2), dtype=bool)
        nodes = {
            name: basis.get_dofs(facets=facets[which]).flatten()
            for name, which in (("side", side), ("ahead", ahead), ("ligament", ligament))
        }
        held[nodes["ligament"], 1] = True
        held[nodes["ahead"], 0] = True
        held[nodes["side"], 1] = hold != Side.FREE.value
        held[nodes["side"], 0] |= hold == Side.GLUED.value
        self.held = held
        self.free = np.concatenate([~held.ravel(), np.ones(len(self.pressure_places), dtype=bool)])


def block_cut(
    alpha: float, half_height: float, side: Side, depth: float, settings: Settings
) -> Cut:
    """Return a block on a mesh that is fine under a wire at the distance `depth` from the tip.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    half_height : float
        H [R_w].
    side : Side
        How the side is held.
    depth : float
        Distance of the wire behind the reference tip [R_w]; negative ahead of it.
    settings : Settings
        Mesh, bulk term, solver; the outer radius is not used.
    """
    spec = MeshSpec(
        notch_radius=min(max(settings.notch_radius, 5e-4 * depth), 0.02),
        outer_radius=half_height,
        sectors=4 * round(settings.sectors / 4),
        contact_start=max(depth - _WINDOW, 0.0),
        contact_end=max(depth, 1.0) + _WINDOW,
        contact_spacing=settings.contact_spacing,
        growth=0.25,
    )

    def build(alpha: float, spec: MeshSpec, settings: Settings) -> Body:
        mesh = block_mesh(spec, _LENGTH * half_height + max(depth, 0.0))
        return Block(mesh, alpha, settings.bulk, side.value)

    return Cut(alpha, spec, settings, build)


def raised(cut: Cut, depth: float) -> State:
    """Return the state with the wire raised at `depth`, the ends of its contact made fine."""
    return cut.sharpened(cut.raised(-depth), Control.POSITION)


@dataclass(frozen=True, slots=True)
class Case:
    """One configuration of the study.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    half_height : float
        H [R_w]; infinite for the large body.
    side : str
        A value of :class:`Side`; "none" for the large body.
    depth : float
        Distance of the wire behind the reference tip [R_w].
    """

    alpha: float
    half_height: float
    side: str
    depth: float


@dataclass(frozen=True, slots=True)
class Result:
    """What came out of a case; nan where it was not reached.

    Parameters
    ----------
    case : Case
    energy_release_rate : float
        g = J/(mu R_w) [-].
    distance : float
        delta [R_w].
    arc, normal_load : float
        A and B [-].
    force_mismatch : float
        |J - 2 F_h|/J [-].
    unknowns : int
    outcome : str
        Name of an outcome of :class:`fe_training.solver.record.Outcome`.
    """

    case: Case
    energy_release_rate: float
    distance: float
    arc: float
    normal_load: float
    force_mismatch: float
    unknowns: int
    outcome: str


#: Head of the file of results: names with units, in the order of the fields.
COLUMNS = (
    "alpha_-",
    "half_height_R_w",
    "side",
    "depth_R_w",
    "energy_release_rate_mu_R_w",
    "distance_R_w",
    "arc_-",
    "normal_load_mu_R_w",
    "force_mismatch_-",
    "unknowns",
    "outcome",
)

#: The meshes of the study: a compromise, |J - 2 F_h|/J stays below 3e-3.
STUDY_SETTINGS = Settings(sectors=20, contact_spacing=0.08)
_HEIGHTS = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
_DEPTHS = (0.8, 1.2, 1.7, 2.5, 4.0, 6.0, 10.0, 15.0, 20.0)
_SPOT_HEIGHTS, _SPOT_DEPTHS = (10.0, 50.0, 200.0), (1.2, 2.5, 6.0)

#: A wire is put no deeper than this share of H: J falls like an exponential beyond.
_DEEPEST = 0.7


def cases() -> list[Case]:
    """Return the cases of the study: alpha = 2 in full, 5 and 9 at single heights."""
    steady = (Side.ROLLERS.value, Side.FREE.value)
    wanted: dict[float, tuple[tuple[float, ...], tuple[float, ...]]] = {
        2.0: (_HEIGHTS, _DEPTHS),
        5.0: (_SPOT_HEIGHTS, _SPOT_DEPTHS),
        9.0: (_SPOT_HEIGHTS, _SPOT_DEPTHS),
    }
    found = []
    for alpha, (heights, depths) in wanted.items():
        found += [Case(alpha, math.inf, "none", depth) for depth in depths]
        found += [
            Case(alpha, height, side, depth)
            for height in heights
            for side in steady
            for depth in depths
            if depth <= _DEEPEST * height
        ]
    return found


def solve_case(case: Case, settings: Settings = STUDY_SETTINGS) -> Result:
    """Return the result of one case; a wire that could not be raised is a result as well."""
    if math.isinf(case.half_height):
        cut = far_field_cut(case.alpha, case.depth, settings)
    else:
        side = Side(case.side)
        cut = block_cut(case.alpha, case.half_height, side, case.depth, settings)
    try:
        record = cut.record(raised(cut, case.depth))
    except PathStalledError as error:
        record = cut.failure(error)
    return _result(case, record)


def _result(case: Case, record: Record) -> Result:
    return Result(
        case,
        record.energy_release_rate,
        record.distance,
        record.arc,
        record.normal_load,
        record.force_mismatch,
        record.unknowns,
        record.outcome.name,
    )


def add_result(file: Path, result: Result) -> None:
    """Append one result to the file of results, so that it survives whatever comes next."""
    new = not file.exists() or not file.stat().st_size
    with file.open("a", newline="", encoding="utf-8") as out:
        writer = csv.writer(out, lineterminator="\n")
        if new:
            writer.writerow(COLUMNS)
        writer.writerow([*astuple(result.case), *astuple(result)[1:]])
        out.flush()
        os.fsync(out.fileno())


def read_results(file: Path) -> list[Result]:
    """Return the results in a file.

    Raises
    ------
    InputError
        If the file is not one of results, or a line is damaged.
    """
    try:
        with file.open(newline="", encoding="utf-8") as lines:
            head, *rows = csv.reader(lines)
    except (ValueError, csv.Error) as error:  # no text, or nothing at all
        raise InputError(f"{file} is no file of specimens: {error}") from None
    if tuple(head) != COLUMNS:
        raise InputError(f"{file} is no file of specimens: its head is {','.join(head)[:80]!r}")
    return [_read(file, number, row) for number, row in enumerate(rows, 2)]


def _read(file: Path, number: int, row: Sequence[str]) -> Result:
    try:
        if len(row) != len(COLUMNS):
            raise ValueError(f"{len(row)} cells, {len(COLUMNS)} are wanted")
        alpha, height, side, depth, g, distance, arc, load, mismatch, unknowns, outcome = row
        return Result(
            Case(float(alpha), float(height), side, float(depth)),
            energy_release_rate=float(g),
            distance=float(distance),
            arc=float(arc),
            normal_load=float(load),
            force_mismatch=float(mismatch),
            unknowns=int(unknowns),
            outcome=outcome,
        )
    except ValueError as error:
        raise InputError(
            f"{file}, line {number}: {error}; delete the line to solve it again"
        ) from None


def missing(file: Path) -> Iterator[Case]:
    """Yield the cases of the study that the file has no line for."""
    done = {result.case for result in read_results(file)} if file.exists() else set()
    yield from (case for case in cases() if case not in done)


#: delta/R_w between which the exponent of J is fitted: those of the paper's Fig. 2c.
_FITTED = (1.05, 16.0)
_TOLERANCES = (0.05, 0.01)
_SIDES = ("rollers", "free")
_QUANTITIES: dict[str, tuple[Callable[[Result], float], Callable[[Result], float]]] = {
    "J at delta": (lambda r: r.distance, lambda r: r.energy_release_rate),
    "A at g": (lambda r: r.energy_release_rate, lambda r: r.arc),
    "B at g": (lambda r: r.energy_release_rate, lambda r: r.normal_load),
}
_WANTED = (
    *(("J at delta", x) for x in (2.0, 5.0, 10.0)),
    *((kind, x) for kind in ("A at g", "B at g") for x in (0.02, 0.1, 0.3)),
)


def group(results: Sequence[Result], alpha: float) -> dict[tuple[str, float], list[Result]]:
    """Return the results of one alpha by side and half height, from the tip outwards."""
    found: dict[tuple[str, float], list[Result]] = {}
    for one in results:
        if one.case.alpha == alpha and np.isfinite(one.energy_release_rate):
            found.setdefault((one.case.side, one.case.half_height), []).append(one)
    for rows in found.values():
        rows.sort(key=lambda one: one.distance)
    return dict(sorted(found.items()))


def interpolated(rows: Sequence[Result], kind: str, at: float) -> float:
    """Return a quantity at a distance or a g [-], nan outside what was solved."""
    x_of, y_of = _QUANTITIES[kind]
    pairs = np.array(sorted((x_of(one), y_of(one)) for one in rows))
    if not pairs[0, 0] <= at <= pairs[-1, 0]:
        return float("nan")
    return float(np.exp(np.interp(np.log(at), *np.log(pairs.T))))


def evidence(results: Sequence[Result]) -> str:
    """Return in words how the cases ended, and the largest |J - 2 F_h|/J."""
    reached = [one for one in results if np.isfinite(one.energy_release_rate)]
    mismatch = np.array([one.force_mismatch for one in reached])
    case = reached[int(mismatch.argmax())].case
    size = (
        f"at $H = {case.half_height:g} R_w$" if case.half_height < np.inf else "in the large body"
    )
    return (
        f"{len(reached)} of {len(results)} cases were reached. The median of $|J - 2 F_h|/J$ is "
        f"{np.median(mismatch):.1g}, 95 % are below {np.quantile(mismatch, 0.95):.1g}, and the "
        f"largest is {mismatch.max():.1g}, {size}, {case.side}, $\\alpha$ = {case.alpha:g}."
    )


def size_table(results: Sequence[Result], alpha: float) -> str:
    """Return H/R_w from which the large body's values hold within 5 % and 1 %."""
    groups = group(results, alpha)
    large = groups["none", np.inf]
    lines = []
    for kind, x in _WANTED:
        limit = interpolated(large, kind, x)
        cells = [f"{kind} = {x:g}"]
        for side in _SIDES:
            pairs = [
                (height, interpolated(rows, kind, x))
                for (held, height), rows in groups.items()
                if held == side
            ]
            known = np.array([pair for pair in pairs if np.isfinite(pair[1])])
            for tolerance in _TOLERANCES:
                enough = len(known) > 1 and np.isfinite(limit)
                size = (
                    reached_from(known[:, 0], known[:, 1], limit, tolerance) if enough else np.nan
                )
                cells.append(_size(size, known))
        lines.append(cells)
    head = [f"{side}, {100 * t:g} %" for side in _SIDES for t in _TOLERANCES]
    return markdown_table(["quantity", *head], lines)


def _size(size: float, known: np.ndarray) -> str:
    if np.isnan(size):
        return "-"
    if np.isinf(size):
        return f"above {known[-1, 0]:g}"
    return plain(size) if size > known[0, 0] else f"up from {size:g}"


def block_table(results: Sequence[Result], alphas: Sequence[float]) -> str:
    """Return, for each block, power laws of J by two definitions of delta, and A and B.

    The distance is that of the deformed tip, or of the tip before deformation.
    """
    lines = []
    for alpha in alphas:
        for (side, height), rows in group(results, alpha).items():
            low, high = _FITTED
            inside = [one for one in rows if low < one.distance < high]
            if len(inside) < 3:
                continue
            J = [one.energy_release_rate for one in inside]
            delta, depth = [one.distance for one in inside], [one.case.depth for one in inside]
            deformed, reference = fit_power(delta, J), fit_power(depth, J)
            A, B = ([getattr(one, name) for one in rows] for name in ("arc", "normal_load"))
            lines.append(
                [
                    f"{alpha:g}",
                    "-" if np.isinf(height) else f"{height:g}",
                    "large body" if np.isinf(height) else side,
                    f"{min(delta):.2f} to {max(delta):.1f}",
                    f"{deformed.exponent:.2f}",
                    f"{deformed.r_squared:.3f}",
                    f"{reference.exponent:.2f}",
                    f"{min(A):.2f} to {max(A):.2f}",
                    f"{min(B):.2f} to {max(B):.2f}",
                ]
            )
    head = [r"$\alpha$", "$H/R_w$", "side", r"$\delta/R_w$", r"$n$ of $J(\delta)$", "$r^2$"]
    return markdown_table([*head, "$n$ by reference", "$A$", "$B$"], lines)
