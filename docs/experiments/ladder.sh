#!/bin/sh
# ladder.sh: error of each refraction model against the reference.
#
# ladder.sh [FIRN [FOLDER]]   (build/firn, out/ladder)
# Each cell is the error of the exit direction in degrees (pixels without total internal reflection)
# / FLIP of the whole image. The surroundings are a panorama at infinity.
set -eu
if [ $# -gt 2 ] || case ${1-} in -*) true ;; *) false ;; esac; then
    printf 'usage: %s [FIRN [FOLDER]]\n' "$0" >&2
    exit 2
fi
here=$(dirname -- "$0")
firn=${1:-$here/../../build/firn}
out=${2:-$here/../../out/ladder}
python3 "$here/ladder_scenes.py" "$out"

# ladder NAME SCENE SIDE [OPTION...]: writes errors as JSON and a contact sheet to FOLDER
ladder() {
    name=$1-$3 scene=$2 side=$3
    shift 3
    "$firn" ladder "$scene" --size "${side}x$side" --env "$out/around.hdr" --runs 0 --quiet --json \
        --set refract.lookup=infinite "$@" -o "$out/$name.png" >"$out/$name.json"
}

for side in 256 512; do
    ladder sphere sphere "$side"
    ladder rounded-cube "$out/rounded-cube.obj" "$side"
    ladder valley valley "$side"
    ladder torus "$out/torus.obj" "$side" --orbit 28,60,4
    ladder teapot teapot "$side"
done
python3 - "$out" <<'END'
import json
import pathlib
import sys

SCENES = 'sphere', 'rounded-cube', 'valley', 'torus', 'teapot'
for side in 256, 512:
    said = [json.loads((pathlib.Path(sys.argv[1]) / f'{scene}-{side}.json').read_text())
            for scene in SCENES]
    print(f'{side} x {side}'.ljust(14) + ''.join(scene.rjust(18) for scene in SCENES))
    total = [100 - 100 * one['straight_pixels'] / one['object_pixels'] for one in said]
    print('reflected'.ljust(14) + ''.join(f'{share:.0f} %'.rjust(18) for share in total))
    for index, rung in enumerate(said[0]['rungs']):
        cells = [one['rungs'][index] for one in said]
        print(rung['name'].ljust(14) + ''.join(
            f'{cell["angle"]:.2f} / {cell["flip"]:.3f}'.rjust(18) for cell in cells))
    print()
END
