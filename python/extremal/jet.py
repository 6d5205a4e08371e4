# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that carry their first and second derivatives, for Lagrangians that are not formulas.

With f, f', f'' at the value u,  grad f(u) = f' grad u,  hess f(u) = f' hess u + f'' grad u grad u^T. Comparisons
are those of the values, so that a Lagrangian may have branches; at a branch its derivatives are those of the side
that was taken.
"""

import math

import numpy as np

from .number import Named, Number, result_of

__all__ = ["Jet", "derivatives"]


class Jet(Number):
    """value, gradient and Hessian in the variables that the Lagrangian depends on."""

    __slots__ = ("value", "gradient", "hessian")
    def __init__(self, value, gradient, hessian):
        self.value, self.gradient, self.hessian = value, gradient, hessian

    def __repr__(self):
        return f"<{self.value!r} with derivatives>"

    def chain(self, f, df, ddf):
        """f(x) from f, f' and f'' at x.value: for functions that are not in the module, such as tables."""
        return self._chain(*(_plain(name, each) for name, each in (("f", f), ("df", df), ("ddf", ddf))))

    def _chain(self, f, df, ddf):
        g = self.gradient
        return Jet(float(f), df * g, df * self.hessian + ddf * np.outer(g, g))

    @staticmethod
    def binary(operator, a, b):
        return _operations[operator](a, b)

    @staticmethod
    def call(name, *arguments):
        if name == "atan2":
            return _angle(*arguments)
        x = arguments[0]
        return x._chain(*_functions[name](x.value))

    def __lt__(self, other): return self.value < _value(other)
    def __le__(self, other): return self.value <= _value(other)
    def __gt__(self, other): return self.value > _value(other)
    def __ge__(self, other): return self.value >= _value(other)
    def __eq__(self, other): return self.value == _value(other)
    def __ne__(self, other): return self.value != _value(other)
    __hash__ = None

    def __bool__(self):
        return self.value != 0

    def _refuse(self):
        raise TypeError("the Lagrangian makes a plain number of one with derivatives, which would be lost: use "
                        "functions of extremal or numpy, or .value and .chain(f, df, ddf)")

    __float__ = __int__ = __index__ = _refuse


def _plain(name, value):
    """An argument of chain, which an array would multiply entry by entry."""
    if np.ndim(value) == 0:
        try:
            return float(value)
        except (TypeError, ValueError):
            pass
        raise TypeError(f"chain(f, df, ddf): {name} must be a number, got {type(value).__name__}")
    if np.size(value) == 1:
        return float(np.reshape(value, ()))
    raise ValueError(f"chain(f, df, ddf): {name} must be a number, got an array of shape {np.shape(value)}")


def _value(x):
    return x.value if isinstance(x, Jet) else float(x)


def _add(a, b):
    if not isinstance(a, Jet):
        a, b = b, a
    if not isinstance(b, Jet):
        return Jet(a.value + float(b), a.gradient, a.hessian)
    return Jet(a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian)


def _multiply(a, b):
    if not isinstance(a, Jet):
        a, b = b, a
    if not isinstance(b, Jet):
        b = float(b)
        return Jet(a.value * b, a.gradient * b, a.hessian * b)
    cross = np.outer(a.gradient, b.gradient)
    return Jet(a.value * b.value, a.value * b.gradient + b.value * a.gradient,
               a.value * b.hessian + b.value * a.hessian + cross + cross.T)


def _inverse(x):
    if not isinstance(x, Jet):
        return 1 / float(x)
    f = 1 / x.value if x.value != 0 else math.inf
    return x._chain(f, -f * f, 2 * f**3)


def _power(a, b):
    if isinstance(b, Jet):  # a^b = exp(b log a)
        log_a = Jet.call("log", a) if isinstance(a, Jet) else math.log(a) if a > 0 else math.nan
        return Jet.call("exp", _multiply(b, log_a))
    x, n = a.value, float(b)
    try:
        f, df, ddf = x**n, 0.0 if n == 0 else n * x**(n - 1), 0.0 if n in (0, 1) else n * (n - 1) * x**(n - 2)
    except (ZeroDivisionError, OverflowError):
        return a._chain(math.nan, math.nan, math.nan)
    if any(isinstance(each, complex) for each in (f, df, ddf)):
        return a._chain(math.nan, math.nan, math.nan)
    return a._chain(f, df, ddf)


_operations = {"+": _add, "-": lambda a, b: _add(a, _multiply(b, -1.0) if isinstance(b, Jet) else -float(b)),
               "*": _multiply, "/": lambda a, b: _multiply(a, _inverse(b)), "^": _power}


def _angle(y, x):
    """d atan2(y, x) = (x dy - y dx) / r^2: atan of the ratio whose denominator is the larger one, turned."""
    angle = math.atan2(_value(y), _value(x))
    steep = abs(_value(y)) > abs(_value(x))
    ratio = _operations["/"](x, y) if steep else _operations["/"](y, x)
    slope = Jet.call("atan", ratio)
    slope = _multiply(slope, -1.0) if steep else slope
    return Jet(angle, slope.gradient, slope.hessian)


def _where_defined(function):
    """NaN where a function is not defined: a step out of its domain is then tried again, shorter."""
    def call(x):
        try:
            return function(x)
        except (ValueError, ZeroDivisionError, OverflowError):
            return math.nan, math.nan, math.nan

    return call


def _tan(x):
    t = math.tan(x)
    return t, 1 + t * t, 2 * t * (1 + t * t)


def _tanh(x):
    t = math.tanh(x)
    return t, 1 - t * t, -2 * t * (1 - t * t)


def _asin(x):
    d = 1 / math.sqrt(1 - x * x)
    return math.asin(x), d, x * d**3


def _acos(x):
    f, df, ddf = _asin(x)
    return math.acos(x), -df, -ddf


def _atan(x):
    d = 1 / (1 + x * x)
    return math.atan(x), d, -2 * x * d * d


def _exp(x):
    e = math.exp(x)
    return e, e, e


def _sqrt(x):
    r = math.sqrt(x)
    return r, 0.5 / r, -0.25 / r**3


def _size(x):
    sign = (x > 0) - (x < 0)
    return math.fabs(x), sign, 0.0


def _asinh(x):
    d = 1 / math.hypot(1, x)
    return math.asinh(x), d, -x * d**3


def _acosh(x):
    d = 1 / math.sqrt(x * x - 1)
    return math.acosh(x), d, -x * d**3


def _atanh(x):
    d = 1 / (1 - x * x)
    return math.atanh(x), d, 2 * x * d * d


def _log10(x):
    c = 1 / math.log(10)
    return math.log10(x), c / x, -c / (x * x)


def _erf(x):
    d = 2 / math.sqrt(math.pi) * math.exp(-x * x)
    return math.erf(x), d, -2 * x * d


def _erfc(x):
    _, df, ddf = _erf(x)
    return math.erfc(x), -df, -ddf


# f, f' and f'' at x.
_functions = {
    "asinh": _asinh, "acosh": _acosh, "atanh": _atanh, "log10": _log10, "erf": _erf, "erfc": _erfc,
    "floor": lambda x: (math.floor(x), 0.0, 0.0), "ceil": lambda x: (math.ceil(x), 0.0, 0.0),
    "sin": lambda x: (math.sin(x), math.cos(x), -math.sin(x)),
    "cos": lambda x: (math.cos(x), -math.sin(x), -math.cos(x)),
    "sinh": lambda x: (math.sinh(x), math.cosh(x), math.sinh(x)),
    "cosh": lambda x: (math.cosh(x), math.sinh(x), math.cosh(x)),
    "log": lambda x: (math.log(x), 1 / x, -1 / (x * x)),
    "sign": lambda x: ((x > 0) - (x < 0), 0.0, 0.0),
    "tan": _tan, "tanh": _tanh, "asin": _asin, "acos": _acos, "atan": _atan, "exp": _exp, "sqrt": _sqrt,
    "abs": _size,
}
_functions = {name: _where_defined(function) for name, function in _functions.items()}


def derivatives(function, coordinates, t, q, v, parameters):
    """L(t, q, v) with its gradient and Hessian in (q, v): a number, an array, an array of rows."""
    d = len(coordinates)
    unit, nothing = np.eye(2 * d), np.zeros((2 * d, 2 * d))
    numbers = [Jet(float(value), unit[i], nothing) for i, value in enumerate([*q, *v])]
    with np.errstate(all="ignore"):
        value = result_of(function(t, Named(coordinates, numbers[:d]), Named(coordinates, numbers[d:]), **parameters),
                          Jet)
    return value.value, value.gradient, value.hessian
