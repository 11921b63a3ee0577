#!/bin/sh
# inclusions.sh: error of inclusions and surface detail against the reference.
#
# inclusions.sh [FIRN [FOLDER]]   (build/firn, out/inclusions)
# Compares the ice cube rendered with `bounce` and by the ray-traced reference with the same
# inclusions: mean absolute error on the object's pixels, and FLIP of the whole image.
set -eu
if [ $# -gt 2 ] || case ${1-} in -*) true ;; *) false ;; esac; then
    printf 'usage: %s [FIRN [FOLDER]]\n' "$0" >&2
    exit 2
fi
here=$(dirname -- "$0")
firn=${1:-$here/../../build/firn}
out=${2:-$here/../../out/inclusions}
mkdir -p "$out"

# draw NAME MODEL [SETTINGS]: renders the cube with only those inclusions that are set
draw() {
    name=$1 rung=$2
    words=
    for setting in refract.fresnel=exact refract.lookup=distance env_cube.dynamic=off ${3-}; do
        words="$words --set $setting"
    done
    # shellcheck disable=SC2086 # $words is a list
    "$firn" render valley --plain --size 640x480 --samples 8 -r "$rung" -q $words \
        ${4-} -o "$out/$name.exr"
}

# truth NAME [SETTINGS]: renders the reference image
truth() {
    draw "$1" reference "${2-}" '--aov path'
}

# row NAME TRUTH [SETTINGS]: renders with bounce, and prints the errors against TRUTH
row() {
    draw "$1" bounce "${3-}"
    "$firn" diff "$out/$2.exr" "$out/$1.exr" --exposure 0 --mask "$out/$2.exr" \
        --mask-channel path.Z --json >"$out/object.json"
    "$firn" diff "$out/$2.exr" "$out/$1.exr" --exposure 0 --json >"$out/picture.json"
    python3 - "$1" "$out" <<'END'
import json
import pathlib
import sys

name, out = sys.argv[1], pathlib.Path(sys.argv[2])
mae = json.loads((out / 'object.json').read_text())['mae']
flip = json.loads((out / 'picture.json').read_text())['flip']['mean']
print(f'{name:24} {mae:.4f} {flip:.4f}')
END
}

printf '%-24s %6s %6s\n' 'of bounce' MAE FLIP
truth plain-truth
row plain plain-truth
truth bubbles-truth bubbles.count=40
row bubbles bubbles-truth bubbles.count=40
truth shapes-truth 'bubbles.count=40 bubbles.shape=mixed'
row shapes shapes-truth 'bubbles.count=40 bubbles.shape=mixed'
truth cracks-truth cracks.count=4
row cracks-off cracks-truth
for clip in convex interval; do
    row "cracks-gap-$clip" cracks-truth "cracks.count=4 cracks.refract=gap cracks.strength=0
        cracks.clip=$clip"
done
row cracks-normals cracks-truth 'cracks.count=4 cracks.refract=normals cracks.strength=0'
truth air-truth air.count=19
row air air-truth air.count=19
truth bumps-truth bump.strength=0.25
row bumps bumps-truth bump.strength=0.25
truth frost-truth frost.amount=0.6
row frost frost-truth frost.amount=0.6
all='bubbles.count=40 cracks.count=2 cracks.refract=gap cracks.strength=0 air.count=19
    bump.strength=0.25'
truth all-truth "$all"
row all all-truth "$all"
