/* apart.c: FLIP beside the loop. */
#include "src/view/apart.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/tonemap.h"
#include "src/metric/flip.h"
#include "src/metric/heat.h"
#include "src/metric/quantile.h"
#include "src/view/window.h"

static const double most = 0.95; /* of all pixels */

static void forget(struct apart *a)
{
    for (size_t s = 0; s < 2; s++) {
        free(a->planes[s]);
        a->planes[s] = NULL;
    }
    free(a->errors);
    free(a->rgba);
    a->errors = NULL;
    a->rgba = NULL;
}

void apart_finish(struct apart *a)
{
    if (a->runs)
        pthread_join(a->thread, NULL);
    a->runs = false;
    forget(a);
}

static bool copy(struct apart *a, size_t side, const struct apart_side *from)
{
    static const char *const names[] = { "R", "G", "B" };
    const size_t size = (size_t)a->width * a->height;
    a->planes[side] = malloc(size * 3 * sizeof(float));
    a->is_shown[side] = from->is_shown;
    for (size_t c = 0; c < 3 && a->planes[side]; c++) {
        const float *texels = image_find(from->image, names[c]);
        for (size_t i = 0; i < size; i++)
            a->planes[side][c * size + i] = texels ? texels[i] * from->scale : 0.0f;
    }
    return a->planes[side] != NULL;
}

static void show(struct apart *a, size_t side)
{
    const size_t size = (size_t)a->width * a->height;
    float *p = a->planes[side];
    for (size_t i = 0; i < size && !a->is_shown[side]; i++) {
        const vec3s linear = { { p[i], p[size + i], p[2 * size + i] } };
        const vec3s shown = tonemap_apply(linear, a->gain, a->curve);
        for (size_t c = 0; c < 3; c++)
            p[c * size + i] = shown.raw[c];
    }
}

static void colour(struct apart *a)
{
    const size_t size = (size_t)a->width * a->height;
    double sum = 0.0;
    for (size_t i = 0; i < size; i++) {
        heat_srgb(a->errors[i], &a->rgba[i * 4]);
        a->rgba[i * 4 + 3] = 255;
        sum += (double)a->errors[i];
    }
    a->mean = sum / (double)size;
    quantile_sort(a->errors, size);
    a->high = quantile_at(a->errors, size, most);
}

static void *run(void *user)
{
    struct apart *a = user;
    const size_t size = (size_t)a->width * a->height;
    struct flip_pair pair = { .width = a->width, .height = a->height, .ppd = FLIP_PPD };
    for (size_t s = 0; s < 2; s++)
        show(a, s);
    for (size_t c = 0; c < 3; c++) {
        pair.test[c] = &a->planes[0][c * size];
        pair.reference[c] = &a->planes[1][c * size];
    }
    a->errors = malloc(size * sizeof(*a->errors));
    a->rgba = malloc(size * 4);
    a->failed = !a->errors || !a->rgba || !flip_ldr(&pair, 0.0, a->errors);
    if (!a->failed)
        colour(a);
    atomic_store(&a->done, true);
    window_wake();
    return NULL;
}

bool apart_begin(struct apart *a, const struct apart_side sides[static 2], float gain,
                 uint32_t curve)
{
    forget(a);
    a->width = sides[0].image->width;
    a->height = sides[0].image->height;
    a->gain = gain;
    a->curve = curve;
    a->failed = false;
    atomic_store(&a->done, false);
    if (copy(a, 0, &sides[0]) && copy(a, 1, &sides[1]))
        a->runs = pthread_create(&a->thread, NULL, run, a) == 0;
    if (!a->runs)
        forget(a);
    return a->runs;
}

bool apart_take(struct apart *a)
{
    if (!a->runs || !atomic_load(&a->done))
        return false;
    pthread_join(a->thread, NULL);
    a->runs = false;
    return true;
}
