# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the wheel for pip (PEP 517) with CMake and nothing else, so that no network is needed.

    pip install .                                         builds in build-python, which is kept for the next time
    pip install . --config-settings build-dir=build       with a folder that is configured already
"""

import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

root = pathlib.Path(__file__).resolve().parent.parent


def _call(*command):
    subprocess.run([str(part) for part in command], check=True, stdout=sys.stderr)


def _project():
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    project["version"] = re.search(r"project\(extremal VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
    return project


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {each}" for each in project["dependencies"]]
    lines += ["Description-Content-Type: text/markdown", "", (root / project["readme"]).read_text()]
    return "\n".join(lines)


def _build(build):
    if not (build / "CMakeCache.txt").exists():
        _call("cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DEXTREMAL_UNITY=ON",
              "-DEXTREMAL_PROGRAM=OFF", "-DEXTREMAL_TESTS=OFF", "-DEXTREMAL_BENCH=OFF", "-DEXTREMAL_LIBRARY=OFF",
              f"-DPython_EXECUTABLE={sys.executable}")
    _call("cmake", "--build", build, "--target", "extremal_python")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = (root / (config_settings or {}).get("build-dir", "build-python")).resolve()
    _build(build)
    project = _project()
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    name = f"{project['name']}-{project['version']}"
    info = f"{name}.dist-info"
    wheel = pathlib.Path(wheel_directory) / f"{name}-{tag}-{tag}-{platform}.whl"
    record = []
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        _call("cmake", "--install", build, "--component", "wheel", "--prefix", folder, "--strip")
        files = {str(path.relative_to(folder)): path.read_bytes()
                 for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}
        files[f"{info}/METADATA"] = _metadata().encode()
        files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: extremal\nRoot-Is-Purelib: false\n"
                                  f"Tag: {tag}-{tag}-{platform}\n").encode()
        files[f"{info}/LICENSE"] = (root / "LICENSE").read_bytes()
        for path, data in files.items():
            archive.writestr(path, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(data)}")
        archive.writestr(f"{info}/RECORD", "\n".join(record + [f"{info}/RECORD,,"]) + "\n")
    return wheel.name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("there is no source distribution: pip install . in the folder of the project, or pip wheel .")
