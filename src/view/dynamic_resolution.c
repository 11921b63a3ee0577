/* dynamic_resolution.c: adapts the render size to the measured frame times during interaction. */
#include "src/view/dynamic_resolution.h"
#include <math.h>

static const double target = 0.028;   /* target frame time, seconds */
static const double early = 0.024;    /* predicted time (s) below which the render size grows */
static const double late = 0.033;     /* 2 successive frames over `late` seconds shrink the size */
static const double very_late = 0.05; /* one frame over `very_late` seconds shrinks the size */
static const double first_rest = 0.006;
static const double smoothing = 0.1; /* weight of the newest frame */

enum {
    RISE_INTERVAL = 8, /* minimum frames between size increases */
};

static double area(uint32_t k)
{
    const double side = (double)k / DYNAMIC_RESOLUTION_MAX;
    return side * side;
}

static uint32_t largest(double passes, double rest)
{
    uint32_t k = DYNAMIC_RESOLUTION_MAX;
    while (k > DYNAMIC_RESOLUTION_MIN && rest + passes * area(k) > target)
        k--;
    return k;
}

void dynamic_resolution_begin(struct dynamic_resolution *m, double passes)
{
    *m = (struct dynamic_resolution){ .k = DYNAMIC_RESOLUTION_MAX,
                                      .passes = passes,
                                      .rest = first_rest };
    if (passes > 0.0)
        m->k = largest(passes, first_rest);
}

static void use(struct dynamic_resolution *m, uint32_t k)
{
    if (m->k != k)
        m->since = m->late = 0;
    m->k = k;
}

void dynamic_resolution_add(struct dynamic_resolution *m, double frame, double passes)
{
    /* without GPU timestamps, the whole frame time counts as pass time */
    passes = passes > 0.0 ? passes : frame;
    const double whole = passes / area(m->k);
    const double rest = fmax(frame - passes, 0.0);
    m->late = frame > late ? m->late + 1 : 0;
    m->since++;
    if (m->late >= 2 || frame > very_late) {
        m->passes = whole;
        m->rest = rest;
        const uint32_t k = largest(whole, rest);
        use(m, k < m->k ? k : m->k);
        return;
    }
    m->passes += smoothing * (whole - m->passes);
    m->rest += smoothing * (rest - m->rest);
    if (m->k < DYNAMIC_RESOLUTION_MAX && m->since >= RISE_INTERVAL &&
        m->rest + m->passes * area(m->k + 1) <= early)
        use(m, m->k + 1);
}

uint32_t dynamic_resolution_scale(uint32_t length, uint32_t k)
{
    const uint32_t even = (length * k / DYNAMIC_RESOLUTION_MAX) & ~1u;
    return k >= DYNAMIC_RESOLUTION_MAX || even < 2 ? length : even;
}
