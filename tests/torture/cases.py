"""Every public function with arguments that are sound, found by introspection.

A public function with a parameter that has no sound value here is a failure: what is new has to be
given one, and is then tortured like everything else.
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, partial

import surrogate
from surrogate.choosing.by_name import FITTED_NAMES
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.shipped import shipped
from surrogate.errors import WirecutError
from surrogate.scene import NAMES, Scene

from . import exact
from .sound import ALIASES, ARRAYS, BASE, CHOICES, FORCES, OWN, RADII, SCENE, STD

__all__ = ["SCENE", "Case", "cases", "model_names"]

DRAWN = ("plot_force", "plot_gels", "plot_identification", "plot_regime_map")
AUTOMATIC = (
    *("cutting_force", "dissipative_force", "force_gradient", "propagate"),
    *("identify", "transition_radius", "classify"),
)


@dataclass(frozen=True)
class Case:
    """A function with sound arguments.

    Parameters
    ----------
    label : str
        Name, with the model where the function takes one.
    call : callable
        Takes the arguments by keyword.
    arguments : dict
        Sound ones.
    numeric : tuple of str
        Those that are numbers or arrays of numbers.
    exact : callable or None
        Gives the exact results for numbers, one for each result of `values`.
    values : callable
        Gives the results that `exact` speaks of.
    tolerance : float
        Relative error that is admitted.
    aliases : tuple of str
        Other names by which an error may speak of an argument.
    slow : bool
        Whether a call takes more than some milliseconds.
    """

    label: str
    call: Callable
    arguments: dict
    numeric: tuple = ()
    exact: Callable | None = None
    values: Callable = field(default=lambda result: (result,))
    tolerance: float = 1e-13
    aliases: tuple = ()
    slow: bool = False


OF_ONE_SCENE = ("write_explorer",)
"""Functions whose scene is of single numbers, and given as it is."""


@cache
def model_names():
    """Return the models that this installation can evaluate."""
    try:
        return (*FORCE_MODELS, *shipped().models, "auto")
    except WirecutError:
        return tuple(FORCE_MODELS)


def _function_names():
    for name in surrogate.__all__:
        thing = getattr(surrogate, name)
        if inspect.isfunction(thing):
            yield name, thing


def cases(drawn=True):
    """Return all cases.

    Raises
    ------
    LookupError
        If a public function has a parameter without a sound value here.
    """
    found = [*_of_scene(), *_of_results()]
    for name, function in _function_names():
        if name in DRAWN and not drawn:
            continue
        found.extend(_cases_of(name, function))
    return found


def _sound(name, parameters):
    own = OWN.get(name, {})
    values = {}
    for parameter in parameters:
        if parameter in ("scene", "model"):
            continue
        known = own if parameter in own else _made() if parameter in _made() else BASE
        if parameter not in known:
            raise LookupError(f"{name}: no sound value of {parameter!r} in torture/sound.py")
        values[parameter] = known[parameter]
    return values


@cache
def _made():
    return {
        "identification": surrogate.identify(RADII, FORCES, 685.0, force_std=STD),
        "identifications": {
            name: surrogate.identify(RADII, FORCES, 685.0, force_std=std, model="eq13")
            for name, std in (("A", STD), ("B", 0.3))
        },
        "made": surrogate.regime_map("R_w", "Gamma_o", BASE["ranges"], BASE["fixed"], nodes=5),
    }


def _cases_of(name, function):
    parameters = list(inspect.signature(function).parameters)
    arguments = _sound(name, parameters)
    models = model_names() if "model" in parameters else (None,)
    if name in (*DRAWN, "design_wires") and "model" in parameters:
        models = ("eq13",)  # drawing is slow, and the other models are tortured without it
    for model in models:
        if model == "auto" and name not in AUTOMATIC:
            continue
        case = _case(name, function, parameters, arguments, model)
        if case is not None:
            yield case
    if "scene" in parameters:
        yield Case(f"{name}: scene", partial(function, **arguments), {"scene": Scene(**SCENE)})
    for chosen, changed in CHOICES.get(name, {}).items():
        yield Case(
            f"{name}: {chosen}",
            function,
            {**arguments, **changed},
            aliases=ALIASES.get(name, ()),
            slow=True,
        )


def _case(name, function, parameters, arguments, model):
    fixed = {} if model is None else {"model": model}
    label = name if model is None else f"{name}: {model}"
    fitted = model in (*FITTED_NAMES, "auto")
    aliases = (*ALIASES.get(name, ()), *(("g", "alpha") if fitted else ()))
    searches = name == "transition_radius" and fitted
    slow = searches or name in ("identify", "design_wires", "regime_map", *DRAWN)
    if name == "identify" and model in ("high-toughness", "eq9"):
        return None  # without wear there is nothing to identify
    if "scene" in parameters and name not in OF_ONE_SCENE:
        quantities = _quantities(name, model)

        def call(**given):
            rest = {k: given.pop(k) for k in list(given) if k not in NAMES}
            return function(scene=Scene(**{**SCENE, **given}), **rest, **fixed)

        arguments = {**{q: SCENE[q] for q in quantities}, **arguments}
    else:

        def call(**given):
            return function(**{**fixed, **given})

        if model is not None and name in ("identify", "regime_map"):
            arguments = {**arguments, "model": model}
    if name == "contact_functions" and model in FORCE_MODELS:
        arguments.pop("rtol", None)  # closed forms have no measured errors
    reference, values, tolerance = _exact(name, model)
    numeric = tuple(a for a in arguments if a in ARRAYS and name not in ("identify", "regime_map"))
    return Case(label, call, arguments, numeric, reference, values, tolerance, aliases, slow)


def _quantities(name, model):
    if name == "wear_transition_radius":
        return ("toughness", "wear_strength")
    if name == "transition_radius":
        return tuple(n for n in NAMES if n != "wire_radius")
    return NAMES


def _of_scene():
    """Yield the properties of a scene."""
    for name, over, under in (
        ("dimensionless_toughness", ("toughness",), ("shear_modulus", "wire_radius")),
        ("elasto_cohesive_length", ("toughness",), ("shear_modulus",)),
        ("wear_length", ("toughness",), ("wear_strength",)),
    ):

        def call(name=name, **given):
            return getattr(Scene(**{**SCENE, **given}), name)

        def ratio(under=under, **given):
            divisor = exact.mp(1)
            for one in under:
                divisor *= exact.mp(given[one])
            return (exact.over(given["toughness"], divisor),)

        names = (*over, *under)
        yield Case(f"Scene.{name}", call, {n: SCENE[n] for n in names}, names, ratio)


def _of_results():
    """Yield the methods of results that take arguments."""
    fit, made = _made()["identification"], _made()["made"]
    for name in ("predict", "predict_std", "band"):
        yield Case(f"Identification.{name}", getattr(fit, name), {"wire_radius": 3e-4})
    yield Case("Identification.scene", fit.scene, {"wire_radius": 3e-4})
    yield Case("RegimeMap.scene_at", made.scene_at, {"x": 1e-4, "y": 1.0}, aliases=NAMES)
    yield Case("RegimeMap.locate", made.locate, {"scene": Scene(**SCENE)})
    yield Case("RegimeMap.difference", made.difference, {"model": "high-toughness"})
    design = surrogate.design_radii(1e-4, 5e-4, force_std=0.5)
    yield Case("Design.gain_over", design.gain_over, {"wire_radius": RADII}, aliases=("radi",))
    yield Case(
        "MapPoints",
        surrogate.MapPoints,
        {"scene": Scene(**SCENE), "label": "gel", "std": {"toughness": 0.1}},
        aliases=("standard error", "dimension"),
    )


def _exact(name, model):
    """Return reference, results that it speaks of, and tolerance, of a function."""
    nothing = None, lambda result: (result,), 1e-13
    if model is not None and model not in FORCE_MODELS:
        return nothing
    if name in _PLAIN:
        return (lambda **a: (_PLAIN[name](**{k: exact.mp(v) for k, v in a.items()}),)), *nothing[1:]
    if name == "cutting_force":
        of = lambda f: (f.total, f.cleavage, f.friction, f.wear)  # noqa: E731
        return (lambda rtol, extrapolate, **a: exact.FORCE[model](**_short(a))), of, 1e-13
    if name == "force_gradient":
        of = lambda f: tuple(getattr(f, n) for n in NAMES)  # noqa: E731
        return (lambda **a: exact.GRADIENT[model](**_short(a))), of, 1e-13
    if name == "transition_radius":
        return (lambda **a: (exact.RADIUS[model](**_short(a)),)), *nothing[1:]
    if name == "wear_transition_radius":
        divided = lambda toughness, wear_strength: (  # noqa: E731
            exact.over(toughness, 4 * exact.mp(wear_strength)),
        )
        return divided, *nothing[1:]
    if name == "dissipative_force":

        def dissipation(g, alpha, friction_coefficient, relative_wear_strength, **_):
            scene = 1, g, 1, friction_coefficient, relative_wear_strength, alpha
            *_, friction, worn = exact.FORCE[model](*scene)
            return (friction + worn,)

        return dissipation, *nothing[1:]
    if name == "contact_functions":
        of = lambda f: (f.arc, f.normal_load, f.delta)  # noqa: E731
        return (lambda g, alpha, **_: exact.CONTACT[model](g, alpha)), of, 1e-13
    if name == "energy_release_rate":
        return (lambda delta, **_: (1 / exact.mp(delta) ** 2,)), *nothing[1:]
    return nothing


def _short(arguments):
    letters = dict(zip(NAMES, ("mu", "gamma", "radius", "xi", "wear", "alpha"), strict=True))
    return {letters[name]: value for name, value in arguments.items() if name in letters}


def _proportion(a, b, c):
    return a * b / c if c != exact.INF else exact.mp(0)


_PLAIN = {
    "far_field_energy_release_rate": lambda relative_distance: 1 / relative_distance**2,
    "power_law_exponent": lambda stiffening_exponent: exact.exponent(stiffening_exponent),
    "power_law_dissipation": lambda g, friction_coefficient, exponent: (
        friction_coefficient * g**exponent if friction_coefficient else exact.mp(0)
    ),
    "high_toughness_force": lambda toughness, friction_coefficient: (
        toughness * (1 + friction_coefficient)
    ),
    "low_toughness_dissipation": lambda friction_coefficient, relative_wear_strength: (
        4 * (friction_coefficient + relative_wear_strength)
    ),
    "low_toughness_force": (
        lambda shear_modulus, toughness, wire_radius, friction_coefficient, wear_strength: (
            toughness + 4 * (wear_strength + friction_coefficient * shear_modulus) * wire_radius
        )
    ),
    "general_force": (
        lambda shear_modulus, toughness, wire_radius, friction_coefficient, wear_strength: (
            (1 + friction_coefficient) * toughness
            + 4 * (wear_strength + friction_coefficient * shear_modulus) * wire_radius
        )
    ),
    "relative_force": (
        lambda wire_radius, elasto_cohesive_length, friction_coefficient, relative_wear_strength: (
            1
            + friction_coefficient
            + 4
            * _proportion(
                friction_coefficient + relative_wear_strength, wire_radius, elasto_cohesive_length
            )
        )
    ),
    "friction_free_relative_force": lambda wire_radius, wear_length: (
        1 + 4 * _proportion(1, wire_radius, wear_length)
    ),
    "fracto_cohesive_transition_radius": lambda toughness, work_of_fracture: exact.over(
        toughness, 4 * work_of_fracture
    ),
}
