# SPDX-License-Identifier: GPL-3.0-or-later
"""A thousand short runs from Python and from C++ (library_bench.cpp), and their ratio: python_bench.py PROGRAM"""

import re
import subprocess
import sys
import time

import extremal

scene = {"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]}, "time": {"end": 10},
         "observe": ["energy"], "reference": "none",
         "schemes": [{"label": "midpoint", "scheme": "midpoint", "step": 0.1}]}
ratios = []
for _ in range(3):
    best = 1e9
    for _ in range(5):
        start, total = time.perf_counter(), 0
        for i in range(1000):
            scene["schemes"][0]["step"] = 0.1 + 1e-6 * i
            total += extremal.run(scene, threads=1)[0]["energy_error"][-1]
        best = min(best, time.perf_counter() - start)
    said = subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True).stdout
    native = float(re.match(r"[\d.]+", said)[0])
    assert f"{total:.6g}" in said, (total, said)
    ratios.append(best / native)
    print(f"1000 runs: Python {best:.4f} s, C++ {native:.4f} s, ratio {ratios[-1]:.2f}")
print(f"best ratio {min(ratios):.2f}")
