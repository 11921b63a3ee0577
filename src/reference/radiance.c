/* radiance.c: radiance of sky, environment image, matt surfaces and their textures. */
#include "src/reference/radiance.h"
#include <math.h>
#include "shaders/background.h"
#include "shaders/sky.h"
#include "src/image/half.h"
#include "src/image/srgb.h"

struct radiance radiance_of(const struct scene *scene, const struct globals *globals)
{
    struct radiance radiance = { .scene = scene, .globals = globals };
    for (int i = 0; i < 256; i++)
        radiance.linear[i] = srgb_decode((float)i / 255.0f);
    return radiance;
}

/* ---- textures ---- */

/* The two texels around a coordinate, and the weight of the second one. */
struct pair {
    uint32_t first, second;
    float share;
};

static uint32_t wrapped(double index, uint32_t count)
{
    return (uint32_t)(index - floor(index / count) * count);
}

static struct pair pair_at(float coordinate, uint32_t count, bool repeat)
{
    const double x = (double)coordinate * count - 0.5;
    const double first = floor(x);
    const double last = count - 1.0;
    if (repeat)
        return (struct pair){ wrapped(first, count), wrapped(first + 1, count),
                              (float)(x - first) };
    return (struct pair){
        (uint32_t)fmin(fmax(first, 0), last),
        (uint32_t)fmin(fmax(first + 1, 0), last),
        (float)(x - first),
    };
}

typedef vec4s fetch_fn(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y);

static vec4s blend(const struct radiance *radiance, fetch_fn *fetch, uint32_t layer, struct pair x,
                   struct pair y)
{
    const vec4s above = glms_vec4_lerp(fetch(radiance, layer, x.first, y.first),
                                       fetch(radiance, layer, x.second, y.first), x.share);
    const vec4s below = glms_vec4_lerp(fetch(radiance, layer, x.first, y.second),
                                       fetch(radiance, layer, x.second, y.second), x.share);
    return glms_vec4_lerp(above, below, y.share);
}

static vec4s fetch_texture(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y)
{
    const struct texture_layers *textures = &radiance->scene->model.textures;
    const size_t row = (size_t)layer * textures->size + y;
    const uint8_t *texel = &textures->texels[(row * textures->size + x) * 4];
    return (vec4s){ { radiance->linear[texel[0]], radiance->linear[texel[1]],
                      radiance->linear[texel[2]], (float)texel[3] / 255.0f } };
}

static vec4s fetch_environment(const struct radiance *radiance, uint32_t layer, uint32_t x,
                               uint32_t y)
{
    const struct environment *environment = &radiance->scene->environment;
    const uint16_t *texel = &environment->texels[((size_t)y * environment->width + x) * 4];
    (void)layer;
    return (vec4s){ { half_to_float(texel[0]), half_to_float(texel[1]), half_to_float(texel[2]),
                      1.0f } };
}

vec4s radiance_texel(const struct radiance *radiance, uint32_t material, vec2s uv)
{
    const uint32_t layer = material & MESH_TEXTURE_MASK;
    const uint32_t size = radiance->scene->model.textures.size;
    if (!layer || !size)
        return glms_vec4_one();
    return blend(radiance, fetch_texture, layer - 1, pair_at(uv.x, size, true),
                 pair_at(uv.y, size, true));
}

/* ---- radiance ---- */

static vec3s scaled(const struct globals *globals, vec3s light)
{
    return glms_vec3_scale(light, globals->sky_strength);
}

vec3s radiance_sky(const struct radiance *radiance, vec3s dir)
{
    const struct globals *g = radiance->globals;
    const struct environment *environment = &radiance->scene->environment;
    if (radiance->scene->background == SCENE_COLOR)
        return g->background_color;
    if (radiance->scene->background == SCENE_SKY)
        return scaled(g, sky_seen(dir, g->sun_dir, g->sun_strength));
    const vec2s uv = background_uv(dir, environment->turn);
    return glms_vec3(blend(radiance, fetch_environment, 0, pair_at(uv.x, environment->width, true),
                           pair_at(uv.y, environment->height, false)));
}

vec3s radiance_surface(const struct radiance *radiance, const struct mesh_vertex *surface,
                       vec3s dir)
{
    const struct globals *g = radiance->globals;
    const vec4s texel = radiance_texel(radiance, surface->material, surface->uv);
    const vec3s albedo = glms_vec3_mul(surface->color, glms_vec3(texel));
    if (surface->material & MESH_UNLIT)
        return albedo;
    const bool is_back = glms_vec3_dot(surface->normal, dir) > 0.0f;
    const vec3s n = is_back ? glms_vec3_negate(surface->normal) : surface->normal;
    return glms_vec3_mul(albedo, scaled(g, sky_reflected(n, g->sun_dir, g->sun_strength)));
}
