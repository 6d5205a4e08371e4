# SPDX-License-Identifier: GPL-3.0-or-later
"""Lagrangians written as Python functions, turned into formulas.

A function L(t, q, v) is called once with symbols in place of numbers. What it returns is a formula, which the
library differentiates and compiles: a run costs what it costs with a formula that was typed, and Python is not
called again. This works for everything that is arithmetic and the functions of extremal (or those of numpy of
the same names); a function that asks for the value of a symbol (if q.x > 0, float(q.x)) is not a formula, and says
so: it can be added as a system that is evaluated in Python (extremal.add_system).
"""

import math as _math

from .number import Named, Number, result_of

__all__ = ["Symbol", "formula"]


class Symbol(Number):
    """A formula: arithmetic with it gives longer formulas."""

    __slots__ = ("text",)
    def __init__(self, text):
        self.text = text

    def __repr__(self):
        return self.text

    @staticmethod
    def binary(operator, a, b):
        return Symbol(f"({_text(a)}{operator}{_text(b)})")

    @staticmethod
    def call(name, *arguments):
        return Symbol(f"{name}({','.join(map(_text, arguments))})")

    def __neg__(self): return Symbol(f"(-{self.text})")

    def _refuse(self, *_):
        raise TypeError(f"the formula asks for the value of {self.text}, which has none: a Lagrangian with branches "
                        "or tables is not a formula (extremal.sign and abs may be in one). extremal.add_system takes "
                        "it as it is, and is slower")

    __bool__ = __float__ = __int__ = __lt__ = __le__ = __gt__ = __ge__ = __index__ = _refuse


def _text(value):
    if isinstance(value, Symbol):
        return value.text
    number = float(value)
    if not _math.isfinite(number):
        raise ValueError(f"{number} cannot be in a formula")
    return f"({number!r})" if number < 0 else repr(number)


def formula(lagrangian, coordinates):
    """The text of the formula that a function L(t, q, v) computes."""
    def symbols(suffix):
        return Named(coordinates, [Symbol(name + suffix) for name in coordinates])

    return result_of(lagrangian(Symbol("t"), symbols(""), symbols("_t")), Symbol).text
