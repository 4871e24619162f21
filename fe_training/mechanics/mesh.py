"""Meshes of the half body around a crack, graded from the notch out to the far field.

The reference body is the half disc ``Y >= 0`` of radius L.  The crack runs along ``Y = 0, X < 0``
and ends in a notch of small radius r0 about the origin instead of a mathematical point: every
element then has a finite stretch, and the limit of a sharp crack is approached as r0 falls (the
error is of order r0).  Rings grow geometrically, so a body of
1e7 wire radii costs little more than one of 1e3.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import MeshTri

Array = NDArray[np.float64]

#: Rings beyond this radius carry only the smooth far field and may grow faster.
_NEAR_FIELD = 6.0
_LARGEST_RATIO = 2.0


@dataclass(frozen=True, slots=True)
class MeshSpec:
    """What determines a mesh of the half body; lengths in wire radii.

    Parameters
    ----------
    notch_radius : float
        Radius r0 of the notch at the crack tip [R_w].
    outer_radius : float
        Radius L of the body [R_w].
    sectors : int
        Number of sectors over the half circle; the rings follow from it, so that elements are
        about as long as wide.
    contact_start, contact_end : float
        The part of the crack face, as distances from the tip, that the wire may touch [R_w].
    contact_spacing : float
        Largest element on that part, relative to the distance from the tip and never above half
        of this fraction of the wire radius.
    growth : float
        An element may be this much longer per unit distance from the contact [-].
    """

    notch_radius: float = 5e-4
    outer_radius: float = 1e7
    sectors: int = 36
    contact_start: float = 0.0
    contact_end: float = 3.0
    contact_spacing: float = 0.05
    growth: float = 0.35

    def refined(self, factor: float = 2.0) -> MeshSpec:
        """Return the specification with elements smaller by `factor`."""
        return replace(
            self,
            sectors=round(self.sectors * factor),
            contact_spacing=self.contact_spacing / factor,
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the fields as a plain dictionary."""
        return asdict(self)


def crack_mesh(spec: MeshSpec) -> MeshTri:
    """Return the triangulated half body.

    Parameters
    ----------
    spec : MeshSpec
        Radii, number of sectors and contact window [R_w].

    Returns
    -------
    skfem.MeshTri
        Straight-sided triangles; ``Y = 0`` holds exactly on the crack face and the ligament.

    Examples
    --------
    >>> mesh = crack_mesh(MeshSpec(notch_radius=0.01, outer_radius=100.0, sectors=12))
    >>> float(mesh.p[1].min())
    0.0
    """
    return _fine_under_contact(_half_annulus(_ring_radii(spec), spec.sectors), spec)


def block_mesh(spec: MeshSpec, half_length: float) -> MeshTri:
    """Return the triangulated half block, |X| up to half its length, Y up to `spec.outer_radius`.

    Rings around the notch go over into squares; blocks of elements that grow along X follow at
    both ends.

    Parameters
    ----------
    spec : MeshSpec
        Its outer radius is the half height of the block; the sectors must be a multiple of four,
        so that the corners of the square are nodes.
    half_length : float
        Half the length of the block, above its half height [R_w].

    Returns
    -------
    skfem.MeshTri

    Examples
    --------
    >>> spec = MeshSpec(notch_radius=0.01, outer_radius=10.0, sectors=12)
    >>> mesh = block_mesh(spec, half_length=40.0)
    >>> mesh.p.max(axis=1).tolist(), mesh.p.min(axis=1).tolist()
    ([40.0, 10.0], [-40.0, 0.0])
    """
    height = spec.outer_radius
    ring = _half_annulus(_ring_radii(spec), spec.sectors)
    r = np.hypot(*ring.p)
    share = np.log(np.maximum(r / spec.notch_radius, 1.0)) / np.log(height / spec.notch_radius)
    points = ring.p * (1.0 + share**4 * (r / np.abs(ring.p).max(axis=0) - 1.0))
    outer = np.abs(r / height - 1.0) < 1e-9
    on_side = outer & (np.abs(np.abs(points) / height - 1.0) < 1e-9)
    points = np.where(on_side, np.sign(points) * height, points)
    points[1][ring.p[1] == 0.0] = 0.0
    points = np.ascontiguousarray(points)
    side = np.sort(points[1, points[0] == height])
    steps = [height]
    width = float(np.diff(side).max())
    while steps[-1] < half_length:
        steps.append(steps[-1] + width)
        width *= 1.0 + np.pi / spec.sectors
    along = height + (np.array(steps) - height) * (half_length - height) / (steps[-1] - height)
    along[0], along[-1] = height, half_length
    ends = MeshTri.init_tensor(along, side), MeshTri.init_tensor(-along[::-1], side)
    return _fine_under_contact(MeshTri(points, ring.t) + ends[0] + ends[1], spec)


def _fine_under_contact(mesh: MeshTri, spec: MeshSpec) -> MeshTri:
    for _ in range(12):
        marked = _too_long(mesh, spec)
        if not len(marked):
            break
        mesh = mesh.refined(marked)
    return mesh


def _ring_radii(spec: MeshSpec) -> Array:
    ratio = 1.0 + np.pi / spec.sectors
    near = max(_NEAR_FIELD, 2.0 * spec.contact_end)
    radii = [spec.notch_radius]
    while radii[-1] < min(near, spec.outer_radius):
        radii.append(radii[-1] * ratio)
    while radii[-1] < spec.outer_radius:
        ratio = min(_LARGEST_RATIO, 1.0 + (ratio - 1.0) * 1.1)
        radii.append(radii[-1] * ratio)
    scaled = np.array(radii)
    stretched: Array = scaled * (spec.outer_radius / scaled[-1]) ** (
        np.log(scaled / scaled[0]) / np.log(scaled[-1] / scaled[0])
    )
    return stretched


def _half_annulus(radii: Array, sectors: int) -> MeshTri:
    """Return triangles between concentric half circles, diagonals alternating."""
    angles = np.linspace(0.0, np.pi, sectors + 1)
    cos, sin = np.cos(angles), np.sin(angles)
    cos[-1], sin[0], sin[-1] = -1.0, 0.0, 0.0
    points = np.array([np.outer(radii, cos), np.outer(radii, sin)]).reshape(2, -1)
    ring, sector = np.meshgrid(np.arange(len(radii) - 1), np.arange(sectors), indexing="ij")
    k, j = ring.ravel(), sector.ravel()
    a = k * (sectors + 1) + j
    b, d = a + 1, a + sectors + 1
    c = d + 1
    even = (k + j) % 2 == 0
    first = np.where(even, [a, d, c], [a, d, b])
    second = np.where(even, [a, c, b], [b, d, c])
    return MeshTri(points, np.hstack([first, second]))


def _too_long(mesh: MeshTri, spec: MeshSpec) -> NDArray[np.int64]:
    """Return the elements that are longer than the size wanted near the contact."""
    corners = mesh.p[:, mesh.t]
    longest = np.hypot(*(corners - np.roll(corners, 1, axis=1))).max(axis=0)
    centre = corners.mean(axis=1)
    face = np.clip(-centre[0], spec.contact_start, spec.contact_end)
    distance = np.hypot(centre[0] + face, centre[1])
    wanted = spec.contact_spacing * np.clip(face, spec.notch_radius, 0.5)
    r = np.hypot(*centre)
    outside = r < 4.0 * spec.notch_radius
    wanted = np.where(outside, np.inf, wanted + spec.growth * distance)
    return np.flatnonzero(longest > 1.5 * wanted)
