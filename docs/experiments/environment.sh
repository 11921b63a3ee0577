#!/bin/sh
# environment.sh: the ice cube in the landscape, as in figure 7 of the paper: one- and two-sided
# refraction, with an environment cube that is drawn in every frame (dynamic) or once (static); and
# how much it matters that the ice fills the screen.
#
# environment.sh [FIRN [FOLDER]]   (build/firn, out/experiments)
# Ten frames each, with three objects moving around the ice: a static cube shows them where they
# were in frame 0. 19 planes of air and 2 cracks, clipped as in the paper; no single bubbles.
# The ice covers 20.0 % of the pixels in frame 0 (those that have a front.Z), or all in every frame.
# shellcheck source=docs/experiments/draw.sh
. "$(dirname -- "$0")/draw.sh"

# cube COVERAGE DISTANCE SIDES RUNG CUBE DYNAMIC: ten frames
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
