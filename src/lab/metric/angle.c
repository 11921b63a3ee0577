/* angle.c: statistics of the angles between the directions of two images. */
#include "src/lab/metric/angle.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/metric/quantile.h"

static vec3s load_direction(const float *const direction[static 3], size_t i)
{
    return (vec3s){ { direction[0][i], direction[1][i], direction[2][i] } };
}

bool angle_is_there(const float *const direction[static 3], size_t pixel)
{
    const float length = glms_vec3_norm(load_direction(direction, pixel));
    return isfinite(length) && length > 0.5f;
}

/* Returns the angle in degrees by atan2, since acos is imprecise for small angles. */
static float angle_between(vec3s a, vec3s b)
{
    const float across = glms_vec3_norm(glms_vec3_cross(a, b));
    return glm_deg(atan2f(across, glms_vec3_dot(a, b)));
}

static void summarize(struct angle *angle, float *angles, size_t count)
{
    double sum = 0.0;
    angle->both = count;
    angle->mean = angle->median = angle->percentile_95 = angle->largest = (double)NAN;
    if (!count)
        return;
    quantile_sort(angles, count);
    for (size_t i = 0; i < count; i++)
        sum += (double)angles[i];
    angle->mean = sum / (double)count;
    angle->median = quantile_median(angles, count);
    angle->percentile_95 = quantile_at(angles, count, 0.95);
    angle->largest = (double)angles[count - 1];
}

bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees)
{
    size_t count = 0;
    float *angles = malloc(pair->pixel_count * sizeof(*angles));
    *angle = (struct angle){ 0 };
    if (!angles)
        return false;
    if (degrees)
        memset(degrees, 0, pair->pixel_count * sizeof(*degrees));
    for (size_t i = 0; i < pair->pixel_count; i++) {
        if (pair->counted && !pair->counted[i])
            continue;
        const bool in_reference = angle_is_there(pair->reference, i);
        const bool in_test = angle_is_there(pair->test, i);
        angle->only_reference += in_reference && !in_test;
        angle->only_test += in_test && !in_reference;
        if (!in_reference || !in_test)
            continue;
        angles[count] =
            angle_between(load_direction(pair->reference, i), load_direction(pair->test, i));
        if (degrees)
            degrees[i] = angles[count];
        count++;
    }
    summarize(angle, angles, count);
    free(angles);
    return true;
}
