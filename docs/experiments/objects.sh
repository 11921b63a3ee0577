#!/bin/sh
# objects.sh: repeats figure 6 of the paper: three objects with and without cracks and air bubbles.
#
# objects.sh [FIRN [FOLDER]]   (build/firn, out/experiments)
# The sphere has 960 triangles, the ice cube 4800, the teapot 14400. As in the paper there are 19
# planes of air bubbles, 2 cracks with the paper's clipping (made for convex objects: in the teapot,
# cracks can show between its parts), no single bubbles, and a static environment. Each object
# covers 20.0 % of the pixels (those with a front.Z): the paper's fifth of the screen.
# shellcheck source=docs/experiments/draw.sh
. "$(dirname -- "$0")/draw.sh"

# both OBJECT TRIANGLES DISTANCE: renders the object without and with inclusions
both() {
    for inside in plain cracks-air; do
        case $inside in
        plain) cracks=0 air=0 ;;
        cracks-air) cracks=2 air=19 ;;
        esac
        draw "objects-$1-$2-$inside" "$1" --orbit "28,9,$3" --set "object.triangles=$2" \
            --set "cracks.count=$cracks" --set cracks.clip=convex --set "air.count=$air" \
            --set bubbles.count=0 --set env_cube.dynamic=off
    done
}

heading
both sphere 960 4.27
both valley 4800 4.34
both teapot 14400 2.5
