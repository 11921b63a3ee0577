/* denoise.c: edge-avoiding A-Trous filter that denoises the surroundings' lighting. */
#include "src/render/denoise.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

enum {
    STEPS = 4,         /* filter iterations; iteration i reaches 2 << i pixels */
    WINDOW_RADIUS = 3, /* radius of the variance window, pixels */
};

/* Samples per pixel from which each filter iteration is skipped, narrowest filter first. */
static const float enough_samples[STEPS] = { DENOISE_SAMPLES_ENOUGH, 16.0f, 8.0f, 6.0f };

/* Irradiance of a pixel (without albedo), minus the irradiance from an unoccluded sky. */
struct light {
    vec3s mean;
    float count;                /* samples in `mean`; 0 for none */
    float local_mean, variance; /* mean over the window; its variance */
};

struct surface {
    vec3s position, normal;
    /* distances to the closest horizontal and vertical neighbour, metres; 0 if none */
    float spacing_x, spacing_y;
    float count; /* number of samples that gathered light */
    bool is_diffuse;
};

struct denoiser {
    int width, height;
    struct surface *surfaces;
    struct light *lights, *next;
};

static float brightness(vec3s v)
{
    return (v.x + v.y + v.z) / 3.0f;
}

/* Decodes an octahedral normal that denoise_normal() in trace_denoise_inputs.glsl has packed. */
static vec3s normal_of(float code)
{
    const float steps = fmaxf(code - 1.0f, 0.0f), y = floorf(steps / 4096.0f);
    const float px = (steps - 4096.0f * y) / 2047.0f - 1.0f, py = y / 2047.0f - 1.0f;
    vec3s n = { { px, py, 1.0f - fabsf(px) - fabsf(py) } };
    if (n.z < 0.0f) {
        n.x = copysignf(1.0f - fabsf(py), px);
        n.y = copysignf(1.0f - fabsf(px), py);
    }
    return glms_vec3_normalize(n);
}

static float spacing(const struct surface *s, const struct surface *other)
{
    return other->is_diffuse ? glms_vec3_distance(s->position, other->position) : INFINITY;
}

/* Computes the distances to a pixel's closest horizontal and vertical neighbour, in metres. */
static void find_spacing(struct denoiser *s, int x, int y)
{
    struct surface *own = &s->surfaces[y * s->width + x];
    float spacing_x = INFINITY, spacing_y = INFINITY;
    if (x > 0)
        spacing_x = spacing(own, own - 1);
    if (x + 1 < s->width)
        spacing_x = fminf(spacing_x, spacing(own, own + 1));
    if (y > 0)
        spacing_y = spacing(own, own - s->width);
    if (y + 1 < s->height)
        spacing_y = fminf(spacing_y, spacing(own, own + s->width));
    own->spacing_x = spacing_x < INFINITY ? spacing_x : 0.0f;
    own->spacing_y = spacing_y < INFINITY ? spacing_y : 0.0f;
}

/* Returns the edge-stopping weight, 0 to 1, for pixel b at offset dx, dy from pixel a. */
static float geometric_weight(const struct surface *a, const struct surface *b, int dx, int dy)
{
    if (!b->is_diffuse)
        return 0.0f;
    const float expected = a->spacing_x * (float)abs(dx) + a->spacing_y * (float)abs(dy) +
                           1e-3f * (a->spacing_x + a->spacing_y);
    const vec3s between = glms_vec3_sub(b->position, a->position);
    const float distance2 = glms_vec3_norm2(between), cosine = glms_vec3_dot(a->normal, b->normal);
    if (distance2 > 6.0f * expected * expected || cosine <= 0.0f)
        return 0.0f;
    const float above = fabsf(glms_vec3_dot(between, a->normal));
    const float t2 = cosine * cosine, t4 = t2 * t2;
    return t4 * t4 * fmaxf(1.0f - above / (0.5f * expected + 1e-12f), 0.0f);
}

static bool read_planes(struct denoiser *s, const struct image *ground)
{
    static const char *const names[] = { "light.R",      "light.G",      "light.B",
                                         "due",          "throughput.R", "throughput.G",
                                         "throughput.B", "position.X",   "position.Y",
                                         "position.Z",   "normal",       "samples" };
    const float *p[sizeof(names) / sizeof(names[0])];
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        p[i] = image_find(ground, names[i]);
    const size_t count = (size_t)ground->width * ground->height;
    s->width = (int)ground->width;
    s->height = (int)ground->height;
    s->surfaces = calloc(count, sizeof(*s->surfaces));
    s->lights = calloc(count, sizeof(*s->lights));
    s->next = calloc(count, sizeof(*s->next));
    if (!s->surfaces || !s->lights || !s->next)
        return false;
    for (size_t i = 0; i < count; i++) {
        struct surface *surface = &s->surfaces[i];
        const vec3s throughput = { { p[4][i], p[5][i], p[6][i] } };
        const float fraction = p[3][i] / fmaxf(brightness(throughput), 1e-9f);
        surface->is_diffuse = p[10][i] > 0.0f && brightness(throughput) > 1e-5f;
        surface->position = (vec3s){ { p[7][i], p[8][i], p[9][i] } };
        surface->normal = normal_of(p[10][i]);
        if (fraction <= 0.0f || brightness(throughput) <= 1e-5f)
            continue;
        surface->count = fraction * p[11][i];
        s->lights[i].count = surface->count;
        for (int c = 0; c < 3; c++)
            s->lights[i].mean.raw[c] = p[c][i] / fmaxf(fraction * throughput.raw[c], 1e-5f);
        if (!isfinite(brightness(s->lights[i].mean)))
            s->lights[i] = (struct light){ 0 };
    }
    return true;
}

/* Computes the mean and variance of a pixel's neighbourhood, for edge-stopping weights. Single
 * pixels would not do: the weights would reject the few whose rays are occluded or hit a lamp. */
static struct light local_statistics(const struct denoiser *s, int x, int y)
{
    const struct surface *own = &s->surfaces[y * s->width + x];
    struct light light = s->lights[y * s->width + x];
    double sum = 0.0, squares = 0.0, sample_weight_sum = 0.0;
    for (int dy = -WINDOW_RADIUS; dy <= WINDOW_RADIUS; dy++) {
        for (int dx = -WINDOW_RADIUS; dx <= WINDOW_RADIUS; dx++) {
            if (x + dx < 0 || x + dx >= s->width || y + dy < 0 || y + dy >= s->height)
                continue;
            const int i = (y + dy) * s->width + x + dx;
            const double w =
                (double)geometric_weight(own, &s->surfaces[i], dx, dy) * (double)s->lights[i].count;
            const double b = (double)brightness(s->lights[i].mean);
            sum += w * b;
            squares += w * b * b;
            sample_weight_sum += w;
        }
    }
    light.variance = INFINITY;
    if (sample_weight_sum <= 0.0)
        return light;
    const double mean = sum / sample_weight_sum;
    light.local_mean = (float)mean;
    light.variance =
        (float)(fmax(squares / sample_weight_sum - mean * mean, 0.0) / sample_weight_sum);
    return light;
}

/* Returns a pixel's irradiance after one filter iteration. Filter taps are `step` pixels apart. */
static struct light filtered(const struct denoiser *s, int x, int y, int step)
{
    static const float kernel[] = { 3.0f / 8.0f, 1.0f / 4.0f, 1.0f / 16.0f };
    const int at = y * s->width + x;
    struct light light = s->lights[at];
    vec3s sum = { 0 };
    float sample_weight_sum = 0.0f, weight_sum = 0.0f;
    for (int j = -2; j <= 2; j++) {
        for (int i = -2; i <= 2; i++) {
            const int dx = i * step, dy = j * step;
            if (x + dx < 0 || x + dx >= s->width || y + dy < 0 || y + dy >= s->height)
                continue;
            const struct light *other = &s->lights[at + dy * s->width + dx];
            const float width = 2.0f * sqrtf(light.variance + other->variance) + 1e-4f;
            const float weight =
                kernel[abs(i)] * kernel[abs(j)] *
                geometric_weight(&s->surfaces[at], &s->surfaces[at + dy * s->width + dx], dx, dy) *
                expf(-fabsf(other->local_mean - light.local_mean) / width);
            sum = glms_vec3_add(sum, glms_vec3_scale(other->mean, weight * other->count));
            sample_weight_sum += weight * other->count;
            weight_sum += weight;
        }
    }
    if (sample_weight_sum < 1e-9f)
        return light;
    light.mean = glms_vec3_scale(sum, 1.0f / sample_weight_sum);
    light.count = sample_weight_sum / weight_sum;
    return light;
}

/* Runs filter iteration `index` on all pixels. If `index` is -1, estimates the variance instead. */
static void replace(struct denoiser *s, int index)
{
    for (int y = 0; y < s->height; y++) {
        for (int x = 0; x < s->width; x++) {
            const int i = y * s->width + x;
            struct light light = s->lights[i];
            if (s->surfaces[i].is_diffuse && index < 0)
                light = local_statistics(s, x, y);
            else if (s->surfaces[i].is_diffuse && s->surfaces[i].count < enough_samples[index])
                light = filtered(s, x, y, 1 << index);
            s->next[i] = light;
        }
    }
    struct light *previous = s->lights;
    s->lights = s->next;
    s->next = previous;
}

static void add(const struct denoiser *s, struct image *image, const struct image *ground)
{
    static const char *const throughputs[] = { "throughput.R", "throughput.G", "throughput.B" };
    static const char *const colors[] = { "R", "G", "B" };
    for (int c = 0; c < 3; c++) {
        float *plane = image_find(image, colors[c]);
        const float *throughput = image_find(ground, throughputs[c]);
        for (size_t i = 0; plane && i < (size_t)s->width * (size_t)s->height; i++)
            plane[i] = fmaxf(plane[i] + throughput[i] * s->lights[i].mean.raw[c], 0.0f);
    }
}

bool denoise_light(struct image *image, struct image *display, const struct image *ground)
{
    struct denoiser s = { 0 };
    const bool is_read = read_planes(&s, ground);
    if (is_read) {
        for (int y = 0; y < s.height; y++) {
            for (int x = 0; x < s.width; x++)
                find_spacing(&s, x, y);
        }
        for (int i = -1; i < STEPS; i++)
            replace(&s, i);
        add(&s, image, ground);
        add(&s, display, ground);
    }
    free(s.surfaces);
    free(s.lights);
    free(s.next);
    return is_read;
}
