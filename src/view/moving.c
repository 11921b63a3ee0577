/* moving.c: dynamic resolution: controller of the render size while something moves. */
#include "src/view/moving.h"
#include <math.h>

static const double target = 0.028; /* target seconds of a frame */
static const double early = 0.024;  /* the size is increased only if the predicted time is below */
static const double late = 0.033;   /* longer than this in two frames in a row: reduce the size */
static const double very_late = 0.05; /* longer than this in one frame: reduce the size */
static const double first_rest = 0.006;
static const double smoothing = 0.1; /* weight of the newest frame in the running means */

enum {
    STILL_COUNT = 8, /* minimum number of frames between two increases of the size */
};

static double area(uint32_t k)
{
    const double side = (double)k / MOVING_MOST;
    return side * side;
}

static uint32_t largest(double passes, double rest)
{
    uint32_t k = MOVING_MOST;
    while (k > MOVING_LEAST && rest + passes * area(k) > target)
        k--;
    return k;
}

void moving_begin(struct moving *m, double passes)
{
    *m = (struct moving){ .k = MOVING_MOST, .passes = passes, .rest = first_rest };
    if (passes > 0.0)
        m->k = largest(passes, first_rest);
}

static void use(struct moving *m, uint32_t k)
{
    if (m->k != k)
        m->since = m->late = 0;
    m->k = k;
}

void moving_add(struct moving *m, double frame, double passes)
{
    /* without GPU timestamps the whole frame counts as passes */
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
    if (m->k < MOVING_MOST && m->since >= STILL_COUNT &&
        m->rest + m->passes * area(m->k + 1) <= early)
        use(m, m->k + 1);
}

uint32_t moving_part(uint32_t length, uint32_t k)
{
    const uint32_t part = (length * k / MOVING_MOST) & ~1u;
    return k >= MOVING_MOST || part < 2 ? length : part;
}
