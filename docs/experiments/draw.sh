# shellcheck shell=sh
# draw.sh: functions shared by objects.sh and environment.sh, which source it.
set -eu
if [ $# -gt 2 ] || case ${1-} in -*) true ;; *) false ;; esac; then
    printf 'usage: %s [FIRN [FOLDER]]\n' "$0" >&2
    exit 2
fi
root=$(dirname -- "$0")/../..
firn=${1:-$root/build/firn}
out=${2:-$root/out/experiments}

# heading: prints the head of the table
heading() {
    mkdir -p "$out"
    printf 'Wall-clock time of each run of firn, start-up included: no benchmark.\n\n'
    printf '%-46s %8s\n' 'picture' 'seconds'
}

# draw NAME SCENE [OPTION...]: renders SCENE to NAME.png, and prints its row of the table
draw() {
    picture=$1.png
    shift
    start=$(date +%s.%N)
    "$firn" render --refraction paper --set refract.fresnel=paper --set refract.lookup=infinite \
        --set env_cube.size=512 "$@" --size 1024x768 --quiet -o "$out/$picture"
    end=$(date +%s.%N)
    LC_ALL=C awk -v name="$picture" -v start="$start" -v end="$end" \
        'BEGIN { printf "%-46s %8.2f\n", name, end - start }'
}
