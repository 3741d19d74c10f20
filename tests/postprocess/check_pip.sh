#!/bin/sh
# check_pip.sh PYTHON SOURCE PROGRAM: installs the Python package into a fresh virtual environment, without a network, as the README says,
# and holds its theory to the program. From a copy, because pip writes beside the sources; without optimisation, which takes most of the time.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/src" "$folder/validation"
cp -R "$2/postprocess" "$folder/postprocess"
for room in atlas core inference scenario theory; do cp -R "$2/src/$room" "$folder/src/$room"; done
cp -R "$2/validation/atlas" "$folder/validation/atlas"
"$1" -m venv --system-site-packages "$folder/env"
CMAKE_BUILD_TYPE=Debug "$folder/env/bin/pip" install --quiet --no-index --no-build-isolation "$folder/postprocess"
cd /
version=$("$folder/env/bin/python" -c 'import importlib.metadata; print(importlib.metadata.version("vibrotrough"))')
"$3" --version | head -n 1 | grep -F "$version" >&2
"$folder/env/bin/python" -B "$(dirname "$(readlink -f "$0")")/check_theory.py" "$3" "$folder"
# Without h5py the theory is there, and results say what to install.
"$folder/env/bin/python" -c 'import sys
sys.modules["h5py"] = None
import vibrotrough
assert vibrotrough.theory.solve(throw_number=2, tan_vibration_angle=0.5, friction=0.23).velocity_efficiency > 0
try:
    vibrotrough.open_campaign(sys.executable)
except ImportError as error:
    assert "vibrotrough[results]" in str(error), error
else:
    sys.exit("h5py was not needed")'
