/*
 * bench.c: the tree of a million triangles of glass, on two threads.
 *
 * Prints the seconds of its build, the MiB that it has, and the greatest number of MiB while it was
 * built. Fails if it takes more than seconds_max or has more than MEBIBYTES_MAX.
 */
#include <stdio.h>
#include <sys/resource.h>
#include "src/scene/generate/generate.h"
#include "src/scene/tree.h"

enum {
    TRIANGLES = 1000000,
    THREADS = 2,
    TURNS = 3,
    MEBIBYTES_MAX = 150,
};

static const double seconds_max = 4.0;

/* Returns the most MiB that the process has had. */
static double peak(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_maxrss / 1024.0;
}

int main(void)
{
    struct model model = { 0 };
    double seconds = 1e9, mebibytes = 0.0;
    if (!generate_teapot(&model.object, TRIANGLES))
        return 1;
    const double before = peak();
    for (int i = 0; i < TURNS; i++) {
        struct tree tree;
        if (tree_init(&tree, &model, NULL, THREADS) != STATUS_OK)
            return 1;
        seconds = tree.ms / 1e3 < seconds ? tree.ms / 1e3 : seconds;
        mebibytes = (double)tree_size(&tree) / (1 << 20);
        if (i == 0)
            printf("tree of %u triangles on %d threads: depth %u\n", tree.triangle_count, THREADS,
                   tree.depth);
        tree_finish(&tree);
    }
    printf("%.2f s (at most %.0f), %.0f MiB (at most %d), %.0f MiB more while it is built\n",
           seconds, seconds_max, mebibytes, MEBIBYTES_MAX, peak() - before - mebibytes);
    mesh_finish(&model.object);
    return seconds > seconds_max || mebibytes > MEBIBYTES_MAX;
}
