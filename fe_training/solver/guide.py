"""A path on a rougher mesh ahead of a cut, which then need not pass what is only on the way.

Newton's method on the fine mesh begins at the rough state, carried over: one or two factorisations
a value, however far it is from the one before.
"""

from __future__ import annotations

from fe_training.solver import path
from fe_training.solver.cut import Cut
from fe_training.solver.equilibrium import Control, State
from fe_training.solver.path import PathStalledError

#: Length of the elements of the rough mesh, relative to those of the fine one.
_COARSER = 2.0


class Guide:
    """Reaches rising values of J on a cut, by its own steps or along a path on a rougher mesh.

    Parameters
    ----------
    cut : Cut
        Whose states are wanted.
    position : float
        Where the wire is raised [R_w].

    Raises
    ------
    PathStalledError
        If the wire could not be raised.
    """

    def __init__(self, cut: Cut, position: float) -> None:
        self.cut, self._position = cut, position
        self._rough: Cut | None = cut.coarser(_COARSER)
        self._ahead = self._rough.raised(position)
        self._state: State | None = None
        #: J/(mu R_w) where the wire is raised, on the rough mesh.
        self.start = self._rough.energy_release_rate(self._ahead)

    def at(self, g: float) -> State:
        """Return the state of the cut at which J = g mu R_w.

        Raises
        ------
        PathStalledError
            If the path to it stalled.
        """
        cut, state = self.cut, self._state
        force = 0.5 * g if state is None else cut.force_at(g, state)
        if state is None or not path.in_one_step(cut.body, state, Control.FORCE, force):
            state = self._carried(force) or state or cut.raised(self._position)
        self._state = cut.at(state, g)
        return self._state

    def _carried(self, force: float) -> State | None:
        """Return the state at a horizontal force; None where the rough mesh does not lead to it."""
        if self._rough is None:
            return None
        try:
            self._ahead = self._rough.pulled(self._ahead, force)
        except PathStalledError:
            self._rough = None
            return None
        return self.cut.carried(self._rough, self._ahead, Control.FORCE)
