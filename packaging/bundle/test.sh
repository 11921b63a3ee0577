#!/bin/sh
# test.sh: runs the bundle in a root that has only glibc, /proc and /dev, from a read-only folder.
#
# Usage: test.sh ARCHIVE   as root, because it mounts file systems; prints "skipped" if it must not
set -eu
unset CDPATH
archive=$1
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
if ! unshare -m true 2>/dev/null; then
    echo 'skipped: a root with other files needs the right to mount'
    exit 0
fi
bundle=/opt/$(basename "$archive" .tar.zst)
root=$temporary/root
mkdir -p "$root/proc" "$root/dev" "$root/tmp" "$root/lib" "$root/lib64" "$root/opt"
tar -C "$temporary" -I zstd -xf "$archive"
mkdir "$root$bundle"
ldd "$temporary/${bundle##*/}/libexec/firn" | awk '$3 ~ /^\// { print $3 }' |
    grep -E '/(libc|libm|libdl|libpthread|librt)\.so' | xargs -I{} cp -L {} "$root/lib"
cp -L /lib/x86_64-linux-gnu/libdl.so.2 /lib/x86_64-linux-gnu/libpthread.so.0 "$root/lib"
cp -L /lib64/ld-linux-x86-64.so.2 "$root/lib64"
# inside COMMAND...: runs a command with chroot in that root
inside() {
    # shellcheck disable=SC2016 # variables of the inner shell
    env -i unshare -m sh -euc '
        mount -t proc proc "$1/proc"
        mount --rbind /dev "$1/dev"
        mount --bind "$2" "$1$3"
        mount -o remount,bind,ro "$1$3"
        root=$1
        shift 3
        exec chroot "$root" "$@"' sh "$root" "$temporary/${bundle##*/}" "$bundle" "$@"
}
inside "$bundle/bin/firn" selftest
inside "$bundle/bin/firn" render ice-cube --size 64x48 -q -o /tmp/ice.png
[ -s "$root/tmp/ice.png" ]
# the viewer finds all its libraries, but no display
inside "$bundle/bin/firn" view --size 64x48 2>"$temporary/said" && exit 1
grep -q '^firn: ' "$temporary/said" || { cat "$temporary/said" && exit 1; }
rm "$root/lib/libc.so.6"
inside "$bundle/bin/firn" --version 2>"$temporary/said" && exit 1
[ "$(cat "$temporary/said")" = 'firn: needs glibc 2.36 or later, which this system does not have' ]
