/* inclusion_shading.c: normals of cracks, bumps and frost; opacity of planes of air. */
#include "src/lab/reference/inclusion_shading.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/inclusions/cracks_noise.h"
#include "shaders/lighting/bump_normal.h"
#include "shaders/surroundings/procedural_sky.h"
#include "src/file/half_float.h"
#include "src/lab/reference/linear_texture_filter.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/inclusions/frost.h"
#include "src/tech/lighting/bump.h"

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings)
{
    const struct cracks_params *cracks_params = settings_of(settings, &cracks_settings);
    const struct bump_params *bump_params = settings_of(settings, &bump_settings);
    const struct air_params *air_params = settings_of(settings, &air_settings);
    const struct frost_params *frost_params = settings_of(settings, &frost_settings);
    const bool has_map = radiance->scene->bump.texels != NULL;
    const bool has_bumps = has_map && bump_params->strength > 0.0f;
    const float frost_amount =
        has_map ? frost_params->amount * melted_frost_factor(&radiance->scene->melted) : 0.0f;
    return (struct inclusions){
        .radiance = radiance,
        .world_from_object = glms_mat4_pick3(radiance->globals->world_from_object),
        .crack_rms_slope = cracks_params->shading.bump,
        .crack_gap = cracks_params->shading.gap,
        .is_uneven = has_bumps || frost_amount > 0.0f,
        .has_bumps = has_bumps,
        .is_mapped_by_uv = bump_params->mapping == BUMP_UV,
        .frost = frost_amount,
        .frost_roughness = frost_params->roughness,
        .air = air_is_medium(settings)
                   ? (struct air_push){ 0 }
                   : (struct air_push){ air_params->strength, air_params->haze },
        .air_light = radiance->scene->inclusions.air.index_count ? radiance_mean(radiance, 1)
                                                                 : glms_vec3_zero(),
    };
}

static vec3s to_object(const struct inclusions *inclusions, vec3s dir)
{
    return glms_mat3_mulv(glms_mat3_transpose(inclusions->world_from_object), dir);
}

vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface)
{
    const struct globals *g = inclusions->radiance->globals;
    if (!(inclusions->crack_rms_slope > 0.0f))
        return surface->normal;
    const vec3s moved = glms_vec3(g->world_from_object.col[3]);
    const vec3s at = to_object(inclusions, glms_vec3_sub(surface->position, moved));
    const vec3s bent = crack_perturbed(to_object(inclusions, surface->normal),
                                       glms_vec3_divs(at, g->radius), inclusions->crack_rms_slope);
    return glms_mat3_mulv(inclusions->world_from_object, bent);
}

/* Returns the opacities of bubbles (x) and haze (y) at a texel. */
static vec2s fetch_air(const struct air_layers *layers, uint32_t layer, uint32_t x, uint32_t y)
{
    const size_t row = (size_t)layer * layers->size + y;
    const uint8_t *texel = &layers->texels[(row * layers->size + x) * 2];
    return (vec2s){ { (float)texel[0] / 255.0f, (float)texel[1] / 255.0f } };
}

float inclusions_air_cover(const struct inclusions *inclusions, const struct mesh_vertex *surface,
                           vec3s dir)
{
    const struct air_layers *layers = &inclusions->radiance->scene->inclusions.air_layers;
    const uint32_t layer = (surface->material & MESH_TEXTURE_MASK) - 1;
    if (layer >= layers->count)
        return 0.0f;
    const struct linear_filter x = linear_filter_at(surface->uv.x, layers->size, false);
    const struct linear_filter y = linear_filter_at(surface->uv.y, layers->size, false);
    const vec2s above = glms_vec2_lerp(fetch_air(layers, layer, x.first, y.first),
                                       fetch_air(layers, layer, x.second, y.first), x.weight);
    const vec2s below = glms_vec2_lerp(fetch_air(layers, layer, x.first, y.second),
                                       fetch_air(layers, layer, x.second, y.second), x.weight);
    const vec2s texel = glms_vec2_lerp(above, below, y.weight);
    const float cosine = fabsf(glms_vec3_dot(dir, surface->normal));
    const float edge_fade = glm_smoothstep(0.0f, AIR_EDGE, cosine);
    const float bubbles_opacity = inclusions->air.strength * edge_fade * texel.x;
    const float haze_opacity = inclusions->air.haze * edge_fade * texel.y;
    return 1.0f - (1.0f - bubbles_opacity) * (1.0f - haze_opacity);
}

static vec4s fetch_bump(const struct bump_maps *maps, uint32_t x, uint32_t y)
{
    const uint16_t *texel = &maps->texels[((size_t)y * maps->size + x) * 4];
    return (vec4s){ { half_to_float(texel[0]), half_to_float(texel[1]), half_to_float(texel[2]),
                      half_to_float(texel[3]) } };
}

/* Samples the bump map. Returns the slope in xy, smoothness in z and frost density in w. */
static vec4s sample_bump(const struct inclusions *inclusions, vec2s at)
{
    const struct bump_maps *maps = &inclusions->radiance->scene->bump;
    const struct linear_filter x = linear_filter_at(at.x, maps->size, true);
    const struct linear_filter y = linear_filter_at(at.y, maps->size, true);
    const vec4s above = glms_vec4_lerp(fetch_bump(maps, x.first, y.first),
                                       fetch_bump(maps, x.second, y.first), x.weight);
    const vec4s below = glms_vec4_lerp(fetch_bump(maps, x.first, y.second),
                                       fetch_bump(maps, x.second, y.second), x.weight);
    return glms_vec4_lerp(above, below, y.weight);
}

/* Bump map evaluated at a hit. The height gradient is in world space. */
struct bump_sample {
    vec3s gradient;
    float smoothness, crystals;
};

static struct bump_sample bump_triplanar(const struct inclusions *inclusions, vec3s point,
                                         vec3s normal)
{
    const struct globals *g = inclusions->radiance->globals;
    const vec3s p =
        glms_vec3_scale(to_object(inclusions, glms_vec3_sub(point, g->center)), g->bump_scale);
    const vec3s weights = bump_weights(to_object(inclusions, normal));
    const vec4s x = glms_vec4_scale(sample_bump(inclusions, (vec2s){ { p.y, p.z } }), weights.x);
    const vec2s at_y = glms_vec2_add((vec2s){ { p.z, p.x } }, BUMP_OFFSET_Y);
    const vec4s y = glms_vec4_scale(sample_bump(inclusions, at_y), weights.y);
    const vec2s at_z = glms_vec2_add((vec2s){ { p.x, p.y } }, BUMP_OFFSET_Z);
    const vec4s z = glms_vec4_scale(sample_bump(inclusions, at_z), weights.z);
    const vec3s gradient = { { y.y + z.x, z.y + x.x, x.y + y.x } };
    return (struct bump_sample){
        glms_mat3_mulv(inclusions->world_from_object, gradient),
        x.z + y.z + z.z,
        x.w + y.w + z.w,
    };
}

/* Returns the normalised vector a * s + b * t, or zero if its length is 0. */
static vec3s weighted_direction(vec3s a, float s, vec3s b, float t)
{
    const vec3s sum = glms_vec3_add(glms_vec3_scale(a, s), glms_vec3_scale(b, t));
    return glms_vec3_scale(sum, 1.0f / sqrtf(fmaxf(glms_vec3_norm2(sum), 1e-30f)));
}

/* Samples the bump map at the uv coordinates of a hit. Without uv coordinates the slope is 0. */
static struct bump_sample bump_by_uv(const struct inclusions *inclusions,
                                     const struct embree_scene *embree_scene,
                                     const struct embree_scene_hit *hit, vec3s normal)
{
    const struct embree_scene_mesh *scene_mesh = &embree_scene->meshes[EMBREE_SCENE_OBJECT];
    const uint32_t *corners = &scene_mesh->mesh->indices[(size_t)hit->triangle * 3];
    const vec2s scaled =
        glms_vec2_scale(hit->surface.uv, inclusions->radiance->globals->bump_scale);
    const vec4s texel = sample_bump(inclusions, scaled);
    vec3s edges[2];
    vec2s steps[2];
    for (int k = 0; k < 2; k++) {
        edges[k] =
            glms_vec3_sub(scene_mesh->positions[corners[k + 1]], scene_mesh->positions[corners[0]]);
        steps[k] = glms_vec2_sub(scene_mesh->mesh->vertices[corners[k + 1]].uv,
                                 scene_mesh->mesh->vertices[corners[0]].uv);
    }
    const vec3s across = glms_vec3_cross(edges[1], normal);
    const vec3s down = glms_vec3_cross(normal, edges[0]);
    const float side = glms_vec3_dot(edges[0], across) < 0.0f ? -1.0f : 1.0f;
    const vec3s u = weighted_direction(across, steps[0].x, down, steps[1].x);
    const vec3s v = weighted_direction(across, steps[0].y, down, steps[1].y);
    const vec3s gradient =
        glms_vec3_add(glms_vec3_scale(u, side * texel.x), glms_vec3_scale(v, side * texel.y));
    return (struct bump_sample){ gradient, texel.z, texel.w };
}

struct inclusions_surface inclusions_surface_at(const struct inclusions *inclusions,
                                                const struct embree_scene *embree_scene,
                                                const struct embree_scene_hit *hit, vec3s normal)
{
    const struct bump_sample bump_sample =
        inclusions->is_mapped_by_uv ? bump_by_uv(inclusions, embree_scene, hit, normal)
                                    : bump_triplanar(inclusions, hit->surface.position, normal);
    const float roughness = 1.0f - bump_sample.smoothness;
    const float slope = inclusions->radiance->globals->bump_strength * roughness;
    struct inclusions_surface surface = { normal,
                                          inclusions->frost * roughness * bump_sample.crystals };
    if (inclusions->has_bumps)
        surface.normal = bump_perturbed(normal, glms_vec3_scale(bump_sample.gradient, slope));
    return surface;
}
