"""Lagrangians written as Python functions, turned into formulas.

A function L(t, q, v) is called once with symbols in place of numbers. What it returns is a formula, which the
library differentiates and compiles: a run costs what it costs with a formula that was typed, and Python is not
called again. This works for everything that is arithmetic and the functions below (or those of numpy of the
same names); a function that asks for the value of a symbol (if q.x > 0, float(q.x), tables) cannot be turned
into one formula, and says so.
"""

import math as _math
import operator as _operator

__all__ = ["Symbol", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log",
           "sqrt", "abs", "sign", "formula"]


class Symbol:
    """A formula: arithmetic with it gives longer formulas."""

    __slots__ = ("text",)
    def __init__(self, text):
        self.text = text

    def __repr__(self):
        return self.text

    def _binary(self, operator, other, reflected=False):
        if not isinstance(other, Symbol) and not _is_number(other):
            return NotImplemented
        a, b = (_text(other), self.text) if reflected else (self.text, _text(other))
        return Symbol(f"({a}{operator}{b})")

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
    def __neg__(self): return Symbol(f"(-{self.text})")
    def __pos__(self): return self
    def __abs__(self): return Symbol(f"abs({self.text})")

    def _refuse(self, *_):
        raise TypeError(f"the formula asks for the value of {self.text}, which has none: a Lagrangian must be one "
                        "formula, without branches and tables (extremal.sign and extremal.abs are allowed)")

    __bool__ = __float__ = __int__ = __lt__ = __le__ = __gt__ = __ge__ = __index__ = _refuse

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        """numpy.cos(symbol), and arithmetic of numbers of numpy with symbols."""
        call = _ufuncs.get(ufunc.__name__)
        if method != "__call__" or options or call is None or any(getattr(each, "ndim", 0) for each in inputs):
            raise TypeError(f"numpy.{ufunc.__name__} cannot be in a formula")
        # As plain numbers: those of numpy would ask again.
        return call(*(each if isinstance(each, Symbol) else float(each) for each in inputs))


def _is_number(value):
    return isinstance(value, (int, float)) or hasattr(value, "__float__") and not isinstance(value, Symbol)


def _text(value):
    if isinstance(value, Symbol):
        return value.text
    number = float(value)
    if not _math.isfinite(number):
        raise ValueError(f"{number} cannot be in a formula")
    return f"({number!r})" if number < 0 else repr(number)


def _function(name, plain):
    def call(x):
        return Symbol(f"{name}({x.text})") if isinstance(x, Symbol) else plain(x)

    call.__name__ = name
    call.__doc__ = f"{name} of a number or a symbol."
    return call


def _sign(x):
    return (x > 0) - (x < 0)


_plain = {name: getattr(_math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh",
                                                  "exp", "log", "sqrt")}
_plain |= {"abs": _math.fabs, "sign": _sign}
for _name, _each in _plain.items():
    globals()[_name] = _function(_name, _each)


def atan2(y, x):
    """The angle of (x, y)."""
    if isinstance(y, Symbol) or isinstance(x, Symbol):
        return Symbol(f"atan2({_text(y)},{_text(x)})")
    return _math.atan2(y, x)


# By the names of numpy.
_ufuncs = {name: globals()[name] for name in _plain if name != "abs"}
_ufuncs |= {"absolute": globals()["abs"], "fabs": globals()["abs"], "arcsin": globals()["asin"],
            "arccos": globals()["acos"], "arctan": globals()["atan"], "arctan2": atan2, "square": lambda x: x**2,
            "negative": _operator.neg, "positive": _operator.pos, "add": _operator.add, "subtract": _operator.sub,
            "multiply": _operator.mul, "divide": _operator.truediv, "power": _operator.pow}


class _Symbols(tuple):
    """Symbols by place and by name: q[0], q.x."""

    def __new__(cls, names, suffix):
        self = super().__new__(cls, [Symbol(name + suffix) for name in names])
        self._places = {name: i for i, name in enumerate(names)}
        return self

    def __getattr__(self, name):
        try:
            return self[self.__dict__["_places"][name]]
        except KeyError:
            raise AttributeError(f"there is no coordinate {name!r} (there is {', '.join(self._places)})") from None


def formula(lagrangian, coordinates):
    """The text of the formula that a function L(t, q, v) computes."""
    result = lagrangian(Symbol("t"), _Symbols(coordinates, ""), _Symbols(coordinates, "_t"))
    if _is_number(result):
        raise TypeError("the Lagrangian does not depend on its arguments")
    if not isinstance(result, Symbol):
        raise TypeError(f"the Lagrangian must return one number, got {type(result).__name__}")
    return result.text
