# SPDX-License-Identifier: GPL-3.0-or-later
"""Systems whose Lagrangian is evaluated in Python: their derivatives, their runs against the same formula, and what
they throw."""

import math
import unittest

import numpy as np

import extremal
from extremal.jet import derivatives

NAMES = ["x", "y"]


def swing(t, q, v, k):
    r = 1 + q.a
    return (v.a**2 + (r * v.theta) ** 2) / 2 + 9.81 * r * np.cos(q.theta) - k * q.a**2 / 2


def with_wall(t, q, v, k):
    return v.x**2 / 2 - (k * q.x**4 / 4 if q.x < 0 else 0 * q.x)


def broken(t, q, v):
    if q.x < 0.5:
        raise ZeroDivisionError("below one half")
    return v.x**2 / 2 - q.x**2 / 2


def table(t, q, v):
    f = np.polynomial.Polynomial([0, 0, 0.5, 0, 0.25])
    x = q.x.value
    return v.x**2 / 2 - q.x.chain(f(x), f.deriv()(x), f.deriv(2)(x))


def wrong_shape(make):
    """A system whose derivatives are not of the shapes of its one coordinate: (L, 2, 2 x 2)."""
    return lambda t, q, v, values: make(np.zeros)


WRONG = {"short gradient": (lambda z: (0.0, z(1), z((2, 2))), "a gradient of shape \\(1,\\), and 1 coordinate needs \\(2,\\)"),
         "long gradient": (lambda z: (0.0, z(3), z((2, 2))), "a gradient of shape \\(3,\\)"),
         "flat Hessian": (lambda z: (0.0, z(2), z(4)), "a Hessian of shape \\(4,\\), and 1 coordinate needs \\(2, 2\\)"),
         "small Hessian": (lambda z: (0.0, z(2), z((1, 1))), "a Hessian of shape \\(1, 1\\)"),
         "array for L": (lambda z: (z(2), z(2), z((2, 2))), "a value of shape \\(2,\\), and 1 coordinate needs \\(\\)"),
         "two of three": (lambda z: (0.0, z(2)), "must give \\(L, gradient, Hessian\\), got"),
         "no numbers": (lambda z: (0.0, ["a", "b"], z((2, 2))), "a gradient that is not an array of numbers")}


def wrong_chain(t, q, v):
    return v.x**2 / 2 - q.x.chain(1.0, np.array([1.0, 2.0]), 0.0)


# Before anything is read.
for number, (name, (make, _)) in enumerate(WRONG.items()):
    extremal._extremal.add_system(f"wrong-{number}", name, "", ["x"], {}, False, wrong_shape(make))
extremal.add_system("wrong-chain", wrong_chain, ["x"])
extremal.add_system("swing-python", swing, ["a", "theta"], k=100)
extremal.add_system("wall-python", with_wall, ["x"], k=50)
extremal.add_system("broken-python", broken, ["x"])
extremal.add_system("table-python", table, ["x"])


def scene(model, q, **more):
    return {"extremal": 1, "model": model, "initial": {"q": q}, "time": {"end": 2},
            "schemes": [{"label": "gauss", "scheme": "galerkin-gauss-2", "step": 0.02},
                        {"label": "rk4", "baseline": "rk4", "step": 0.02}], "observe": ["energy"]} | more


class Derivatives(unittest.TestCase):
    """Against differences of order 4 of the value and of the gradient."""

    def check_at(self, function, place):
        def at(x):
            return derivatives(lambda t, q, v: function(*q, *v), NAMES, 0.3, list(x[:2]), list(x[2:]), {})

        h, worst = 1e-3, 0
        _, gradient, hessian = at(place)
        for i in range(4):
            step = h * np.eye(4)[i]
            slope = [(8 * (a - b) - (c - d)) / (12 * h) for a, b, c, d in
                     zip(*(at(place + k * step)[:2] for k in (1, -1, 2, -2)))]
            worst = max(worst, abs(slope[0] - gradient[i]) / (1 + abs(gradient[i])),
                        np.max(np.abs(slope[1] - hessian[i])) / (1 + np.max(np.abs(hessian))))
        np.testing.assert_array_equal(hessian, hessian.T)
        return worst

    def test_every_function(self):
        place = np.array([0.31, 0.42, -0.27, 0.6])
        for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt",
                     "asinh", "atanh", "log10", "erf", "erfc", "floor", "ceil"):
            function = getattr(extremal, name)
            with self.subTest(name):
                self.assertLess(self.check_at(lambda x, y, u, w: u * w + function(x * y + w / 3), place), 1e-8)
                self.assertAlmostEqual(
                    derivatives(lambda t, q, v: function(q.x), NAMES, 0, place[:2], place[2:], {})[0],
                    getattr(math, name)(0.31), delta=1e-15)
        self.assertLess(self.check_at(lambda x, y, u, w: u * w + extremal.acosh(2 + x * y), place), 1e-8)
        self.assertLess(self.check_at(lambda x, y, u, w: u * np.arctanh(x * y) + np.arcsinh(w), place), 1e-8)
        for angle in (0.1, 1.2, 2.0, 3.0, -1.0, -2.5):  # every octant of atan2
            turned = np.array([np.cos(angle), np.sin(angle), 0.2, 0.3])
            with self.subTest(angle):
                self.assertLess(self.check_at(lambda x, y, u, w: extremal.atan2(y + u * w, x * w), turned), 1e-7)

    def test_arithmetic(self):
        place = np.array([0.7, 1.3, -0.4, 0.9])
        for function in (lambda x, y, u, w: (x - y) * u / w - 2 / x + 3 - (1 - y), lambda x, y, u, w: x**2.5 * y**3 - u,
                         lambda x, y, u, w: x**y + 2**u * w, lambda x, y, u, w: -x + abs(u) * y + np.float64(2) * w,
                         lambda x, y, u, w: np.sqrt(x) * np.square(u) + np.arctan2(y, x)):
            self.assertLess(self.check_at(function, place), 1e-8)

    def test_a_plain_number_is_refused(self):
        for function in (lambda t, q, v: float(q.x), lambda t, q, v: math.sin(q.x), lambda t, q, v: 3.0,
                         lambda t, q, v: None, lambda t, q, v: q.z):
            with self.assertRaises((TypeError, AttributeError)):
                derivatives(function, NAMES, 0, [1, 2], [3, 4], {})


class Runs(unittest.TestCase):
    def test_the_same_motion_as_the_formula(self):
        formula = extremal.run(scene(extremal.lagrangian(swing, ["a", "theta"], k=80), [0.1, 1.0]))
        called = extremal.run(scene({"type": "swing-python", "k": 80}, [0.1, 1.0]))
        for label in ("gauss", "rk4"):
            self.assertEqual(called[label].status, "done")
            for column in ("q.a", "q.theta", "p.a", "p.theta", "energy_error"):
                np.testing.assert_allclose(called[label][column], formula[label][column], rtol=0, atol=1e-12)

    def test_a_branch(self):
        # A free flight from x = 1 with p = -2, then half an oscillation in x^4: elastic, so that it leaves at |p|.
        result = extremal.run(scene({"type": "wall-python"}, [1.0],
                                    initial={"q": [1.0], "p": [-2.0]}, time={"end": 4}))["gauss"]
        self.assertLess(abs(result["energy_error"]).max(), 1e-4)
        self.assertAlmostEqual(result["p.x"][-1], 2, delta=1e-4)
        self.assertLess(result["q.x"].min(), -0.5)

    def test_a_table(self):
        formula = extremal.run(scene({"type": "lagrangian", "coordinates": ["x"],
                                      "lagrangian": "x_t^2/2 - x^2/2 - x^4/4"}, [1.0]))
        called = extremal.run(scene({"type": "table-python"}, [1.0]))
        np.testing.assert_allclose(called["gauss"]["q.x"], formula["gauss"]["q.x"], rtol=0, atol=1e-13)

    def test_its_exception_ends_the_run(self):
        with self.assertRaisesRegex(ZeroDivisionError, "below one half"):
            extremal.run(scene({"type": "broken-python"}, [1.0]))
        with self.assertRaisesRegex(ZeroDivisionError, "below one half"):
            extremal.run(scene({"type": "broken-python"}, [0.2]))
        self.assertEqual(extremal.run(scene({"type": "wall-python"}, [1.0]))[0].status, "done")  # and no other

    def test_shapes_of_arrays_are_looked_at(self):
        for number, (name, (_, message)) in enumerate(WRONG.items()):
            with self.subTest(name):
                with self.assertRaisesRegex((ValueError, TypeError), f'system "wrong-{number}" .*{message}'):
                    extremal.run(scene({"type": f"wrong-{number}"}, [1.0]))
        with self.assertRaisesRegex(ValueError, "chain.*df must be a number, got an array of shape \\(2,\\)"):
            extremal.run(scene({"type": "wrong-chain"}, [1.0]))

    @unittest.skipUnless(hasattr(BaseException, "add_note"), "exceptions have no notes before Python 3.11")
    def test_an_exception_says_where(self):
        with self.assertRaises(ZeroDivisionError) as caught:
            extremal.run(scene({"type": "broken-python"}, [0.2]))
        self.assertRegex("".join(caught.exception.__notes__), 'system "broken-python" at t = 0.*q = \\[0.2\\], v = ')

    def test_it_is_in_the_catalogue(self):
        self.assertEqual(extremal.models["swing-python"]["parameters"][0]["default"], 100)
        with self.assertRaisesRegex(RuntimeError, "before the first scene"):
            extremal.add_system("late", with_wall, ["x"], k=1)


if __name__ == "__main__":
    unittest.main()
