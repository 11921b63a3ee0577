/*
 * bench.c: the tree of a million triangles of glass, on two threads.
 *
 * Prints the seconds of its build, the MiB that it has, and the greatest number of MiB while it was
 * built; and the seconds for a pose of a model that moves. Fails if the build takes more than
 * seconds_max, or has more than MEBIBYTES_MAX.
 */
#include <stdio.h>
#include <sys/resource.h>
#include "src/scene/bvh/bvh.h"
#include "src/scene/generate/generate.h"

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

/* Returns the seconds for the tree of the model where it has moved; 1e9: it has failed. */
static double move(struct model *model)
{
    double seconds = 1e9;
    struct bvh_rest_pose *rest = bvh_rest_pose_create(true);
    const struct bvh_params params = { .model = model, .rest = rest, .threads = THREADS };
    for (int i = 0; rest && i < TURNS; i++) {
        struct bvh bvh;
        if (bvh_init(&bvh, &params) != STATUS_OK)
            break;
        if (i > 0)
            seconds = bvh.ms / 1e3 < seconds ? bvh.ms / 1e3 : seconds;
        bvh_finish(&bvh);
        if (i == 0) {
            rest->is_known = mesh_append(&rest->model.object, &model->object);
            mesh_fit(&model->object, 3.0f);
        }
    }
    bvh_rest_pose_destroy(rest);
    return seconds;
}

int main(void)
{
    struct model model = { 0 };
    double seconds = 1e9, mebibytes = 0.0;
    if (!generate_teapot(&model.object, TRIANGLES))
        return 1;
    const double before = peak();
    for (int i = 0; i < TURNS; i++) {
        struct bvh bvh;
        if (bvh_init(&bvh, &(struct bvh_params){ .model = &model, .threads = THREADS }) !=
            STATUS_OK)
            return 1;
        seconds = bvh.ms / 1e3 < seconds ? bvh.ms / 1e3 : seconds;
        mebibytes = (double)bvh_size(&bvh) / (1 << 20);
        if (i == 0)
            printf("tree of %u triangles on %d threads: depth %u\n", bvh.triangle_count, THREADS,
                   bvh.depth);
        bvh_finish(&bvh);
    }
    printf("%.2f s (at most %.0f), %.0f MiB (at most %d), %.0f MiB more while it is built\n",
           seconds, seconds_max, mebibytes, MEBIBYTES_MAX, peak() - before - mebibytes);
    printf("%.2f s where the model has moved\n", move(&model));
    mesh_finish(&model.object);
    return seconds > seconds_max || mebibytes > MEBIBYTES_MAX;
}
