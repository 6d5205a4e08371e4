# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module: results share memory, errors name their places, Ctrl-C and progress stop a run, functions
become formulas, stubs say what there is."""

import ast
import gc
import inspect
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import extremal

PENDULUM = {"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]}, "time": {"end": 5},
            "schemes": [{"label": "midpoint", "scheme": "midpoint", "step": 0.1}], "observe": ["energy"]}
LONG = ["/time/end=1e6", "/schemes/*/step=0.001", "/reference=none"]


class Results(unittest.TestCase):
    def test_columns_are_views_that_keep_the_library_alive(self):
        result = extremal.run(PENDULUM)[0]
        first, again = result["q.theta"], result["q.theta"]
        self.assertEqual(first.__array_interface__["data"], again.__array_interface__["data"])
        self.assertFalse(first.flags.owndata)
        self.assertFalse(first.flags.writeable)
        with self.assertRaises(ValueError):
            first[0] = 0
        copy = first.copy()
        del result, again
        gc.collect()
        [extremal.run(PENDULUM) for _ in range(20)]
        np.testing.assert_array_equal(first, copy)

    def test_the_same_numbers_as_the_program(self):
        program = os.environ.get("EXTREMAL_BINARY")
        if not program:
            self.skipTest("the program is not built")
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "run", "preset:kepler", "--quiet", "--out", folder], check=True)
            comparison = extremal.run("preset:kepler")
            files = comparison.write(folder + "/module")
            for name in files:
                if name.endswith(".csv") and name != "summary.csv":
                    self.assertEqual(pathlib.Path(folder, name).read_bytes(),
                                     pathlib.Path(folder, "module", name).read_bytes(), name)
            self.assertIn("scene.json", files)

    def test_places_and_labels(self):
        comparison = extremal.run(PENDULUM)
        self.assertEqual(comparison[-1].label, "midpoint")
        self.assertEqual([r.label for r in comparison], ["midpoint"])
        self.assertEqual(len(comparison["midpoint"]), 51)
        self.assertIn("q.theta", comparison[0])
        for wrong in (1, -2):
            with self.assertRaises(IndexError):
                comparison[wrong]
        with self.assertRaisesRegex(KeyError, "midpoint"):
            comparison["mitpoint"]
        with self.assertRaisesRegex(KeyError, "q.theta"):
            comparison[0]["q.thta"]

    def test_frames(self):
        wave = extremal.run("preset:breather", ["/time/end=1"])[0]
        t, x, values = wave.frame(0)
        self.assertEqual((t, values.shape), (0, (2, len(x))))
        self.assertFalse(values.flags.owndata)
        with self.assertRaises(IndexError):
            wave.frame(wave.frame_count)


class Scenes(unittest.TestCase):
    def test_numpy_in_a_dict(self):
        scene = extremal.scene(dict(PENDULUM, initial={"q": np.array([1.0])}, time={"end": np.float64(5)}))
        self.assertEqual(scene.to_json(), extremal.scene(PENDULUM).to_json())
        self.assertEqual(extremal.scene(scene.to_dict()).to_json(), scene.to_json())
        self.assertEqual(extremal.scene(scene, ["/time/end=6"]).to_dict()["time"]["end"], 6)

    def test_every_error_with_its_place(self):
        problems = extremal.check({"extremal": 1, "model": {"type": "pendulum", "g": -1}, "initial": {"q": [1]},
                                   "time": {"end": 1}, "schemes": [{"scheme": "midpint", "step": 1}]})
        self.assertEqual([p[0] for p in problems], ["/model/g", "/schemes/0/scheme"])
        self.assertIn("midpoint", problems[1][2])
        self.assertEqual(extremal.check(PENDULUM), [])
        for bad in (dict(PENDULUM, title=object()), {1: 2}, dict(PENDULUM, notes=math.nan)):
            self.assertNotEqual(extremal.check(bad), [])
        deep = []
        for _ in range(1000):
            deep = [deep]
        self.assertIn("deep", extremal.check(dict(PENDULUM, notes=deep))[0][1])
        with self.assertRaises(extremal.InvalidScene):
            extremal.run("no-such-file.json")

    def test_files_outside_need_trust(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "orbit.csv").write_text("t,q.theta,p.theta\n0,1,0\n5,0,0\n")
            inner = pathlib.Path(folder, "inner")
            inner.mkdir()
            scene = dict(PENDULUM, reference={"type": "file", "path": "../orbit.csv"})
            self.assertIn("outside", extremal.check(scene, folder=str(inner))[0][1])
            self.assertEqual(extremal.check(scene, folder=str(inner), trust=True), [])


class Stopping(unittest.TestCase):
    def test_progress_stops(self):
        seen = []
        partial = extremal.run(PENDULUM, LONG, progress=lambda f: seen.append(f) or len(seen) < 3)
        self.assertEqual((len(seen), partial[0].status), (3, "partial"))
        self.assertGreater(len(partial[0]), 1)

    def test_an_exception_in_progress_comes_through(self):
        def fail(fraction):
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            extremal.run(PENDULUM, LONG, progress=fail)

    def test_ctrl_c(self):
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            extremal.run(PENDULUM, LONG)

    def test_other_threads_go_on(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        extremal.run(PENDULUM, LONG, progress=lambda f: counted[0] < 20)
        done.set()
        thread.join()
        self.assertGreaterEqual(counted[0], 20)


class Formulas(unittest.TestCase):
    def test_a_function_is_its_formula(self):
        def lagrangian(t, q, v, k):
            return (v.x**2 + v[1]**2) / 2 - k * np.sqrt(1 + q.x**2) * extremal.cos(-q.y) + np.float64(2) * t * q.x
        model = extremal.lagrangian(lagrangian, ["x", "y"], k=3)
        typed = {"type": "lagrangian", "coordinates": ["x", "y"], "parameters": {"k": 3},
                 "lagrangian": "(x_t^2 + y_t^2)/2 - k*sqrt(1 + x^2)*cos(-y) + 2*t*x"}
        scene = {"extremal": 1, "initial": {"q": [1, 0.5]}, "time": {"end": 2}, "reference": "none",
                 "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.1}]}
        a, b = (extremal.run(dict(scene, model=m))[0] for m in (model, typed))
        np.testing.assert_allclose(a["q.x"], b["q.x"], atol=1e-13)  # measured 0
        self.assertGreater(abs(a["q.x"][-1] - 1), 0.1)

    def test_every_function(self):
        for name in ("sin cos tan asin acos atan sinh cosh tanh exp log sqrt sign asinh atanh log10 erf erfc "
                     "floor ceil").split():
            function = getattr(extremal, name)
            self.assertEqual(function(extremal.Symbol("x")).text, f"{name}(x)")
            self.assertAlmostEqual(function(0.5), getattr(math, name)(0.5) if name != "sign" else 1)
        self.assertEqual(repr(extremal.atan2(extremal.Symbol("y"), 2)), "atan2(y,2.0)")
        self.assertEqual(repr(abs(extremal.Symbol("y"))), "abs(y)")
        self.assertEqual(repr(1 - 2 / extremal.Symbol("y") ** 3), "(1.0-(2.0/(y^3.0)))")

    def test_what_is_no_formula_is_refused(self):
        cases = [lambda t, q, v: v.x**2 if q.x > 0 else 0, lambda t, q, v: math.sin(q.x), lambda t, q, v: 3.0,
                 lambda t, q, v: [q.x], lambda t, q, v: float(q.x)]
        for case in cases:
            with self.assertRaises(TypeError):
                extremal.lagrangian(case, ["x"])
        with self.assertRaisesRegex(AttributeError, "there is x"):
            extremal.lagrangian(lambda t, q, v: q.y, ["x"])


class Surroundings(unittest.TestCase):
    def test_catalogues_have_docstrings(self):
        for name in extremal.catalogue_names():
            catalogue = getattr(extremal, name)
            self.assertTrue(catalogue and catalogue.__doc__, name)
            for key, entry in catalogue.items():
                self.assertIn(entry["title"], entry.__doc__)
        self.assertIn("mu", extremal.models["kepler"].__doc__)
        with self.assertRaises(AttributeError):
            extremal.modells

    def test_stubs_name_what_there_is(self):
        tree = ast.parse(pathlib.Path(extremal.__file__).with_name("_extremal.pyi").read_text())
        stubs = {}
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                stubs[node.name] = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                stubs[node.name] = set()
        module = extremal._extremal
        there = {name for name in dir(module) if not name.startswith("_")}
        self.assertEqual(there, set(stubs))
        for name in there:
            if name != "InvalidScene" and inspect.isclass(getattr(module, name)):
                members = {m for m in vars(getattr(module, name)) if not m.startswith("_")}
                self.assertEqual(members, {m for m in stubs[name] if not m.startswith("_")}, name)

    def test_studies_and_figures(self):
        study = extremal.study("convergence", PENDULUM, steps=[0.05, 0.025, 0.0125], repeat=0)
        self.assertTrue(study.is_complete)
        self.assertAlmostEqual(study.tables["convergence"]["order"][0], 2, delta=0.1)
        figure = study.figures()[0]
        self.assertTrue(figure._repr_svg_().startswith("<svg"))
        (label, x, y), *_ = figure.curves
        self.assertEqual(len(x), 3)
        with self.assertRaises(extremal.InvalidScene):
            extremal.study("converge", PENDULUM)


class End(unittest.TestCase):
    """The interpreter ends while a daemon thread is inside the library: without a crash, whatever it does there."""

    def ended(self, call, loop=False):
        script = f"""
import threading
import extremal
started = threading.Event()
scene = {PENDULUM!r}
def lagrangian(t, q, v):
    started.set()
    return v.x**2 / 2 - q.x**2 / 2
extremal.add_system("swing", lagrangian, ["x"])
def progress(fraction):
    started.set()
def work():
    try:
        {"while True" if loop else "if True"}:
            {call}
    finally:
        started.set()
threading.Thread(target=work, daemon=True).start()
started.wait()
"""
        return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100)

    def test_daemon_threads(self):
        swing = {"type": "swing"}
        for call in (f"extremal.run(scene, {LONG}, progress=progress)",
                     f"extremal.run(scene, {LONG}, threads=2, progress=progress)",
                     f"extremal.run(dict(scene, model={swing}), {LONG})",
                     f"extremal.study('convergence', scene, {LONG[:2]}, steps=[1e-3, 1e-4], progress=progress)"):
            with self.subTest(call):
                ended = self.ended(call)
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    def test_a_thread_that_begins_again_and_again(self):
        ended = self.ended("started.set(); extremal.run(scene)", loop=True)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))


class Answers(unittest.TestCase):
    def test_many_motions(self):
        starts = np.array([[0.4 + 0.01 * i, 0, 0, 2] for i in range(50)])
        changes = ["/time/end=5", '/schemes=[{"label":"SV","baseline":"stormer-verlet","step":0.02}]']
        many = extremal.run_many("preset:kepler", starts, changes)
        self.assertEqual(many["together"], 50)
        self.assertEqual(many["states"].shape, starts.shape)
        self.assertTrue((many["steps"] == 250).all() and not any(many["causes"]))
        one = extremal.run("preset:kepler", changes + ["/initial/q/0=0.4"])[0]
        self.assertEqual([one[name][-1] for name in many["columns"]], list(many["states"][0]))
        with self.assertRaises(extremal.InvalidScene) as caught:
            extremal.run_many("preset:kepler", starts[:, :3], changes)
        self.assertIn("/starts", str(caught.exception))
        with self.assertRaises(extremal.InvalidScene):
            extremal.run_many("preset:kepler", starts[0], changes)
        stopped = extremal.run_many("preset:kepler", starts, changes + ["/schemes/0/step=1e-7"],
                                    progress=lambda fraction: False)
        self.assertTrue(all(cause == "stopped" for cause in stopped["causes"]))

    """Orbits and fits, whose numbers tests/engine/study measures."""

    SWING = {"extremal": 1, "model": {"type": "harmonic-oscillator", "m": 1, "k": 2}, "initial": {"q": [1]},
             "time": {"end": 4}, "schemes": [{"scheme": "galerkin-gauss-3", "step": 0.1}]}

    def test_an_orbit_is_a_scene(self):
        orbit = extremal.orbit("preset:pendulum", period=2.7)
        self.assertTrue(orbit["found"])
        result = extremal.run(orbit["scene"])[0]
        self.assertLess(abs(result["q.theta"][-1] - result["q.theta"][0]), 1e-12)
        family = extremal.orbit("preset:pendulum", period=2.7, follow="energy=3", points=4)["orbits"]
        self.assertAlmostEqual(family[-1]["energy"], 3, places=12)
        with self.assertRaises(extremal.InvalidScene) as caught:
            extremal.orbit("preset:pendulum", hold="angle")
        self.assertEqual(caught.exception.problems[0][0], "--hold")

    def test_a_fit_takes_arrays_and_files(self):
        t = 0.1 * np.arange(1, 41)
        x = np.cos(1.5 * t)
        x[3] = np.nan
        fit = extremal.fit(self.SWING, {"t": t, "x": x, "sd.x": np.full(40, 0.01)}, ["/model/k"])
        self.assertEqual(fit["measurements"], 39)
        self.assertLess(abs(fit["parameters"][0]["value"] - 2.25), 1e-6)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "data.csv")
            np.savetxt(file, np.column_stack([t, x]), delimiter=",", header="t,x", comments="")
            again = extremal.fit(self.SWING, file, ["/model/k"], bias=False)
        self.assertLess(abs(again["parameters"][0]["value"] - 2.25), 1e-6)
        with self.assertRaises(ValueError):
            extremal.fit(self.SWING, {"t": t, "x": x[:-1]}, ["/model/k"])

    def test_a_gradient_is_a_list(self):
        answer = extremal.gradient(self.SWING, "x", ["/model/k", "/initial/q/0"], over="x^2")
        self.assertEqual([each["name"] for each in answer["gradient"]], ["k", "initial.q.x"])
        w = np.sqrt(2.0)
        by_start = np.cos(4 * w) + 4 + np.sin(8 * w) / (2 * w)
        self.assertLess(abs(answer["gradient"][1]["derivative"] - by_start), 1e-6)
        with self.assertRaises(extremal.InvalidScene) as caught:
            extremal.gradient(self.SWING, "y", ["/model/k"])
        self.assertEqual(caught.exception.problems[0][0], "--of")

    def test_a_control_is_found(self):
        scene = {"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"], "lagrangian": "x_t^2/2+u*x",
                                          "controls": {"u": "0"}}, "initial": {"q": [0], "p": [0]},
                 "time": {"end": 1}, "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.125}]}
        answer = extremal.steer(scene, over="u^2/2", end=["x-1", "p_x"])
        self.assertLess(abs(answer["cost"] - 6), 1e-12)
        self.assertEqual(len(answer["controls"]), 16)
        self.assertEqual(len(extremal.run(answer["scene"])), 1)


if __name__ == "__main__":
    unittest.main()
