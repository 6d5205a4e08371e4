# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands for a number in a Lagrangian that is a Python function: arithmetic, and the functions of mathematics.

A kind of number says what each operation gives; numpy's functions of the same names go the same way.
"""

import math as _math
import operator as _operator

__all__ = ["Number", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh",
           "atanh", "exp", "log", "log10", "sqrt", "erf", "erfc", "floor", "ceil", "abs", "sign"]


def is_plain(value):
    """A number of Python or numpy."""
    return isinstance(value, (int, float)) or hasattr(value, "__float__") and not isinstance(value, Number)


class Number:
    """Subclasses have binary(operator, a, b), with one of + - * / ^ and one of a and b plain or neither, and
    call(name, *arguments), a function of the list below."""

    __slots__ = ()

    def _binary(self, operator, other, reflected=False):
        if not isinstance(other, type(self)) and not is_plain(other):
            return NotImplemented
        return self.binary(operator, other, self) if reflected else self.binary(operator, self, other)

    def __add__(self, other): return self._binary("+", other)
    def __radd__(self, other): return self._binary("+", other, True)
    def __sub__(self, other): return self._binary("-", other)
    def __rsub__(self, other): return self._binary("-", other, True)
    def __mul__(self, other): return self._binary("*", other)
    def __rmul__(self, other): return self._binary("*", other, True)
    def __truediv__(self, other): return self._binary("/", other)
    def __rtruediv__(self, other): return self._binary("/", other, True)
    def __pow__(self, other): return self._binary("^", other)
    def __rpow__(self, other): return self._binary("^", other, True)
    def __neg__(self): return self._binary("*", -1.0)
    def __pos__(self): return self
    def __abs__(self): return self.call("abs", self)

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        """numpy.cos(number), and arithmetic of numbers of numpy with these."""
        call = _ufuncs.get(ufunc.__name__)
        if method != "__call__" or options or call is None or any(getattr(each, "ndim", 0) for each in inputs):
            raise TypeError(f"numpy.{ufunc.__name__} cannot be in a Lagrangian")
        # As plain numbers: those of numpy would ask again.
        return call(*(each if isinstance(each, Number) else float(each) for each in inputs))


def _function(name, plain):
    def call(x):
        return x.call(name, x) if isinstance(x, Number) else plain(x)

    call.__name__ = name
    call.__doc__ = f"{name} of a number or of what stands for one in a Lagrangian."
    return call


def _sign(x):
    return (x > 0) - (x < 0)


plain = {name: getattr(_math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh",
                                                 "asinh", "acosh", "atanh", "exp", "log", "log10", "sqrt", "erf", "erfc",
                                                 "floor", "ceil")}
plain |= {"abs": _math.fabs, "sign": _sign}
for _name, _each in plain.items():
    globals()[_name] = _function(_name, _each)


def atan2(y, x):
    """The angle of (x, y)."""
    for each in (y, x):
        if isinstance(each, Number):
            return each.call("atan2", y, x)
    return _math.atan2(y, x)


# By the names of numpy.
_ufuncs = {name: globals()[name] for name in plain if name != "abs"}
_ufuncs |= {"arc" + name[1:]: globals()[name] for name in ("asinh", "acosh", "atanh")}
_ufuncs |= {"absolute": globals()["abs"], "fabs": globals()["abs"], "arcsin": globals()["asin"],
            "arccos": globals()["acos"], "arctan": globals()["atan"], "arctan2": atan2, "square": lambda x: x**2,
            "negative": _operator.neg, "positive": _operator.pos, "add": _operator.add, "subtract": _operator.sub,
            "multiply": _operator.mul, "divide": _operator.truediv, "power": _operator.pow}
_ufuncs |= {"less": _operator.lt, "less_equal": _operator.le, "greater": _operator.gt,
            "greater_equal": _operator.ge}


class Named(tuple):
    """Numbers by place and by name: q[0], q.x."""

    def __new__(cls, names, numbers):
        self = super().__new__(cls, numbers)
        self._places = {name: i for i, name in enumerate(names)}
        return self

    def __getattr__(self, name):
        try:
            return self[self.__dict__["_places"][name]]
        except KeyError:
            raise AttributeError(f"there is no coordinate {name!r} (there is {', '.join(self._places)})") from None


def result_of(value, kind):
    """What a Lagrangian returned, which must be of this kind of number."""
    if is_plain(value):
        raise TypeError("the Lagrangian does not depend on its arguments")
    if not isinstance(value, kind):
        raise TypeError(f"the Lagrangian must return one number, got {type(value).__name__}")
    return value
