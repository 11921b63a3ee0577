/* flip.c: LDR-FLIP and HDR-FLIP. */
#include "src/metric/flip.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/metric/flip_color.h"
#include "src/metric/flip_filter.h"
#include "src/metric/quantile.h"

/* A processed image. */
struct side {
    struct flip_plane color[3];    /* opponent colours, which are then converted to Hunt's */
    struct flip_plane edge, point; /* strength of edges and points */
};

struct work {
    const struct flip_pair *pair;
    struct side reference, test;
    struct flip_plane scratch, first, second;
    float *line;
    struct flip_sensitivity sensitivity[FLIP_CHANNEL_COUNT];
    struct flip_features features;
    float *memory;
};

/* How both images are displayed. */
struct shown {
    float scale;
    bool has_curve; /* tone mapped by `curve`, else clamped */
    enum flip_curve curve;
};

static struct flip_plane take_plane(struct work *work, float **free_texels)
{
    const struct flip_plane plane = {
        .width = work->pair->width,
        .height = work->pair->height,
        .stride = flip_stride(work->pair->width),
        .texels = *free_texels,
    };
    *free_texels += plane.stride * plane.height;
    return plane;
}

static bool work_init(struct work *work, const struct flip_pair *pair)
{
    enum {
        PLANE_COUNT = 2 * 5 + 3
    };

    const size_t plane_size = flip_stride(pair->width) * pair->height;
    *work = (struct work){ .pair = pair };
    if (plane_size > (SIZE_MAX / sizeof(float) - flip_line_size(pair->width)) / PLANE_COUNT)
        return false;
    /* Zeroed, because filters read texels between width and stride. */
    work->memory = calloc(PLANE_COUNT * plane_size + flip_line_size(pair->width), sizeof(float));
    if (!work->memory)
        return false;
    float *texels = work->memory;
    struct flip_plane *const planes[PLANE_COUNT] = {
        &work->reference.color[0],
        &work->reference.color[1],
        &work->reference.color[2],
        &work->reference.edge,
        &work->reference.point,
        &work->test.color[0],
        &work->test.color[1],
        &work->test.color[2],
        &work->test.edge,
        &work->test.point,
        &work->scratch,
        &work->first,
        &work->second,
    };
    for (size_t i = 0; i < PLANE_COUNT; i++)
        *planes[i] = take_plane(work, &texels);
    work->line = texels;
    for (int c = 0; c < FLIP_CHANNEL_COUNT; c++)
        flip_sensitivity_init(&work->sensitivity[c], (enum flip_channel)c, pair->ppd);
    flip_features_init(&work->features, pair->ppd);
    return true;
}

/* ---- an image ---- */

/* HDR-FLIP is defined from 0 to 65536; pixels that are not finite get the error 1 later. */
static vec3s load(const float *const planes[static 3], size_t i)
{
    vec3s v;
    for (int c = 0; c < 3; c++)
        v.raw[c] = fminf(fmaxf(planes[c][i], 0.0f), 65536.0f); /* NaN: 0 */
    return v;
}

static void store(const struct flip_plane planes[static 3], size_t at, vec3s v)
{
    for (int c = 0; c < 3; c++)
        planes[c].texels[at] = v.raw[c];
}

static void fill(struct side *side, const float *const planes[static 3], const struct shown *shown)
{
    const struct flip_plane *first = &side->color[0];
    for (uint32_t y = 0; y < first->height; y++) {
        for (uint32_t x = 0; x < first->width; x++) {
            vec3s v = load(planes, (size_t)y * first->width + x);
            v = glms_vec3_scale(v, shown->scale);
            v = shown->has_curve ? flip_tone(shown->curve, v) : glms_vec3_minv(v, glms_vec3_one());
            store(side->color, y * first->stride + x, flip_color_opponent(v));
        }
    }
}

static void filter(struct work *work, const struct flip_plane *in, const struct flip_kernel *across,
                   const struct flip_kernel *down, struct flip_plane *out)
{
    flip_filter(&(struct flip_filter){
        .in = in,
        .across = across,
        .down = down,
        .scratch = &work->scratch,
        .out = out,
        .line = work->line,
        .share = 1.0f,
    });
}

/* Computes the length of the gradient of Y for one feature kernel. */
static void find_feature(struct work *work, const struct flip_plane *y,
                         const struct flip_kernel *kernel, struct flip_plane *strength)
{
    filter(work, y, kernel, &work->features.smooth, &work->first);
    filter(work, y, &work->features.smooth, kernel, &work->second);
    for (size_t i = 0; i < y->stride * y->height; i++) {
        const float a = work->first.texels[i], b = work->second.texels[i];
        strength->texels[i] = sqrtf(a * a + b * b) / 116.0f; /* scaled to luminance, 1 for white */
    }
}

/* Filters a channel by its contrast sensitivity. */
static void blur(struct work *work, struct flip_plane *plane, enum flip_channel channel)
{
    const struct flip_sensitivity *s = &work->sensitivity[channel];
    struct flip_plane blurred = s->count > 1 ? work->first : *plane;
    for (uint32_t i = 0; i < s->count; i++) {
        flip_filter(&(struct flip_filter){
            .in = plane,
            .across = &s->kernels[i],
            .down = &s->kernels[i],
            .scratch = &work->scratch,
            .out = &blurred,
            .line = work->line,
            .share = s->shares[i],
            .add = i > 0,
        });
    }
    if (s->count > 1) {
        work->first = *plane;
        *plane = blurred;
    }
}

static void prepare(struct work *work, struct side *side, const float *const planes[static 3],
                    const struct shown *shown)
{
    fill(side, planes, shown);
    find_feature(work, &side->color[0], &work->features.edge, &side->edge);
    find_feature(work, &side->color[0], &work->features.point, &side->point);
    for (int c = 0; c < FLIP_CHANNEL_COUNT; c++)
        blur(work, &side->color[c], (enum flip_channel)c);
    for (size_t i = 0; i < side->edge.stride * side->edge.height; i++) {
        const vec3s v = { { side->color[0].texels[i], side->color[1].texels[i],
                            side->color[2].texels[i] } };
        const vec3s linear = glms_vec3_clamp(flip_color_linear(v), 0.0f, 1.0f);
        store(side->color, i, flip_color_hunt(linear));
    }
}

/* ---- errors ---- */

static float find_error(const struct work *work, size_t i)
{
    vec3s a, b;
    for (int c = 0; c < 3; c++) {
        a.raw[c] = work->reference.color[c].texels[i];
        b.raw[c] = work->test.color[c].texels[i];
    }
    const float edge = fabsf(work->reference.edge.texels[i] - work->test.edge.texels[i]);
    const float point = fabsf(work->reference.point.texels[i] - work->test.point.texels[i]);
    const float feature = fminf(sqrtf(fmaxf(edge, point) * 0.707106781f), 1.0f);
    return powf(flip_color_error(flip_color_distance(a, b)), 1.0f - feature);
}

/* Sets errors[] to the maximum of themselves and the errors of images displayed in one way. */
static void raise(struct work *work, const struct shown *shown, float *errors)
{
    const struct flip_pair *pair = work->pair;
    prepare(work, &work->reference, pair->reference, shown);
    prepare(work, &work->test, pair->test, shown);
    for (uint32_t y = 0; y < pair->height; y++) {
        for (uint32_t x = 0; x < pair->width; x++) {
            float *error = &errors[(size_t)y * pair->width + x];
            *error = fmaxf(*error, find_error(work, y * work->first.stride + x));
        }
    }
}

/* Initialises errors[]: 1 for pixels that are not finite, else 0. */
static void begin(const struct flip_pair *pair, float *errors)
{
    for (size_t i = 0; i < (size_t)pair->width * pair->height; i++) {
        bool finite = true;
        for (int c = 0; c < 3; c++)
            finite = finite && isfinite(pair->reference[c][i]) && isfinite(pair->test[c][i]);
        errors[i] = finite ? 0.0f : 1.0f;
    }
}

bool flip_ldr(const struct flip_pair *pair, double exposure, float *errors)
{
    struct work work;
    if (!work_init(&work, pair))
        return false;
    begin(pair, errors);
    raise(&work, &(struct shown){ .scale = (float)exp2(exposure) }, errors);
    free(work.memory);
    return true;
}

/*
 * If half of the image or more is black, the median is that of the other pixels, because the paper
 * defines no exposure for that case. Black is what half floats cannot represent.
 */
static bool find_exposures(const struct flip_pair *pair, enum flip_curve curve,
                           struct flip_exposures *exposures)
{
    const float black = 0x1p-24f;
    const size_t count = (size_t)pair->width * pair->height;
    float *values = malloc(count * sizeof(*values));
    if (!values)
        return false;
    for (size_t i = 0; i < count; i++)
        values[i] = flip_tone_luminance(load(pair->reference, i));
    quantile_sort(values, count);
    size_t first = 0;
    if (quantile_median(values, count) < (double)black) {
        while (first + 1 < count && values[first] < black)
            first++;
    }
    *exposures = flip_tone_exposures(curve, (double)values[count - 1],
                                     quantile_median(values + first, count - first));
    free(values);
    return true;
}

bool flip_hdr(const struct flip_pair *pair, enum flip_curve curve, float *errors,
              struct flip_exposures *exposures)
{
    struct work work;
    if (!find_exposures(pair, curve, exposures) || !work_init(&work, pair))
        return false;
    const double step = (exposures->last - exposures->first) / (exposures->count - 1);
    begin(pair, errors);
    for (uint32_t i = 0; i < exposures->count; i++) {
        const struct shown shown = {
            .scale = (float)exp2(exposures->first + i * step),
            .has_curve = true,
            .curve = curve,
        };
        raise(&work, &shown, errors);
    }
    free(work.memory);
    return true;
}
