"""Runs the code of a page of the handbook, block after block: handbook_test.py PAGE"""

import os
import re
import sys
import tempfile

text = open(sys.argv[1], encoding="utf-8").read()
blocks = list(re.finditer(r"```python\n(.*?)```", text, re.DOTALL))
assert len(blocks) >= 8, "a page of code shows little"
os.chdir(tempfile.mkdtemp())
names = {}
for block in blocks:
    line = text.count("\n", 0, block.start()) + 1
    code = compile("\n" * line + block[1], sys.argv[1], "exec")
    exec(code, names)
print(f"{len(blocks)} passed, 0 failed")
