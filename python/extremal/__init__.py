# SPDX-License-Identifier: GPL-3.0-or-later
"""Generalized Galerkin variational integrators.

>>> import extremal
>>> comparison = extremal.run("preset:kepler")
>>> comparison[0]["energy_error"]          # a numpy array
>>> comparison.figure("energy")            # a plot, shown by a notebook

A scene is the path of a file, "preset:NAME", or a dict of the same contents.
"""

from ._extremal import (Comparison, Figure, InvalidScene, Scene, SchemeResult, Study, __version__, catalogue_names)
from ._extremal import add_system as _add_system
from ._extremal import catalogue as _catalogue
from ._extremal import fit as _fit
from ._extremal import gradient as _gradient
from ._extremal import orbit as _orbit
from ._extremal import run as _run
from ._extremal import run_many as _run_many
from ._extremal import steer as _steer
from .formula import Symbol, formula
from .jet import Jet, derivatives
from .number import (acos, acosh, asin, asinh, atan, atan2, atanh, ceil, cos, cosh, erf, erfc, exp, floor, log, log10,
                     sign, sin, sinh, sqrt, tan, tanh)

__all__ = ["Catalogue", "Comparison", "Entry", "Figure", "InvalidScene", "Jet", "Scene", "SchemeResult", "Study",
           "Symbol", "__version__", "acos", "acosh", "add_system", "asin", "asinh", "atan", "atan2", "atanh", "baselines",
           "catalogue", "catalogue_names", "ceil", "check", "compositions", "cos", "cosh", "erf", "erfc", "exp", "fit", "floor",
           "formula", "gradient", "lagrangian", "log", "log10", "models", "observables", "orbit", "presets",
           "profiles", "quadratures", "run", "run_many", "scene", "schemes", "sign", "sin", "sinh", "spaces", "sqrt", "steer", "studies",
           "study", "tan", "tanh", "views"]


def scene(source, changes=(), *, folder="", trust=False):
    """Reads and checks a scene; raises InvalidScene with every error.

    source   a path, "preset:NAME", or a dict as in a scene file; numbers and arrays of numpy are allowed
    changes  "POINTER=VALUE" from left to right, as --set of the command line
    folder   where relative paths of the scene start; by default the folder of the file
    trust    files that the scene names outside its folder are read
    """
    if isinstance(source, Scene):
        if changes:
            return Scene.from_dict(source.to_dict(), list(changes), folder, trust)
        return source
    if isinstance(source, dict):
        return Scene.from_dict(source, list(changes), folder, trust)
    return Scene.load(str(source), list(changes), folder, trust)


def check(source, changes=(), *, folder="", trust=False):
    """The errors of a scene as (pointer, message, hint); empty if it is valid."""
    try:
        scene(source, changes, folder=folder, trust=trust)
    except InvalidScene as error:
        return error.problems
    return []


def run(source, changes=(), *, threads=0, progress=None, folder="", trust=False):
    """Integrates every enabled scheme of a scene and returns a Comparison.

    progress  called with the fraction that is done, 0 to 1, some thirty times a second; returning False stops
              the run, whose results are then partial. Ctrl-C stops it with KeyboardInterrupt.
    """
    return _run(scene(source, changes, folder=folder, trust=trust), threads, progress)


def run_many(source, starts, changes=(), *, scheme="", threads=0, progress=None, folder="", trust=False):
    """The motions of one scheme from many starts, as a dict of arrays: where each ends.

    starts   an array of two dimensions, in each row a state: the columns of a run after t (q.x, .., p.x, ..)
    scheme   the label of a scheme; by default the first enabled one
    progress as of run()

    states   the last state of each motion, an array like starts; columns names its columns
    t, steps of that state; causes says why a motion has not reached the end ("" where it has)
    energy_error  H there less H at the start

    Motions go through explicit steps of one length together, in the lanes of vector instructions (`together` counts
    them), and have the bits that each has by itself. Events of the scene are not looked for.

    >>> extremal.run_many("preset:henon-heiles", starts)["energy_error"].max()
    """
    return _run_many(scene(source, changes, folder=folder, trust=trust), starts, scheme=scheme, threads=threads,
                     progress=progress)


def study(kind, source, changes=(), *, progress=None, folder="", trust=False, **options):
    """Runs a study ("convergence", "work-precision", "cheapest", "needs", "stability", "limits", "extremes",
    "linear-stability") and returns it.

    Options: metric, final, steps, from_step, to_step, points, error, x, y, limit, repeat, only, threads, wishes,
    candidates, budget, search_time, as those of `extremal study`. The result has tables (dicts of columns) and figures().
    """
    result = Study(kind, scene(source, changes, folder=folder, trust=trust), **options)
    result.run(progress)
    return result


def orbit(source, changes=(), *, scheme="", period="", energy=None, hold="", follow="", points=0, folder="",
          trust=False):
    """The periodic orbit near the start of a scene, as a dict: period, energy, start, multipliers, stability, scene.

    Options as those of `extremal orbit`. With follow="energy=0.125", or "/model/k=2", `orbits` has the family, a dict
    per orbit. Where `found` is False, `problem` and `remedy` say why.

    >>> extremal.orbit("preset:pendulum")["period"]
    """
    return _orbit(scene(source, changes, folder=folder, trust=trust), scheme=scheme, period=str(period), energy=energy,
                  hold=hold, follow=follow, points=points)


def fit(source, data, free, changes=(), *, scheme="", columns=(), bias=True, folder="", trust=False):
    """Numbers of a scene from measurements of its motion, as a dict: parameters, directions, notes, residuals, scene.

    data     the path of a CSV file, or a dict of columns: "t", columns of the state ("q.theta" or "theta"), and
             standard deviations ("sd.theta") or weights ("weight.theta"); None or NaN was not measured
    free     pointers to the numbers, ["/model/l", "/initial/q/0"]
    columns  those to compare; by default all
    bias     fit with half the step as well, for the bias of the scheme

    >>> extremal.fit("preset:pendulum", {"t": t, "theta": theta}, ["/model/l"])["parameters"]
    """
    if isinstance(data, dict):
        names = list(data)
        lengths = {len(data[name]) for name in names}
        if len(lengths) > 1:
            raise ValueError("columns of data have different lengths: " + ", ".join(map(str, sorted(lengths))))
        lines = [",".join(names)]
        for row in zip(*(data[name] for name in names)):
            lines.append(",".join("" if each is None else repr(float(each)) for each in row))
        text = "\n".join(lines) + "\n"
    else:
        with open(data, encoding="utf-8") as file:
            text = file.read()
    return _fit(scene(source, changes, folder=folder, trust=trust), text, list(free), scheme=scheme,
                columns=list(columns), bias=bias)


def gradient(source, of, with_respect_to, changes=(), *, over="", scheme="", folder="", trust=False):
    """Derivatives of a number of the run by many numbers of the scene, as a dict: value, at_end, integral, gradient.

    of               a formula at the end of the run, in coordinates, momenta ("p_theta"), t and parameters, or ""
    with_respect_to  pointers, ["/model/l", "/initial/q/0"]; of a control by a table all its rows: "/model/controls/u"
    over             a formula that is integrated over the run and added

    `gradient` is a list of dicts with name, pointer, value and derivative: that of the discrete motion, without
    differences. Its cost does not depend on how many there are.

    >>> extremal.gradient("preset:pendulum", "theta^2/2", ["/model/l"])["gradient"][0]["derivative"]
    """
    return _gradient(scene(source, changes, folder=folder, trust=trust), list(with_respect_to), of=of, over=over,
                     scheme=scheme)


def steer(source, over="", end=(), changes=(), *, of="", controls=(), bounds=(), scheme="", folder="", trust=False):
    """The controls of a model that make a cost of the run least, as a dict: cost, multipliers, controls, states, scene.

    over      a formula that is integrated over the run, "u^2/2"
    end       formulas that are to be 0 at the end, ["theta-pi", "p_theta"]
    of        a cost at the end
    controls  the names of those that are free; by default all of the model
    bounds    ["u=-1:1"]

    `controls` has their values at the points of each step, `states` the state and the costates at its ends. Where
    `found` is False, `problem` and `remedy` say why.
    """
    return _steer(scene(source, changes, folder=folder, trust=trust), over=over, of=of, end=list(end),
                  controls=list(controls), bounds=list(bounds), scheme=scheme)


def lagrangian(function, coordinates, **parameters):
    """The "model" of a scene from a Python function L(t, q, v).

    The function is called once, with symbols, and turned into a formula (see extremal.formula): runs are as fast
    as with a formula that was typed. `parameters` are numbers that the function takes by name; they stay
    parameters of the model, so that changes=["/model/parameters/k=2"] works.

    >>> extremal.lagrangian(lambda t, q, v, k: v.x**2 / 2 - k * q.x**2 / 2, ["x"], k=4)
    """
    names = list(coordinates)
    symbols = {name: Symbol(name) for name in parameters}
    text = formula(lambda t, q, v: function(t, q, v, **symbols), names)
    model = {"type": "lagrangian", "coordinates": names, "lagrangian": text}
    if parameters:
        model["parameters"] = {name: float(value) for name, value in parameters.items()}
    return model


def add_system(id, function, coordinates, *, title="", description="", time_dependent=False, **parameters):
    """Adds a system whose Lagrangian L(t, q, v) is a Python function that need not be a formula.

    Any branches are allowed; tables as well, by x.chain(f, df, ddf) with the derivatives at x.value. The function is
    called at every node of every iteration, with numbers that carry their derivatives (extremal.Jet): hundreds
    of times slower than a formula, for which extremal.lagrangian is. In a scene it is the model
    {"type": id, parameter: value, ...}.

    Systems are added before the first scene is read or catalogue asked for. An exception of the function ends the
    run and is raised by it.

    >>> def wall(t, q, v, k): return v.x**2 / 2 - (k * q.x**4 / 4 if q.x < 0 else 0)
    >>> extremal.add_system("wall", wall, ["x"], k=100)
    """
    names = list(coordinates)
    _add_system(id, title or id, description, names, {key: float(value) for key, value in parameters.items()},
                time_dependent, lambda t, q, v, values: derivatives(function, names, t, q, v, values))


class Entry(dict):
    """What a catalogue says of one name; its docstring describes the keys."""

    def __init__(self, data):
        super().__init__(data)
        lines = [data["title"], "", data["description"]]
        for p in data["parameters"]:
            default = "" if p["default"] is None else f" = {p['default']!r}"
            unit = f" [{p['unit']}]" if p["unit"] else ""
            lines.append(f"  {p['key']}{default}{unit}  {p['description']}")
        self.__doc__ = "\n".join(lines).rstrip()

    def __repr__(self):
        return self.__doc__


class Catalogue(dict):
    """The entries of a catalogue by their ids; `help(catalogue)` and the docstring of an entry describe them."""

    def __init__(self, name):
        super().__init__((entry["id"], Entry(entry)) for entry in _catalogue(name))
        width = max(map(len, self), default=0)
        self.__doc__ = "\n".join(f"{key:{width}}  {entry['title']}" for key, entry in self.items())

    def __repr__(self):
        return self.__doc__


def catalogue(name):
    """One of catalogue_names(): the models, spaces, quadratures, schemes, ... that a scene may contain."""
    return Catalogue(name)


def __getattr__(name):  # extremal.models, extremal.schemes, ...
    if not name.startswith("_") and name in catalogue_names():
        result = globals()[name] = Catalogue(name)
        return result
    raise AttributeError(f"module 'extremal' has no attribute {name!r}")


def __dir__():
    return __all__
