#!/bin/sh
# Opens this folder in ParaView: the whole scene, or the bare frames when ParaView lacks its Python modules.
here=$(dirname "$(readlink -f "$0")")
# Python must not find modules in the folder that this is called from, nor in this one.
PYTHONSAFEPATH=1
export PYTHONSAFEPATH
cd / || exit 1
if command -v pvbatch >/dev/null && ! echo 'import paraview.simple' | pvbatch /dev/stdin 2>/dev/null; then
    echo "ParaView's Python modules are missing (Debian: python3-paraview), so only the bare frames open:" >&2
    echo "press Apply, then draw grains.pvd as Point Gaussian, scaled by radius." >&2
    set -- "$here/grains.pvd" "$here/trough.pvd"
    if grep -q '<DataSet' "$here/point_mass.pvd" 2>/dev/null; then set -- "$@" "$here/point_mass.pvd"; fi
    exec paraview "$@"
fi
exec paraview --state="$here/view_case.py"
