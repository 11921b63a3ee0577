/* surroundings_radiance.c: radiance of sky and environment map; shading of the surroundings. */
#include "src/lab/reference/surroundings_radiance.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/brdf.h"
#include "shaders/surroundings/procedural_sky.h"
#include "shaders/surroundings/surroundings.h"
#include "shaders/water/pool_tiles.h"
#include "src/file/half_float.h"
#include "src/file/srgb.h"
#include "src/lab/reference/linear_texture_filter.h"
#include "src/scene/gpu_material_table.h"

#define TILES_WIDTH ABI_VEC2(1e-4f, 1e-4f) /* texture filter width of procedural tiles */
#define COSINE_MIN  0.05f                  /* lower clamp of a cosine divisor */

struct radiance radiance_of(const struct scene *scene, const struct globals *globals)
{
    struct radiance radiance = { .scene = scene, .globals = globals };
    for (int i = 0; i < 256; i++)
        radiance.linear[i] = srgb_decode((float)i / 255.0f);
    return radiance;
}

typedef vec4s fetch_fn(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y);

static vec4s bilinear(const struct radiance *radiance, fetch_fn *fetch, uint32_t layer,
                      struct linear_filter x, struct linear_filter y)
{
    const vec4s above = glms_vec4_lerp(fetch(radiance, layer, x.first, y.first),
                                       fetch(radiance, layer, x.second, y.first), x.weight);
    const vec4s below = glms_vec4_lerp(fetch(radiance, layer, x.first, y.second),
                                       fetch(radiance, layer, x.second, y.second), x.weight);
    return glms_vec4_lerp(above, below, y.weight);
}

static vec4s fetch_texture(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y)
{
    const struct texture_layers *textures = &radiance->scene->model.textures;
    const size_t row = (size_t)layer * textures->size + y;
    const uint8_t *texel = &textures->texels[(row * textures->size + x) * 4];
    return (vec4s){ { radiance->linear[texel[0]], radiance->linear[texel[1]],
                      radiance->linear[texel[2]], (float)texel[3] / 255.0f } };
}

static vec4s fetch_number(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y)
{
    const struct texture_layers *numbers = &radiance->scene->model.numbers;
    const size_t row = (size_t)layer * numbers->size + y;
    const uint8_t *texel = &numbers->texels[(row * numbers->size + x) * 4];
    vec4s values;
    for (int k = 0; k < 4; k++)
        values.raw[k] = (float)texel[k] / 255.0f;
    return values;
}

static vec4s fetch_light(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y)
{
    const size_t row = (size_t)layer * LIT_HEIGHT + y;
    const uint16_t *texel = &radiance->scene->background.prefiltered[(row * LIT_WIDTH + x) * 4];
    return (vec4s){ { half_to_float(texel[0]), half_to_float(texel[1]), half_to_float(texel[2]),
                      1.0f } };
}

static vec4s fetch_split(const struct radiance *radiance, uint32_t layer, uint32_t x, uint32_t y)
{
    const uint16_t *texel = &radiance->scene->tables.brdf[((size_t)y * LIT_SPLIT_SIDE + x) * 2];
    (void)layer;
    return (vec4s){ { half_to_float(texel[0]), half_to_float(texel[1]), 0.0f, 0.0f } };
}

static vec4s fetch_environment(const struct radiance *radiance, uint32_t layer, uint32_t x,
                               uint32_t y)
{
    const struct environment *environment = &radiance->scene->background.environment;
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
    return bilinear(radiance, fetch_texture, layer - 1, linear_filter_at(uv.x, size, true),
                    linear_filter_at(uv.y, size, true));
}

static vec3s scaled(const struct globals *globals, vec3s light)
{
    return glms_vec3_scale(light, globals->sky_strength);
}

/* Returns the radiance of the environment map in a direction. */
static vec3s environment_radiance(const struct radiance *radiance, vec3s dir)
{
    const struct environment *environment = &radiance->scene->background.environment;
    const vec2s uv = surroundings_equirect_uv(dir, environment->turn);
    return glms_vec3(bilinear(radiance, fetch_environment, 0,
                              linear_filter_at(uv.x, environment->width, true),
                              linear_filter_at(uv.y, environment->height, false)));
}

vec3s radiance_sky(const struct radiance *radiance, vec3s dir)
{
    const struct globals *g = radiance->globals;
    if (radiance->scene->background.kind == SCENE_COLOR)
        return g->background_color;
    if (radiance->scene->background.kind == SCENE_SKY)
        return scaled(g, sky_radiance_with_sun(dir, g->sun_dir, g->sun_strength));
    const vec3s light = environment_radiance(radiance, dir);
    if (!(g->sun_radius > 0.0f))
        return light;
    return glms_vec3_muladds(g->sun_light, sky_disc(dir, g->sun_dir, g->sun_radius, 0.0f), light);
}

/* Returns the mean radiance of the environment map over all directions, from every `step`th texel
 * of every `step`th row. */
static vec3s environment_mean(const struct radiance *radiance, uint32_t step)
{
    const struct environment *environment = &radiance->scene->background.environment;
    double sum[3] = { 0 };
    double weights = 0.0;
    for (uint32_t y = 0; y < environment->height; y += step) {
        const double weight = sin(((double)y + 0.5) / environment->height * 3.14159265358979);
        for (uint32_t x = 0; x < environment->width; x += step) {
            const vec4s texel = fetch_environment(radiance, 0, x, y);
            for (int c = 0; c < 3; c++)
                sum[c] += weight * (double)texel.raw[c];
            weights += weight;
        }
    }
    return (vec3s){ { (float)(sum[0] / weights), (float)(sum[1] / weights),
                      (float)(sum[2] / weights) } };
}

vec3s radiance_mean(const struct radiance *radiance, uint32_t step)
{
    const struct globals *g = radiance->globals;
    if (radiance->scene->background.kind == SCENE_COLOR)
        return g->background_color;
    if (radiance->scene->background.kind == SCENE_ENVIRONMENT)
        return environment_mean(radiance, step);
    const vec3s away = glms_vec3_negate(g->sun_dir);
    const vec3s light = glms_vec3_add(sky_reflected(g->sun_dir, g->sun_dir, g->sun_strength),
                                      sky_reflected(away, g->sun_dir, g->sun_strength));
    return glms_vec3_scale(light, 0.5f * g->sky_strength);
}

/* Returns a vertex's glTF material, or NULL if the settings alone determine its shading. */
static const struct material *material_of(const struct radiance *radiance, uint32_t material)
{
    const uint32_t index = material >> MESH_SURFACE_SHIFT;
    const struct material *found = index ? &radiance->scene->model.materials[index - 1] : NULL;
    return found && !(found->flags & MATERIAL_FROM_SETTINGS) ? found : NULL;
}

/* Texture coordinates of a surface point. */
struct coordinates {
    vec2s uv, other_uv; /* first and second uv set */
};

static struct coordinates coordinates_of(const struct radiance_point *point)
{
    return (struct coordinates){
        .uv = point->vertex->uv,
        .other_uv = point->extra ? point->extra->uv : glms_vec2_zero(),
    };
}

/* Samples a texture of a material. Returns white if the material has no such texture. */
static vec4s texel_of(const struct radiance *radiance, const struct material *material,
                      uint32_t use, struct coordinates coordinates)
{
    const struct material_texture *texture = &material->textures[use];
    const vec2s uv = texture->uv_set == 1 ? coordinates.other_uv : coordinates.uv;
    const struct model *model = &radiance->scene->model;
    const bool is_color = material_texture_is_color(use);
    const uint32_t size = is_color ? model->textures.size : model->numbers.size;
    const vec3s at = { { uv.x, uv.y, 1.0f } };
    if (!texture->layer)
        return glms_vec4_one();
    const float u = material_wrap(glms_vec3_dot(texture->u_row, at), texture->wrap_u, (float)size);
    const float v = material_wrap(glms_vec3_dot(texture->v_row, at), texture->wrap_v, (float)size);
    return bilinear(radiance, is_color ? fetch_texture : fetch_number, texture->layer - 1,
                    linear_filter_at(u, size, true), linear_filter_at(v, size, true));
}

static vec4s base_texel(const struct radiance *radiance, const struct mesh_vertex *vertex)
{
    const struct material *material = material_of(radiance, vertex->material);
    if ((vertex->material & MESH_TEXTURE_MASK) == MESH_TILES)
        return glms_vec4(tiles_color(vertex->uv, TILES_WIDTH), 1.0f);
    if (material && material->textures[MATERIAL_BASE_COLOR].layer)
        return texel_of(radiance, material, MATERIAL_BASE_COLOR,
                        (struct coordinates){ .uv = vertex->uv });
    return radiance_texel(radiance, vertex->material, vertex->uv);
}

float radiance_transmittance(const struct radiance *radiance, const struct mesh_vertex *vertex)
{
    const struct material *material = material_of(radiance, vertex->material);
    const bool is_cutout =
        vertex->material & MESH_CUTOUT || (material && material->flags & MATERIAL_IS_CUTOUT);
    if (!is_cutout && !(material && material->flags & MATERIAL_IS_BLENDED))
        return 0.0f;
    const float alpha = base_texel(radiance, vertex).w * (material ? material->alpha : 1.0f);
    if (is_cutout)
        return alpha < (material ? material->alpha_cutoff : 0.5f) ? 1.0f : 0.0f;
    return 1.0f - alpha;
}

/* Perturbs a shading normal by the normal map. */
static vec3s normal_mapped(const struct radiance *radiance, const struct material *m,
                           const struct radiance_point *point, vec3s n)
{
    if (!m->textures[MATERIAL_NORMAL].layer)
        return n;
    const vec4s texel = texel_of(radiance, m, MATERIAL_NORMAL, coordinates_of(point));
    const uint32_t set = m->textures[MATERIAL_NORMAL].uv_set;
    const float side = point->extra ? point->extra->side : 0.0f;
    const bool has_tangent = fabsf(side) > 0.0f;
    const vec3s uv_tangent = has_tangent ? point->extra->tangent : point->dp_du[set];
    const vec3s tangent = glms_vec3_muladds(n, -glms_vec3_dot(n, uv_tangent), uv_tangent);
    if (!(glms_vec3_norm2(tangent) > 0.0f))
        return n;
    const vec3s t = glms_vec3_normalize(tangent);
    vec3s b = glms_vec3_cross(n, t);
    const bool is_back = glms_vec3_dot(n, point->vertex->normal) < 0.0f;
    /* the texture's v axis points down */
    const bool is_flipped =
        has_tangent ? (side < 0.0f) != is_back : glms_vec3_dot(b, point->dp_dv[set]) > 0.0f;
    if (is_flipped)
        b = glms_vec3_negate(b);
    const vec3s slope = { { (2.0f * texel.x - 1.0f) * m->normal_scale,
                            (2.0f * texel.y - 1.0f) * m->normal_scale, 2.0f * texel.z - 1.0f } };
    return glms_vec3_normalize(
        glms_vec3_muladds(t, slope.x, glms_vec3_muladds(b, slope.y, glms_vec3_scale(n, slope.z))));
}

struct object_material radiance_material_at(const struct radiance *radiance,
                                            const struct material *material,
                                            const struct radiance_point *point,
                                            struct object_material untextured, vec3s *normal)
{
    const struct coordinates uv = coordinates_of(point);
    *normal = normal_mapped(radiance, material, point, point->vertex->normal);
    return object_material_of(untextured,
                              glms_vec3(texel_of(radiance, material, MATERIAL_BASE_COLOR, uv)),
                              texel_of(radiance, material, MATERIAL_METALLIC_ROUGHNESS, uv).y,
                              texel_of(radiance, material, MATERIAL_TRANSMISSION, uv).x);
}

static vec3s environment_light(const struct radiance *radiance, uint32_t layer, vec3s dir)
{
    const vec2s uv = surroundings_equirect_uv(dir, radiance->scene->background.environment.turn);
    return glms_vec3(bilinear(radiance, fetch_light, layer, linear_filter_at(uv.x, LIT_WIDTH, true),
                              linear_filter_at(uv.y, LIT_HEIGHT, false)));
}

static vec3s diffuse_irradiance(const struct radiance *radiance, vec3s n)
{
    if (radiance->scene->background.kind == SCENE_COLOR)
        return radiance->globals->background_color;
    if (radiance->scene->background.prefiltered)
        return environment_light(radiance, LIT_DIFFUSE_LAYER, n);
    return scaled(radiance->globals, sky_diffuse(n));
}

static vec3s prefiltered_radiance(const struct radiance *radiance, vec3s dir, float roughness)
{
    const struct globals *g = radiance->globals;
    if (radiance->scene->background.kind == SCENE_COLOR)
        return g->background_color;
    if (radiance->scene->background.kind == SCENE_SKY)
        return scaled(g, sky_glossy(dir, roughness, g->sun_dir, g->sun_strength));
    const float layer = roughness * LIT_ROUGH_LAYERS;
    const uint32_t first = (uint32_t)fminf(layer, LIT_ROUGH_LAYERS - 1);
    const vec3s sharper = first > 0 ? environment_light(radiance, first - 1, dir)
                                    : environment_radiance(radiance, dir);
    return glms_vec3_lerp(sharper, environment_light(radiance, first, dir), layer - (float)first);
}

static vec2s split_of(const struct radiance *radiance, float roughness, float n_dot_v)
{
    const vec2s at =
        glms_vec2_divs(glms_vec2_adds(lit_split_at(roughness, n_dot_v), 0.5f), LIT_SPLIT_SIDE);
    const vec4s split =
        bilinear(radiance, fetch_split, 0, linear_filter_at(at.x, LIT_SPLIT_SIDE, false),
                 linear_filter_at(at.y, LIT_SPLIT_SIDE, false));
    return (vec2s){ { split.x, split.y } };
}

static struct lit_surface surface_of(const struct radiance *radiance, const struct material *m,
                                     const struct radiance_point *point, vec3s albedo)
{
    const struct coordinates uv = coordinates_of(point);
    const vec4s rough = texel_of(radiance, m, MATERIAL_METALLIC_ROUGHNESS, uv);
    const vec4s tint = texel_of(radiance, m, MATERIAL_SPECULAR_COLOR, uv);
    const vec3s f0 = glms_vec3_mul(material_f0(m), glms_vec3(tint));
    float specular = m->specular * texel_of(radiance, m, MATERIAL_SPECULAR, uv).w;
    if (m->flags & MATERIAL_IS_WATER_LAYER) /* water on ice reflects almost nothing */
        specular *= lit_reflectance_in_medium(glms_vec3_max(f0), point->ior);
    return lit_surface_of(albedo, m->metallic * rough.z, m->roughness * rough.y, f0, specular);
}

/* Shading normals of the specular top layer, of the diffuse base layer and of the clear coat. */
struct normals {
    vec3s top, base, coat;
};

static struct normals normals_of(const struct radiance *radiance, const struct material *m,
                                 const struct radiance_point *point, vec3s n)
{
    const vec3s base = normal_mapped(radiance, m, point, n);
    return (struct normals){ m->flags & MATERIAL_IS_WATER_LAYER ? n : base, base, n };
}

/* Returns the radiance reflected from the model file's punctual lights, ignoring shadows. */
static vec3s shade_lights(const struct radiance *radiance, const struct lit_surface *surface,
                          vec3s point, struct normals n, vec3s to_camera)
{
    const struct scene *scene = radiance->scene;
    vec3s sum = glms_vec3_zero();
    for (uint32_t i = 0; scene->tables.punctual_lights && i < scene->model.light_count; i++) {
        const vec4s *row = &scene->tables.punctual_lights[(size_t)i * LIT_LIGHT_WIDTH];
        sum = glms_vec3_add(
            sum, lit_by_punctual_light(
                     *surface, point, n.top, n.base, to_camera,
                     (struct lit_punctual_light){ row[LIT_LIGHT_POSITION], row[LIT_LIGHT_DIRECTION],
                                                  row[LIT_LIGHT_COLOR], row[LIT_LIGHT_CONE] }));
    }
    return sum;
}

static const struct radiance_sun unoccluded_sun = { .sky = { { 1.0f, 1.0f, 1.0f } },
                                                    .direct = 1.0f };

static const struct radiance_sun *sun_of(const struct radiance_point *point)
{
    return point->sun ? point->sun : &unoccluded_sun;
}

/* Returns the reflected radiance of a white Lambertian surface. */
static vec3s shade_white_diffuse(const struct radiance *radiance,
                                 const struct radiance_point *point, vec3s n)
{
    const struct radiance_sun *sun = sun_of(point);
    const float cosine = fmaxf(0.0f, glms_vec3_dot(n, radiance->globals->sun_dir));
    const vec3s direct = glms_vec3_scale(glms_vec3_one(), sun->direct * cosine);
    return glms_vec3_muladd(radiance->globals->sun_light, glms_vec3_add(direct, sun->refracted),
                            glms_vec3_mul(sun->sky, diffuse_irradiance(radiance, n)));
}

/* Shades a surface by direct sunlight, and by refracted sunlight as if from one direction. */
static vec3s shade_sun(const struct radiance *radiance, const struct lit_surface *surface,
                       const struct radiance_point *point, struct normals n)
{
    const struct radiance_sun *sun = sun_of(point);
    const vec3s to_camera = glms_vec3_negate(point->dir);
    const vec3s direct = lit_by_light_on(*surface, n.top, n.base, to_camera,
                                         radiance->globals->sun_dir, radiance->globals->sun_spread);
    const float cosine = glms_vec3_dot(n.base, sun->refracted_dir);
    vec3s reflected = glms_vec3_scale(direct, sun->direct);
    if (cosine > 0.0f) {
        const vec3s brdf = lit_by_light_on(*surface, n.top, n.base, to_camera, sun->refracted_dir,
                                           radiance->globals->sun_spread);
        const vec3s weight = glms_vec3_scale(brdf, 1.0f / fmaxf(cosine, COSINE_MIN));
        reflected = glms_vec3_muladd(weight, sun->refracted, reflected);
    }
    return glms_vec3_mul(radiance->globals->sun_light, reflected);
}

/* Returns the reflected radiance of a Lambertian surface of the given albedo. */
static vec3s shade_diffuse(const struct radiance *radiance, const struct radiance_point *point,
                           vec3s n, vec3s albedo)
{
    const struct lit_surface surface = lit_surface_of(albedo, 0.0f, 1.0f, glms_vec3_zero(), 0.0f);
    const vec3s lights = shade_lights(radiance, &surface, point->vertex->position,
                                      (struct normals){ n, n, n }, glms_vec3_negate(point->dir));
    return glms_vec3_muladd(albedo, shade_white_diffuse(radiance, point, n), lights);
}

/* Returns the factor of the ambient occlusion map, or 1 if occlusion is ray-traced. */
static float occlusion_of(const struct radiance *radiance, const struct material *m,
                          struct coordinates uv)
{
    if (radiance->is_traced)
        return 1.0f;
    return 1.0f + m->occlusion_strength * (texel_of(radiance, m, MATERIAL_OCCLUSION, uv).x - 1.0f);
}

/* Clear coat of a surface, multiplied by its textures. */
struct coat {
    struct lit_surface surface;
    float factor;      /* 0 if there is none */
    float reflectance; /* fraction of light that the base does not receive */
};

static struct coat coat_of(const struct radiance *radiance, const struct material *m,
                           const struct radiance_point *point, vec3s n)
{
    const struct coordinates uv = coordinates_of(point);
    const float roughness =
        m->coat_roughness * texel_of(radiance, m, MATERIAL_COAT_ROUGHNESS, uv).y;
    const float factor = m->coat * texel_of(radiance, m, MATERIAL_COAT, uv).x;
    const float n_dot_v = glm_clamp(-glms_vec3_dot(n, point->dir), 0.0f, 1.0f);
    return (struct coat){
        .surface = lit_coat_surface(roughness),
        .factor = factor,
        .reflectance = lit_coat_reflectance(factor, split_of(radiance, roughness, n_dot_v)),
    };
}

/* Returns the radiance of a surface with its clear coat; `base` is the radiance without it. */
static vec3s shade_coat(const struct radiance *radiance, const struct material *m,
                        const struct radiance_point *point, vec3s n, vec3s base)
{
    const struct coat coat = coat_of(radiance, m, point, n);
    const struct normals normals = { n, n, n };
    const vec3s reflected_dir =
        glms_vec3_muladds(n, -2.0f * glms_vec3_dot(n, point->dir), point->dir);
    const vec3s environment = prefiltered_radiance(radiance, reflected_dir, coat.surface.roughness);
    const vec3s sun = shade_sun(radiance, &coat.surface, point, normals);
    const vec3s lights = shade_lights(radiance, &coat.surface, point->vertex->position, normals,
                                      glms_vec3_negate(point->dir));
    const float occlusion = occlusion_of(radiance, m, coordinates_of(point));
    const vec3s reflected = glms_vec3_muladds(environment, coat.reflectance * occlusion,
                                              glms_vec3_scale(base, 1.0f - coat.reflectance));
    return glms_vec3_muladds(glms_vec3_add(sun, lights), coat.factor, reflected);
}

/* Shades a glTF material lit by environment, sun and punctual lights. Adds its emission. */
static vec3s shade_material(const struct radiance *radiance, const struct material *m,
                            const struct radiance_point *point, struct normals n, vec3s albedo)
{
    const struct coordinates uv = coordinates_of(point);
    const vec3s to_camera = glms_vec3_negate(point->dir);
    const struct lit_surface surface = surface_of(radiance, m, point, albedo);
    const float n_dot_v = glm_clamp(glms_vec3_dot(n.top, to_camera), 0.0f, 1.0f);
    const vec3s reflected_dir =
        glms_vec3_muladds(n.top, -2.0f * glms_vec3_dot(n.top, point->dir), point->dir);
    const vec3s environment =
        lit_by_environment(surface, split_of(radiance, surface.roughness, n_dot_v),
                           prefiltered_radiance(radiance, reflected_dir, surface.roughness),
                           diffuse_irradiance(radiance, n.base));
    const vec3s sun = shade_sun(radiance, &surface, point, n);
    const vec4s glow = texel_of(radiance, m, MATERIAL_EMISSION, uv);
    const vec3s shaded = glms_vec3_scale(environment, occlusion_of(radiance, m, uv));
    const vec3s lights = shade_lights(radiance, &surface, point->vertex->position, n, to_camera);
    const vec3s base = glms_vec3_muladd(m->emission, glms_vec3(glow),
                                        glms_vec3_add(shaded, glms_vec3_add(sun, lights)));
    return m->coat > 0.0f ? shade_coat(radiance, m, point, n.coat, base) : base;
}

vec3s radiance_albedo(const struct radiance *radiance, const struct mesh_vertex *vertex)
{
    return glms_vec3_mul(vertex->color, glms_vec3(base_texel(radiance, vertex)));
}

/* Returns the albedo of a material. That of a shadow catcher gives it, where it is unoccluded, the
 * environment's radiance in the ray's direction. */
static vec3s albedo_of(const struct radiance *radiance, const struct material *m,
                       const struct radiance_point *point, vec3s n)
{
    const struct globals *g = radiance->globals;
    if (!(m->flags & MATERIAL_IS_SHADOW_CATCHER))
        return radiance_albedo(radiance, point->vertex);
    const float cosine = fmaxf(glms_vec3_dot(n, g->sun_dir), 0.0f);
    const vec3s light = glms_vec3_muladds(g->sun_light, cosine, diffuse_irradiance(radiance, n));
    return glms_vec3_div(radiance_at_infinity(radiance, point->dir),
                         glms_vec3_maxv(light, glms_vec3_fill(1e-6f)));
}

vec3s radiance_surface(const struct radiance *radiance, const struct radiance_point *point)
{
    const struct mesh_vertex *vertex = point->vertex;
    const struct material *m = material_of(radiance, vertex->material);
    const vec3s albedo = radiance_albedo(radiance, vertex);
    if (vertex->material & MESH_UNLIT)
        return glms_vec3_muladd(glms_vec3_mul(albedo, radiance->globals->sun_light),
                                sun_of(point)->refracted, albedo);
    const bool is_back = glms_vec3_dot(vertex->normal, point->dir) > 0.0f;
    const vec3s n = is_back ? glms_vec3_negate(vertex->normal) : vertex->normal;
    if (!m || point->is_base)
        return shade_diffuse(radiance, point, n, albedo);
    return shade_material(radiance, m, point, normals_of(radiance, m, point, n),
                          albedo_of(radiance, m, point, n));
}

vec3s radiance_at_infinity(const struct radiance *radiance, vec3s dir)
{
    if (radiance->scene->background.kind == SCENE_ENVIRONMENT)
        return environment_radiance(radiance, dir);
    return prefiltered_radiance(radiance, dir, 0.0f);
}

/* Adds a clear coat to the reflectance of a surface. Only the stronger specular lobe counts. */
static void add_coat(const struct radiance *radiance, const struct material *m,
                     const struct radiance_point *point, float occlusion,
                     struct radiance_reflectance *reflectance)
{
    const bool is_back = glms_vec3_dot(point->vertex->normal, point->dir) > 0.0f;
    const vec3s n = is_back ? glms_vec3_negate(point->vertex->normal) : point->vertex->normal;
    const struct coat coat = coat_of(radiance, m, point, n);
    reflectance->diffuse = glms_vec3_scale(reflectance->diffuse, 1.0f - coat.reflectance);
    reflectance->glossy = glms_vec3_scale(reflectance->glossy, 1.0f - coat.reflectance);
    if (!lit_coat_is_stronger(coat.reflectance, reflectance->glossy))
        return;
    reflectance->glossy = glms_vec3_fill(coat.reflectance * occlusion);
    reflectance->top = n;
    reflectance->roughness = coat.surface.roughness;
}

bool radiance_reflectance_at(const struct radiance *radiance, const struct radiance_point *point,
                             struct radiance_reflectance *reflectance)
{
    const struct mesh_vertex *vertex = point->vertex;
    const struct material *m = material_of(radiance, vertex->material);
    const vec3s albedo = radiance_albedo(radiance, vertex);
    const bool is_back = glms_vec3_dot(vertex->normal, point->dir) > 0.0f;
    *reflectance = (struct radiance_reflectance){
        .diffuse = albedo,
        .normal = is_back ? glms_vec3_negate(vertex->normal) : vertex->normal,
        .roughness = 1.0f,
    };
    reflectance->top = reflectance->normal;
    if (vertex->material & MESH_UNLIT || !m)
        return !(vertex->material & MESH_UNLIT);
    const struct coordinates uv = coordinates_of(point);
    const struct lit_surface surface =
        surface_of(radiance, m, point, albedo_of(radiance, m, point, reflectance->normal));
    const struct normals n = normals_of(radiance, m, point, reflectance->normal);
    reflectance->normal = n.base;
    reflectance->top = n.top;
    reflectance->roughness = surface.roughness;
    const float n_dot_v = glm_clamp(-glms_vec3_dot(reflectance->top, point->dir), 0.0f, 1.0f);
    const vec2s split = split_of(radiance, surface.roughness, n_dot_v);
    const vec3s all = glms_vec3_fill(occlusion_of(radiance, m, uv));
    reflectance->diffuse = lit_by_environment(surface, split, glms_vec3_zero(), all);
    reflectance->glossy = lit_by_environment(surface, split, all, glms_vec3_zero());
    if (m->coat > 0.0f)
        add_coat(radiance, m, point, all.x, reflectance);
    return true;
}
