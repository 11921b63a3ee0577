/* flip.c: computes LDR-FLIP and HDR-FLIP error maps. */
#include "src/lab/metric/flip.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include "src/lab/metric/flip_color.h"
#include "src/lab/metric/flip_filter.h"
#include "src/lab/metric/quantile.h"

/* Filtered image: the reference or the test. */
struct side {
    struct flip_plane color[3];    /* YCxCz, filtered, later Hunt-adjusted L*a*b* */
    struct flip_plane edge, point; /* edge and point feature strength */
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

/* Display transform of both images. */
struct display {
    float scale;
    bool has_curve; /* tone-mapped by `curve`, else clamped */
    enum flip_curve curve;
};

static struct flip_plane allocate_plane(struct work *work, float **free_texels)
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
    /* The memory is zeroed, because the filters also read the padding of each row. */
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
        *planes[i] = allocate_plane(work, &texels);
    work->line = texels;
    for (int c = 0; c < FLIP_CHANNEL_COUNT; c++)
        flip_sensitivity_init(&work->sensitivity[c], (enum flip_channel)c, pair->ppd);
    flip_features_init(&work->features, pair->ppd);
    return true;
}

/* Loads a pixel, clamped to 0..65536. Non-finite pixels are handled by init_errors(). */
static vec3s load(const float *const planes[static 3], size_t i)
{
    vec3s v;
    for (int c = 0; c < 3; c++)
        v.raw[c] = fminf(fmaxf(planes[c][i], 0.0f), 65536.0f); /* NaN becomes 0 */
    return v;
}

static void store(const struct flip_plane planes[static 3], size_t at, vec3s v)
{
    for (int c = 0; c < 3; c++)
        planes[c].texels[at] = v.raw[c];
}

static void fill(struct side *side, const float *const planes[static 3],
                 const struct display *display)
{
    const struct flip_plane *first = &side->color[0];
    for (uint32_t y = 0; y < first->height; y++) {
        for (uint32_t x = 0; x < first->width; x++) {
            vec3s v = load(planes, (size_t)y * first->width + x);
            v = glms_vec3_scale(v, display->scale);
            v = display->has_curve ? flip_tone(display->curve, v)
                                   : glms_vec3_minv(v, glms_vec3_one());
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
        .scale = 1.0f,
    });
}

static void find_feature(struct work *work, const struct flip_plane *y,
                         const struct flip_kernel *kernel, struct flip_plane *strength)
{
    filter(work, y, kernel, &work->features.smooth, &work->first);
    filter(work, y, &work->features.smooth, kernel, &work->second);
    for (size_t i = 0; i < y->stride * y->height; i++) {
        const float a = work->first.texels[i], b = work->second.texels[i];
        strength->texels[i] = sqrtf(a * a + b * b) / 116.0f; /* from Y to relative luminance */
    }
}

/* Filters a colour channel with its contrast sensitivity function. */
static void filter_contrast(struct work *work, struct flip_plane *plane, enum flip_channel channel)
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
            .scale = s->fractions[i],
            .add = i > 0,
        });
    }
    if (s->count > 1) {
        work->first = *plane;
        *plane = blurred;
    }
}

static void prepare(struct work *work, struct side *side, const float *const planes[static 3],
                    const struct display *display)
{
    fill(side, planes, display);
    find_feature(work, &side->color[0], &work->features.edge, &side->edge);
    find_feature(work, &side->color[0], &work->features.point, &side->point);
    for (int c = 0; c < FLIP_CHANNEL_COUNT; c++)
        filter_contrast(work, &side->color[c], (enum flip_channel)c);
    for (size_t i = 0; i < side->edge.stride * side->edge.height; i++) {
        const vec3s v = { { side->color[0].texels[i], side->color[1].texels[i],
                            side->color[2].texels[i] } };
        const vec3s linear = glms_vec3_clamp(flip_color_linear(v), 0.0f, 1.0f);
        store(side->color, i, flip_color_hunt(linear));
    }
}

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

/* Sets each element of errors[] to the FLIP error at one exposure if that error is larger. */
static void raise_errors(struct work *work, const struct display *display, float *errors)
{
    const struct flip_pair *pair = work->pair;
    prepare(work, &work->reference, pair->reference, display);
    prepare(work, &work->test, pair->test, display);
    for (uint32_t y = 0; y < pair->height; y++) {
        for (uint32_t x = 0; x < pair->width; x++) {
            float *error = &errors[(size_t)y * pair->width + x];
            *error = fmaxf(*error, find_error(work, y * work->first.stride + x));
        }
    }
}

/* Initialises errors[] with 1 for non-finite pixels, else 0. */
static void init_errors(const struct flip_pair *pair, float *errors)
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
    init_errors(pair, errors);
    raise_errors(&work, &(struct display){ .scale = (float)exp2(exposure) }, errors);
    free(work.memory);
    return true;
}

/*
 * Computes HDR-FLIP's exposure range from the reference. If the median luminance is below the
 * smallest half float, uses the median of all brighter pixels. The paper omits this case.
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
    init_errors(pair, errors);
    for (uint32_t i = 0; i < exposures->count; i++) {
        const struct display display = {
            .scale = (float)exp2(exposures->first + i * step),
            .has_curve = true,
            .curve = curve,
        };
        raise_errors(&work, &display, errors);
    }
    free(work.memory);
    return true;
}
