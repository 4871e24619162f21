"""Pictures: what they draw, and that they leave everything else as it was."""

import matplotlib
import numpy as np
import pytest
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from fe_training.mechanics.analytic import far_field_wedge
from fe_training.solver.cut import RESOLUTIONS
from fe_training.solver.pictures import (
    plot_configuration,
    plot_energy_release_rate,
    plot_stress_ahead,
)
from fe_training.solver.record import Outcome, Record
from fe_training.solver.solve import indentation_cut
from surrogate.basics.figures import WIDTHS
from surrogate.errors import InputError, WirecutError


@pytest.fixture(scope="module")
def cut():
    """Return a body of alpha = 9; a wire at -1.2 has g of about 0.6."""
    return indentation_cut(9.0, RESOLUTIONS["coarse"])


@pytest.fixture(scope="module")
def state(cut):
    """Return the wire raised behind the tip."""
    return cut.raised(-1.2)


@pytest.fixture(scope="module")
def record(cut, state):
    """Return the record of that state."""
    return cut.record(state)


@pytest.fixture
def ax():
    """Return axes that no window knows of."""
    return Figure(figsize=(3.5, 3.4), layout="constrained").add_subplot()


def boxes(figure):
    """Return the extents of everything that is written around the axes, in pixels."""
    figure.canvas.draw()
    texts = []
    for axes in figure.axes:
        texts += [axes.xaxis.label, axes.yaxis.label, axes.title, axes.get_legend()]
        for labels, limits, i in (
            (axes.get_xticklabels(), axes.get_xlim(), 0),
            (axes.get_yticklabels(), axes.get_ylim(), 1),
        ):
            low, high = limits
            texts += [label for label in labels if low <= label.get_position()[i] <= high]
    extents = [text.get_window_extent() for text in texts if text]
    return [box for box in extents if box.width > 1 and box.height > 1]


def test_a_configuration_is_mesh_wire_and_pressure(cut, state, ax):
    assert plot_configuration(cut.body, state, ax) is ax
    (wire,) = [patch for patch in ax.patches if isinstance(patch, Circle)]
    assert wire.center == pytest.approx(state.centre)
    assert wire.radius == 1.0
    filled = [c for c in ax.collections if isinstance(c, PolyCollection)]
    assert len(filled) == 2  # the half model and its mirror image
    assert filled[0].get_array().min() >= 1.0 - 1e-6
    for collection in filled:
        assert type(collection.norm).__name__ == "LogNorm"
    assert ax.get_aspect() == 1.0


def test_pressure_normals_point_to_the_centre_and_stay_in_the_wire(cut, state, ax):
    plot_configuration(cut.body, state, ax)
    normals = [c for c in ax.collections if isinstance(c, LineCollection) and c.zorder == 4]
    segments = np.concatenate([c.get_segments() for c in normals]) - state.centre
    outer, inner = np.hypot(*segments[:, 0].T), np.hypot(*segments[:, 1].T)
    assert outer == pytest.approx(np.ones(len(outer)))
    assert (inner > 0.39).all()
    assert (inner <= 1.0).all()
    across = segments[:, 0, 0] * segments[:, 1, 1] - segments[:, 0, 1] * segments[:, 1, 0]
    assert np.abs(across).max() < 1e-12


def test_the_wire_touches_the_mesh_that_is_drawn(cut, state, ax):
    """No vertex of a drawn triangle is deeper in the wire than the sag of a curved edge."""
    plot_configuration(cut.body, state, ax)
    drawn = next(c for c in ax.collections if isinstance(c, PolyCollection))
    places = np.concatenate([path.vertices for path in drawn.get_paths()])
    assert np.hypot(*(places - state.centre).T).min() == pytest.approx(1.0, abs=5e-3)


def test_the_rate_stands_beside_its_two_limits(record, ax):
    failed = Record(9.0, Outcome.STALLED, reason="stalled")
    assert plot_energy_release_rate([record, failed], ax) is ax
    lines = {line.get_label(): line for line in ax.lines}
    delta, eq5 = lines[r"Eq. (5), $(R_w/\delta)^2$"].get_data()
    assert eq5 == pytest.approx(delta**-2.0)
    delta, linear = lines["linear wedge limit"].get_data()
    assert linear == pytest.approx(far_field_wedge(delta).energy_release_rate)
    points = [np.array(line.get_xydata()) for line in ax.lines if line.get_linestyle() == "None"]
    points = np.concatenate(points)
    assert points == pytest.approx(np.array([[record.distance, record.energy_release_rate]]))
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")


def test_markers_are_hollow_where_the_evidence_is_not_enough(ax):
    records = [
        Record(5.0, outcome, energy_release_rate=rate, distance=1.0 / rate)
        for outcome, rate in [(Outcome.CONVERGED, 0.5), (Outcome.OUTSIDE_EVIDENCE, 0.1)]
    ]
    plot_energy_release_rate(records, ax)
    white = [line for line in ax.lines if line.get_markerfacecolor() == "white"]
    (hollow,) = [line for line in white if len(line.get_xdata())]
    assert hollow.get_xdata() == pytest.approx([10.0])


def test_the_stress_begins_beyond_the_notch_and_falls(record, ax):
    assert plot_stress_ahead([record], ax) is ax
    r, stress = next(line for line in ax.lines if line.get_zorder() == 3).get_data()
    assert r.min() > 5 * record.mesh["notch_radius"]
    assert stress[0] > 2 * stress[-1] > 0
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")


def test_the_neo_hookean_field_is_drawn_for_alpha_2_only(ax):
    r = np.geomspace(0.01, 10.0, 30)
    records = [
        Record(
            alpha,
            Outcome.CONVERGED,
            energy_release_rate=1.0,
            distance=1.4,
            ahead_reference=r,
            ahead_stress=1.0 / (np.pi * r),
        )
        for alpha in (2.0, 5.0)
    ]
    plot_stress_ahead(records, ax)
    fields = [line for line in ax.lines if line.get_linestyle() == "-." and len(line.get_xdata())]
    assert len(fields) == 1
    x, y = fields[0].get_data()
    assert y == pytest.approx(1.0 / (np.pi * x))


def test_of_many_configurations_six_are_drawn_with_both_ends(ax):
    r = np.geomspace(0.01, 10.0, 5)
    records = [
        Record(
            5.0,
            Outcome.CONVERGED,
            energy_release_rate=1.0 / delta,
            distance=delta,
            ahead_reference=r,
            ahead_stress=1.0 / r,
        )
        for delta in range(20, 1, -1)
    ]
    plot_stress_ahead(records, ax)
    labels = [line.get_label() for line in ax.lines if line.get_zorder() == 3]
    assert len(labels) == 6
    assert "= 2, " in labels[0]
    assert "= 20, " in labels[-1]


@pytest.mark.parametrize("kind", ["configuration", "rate", "stress"])
def test_new_figures_fit_a_column_and_nothing_overlaps(kind, cut, state, record):
    plt = pytest.importorskip("matplotlib.pyplot")
    with matplotlib.rc_context():
        before = dict(matplotlib.rcParams)
        made = {
            "configuration": lambda: plot_configuration(cut.body, state),
            "rate": lambda: plot_energy_release_rate([record]),
            "stress": lambda: plot_stress_ahead([record]),
        }[kind]()
        figure = made.figure
        try:
            assert dict(matplotlib.rcParams) == before
            assert 25.4 * figure.get_figwidth() == pytest.approx(25.4 * WIDTHS["single"])
            found = boxes(figure)
            assert len(found) > 5
            width, height = figure.canvas.get_width_height()
            for i, box in enumerate(found):
                assert box.x0 > -1
                assert box.y0 > -1
                assert box.x1 < width + 1
                assert box.y1 < height + 1
                assert not any(box.overlaps(other) for other in found[i + 1 :])
        finally:
            plt.close(figure)


@pytest.mark.parametrize("plot", [plot_energy_release_rate, plot_stress_ahead])
@pytest.mark.parametrize("records", [[], [Record(2.0, Outcome.STALLED)]])
def test_nothing_reached_is_an_error(plot, records):
    with pytest.raises(InputError, match="has been reached"):
        plot(records)


def test_without_matplotlib_the_error_names_the_extra(monkeypatch, cut, state):
    monkeypatch.setattr("surrogate.basics.extras.find_spec", lambda name: None)
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[plot\]'"):
        plot_configuration(cut.body, state)
