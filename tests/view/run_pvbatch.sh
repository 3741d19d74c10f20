#!/bin/sh
# run_pvbatch.sh WORK_FOLDER PYTHON SCRIPT ARGUMENTS ...: runs a script in Debian's ParaView and renders without a screen.
# Exits with 77 (skipped) and a message when ParaView is not installed.
set -eu
work=$1
python=$2
shift 2

for program in pvbatch xvfb-run; do
    if ! command -v "$program" >/dev/null; then
        echo "SKIPPED: $program is not installed; apt-get install --no-install-recommends paraview xvfb xauth libgl1-mesa-dri libglx-mesa0"
        exit 77
    fi
done

# Debian's python3-paraview cannot be installed beside libvtk9-dev, so its files are unpacked here.
if ! "$python" -c 'import importlib.util, sys; sys.exit(importlib.util.find_spec("paraview") is None)'; then
    modules=$work/python3-paraview
    if ! test -d "$modules"; then
        mkdir -p "$work/download"
        (cd "$work/download" && apt-get download python3-paraview) || {
            echo "SKIPPED: python3-paraview was not found and could not be downloaded"
            exit 77
        }
        rm -rf "$modules.part"
        dpkg-deb -x "$work"/download/python3-paraview_*.deb "$modules.part"
        mv "$modules.part" "$modules"
    fi
    PYTHONPATH=$modules/usr/lib/python3/dist-packages
    export PYTHONPATH
fi
exec xvfb-run -a -s "-screen 0 1600x1000x24 +extension GLX -noreset" pvbatch --force-offscreen-rendering "$@"
