"""Which nodes touch the wire, where the shear of wear jumps at the ends of the contact.

A node that meets the wire without pressure may carry any shear from 0 to ``tau_w l``: only then is
there always an equilibrium.  Such a node is recognised by going back and forth between the two.
Wear that is tapered does not jump, and needs none.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics.active_set import ActiveSet
from fe_training.mechanics.body import Body
from fe_training.sliding.shear import Load, face_lengths
from fe_training.sliding.state import SlidingState

#: Changes of one node in one equilibrium from which on it counts as grazing, up to which it may,
#: and before Newton's method counts as going in a circle.
_FLIPS, _LAST_FLIPS, _MOST_FLIPS = 2, 6, 9

#: Pull up to which a node that goes on changing is held, relative to the mean force of those that
#: touch.
_HOLD = 0.05


class Ends:
    """Follows the touching nodes through the iterations of one equilibrium.

    Parameters
    ----------
    body : Body
    load : Load
    """

    def __init__(self, body: Body, load: Load) -> None:
        self.body, self.load = body, load
        self.flips: NDArray[np.int64] = np.zeros(len(body.face), dtype=np.int64)

    @property
    def cycled(self) -> bool:
        """Whether a node goes on changing."""
        return bool(self.flips.max(initial=0) > _MOST_FLIPS)

    def settled(self, state: SlidingState, there: SlidingState) -> bool:
        """Return whether a step leaves every node as it was."""
        grazing = (state.grazing == there.grazing).all()
        return bool(grazing) and there.active.same(state.active)

    def _held(self, there: SlidingState) -> NDArray[np.bool_]:
        """Return which nodes stay although they are pulled, having found no rest otherwise."""
        allowed = _HOLD * float(np.abs(there.force).sum()) / max(int(there.active.wire.sum()), 1)
        return np.asarray((self.flips > _LAST_FLIPS) & (there.force > -allowed))

    def updated(self, there: SlidingState) -> SlidingState:
        """Return a state after a step with its touching and grazing nodes brought up to date."""
        before, grazing = there.active, there.grazing
        pressed = np.where(grazing | self._held(there), 0.0, there.force)
        after = contact.updated(self.body, there.u, there.centre, before, pressed)
        wire, grazing = after.wire | (grazing & before.wire), grazing.copy()
        if grazing.any():
            full = self.load.wear * face_lengths(self.body, there)
            lost, gripped = grazing & (there.shear < 0.0), grazing & (there.shear > full)
            wire, grazing = wire & ~lost, grazing & ~lost & ~gripped
            self.flips += lost | gripped
        changed = wire != before.wire
        self.flips += changed
        if self.load.jumps:
            between = changed & (self.flips >= _FLIPS) & ~after.plane
            between &= self.flips <= _LAST_FLIPS
            wire, grazing = wire | between, grazing | between
        return replace(there, active=ActiveSet(wire, after.plane & ~wire), grazing=grazing)
