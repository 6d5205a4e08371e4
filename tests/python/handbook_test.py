# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the code of a page of the handbook, block after block: handbook_test.py PAGE. A block that imports the module
anew is a program of its own."""

import os
import re
import subprocess
import sys
import tempfile

text = open(sys.argv[1], encoding="utf-8").read()
blocks = list(re.finditer(r"```python\n(.*?)```", text, re.DOTALL))
assert len(blocks) >= 8, "a page of code shows little"
os.chdir(tempfile.mkdtemp())
names = {}
for block in blocks:
    line = text.count("\n", 0, block.start()) + 1
    if names and "import extremal\n" in block[1]:
        subprocess.run([sys.executable, "-c", "\n" * line + block[1]], check=True)
        continue
    exec(compile("\n" * line + block[1], sys.argv[1], "exec"), names)
print(f"{len(blocks)} passed, 0 failed")
