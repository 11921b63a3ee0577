#!/bin/sh
# environment.sh: repeats figure 7 of the paper, an ice cube in a landscape: one- and two-sided
# refraction, with an environment cube map rendered in every frame (dynamic) or once (static), and
# with ice that fills the screen.
#
# environment.sh [FIRN [FOLDER]]   (build/firn, out/experiments)
# Ten frames each, with three objects moving around the ice; a static cube map shows them at their
# positions in frame 0. The ice has 19 planes of air bubbles and 2 cracks, clipped as in the paper,
# and no single bubbles. It covers 20.0 % of the pixels in frame 0 (those with a front.Z), or all.
# shellcheck source=docs/experiments/draw.sh
. "$(dirname -- "$0")/draw.sh"

# cube COVERAGE DISTANCE SIDES MODEL CUBE DYNAMIC: renders ten frames
cube() {
    draw "environment-$1-$3-$5.####" valley --frames 0-9 --orbit "28,9,$2" --refraction "$4" \
        --set "env_cube.dynamic=$6" --set motion.count=3 --set cracks.count=2 \
        --set cracks.clip=convex --set air.count=19 --set bubbles.count=0
}

heading
cube fifth 4.34 one-sided one-sided dynamic on
cube fifth 4.34 one-sided one-sided static off
cube fifth 4.34 two-sided paper dynamic on
cube fifth 4.34 two-sided paper static off
cube full 1.5 two-sided paper static off
