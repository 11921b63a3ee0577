/* smooth.c: an edge-avoiding filter of light, in places of the scene. */
#include "src/render/smooth.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

enum {
    STEPS = 4, /* of the filter; step i reaches 2 << i pixels */
    REACH = 3, /* pixels by whose mean one is compared */
};

/* Pixels that have gathered light in more samples do without a step, the widest ones first. */
static const float enough[STEPS] = { SMOOTH_ENOUGH, 16.0f, 8.0f, 6.0f };

/* A pixel's light: how far it is from that of a sky that nothing hides. */
struct light {
    vec3s mean;
    float count;         /* samples in it; 0: none */
    float around, noise; /* brightness of the lights around, and the square of its error */
};

struct surface {
    vec3s place, normal;
    float across, down; /* metres to the same surface in the next pixel; 0: it is not there */
    float count;        /* samples that have gathered light */
    bool is_matt;
};

struct smooth {
    int width, height;
    struct surface *surfaces;
    struct light *lights, *next;
};

static float brightness(vec3s v)
{
    return (v.x + v.y + v.z) / 3.0f;
}

/* The inverse of smooth_normal() of trace_smooth.glsl. */
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
    return other->is_matt ? glms_vec3_distance(s->place, other->place) : INFINITY;
}

/* Finds how far it is to the next pixel's point, of two neighbours to the nearer one's. */
static void find_spacing(struct smooth *s, int x, int y)
{
    struct surface *own = &s->surfaces[y * s->width + x];
    float across = INFINITY, down = INFINITY;
    if (x > 0)
        across = spacing(own, own - 1);
    if (x + 1 < s->width)
        across = fminf(across, spacing(own, own + 1));
    if (y > 0)
        down = spacing(own, own - s->width);
    if (y + 1 < s->height)
        down = fminf(down, spacing(own, own + s->width));
    own->across = across < INFINITY ? across : 0.0f;
    own->down = down < INFINITY ? down : 0.0f;
}

/* Returns by how much a pixel, some pixels away, shows the same surface: 0 to 1. */
static float likeness(const struct surface *a, const struct surface *b, int dx, int dy)
{
    if (!b->is_matt)
        return 0.0f;
    const float expected =
        a->across * (float)abs(dx) + a->down * (float)abs(dy) + 1e-3f * (a->across + a->down);
    const vec3s between = glms_vec3_sub(b->place, a->place);
    const float away2 = glms_vec3_norm2(between), towards = glms_vec3_dot(a->normal, b->normal);
    if (away2 > 6.0f * expected * expected || towards <= 0.0f)
        return 0.0f;
    const float above = fabsf(glms_vec3_dot(between, a->normal));
    const float t2 = towards * towards, t4 = t2 * t2;
    return t4 * t4 * fmaxf(1.0f - above / (0.5f * expected + 1e-12f), 0.0f);
}

static bool read_planes(struct smooth *s, const struct image *ground)
{
    static const char *const names[] = { "light.R", "light.G", "light.B", "due",
                                         "share.R", "share.G", "share.B", "place.X",
                                         "place.Y", "place.Z", "normal",  "samples" };
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
        const vec3s share = { { p[4][i], p[5][i], p[6][i] } };
        const float part = p[3][i] / fmaxf(brightness(share), 1e-9f);
        surface->is_matt = p[10][i] > 0.0f && brightness(share) > 1e-5f;
        surface->place = (vec3s){ { p[7][i], p[8][i], p[9][i] } };
        surface->normal = normal_of(p[10][i]);
        if (part <= 0.0f || brightness(share) <= 1e-5f)
            continue;
        surface->count = part * p[11][i];
        s->lights[i].count = surface->count;
        for (int c = 0; c < 3; c++)
            s->lights[i].mean.raw[c] = p[c][i] / fmaxf(part * share.raw[c], 1e-5f);
        if (!isfinite(brightness(s->lights[i].mean)))
            s->lights[i] = (struct light){ 0 };
    }
    return true;
}

/* Finds the mean of the lights of the surface around a pixel, by which pixels are compared: by
 * their own light, rare rays that are hidden, or find a lamp, would be left out. */
static struct light compared(const struct smooth *s, int x, int y)
{
    const struct surface *own = &s->surfaces[y * s->width + x];
    struct light light = s->lights[y * s->width + x];
    double sum = 0.0, squares = 0.0, weights = 0.0;
    for (int dy = -REACH; dy <= REACH; dy++) {
        for (int dx = -REACH; dx <= REACH; dx++) {
            if (x + dx < 0 || x + dx >= s->width || y + dy < 0 || y + dy >= s->height)
                continue;
            const int i = (y + dy) * s->width + x + dx;
            const double w =
                (double)likeness(own, &s->surfaces[i], dx, dy) * (double)s->lights[i].count;
            const double b = (double)brightness(s->lights[i].mean);
            sum += w * b;
            squares += w * b * b;
            weights += w;
        }
    }
    light.noise = INFINITY;
    if (weights <= 0.0)
        return light;
    const double mean = sum / weights;
    light.around = (float)mean;
    light.noise = (float)(fmax(squares / weights - mean * mean, 0.0) / weights);
    return light;
}

/* Returns a pixel's light as a step of the filter leaves it. */
static struct light filtered(const struct smooth *s, int x, int y, int step)
{
    static const float kernel[] = { 3.0f / 8.0f, 1.0f / 4.0f, 1.0f / 16.0f };
    const int at = y * s->width + x;
    struct light light = s->lights[at];
    vec3s sum = { 0 };
    float weights = 0.0f, shares = 0.0f;
    for (int j = -2; j <= 2; j++) {
        for (int i = -2; i <= 2; i++) {
            const int dx = i * step, dy = j * step;
            if (x + dx < 0 || x + dx >= s->width || y + dy < 0 || y + dy >= s->height)
                continue;
            const struct light *other = &s->lights[at + dy * s->width + dx];
            const float width = 2.0f * sqrtf(light.noise + other->noise) + 1e-4f;
            const float share =
                kernel[abs(i)] * kernel[abs(j)] *
                likeness(&s->surfaces[at], &s->surfaces[at + dy * s->width + dx], dx, dy) *
                expf(-fabsf(other->around - light.around) / width);
            sum = glms_vec3_add(sum, glms_vec3_scale(other->mean, share * other->count));
            weights += share * other->count;
            shares += share;
        }
    }
    if (weights < 1e-9f)
        return light;
    light.mean = glms_vec3_scale(sum, 1.0f / weights);
    light.count = weights / shares;
    return light;
}

/* Replaces all lights: by compared(), or by a step of the filter where there is not enough. */
static void replace(struct smooth *s, int index)
{
    for (int y = 0; y < s->height; y++) {
        for (int x = 0; x < s->width; x++) {
            const int i = y * s->width + x;
            struct light light = s->lights[i];
            if (s->surfaces[i].is_matt && index < 0)
                light = compared(s, x, y);
            else if (s->surfaces[i].is_matt && s->surfaces[i].count < enough[index])
                light = filtered(s, x, y, 1 << index);
            s->next[i] = light;
        }
    }
    struct light *former = s->lights;
    s->lights = s->next;
    s->next = former;
}

static void add(const struct smooth *s, struct image *picture, const struct image *ground)
{
    static const char *const shares[] = { "share.R", "share.G", "share.B" };
    static const char *const colors[] = { "R", "G", "B" };
    for (int c = 0; c < 3; c++) {
        float *plane = image_find(picture, colors[c]);
        const float *share = image_find(ground, shares[c]);
        for (size_t i = 0; plane && i < (size_t)s->width * (size_t)s->height; i++)
            plane[i] = fmaxf(plane[i] + share[i] * s->lights[i].mean.raw[c], 0.0f);
    }
}

bool smooth_light(struct image *picture, const struct image *ground)
{
    struct smooth s = { 0 };
    const bool is_read = read_planes(&s, ground);
    if (is_read) {
        for (int y = 0; y < s.height; y++) {
            for (int x = 0; x < s.width; x++)
                find_spacing(&s, x, y);
        }
        for (int i = -1; i < STEPS; i++)
            replace(&s, i);
        add(&s, picture, ground);
    }
    free(s.surfaces);
    free(s.lights);
    free(s.next);
    return is_read;
}
