#!/bin/sh
# another_debian.sh SUITE FOLDER COMMAND...: runs COMMAND in a copy of this checkout's last commit on another Debian, as root.
#
#     sh tests/machines/another_debian.sh trixie /tmp/debian13 ./setup demo
#     sh tests/machines/another_debian.sh trixie /tmp/debian13 ctest --preset release -R 'page|postprocess'
#
# The first call makes FOLDER with debootstrap and installs what the tests need (2 GB to download); later calls use it again, with
# what was built in it. Its processes see this machine's devices and processors; the mounts end with the command.
set -eu
[ $# -ge 3 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
suite=$1
folder=$2
shift 2
checkout=$(cd "$(dirname "$0")/../.." && pwd)
root=$folder/root
if [ ! -e "$folder/made" ]; then
    mkdir -p "$folder"
    debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$root" >&2
    touch "$folder/made"
fi
# The last commit only: what lies uncommitted in the checkout is not what others get.
git -C "$checkout" bundle create --quiet "$root/checkout.bundle" HEAD
exec unshare --mount sh -eu -c '
    root=$1
    shift
    mount --bind "$root" "$root"  # so that a process inside may have mounts of its own
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    cp /etc/resolv.conf /etc/hosts "$root/etc/"  # a browser asks for localhost
    exec chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 sh -eu -c "
        git clone --quiet /checkout.bundle /checkout-of-vibrotrough 2>/dev/null || { cd /checkout-of-vibrotrough && git fetch --quiet origin HEAD; }
        cd /checkout-of-vibrotrough
        git checkout --quiet --detach \"\$(git bundle list-heads /checkout.bundle | cut -d\" \" -f1)\"
        [ -e /installed ] || { apt-get update -qq; DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \$(./setup packages test) >/dev/null; touch /installed; }
        exec \"\$@\"" sh "$@"' sh "$root" "$@"
