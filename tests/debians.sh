#!/bin/bash
# Runs the test suite on bare Debian systems, one after another: for releases.
#
#   tests/debians.sh [SUITE...]      bookworm, trixie and sid unless named
#
# Each is made by debootstrap in a folder under $DEBIANS (default: crosscheck-debians in the folder
# for temporary files) and kept there; delete it to start anew. What is committed at HEAD is tested
# by ./crosscheck test as from a tarball, where no git is installed. Prints pytest's closing line of
# each; ends with 1 if one failed. Needs root, debootstrap and git; 4 GB of disk and up to half an
# hour a system. Package mirror, certificates, name service and pip's settings are this machine's.
set -euo pipefail

checkout=$(cd "$(dirname "$0")/.." && pwd)
roots=${DEBIANS:-${TMPDIR:-/tmp}/crosscheck-debians}
fail() { printf 'debians.sh: %s\n' "$*" >&2; exit 2; }

# The first archive that apt's own sources name.
mirror() {
    cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | sed 's/#.*//' |
        tr -s ' \t' '\n' | grep -E -m 1 '^https?://.*/debian/?$' || true
}

make_root() {  # SUITE ROOT
    printf 'debians.sh: making %s\n' "$2" >&2
    # Under another name until it is whole: what an interrupted one left is not taken for a system.
    if [ -e "$2.part" ]; then
        umount --recursive --quiet "$2.part/proc" "$2.part/sys" || true
        rm -rf --one-file-system "$2.part"
    fi
    mkdir -p "$2.part"
    debootstrap --variant=minbase --include=ca-certificates "$1" "$2.part" "$archive" >"$2.log" 2>&1 ||
        fail "debootstrap failed, see $2.log"
    printf 'deb %s %s main\n' "$archive" "$1" >"$2.part/etc/apt/sources.list"
    # Daemons are not started in here.
    printf '#!/bin/sh\nexit 101\n' >"$2.part/usr/sbin/policy-rc.d"
    chmod +x "$2.part/usr/sbin/policy-rc.d"
    mv "$2.part" "$2"
}

# What belongs to the place and not to the system.
settle() {  # ROOT
    cp -L /etc/resolv.conf /etc/hosts "$1/etc/"
    [ ! -f /etc/pip.conf ] || cp /etc/pip.conf "$1/etc/"
    printf 'Acquire::Check-Valid-Until "false";\n' >"$1/etc/apt/apt.conf.d/99place"
    if compgen -G '/usr/local/share/ca-certificates/*.crt' >/dev/null; then
        cp -L /usr/local/share/ca-certificates/*.crt "$1/usr/local/share/ca-certificates/"
        chroot "$1" update-ca-certificates >/dev/null 2>&1
    fi
}

# In a namespace of its own, whose mounts go when it ends.
run_suite() {  # ROOT
    unshare --mount --pid --fork --kill-child /bin/bash -c '
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --rbind /dev "$0/dev"
        exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
            PIP_CONFIG_FILE=/etc/pip.conf /bin/sh -c "cd /project && exec ./crosscheck test -q"
    ' "$1" </dev/null
}

[ "$EUID" = 0 ] || fail "needs root"
command -v debootstrap >/dev/null || fail "debootstrap is missing: apt-get install debootstrap"
archive=$(mirror)
[ -n "$archive" ] || fail "no Debian archive found in /etc/apt"
[ $# -gt 0 ] || set -- bookworm trixie sid
status=0
for suite; do
    root=$roots/$suite
    [ -x "$root/bin/sh" ] || make_root "$suite" "$root"
    settle "$root"
    rm -rf "$root/project"
    mkdir "$root/project"
    git -C "$checkout" archive HEAD | tar -x -C "$root/project"
    if run_suite "$root" >"$root.test.log" 2>&1; then result=passed; else result=failed status=1; fi
    printf '%-9s %s: %s\n' "$suite" "$result" "$(tail -n 1 "$root.test.log")"
done
exit $status
