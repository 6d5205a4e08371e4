#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pip_test.sh PYTHON ROOT BUILD OUT: `pip install .` in an empty environment without a network, then five lines that
# integrate Kepler's problem and draw the energy.
set -euo pipefail
python=$1 root=$2 build=$3 out=$4
rm -rf "$out"
mkdir -p "$out"
"$python" -m venv --system-site-packages "$out/env"
# No index: whatever pip wants to fetch fails. The folder of the build is that of this test, so nothing is compiled again.
PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 "$out/env/bin/pip" install --quiet "$root" --config-settings build-dir="$build"
cd "$out"
env -u PYTHONPATH "$out/env/bin/python" - <<'P'
import extremal
comparison = extremal.run("preset:kepler")
errors = [abs(result["energy_error"]).max() for result in comparison]
open("energy.svg", "w").write(comparison.figure("energy").svg())
print(extremal.__file__, len(comparison), max(errors))
assert "/env/" in extremal.__file__ and max(errors) < 1e-2
P
grep -q "</svg>" energy.svg
"$out/env/bin/pip" --disable-pip-version-check show -f extremal | grep "_extremal.*so" >/dev/null
"$out/env/bin/pip" --disable-pip-version-check uninstall --quiet --yes extremal
rm -rf "$out/env"
