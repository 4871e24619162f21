"""The paper's experiment under Eq. (13) and a fitted model: Fig. 1c, regime map and misfit."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from fe_training.figure_style import Columns
from fe_training.markdown import markdown_table
from fe_training.paper.laws import Verdict, verdicts
from surrogate import (
    Identification,
    MapPoints,
    Scene,
    identify,
    plot_identification,
    plot_regime_map,
    read_material,
    read_measurements,
    regime_map,
)
from surrogate.basics.figures import SMALL, legend_above
from surrogate.basics.files import model_file
from surrogate.choosing.by_name import force_model
from surrogate.cutting.force import cutting_force
from surrogate.identification.figure import plot_profile
from surrogate.inference.profile import Mode

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Experiment"]

_ORIGIN = "published line"
_LINES = (("-.", "#0072B2"), ((0, (1, 1)), "#009E73"), ("--", "#CC79A7"))
_MARKERS = 3
_BEYOND_END = 1.1
"""Factor above the model's end from which a minimum is one of the forces, not of that end."""
_BESIDE: dict[str, Any] = {"textcoords": "offset points", "fontsize": SMALL}


class Experiment:
    """The shipped experiment, identified by Eq. (13) and by one fitted model.

    Parameters
    ----------
    model : str
        Name of the fitted model.

    Raises
    ------
    WirecutError
        If there is no such model, or it is not shipped.
    """

    def __init__(self, model: str) -> None:
        self.cuts = read_measurements(model_file("paam-wire-cutting.csv"))
        self.gel = read_material(model_file("paam-material.json"))
        self.alpha = self.gel.stiffening_exponent or 2.0
        self.model = model
        self.paper, self.ours = self._identified("eq13"), self._identified(model)

    def _identified(self, model: str, law: str = "projected") -> Identification:
        mu = self.gel.shear_modulus
        assert mu is not None  # the shipped gel has one
        return identify(
            self.cuts.wire_radius,
            self.cuts.force,
            mu,
            stiffening_exponent=self.alpha,
            model=model,
            law=law,
        )

    @property
    def modes(self) -> list[Mode]:
        """The minima that the forces admit, inside the search and the model's range, best first."""
        return self._modes(self.ours)

    def _modes(self, fit: Identification) -> list[Mode]:
        profile = fit.profile
        assert profile is not None  # a fitted model is not linear
        low = force_model(self.model).accepted(False)[0].lower
        least = low * self.ours.shear_modulus * float(self.cuts.wire_radius.max())
        return [
            one
            for one in profile.modes
            if one.admitted and not one.at_end and one.toughness > _BEYOND_END * least
        ]

    def scene(self, mode: Mode, radius: np.ndarray) -> Scene:
        """Return cuts of the gel [m] as one of the minima has it."""
        return Scene(
            shear_modulus=self.ours.shear_modulus,
            toughness=mode.toughness,
            wire_radius=radius,
            wear_strength=mode.wear_strength,
            stiffening_exponent=self.alpha,
        )

    def force_figure(self, ax: Axes) -> Columns:
        """Draw force over radius: Eq. (13) and the fitted model through the same forces, Fig. 1c.

        Parameters
        ----------
        ax : matplotlib.axes.Axes
            Where to draw.

        Returns
        -------
        dict
            Columns: wire radius [m], the forces of Eq. (13) and of each minimum [N/m].
        """
        plot_identification(
            self.paper, ax, pure_shear_toughness=self.gel.pure_shear_toughness, force_label=_ORIGIN
        )
        line = next(one for one in ax.get_lines() if "kPa" in str(one.get_label()))
        line.set_label(f"Eq. (13), {_short(self.paper.toughness)}")
        largest = ax.get_xlim()[1] * 1e-3
        radius = np.linspace(0.0, largest, 202)[1:]
        columns: Columns = {
            ("wire_radius", "m"): radius,
            ("eq13", "N/m"): self.paper.predict(radius),
        }
        upper = force_model(self.model).highest_g(self.alpha)
        for mode, (style, colour) in zip(self.modes, _LINES, strict=False):
            inside = mode.toughness / (self.ours.shear_modulus * radius) <= upper
            force = np.full(radius.size, np.nan)
            force[inside] = cutting_force(
                self.scene(mode, radius[inside]), self.model, law="projected"
            ).total
            label = f"finite elements, {_short(mode.toughness)}"
            ax.plot(1e3 * radius, force, ls=style, color=colour, lw=1.2, label=label)
            columns[f"{self.model}_at_{mode.toughness:.3g}_J_per_m2", "N/m"] = force
        _label_references(ax, self.gel.pure_shear_toughness, self.paper.transition_radius)
        return columns

    def map_figure(self, ax: Axes) -> Columns:
        """Draw the gel's regimes by the fitted model, with the wires where each minimum has them.

        Parameters
        ----------
        ax : matplotlib.axes.Axes
            Where to draw.

        Returns
        -------
        dict
            Columns of the boundaries: equation, R_w/l_e and R_w/l_w [-].
        """
        ranges = ((1e-2, 1e2), (1e-2, 1e2))
        fixed = {"xi": 0.0, "alpha": self.alpha}
        made = regime_map("R_w/l_e", "R_w/l_w", ranges, fixed, self.model, law="projected")
        points = [
            MapPoints(self.scene(mode, self.cuts.wire_radius), f"PAAm, {_toughness(mode)}")
            for mode in self.modes[:_MARKERS]
        ]
        plot_regime_map(made, ax, points, limits=["eq13"])
        lines = [(one, line) for one in made.boundaries for line in one.lines]
        sizes = [len(line) for _, line in lines]
        at = np.concatenate([line for _, line in lines])
        return {
            ("boundary", ""): np.repeat([one.equation for one, _ in lines], sizes),
            ("R_w_over_l_e", ""): at[:, 0],
            ("R_w_over_l_w", ""): at[:, 1],
        }

    def misfit_figure(self, ax: Axes) -> Columns:
        """Draw the misfit over Gamma_o.

        Parameters
        ----------
        ax : matplotlib.axes.Axes
            Where to draw.

        Returns
        -------
        dict
            Columns: toughness [J/m2] and misfit [N2/m2].
        """
        plot_profile(self.ours, ax)
        profile = self.ours.profile
        assert profile is not None
        unit = "" if self.ours.force_std is not None else "N^2/m^2"
        return {("toughness", "J/m^2"): profile.toughness, ("misfit", unit): profile.misfit}

    def table(self) -> str:
        """Return what Eq. (13) and each minimum of the fitted model say of the gel."""
        g = self.paper.dimensionless_toughness
        law = ["Eq. (13)", f"{self.paper.toughness:.3g}", f"{1e-3 * self.paper.wear_strength:.3g}"]
        lines = [[*law, _range(g), _off(self.paper.residuals)]]
        for mode in self.modes:
            scene = self.scene(mode, self.cuts.wire_radius)
            force = cutting_force(scene, self.model, law="projected").total
            lines.append([f"model `{self.model}`", *_row(mode, scene, force - self.cuts.force)])
        head = ["law", r"$\Gamma_o$ [J/m²]", r"$\tau_w$ [kPa]", "$g$ of the wires"]
        return markdown_table([*head, "largest difference [N/m]"], lines)

    @cached_property
    def by_laws(self) -> list[Verdict]:
        """What each law of dissipation, and "auto", makes of the same forces."""
        return verdicts(lambda law: self._identified(self.model, law), self._modes, self.gel)


def _row(mode: Mode, scene: Scene, difference: np.ndarray) -> Iterator[str]:
    yield f"{mode.toughness:.3g}"
    yield f"{1e-3 * mode.wear_strength:.3g}"
    yield _range(np.asarray(scene.toughness / (scene.shear_modulus * scene.wire_radius)))
    yield _off(difference)


def _range(g: np.ndarray) -> str:
    return f"{g.min():.2g} to {g.max():.2g}"


def _off(difference: np.ndarray) -> str:
    return f"{abs(difference).max():.2f}"


def _toughness(mode: Mode) -> str:
    return rf"$\Gamma_o$ = {mode.toughness:.2g} J/m$^2$"


def _short(toughness: float) -> str:
    return rf"{toughness:.2g} J/m$^2$"


def _label_references(ax: Axes, gamma: float | None, star: float) -> None:
    """Name the straight lines where they are, and the others above the axes."""
    if gamma is not None:
        label = rf"$\Gamma$ = {gamma:g} J/m$^2$"
        ax.annotate(label, (ax.get_xlim()[1], gamma), (0, -3), ha="right", va="top", **_BESIDE)
    label = rf"$R_w^*$ = {1e6 * star:.3g} µm"
    ax.annotate(label, (1e3 * star, ax.get_ylim()[1]), (3, 0), va="top", **_BESIDE)
    drawn = ax.get_legend_handles_labels()[0]
    handles = [one for one in drawn if not str(one.get_label()).startswith("$")]
    legend_above(ax, 2, handles)
