/* ray_layer_tracer.c: ordered surfaces, refracted paths and Cryptomattes, by Embree. */
#include "src/lab/reference/ray_layer_tracer.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/base/tile.h"
#include "src/file/cryptomatte.h"
#include "src/lab/reference/primary_hit_aovs.h"
#include "src/lab/reference/ray_branch.h"
#include "src/lab/reference/traced_scene.h"
#include "src/lab/reference/whitted.h"
#include "src/render/make_frame_request.h"
#include "src/render/sample_accumulation.h"
#include "src/tech/output/gbuffer.h"
#include "src/tech/output/ray_layers.h"

enum {
    CROSSINGS_MAX = 4096, /* surfaces tested along an unrefracted camera ray */
    PLANES_MAX = sizeof(struct ray_layer_values) / sizeof(float),
    NEIGHBOURS = 4,
};

#define ROUNDING 1e-6f /* relative rounding error of distances */

/* Maximum distance of the surfaces of neighbouring pixels that touch, in widths of a pixel. */
#define CONTACT_WIDTHS 8.0f

/* Cryptomatte IDs by number of layer `object` or `material`. */
struct id_table {
    float *ids;
    uint32_t count;
};

struct ray_layer_tracer {
    struct renderer_params params;
    struct tiling tiling;
    RTCDevice device;
    struct traced_scene traced;
    bool is_built;                      /* `traced` is initialised */
    bool has_surfaces;                  /* depths or objects are requested */
    bool has_boundary;                  /* boundary is requested */
    bool has_refraction;                /* a layer of the refracted path is requested */
    bool has_mattes;                    /* a Cryptomatte is requested */
    struct camera_rays sample_rays;     /* of all samples, for Cryptomattes */
    struct id_table objects, materials; /* for Cryptomattes */
};

/* First visible surface of a pixel. */
struct first_surface {
    float object; /* 0 if there is none */
    float width;  /* of a pixel at the surface, metres */
    vec3s position;
};

/* Image or tile being traced. */
struct job {
    const struct ray_layer_tracer *tracer;
    struct tracer tracing;
    struct primary_hit_layers primary;
    uint32_t left, top, width, height; /* pixels of the image; of the tile, if interleaved */
    uint32_t step_x, step_y;           /* spacing of an interleaved tile's pixels */

    struct {
        float *texels;
        uint32_t value; /* float of struct ray_layer_values */
    } planes[PLANES_MAX];

    uint32_t plane_count;
    float *boundary;             /* plane of layer `boundary`, or NULL */
    struct first_surface *first; /* of all pixels; NULL unless `boundary` is traced */
};

uint64_t ray_layer_tracer_mask(uint64_t layers)
{
    uint64_t mask = 0;
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (techniques_layer(i)->is_traced)
            mask |= UINT64_C(1) << i;
    }
    return layers & mask;
}

/* Returns true if a mask contains a layer whose values are at `first` to `end` floats. */
static bool wants(uint64_t layers, size_t first, size_t end)
{
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct frame_layer *layer = techniques_layer(i);
        if (layer->is_traced && layers & UINT64_C(1) << i && layer->first_channel >= first &&
            layer->first_channel < end)
            return true;
    }
    return false;
}

/* Sets the IDs from lines "NUMBER NAME", whose numbers ascend. Returns false when out of memory. */
static bool read_ids(struct id_table *table, const char *names)
{
    uint32_t count = 0;
    for (const char *c = names; *c; c++)
        count += *c == '\n';
    table->ids = calloc(count + (size_t)2, sizeof(*table->ids));
    table->count = table->ids ? count + 2 : 0;
    for (const char *line = names; *line && table->ids; line = strchr(line, '\n') + 1) {
        char name[MATERIAL_NAME_SIZE] = "";
        char *rest;
        const unsigned long number = strtoul(line, &rest, 10);
        const size_t length = strcspn(rest + 1, "\n");
        memcpy(name, rest + 1, length < sizeof(name) ? length : sizeof(name) - 1);
        if (number < table->count)
            table->ids[number] = cryptomatte_id(name);
    }
    return table->ids;
}

enum status ray_layer_tracer_create(struct ray_layer_tracer **tracer,
                                    const struct renderer_params *params, const char *objects,
                                    const char *materials)
{
    const size_t material = offsetof(struct ray_layer_values, material) / sizeof(float);
    const size_t boundary = offsetof(struct ray_layer_values, boundary) / sizeof(float);
    const size_t matte = offsetof(struct ray_layer_values, object_matte) / sizeof(float);
    struct ray_layer_tracer *t = calloc(1, sizeof(*t));
    *tracer = NULL;
    if (!t)
        return log_out_of_memory(NULL);
    t->params = *params;
    t->tiling = renderer_tiling(params);
    t->has_surfaces = wants(params->layers, 0, material);
    t->has_boundary = wants(params->layers, boundary, boundary + 1);
    t->has_refraction = wants(params->layers, boundary + 1, matte);
    t->has_mattes = wants(params->layers, matte, PLANES_MAX);
    enum status status = traced_scene_open_device(&t->device);
    if (status == STATUS_OK && t->has_mattes &&
        !(read_ids(&t->objects, objects) && read_ids(&t->materials, materials)))
        status = log_out_of_memory("names");
    if (status == STATUS_OK)
        *tracer = t;
    else
        ray_layer_tracer_destroy(t);
    return status;
}

void ray_layer_tracer_destroy(struct ray_layer_tracer *tracer)
{
    if (!tracer)
        return;
    if (tracer->is_built)
        traced_scene_finish(&tracer->traced);
    if (tracer->device)
        rtcReleaseDevice(tracer->device);
    free(tracer->objects.ids);
    free(tracer->materials.ids);
    free(tracer);
}

/* ---- unrefracted camera ray ---- */

static bool is_surface(const struct job *job, const struct embree_scene_hit *hit)
{
    return hit->kind == EMBREE_SCENE_OBJECT ||
           (hit->kind == EMBREE_SCENE_SURROUNDINGS &&
            !(radiance_transmittance(job->tracing.radiance, &hit->surface) > 0.5f));
}

/* Returns true if a hit is on a surface that was found before: again on the same triangle, or on
 * one that shares an edge, which the ray hits. */
static bool is_found(const struct embree_scene_hit *hits, uint32_t count,
                     const struct embree_scene_hit *hit, vec3s dir)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct embree_scene_hit *a = &hits[i];
        const bool is_same_side =
            (glms_vec3_dot(a->facet, dir) < 0.0f) == (glms_vec3_dot(hit->facet, dir) < 0.0f);
        if (a->kind == hit->kind && a->object == hit->object && is_same_side &&
            hit->distance - a->distance <= 2.0f * ROUNDING * hit->distance)
            return true;
    }
    return false;
}

/* Finds up to `most` surfaces along a ray, front to back. Returns their number. */
static uint32_t find_surfaces(const struct job *job, const struct embree_scene_ray *from,
                              uint32_t most, struct embree_scene_hit *hits)
{
    struct embree_scene_search search = { .count = 0 };
    struct embree_scene_ray ray = *from;
    struct embree_scene_hit hit;
    uint32_t count = 0;
    ray.search = &search;
    for (uint32_t i = 0; i < CROSSINGS_MAX && count < most &&
                         embree_scene_intersect(job->tracing.embree_scene, &ray, &hit);
         i++) {
        if (is_surface(job, &hit) && !is_found(hits, count, &hit, ray.dir))
            hits[count++] = hit;
        ray.near = nextafterf(hit.distance, INFINITY);
        if (hit.kind == EMBREE_SCENE_OBJECT) { /* another object may be hit at the same distance */
            embree_scene_search_add(&search, hit.triangle);
            ray.near = fmaxf(ray.near * (1.0f - 2.0f * ROUNDING), from->near);
        }
    }
    return count;
}

static float view_depth(const struct job *job, const struct embree_scene_ray *ray, vec3s point)
{
    return glms_vec3_dot(glms_vec3_sub(point, ray->origin),
                         job->tracer->traced.camera_rays.forward);
}

/* Returns the number of a hit surface's material, its index + 1; 0 if there is none. */
static uint32_t material_number(const struct job *job, const struct embree_scene_hit *hit)
{
    const struct model *model = &job->tracing.radiance->scene->model;
    const uint32_t own = hit->surface.material >> MESH_SURFACE_SHIFT;
    if (hit->kind == EMBREE_SCENE_SURROUNDINGS)
        return own;
    const uint32_t material = model->objects[hit->object].material;
    return model->materials[material].flags & MATERIAL_IS_PARTIAL && own ? own : material + 1;
}

static void fill_surfaces(const struct job *job, const struct embree_scene_ray *ray,
                          struct ray_layer_values *values, struct first_surface *first)
{
    struct embree_scene_hit hits[RAY_LAYER_SURFACES];
    const struct model *model = &job->tracing.radiance->scene->model;
    const uint32_t count =
        find_surfaces(job, ray, job->tracer->has_surfaces ? RAY_LAYER_SURFACES : 1, hits);
    for (uint32_t i = 0; i < count; i++) {
        values->depths[i] = view_depth(job, ray, hits[i].surface.position);
        values->objects[i] = primary_hit_layers_object(&job->primary, &hits[i]);
    }
    for (uint32_t i = count; i < RAY_LAYER_SURFACES; i++)
        values->depths[i] = GBUFFER_NOTHING;
    if (!count)
        return;
    const uint32_t material = material_number(job, &hits[0]);
    values->material = (float)material;
    values->class_id = material ? (float)model->materials[material - 1].class_id : 0.0f;
    const struct surroundings_push *push = &job->tracer->traced.camera_rays.push;
    const float ahead = job->tracer->traced.camera_rays.is_orthographic ? 1.0f : values->depths[0];
    first->object = values->objects[0];
    first->position = hits[0].surface.position;
    first->width = 2.0f * glms_vec3_norm(push->right) / (float)job->tracer->params.width * ahead;
}

/* ---- refracted path ---- */

/* Returns true if the path ends at a hit. */
static bool is_opaque(const struct surface_hit *surface_hit)
{
    return surface_hit->hit.kind == EMBREE_SCENE_OBJECT && surface_hit->material.opacity > 0.5f;
}

/* Follows the refracted path, and the reflected one at total reflection, to the first opaque
 * surface. Returns true if there is one. */
static bool follow(const struct job *job, struct ray_branch *b, struct surface_hit *surface_hit)
{
    while (ray_branch_advance(&job->tracing, b, surface_hit)) {
        const struct embree_scene_hit *hit = &surface_hit->hit;
        if (hit->kind == EMBREE_SCENE_SURROUNDINGS) {
            const float passing = radiance_transmittance(job->tracing.radiance, &hit->surface);
            if (!(passing > 0.5f))
                return true;
            ray_branch_pass(&job->tracing, b, hit, passing);
            continue;
        }
        if (is_opaque(surface_hit))
            return true;
        surface_hit->material.roughness = 0.0f;
        const struct fork fork = ray_branch_split(&job->tracing, b, surface_hit);
        *b = fork.split.fresnel >= 1.0f ? fork.reflected : fork.refracted;
    }
    return false;
}

/* Returns the offset from a pixel's centre to the projection of a homogeneous point; NaN outside
 * the image. */
static vec2s flow_to(const struct job *job, vec4s point, uint32_t x, uint32_t y)
{
    const struct ray_layer_tracer *t = job->tracer;
    const float width = (float)t->params.width, height = (float)t->params.height;
    const vec4s clip = glms_mat4_mulv(t->traced.globals.clip_from_world, point);
    const float to_x = (0.5f * clip.x / clip.w + 0.5f) * width;
    const float to_y = (0.5f * clip.y / clip.w + 0.5f) * height;
    if (!(clip.w > 0.0f && to_x >= 0.0f && to_x < width && to_y >= 0.0f && to_y < height))
        return (vec2s){ { NAN, NAN } };
    return (vec2s){ { to_x - ((float)x + 0.5f), to_y - ((float)y + 0.5f) } };
}

static void fill_refraction(const struct job *job, const struct embree_scene_ray *ray,
                            const uint32_t at[2], struct ray_layer_values *values)
{
    struct surface_hit surface_hit = { .channel = 1 };
    struct ray_branch b = {
        .ray = *ray,
        .inside = job->tracing.camera_inside,
        .throughput = glms_vec3_one(),
        .ignores_scattering = true,
    };
    if (job->tracer->traced.camera_rays.is_orthographic)
        whitted_find_enclosing(&job->tracing, ray->origin, &b.inside);
    values->z = GBUFFER_NOTHING;
    values->flow = (vec2s){ { NAN, NAN } };
    const bool is_hit = follow(job, &b, &surface_hit);
    if (!is_hit && ray_branch_is_exhausted(&job->tracing, &b))
        return;
    values->transmission = b.throughput;
    const vec3s end = is_hit ? surface_hit.hit.surface.position : b.ray.dir;
    values->flow = b.bounces ? flow_to(job, glms_vec4(end, is_hit ? 1.0f : 0.0f), at[0], at[1])
                             : glms_vec2_zero();
    if (!is_hit)
        return;
    values->position = end;
    values->z = view_depth(job, ray, end);
    values->object = primary_hit_layers_object(&job->primary, &surface_hit.hit);
    values->uv = surface_hit.hit.surface.uv;
    values->motion = primary_hit_layers_motion(&job->primary, &surface_hit.hit);
}

/* ---- Cryptomattes ---- */

/* Adds a sample to the pairs of a Cryptomatte. Drops IDs beyond the last rank. */
static void add_to_matte(float *pairs, const struct id_table *table, uint32_t number, float weight)
{
    const float id = number < table->count ? table->ids[number] : 0.0f;
    if (!number || !(fabsf(id) > 0.0f))
        return;
    for (uint32_t rank = 0; rank < RAY_LAYER_RANKS; rank++) {
        float *pair = &pairs[2 * (size_t)rank];
        if (pair[1] > 0.0f && fabsf(pair[0] - id) > 0.0f)
            continue;
        pair[0] = id;
        pair[1] += weight;
        return;
    }
}

/* Sorts the pairs by descending coverage; pairs of equal coverage keep their order. */
static void sort_matte(float *pairs)
{
    for (size_t i = 1; i < RAY_LAYER_RANKS; i++) {
        for (size_t k = i; k > 0 && pairs[2 * k + 1] > pairs[2 * k - 1]; k--) {
            float swap[2];
            memcpy(swap, &pairs[2 * k], sizeof(swap));
            memcpy(&pairs[2 * k], &pairs[2 * k - 2], sizeof(swap));
            memcpy(&pairs[2 * k - 2], swap, sizeof(swap));
        }
    }
}

static void fill_mattes(const struct job *job, uint32_t x, uint32_t y,
                        struct ray_layer_values *values)
{
    const struct ray_layer_tracer *t = job->tracer;
    const uint32_t samples = t->params.samples ? t->params.samples : 1;
    for (uint32_t s = 0; s < samples; s++) {
        const struct embree_scene_ray ray = camera_rays_at(&t->sample_rays, x, y, s);
        struct embree_scene_hit hit;
        if (!find_surfaces(job, &ray, 1, &hit))
            continue;
        add_to_matte(values->object_matte, &t->objects,
                     (uint32_t)primary_hit_layers_object(&job->primary, &hit),
                     1.0f / (float)samples);
        add_to_matte(values->material_matte, &t->materials, material_number(job, &hit),
                     1.0f / (float)samples);
    }
    sort_matte(values->object_matte);
    sort_matte(values->material_matte);
}

/* ---- pixels ---- */

/* Traces pixel (x, y) of the image. */
static struct first_surface trace_pixel(const struct job *job, uint32_t x, uint32_t y,
                                        struct ray_layer_values *values)
{
    struct first_surface first = { 0 };
    const struct embree_scene_ray ray = camera_rays_at(&job->tracer->traced.camera_rays, x, y, 0);
    fill_surfaces(job, &ray, values, &first);
    if (job->tracer->has_refraction)
        fill_refraction(job, &ray, (uint32_t[]){ x, y }, values);
    if (job->tracer->has_mattes)
        fill_mattes(job, x, y, values);
    return first;
}

static void trace_row(void *user, uint32_t row)
{
    const struct job *job = user;
    for (uint32_t i = 0; i < job->width; i++) {
        struct ray_layer_values values = { 0 };
        float floats[PLANES_MAX];
        const size_t pixel = (size_t)row * job->width + i;
        const struct first_surface first =
            trace_pixel(job, job->left + i * job->step_x, job->top + row * job->step_y, &values);
        memcpy(floats, &values, sizeof(floats));
        for (uint32_t p = 0; p < job->plane_count; p++)
            job->planes[p].texels[pixel] = floats[job->planes[p].value];
        if (job->first)
            job->first[pixel] = first;
    }
}

/* ---- boundaries ---- */

/* Returns the first surface at pixel (x, y) of the image, which may be outside the tile. */
static struct first_surface first_at(const struct job *job, uint32_t x, uint32_t y)
{
    const uint32_t column = x - job->left, row = y - job->top;
    if (job->step_x == 1 && job->step_y == 1 && column < job->width && row < job->height)
        return job->first[(size_t)row * job->width + column];
    struct ray_layer_values values;
    struct first_surface first = { 0 };
    const struct embree_scene_ray ray = camera_rays_at(&job->tracer->traced.camera_rays, x, y, 0);
    fill_surfaces(job, &ray, &values, &first);
    return first;
}

static enum ray_layer_boundary compare(const struct first_surface *a, const struct first_surface *b)
{
    if ((uint32_t)a->object == (uint32_t)b->object)
        return RAY_LAYER_INTERIOR;
    const float reach = CONTACT_WIDTHS * fmaxf(a->width, b->width);
    const bool is_near = a->object > 0.0f && b->object > 0.0f &&
                         glms_vec3_distance(a->position, b->position) <= reach;
    return is_near ? RAY_LAYER_CONTACT : RAY_LAYER_OCCLUSION;
}

static enum ray_layer_boundary classify(const struct job *job, uint32_t x, uint32_t y,
                                        const struct first_surface *own)
{
    static const int32_t offsets[NEIGHBOURS][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    enum ray_layer_boundary found = RAY_LAYER_INTERIOR;
    for (uint32_t n = 0; n < NEIGHBOURS && found != RAY_LAYER_OCCLUSION; n++) {
        const uint32_t across = x + (uint32_t)offsets[n][0], down = y + (uint32_t)offsets[n][1];
        if (across >= job->tracer->params.width || down >= job->tracer->params.height)
            continue;
        const struct first_surface other = first_at(job, across, down);
        const enum ray_layer_boundary kind = compare(own, &other);
        found = kind == RAY_LAYER_INTERIOR ? found : kind;
    }
    return found;
}

static void classify_row(void *user, uint32_t row)
{
    const struct job *job = user;
    for (uint32_t i = 0; i < job->width; i++) {
        const size_t pixel = (size_t)row * job->width + i;
        job->boundary[pixel] = (float)classify(job, job->left + i * job->step_x,
                                               job->top + row * job->step_y, &job->first[pixel]);
    }
}

/* ---- images ---- */

/* Builds the Embree scene, unless that of the previous shot can be used. */
static enum status prepare(struct ray_layer_tracer *t, const struct renderer_shot *shot)
{
    const struct traced_scene_params params = {
        .scene = t->params.scene,
        .settings = t->params.settings,
        .width = t->params.width,
        .height = t->params.height,
        .filter = PIXEL_FILTER_POINT,
        .device = t->device,
    };
    enum status status = STATUS_OK;
    if (!t->is_built || !traced_scene_set_shot(&t->traced, shot)) {
        if (t->is_built)
            traced_scene_finish(&t->traced);
        status = traced_scene_init(&t->traced, &params, shot);
        t->is_built = status == STATUS_OK;
        if (!t->is_built)
            traced_scene_finish(&t->traced);
        t->traced.tracing.scattering_media_count = 0;
    }
    t->sample_rays = t->traced.camera_rays;
    t->sample_rays.filter = t->params.filter;
    t->traced.camera_rays.has_lens = false;
    return status;
}

/* Sets the pixels of a shot's tile. */
static void set_area(struct job *job, uint32_t index)
{
    const struct renderer_params *params = &job->tracer->params;
    const struct tile tile = tile_at(&job->tracer->tiling, index);
    job->step_x = job->step_y = 1;
    job->left = tile.x;
    job->top = tile.y;
    job->width = tile.width;
    job->height = tile.height;
    if (!renderer_is_interleaved(params))
        return;
    job->step_x = params->columns;
    job->step_y = params->rows;
    job->left = index % params->columns;
    job->top = index / params->columns;
    job->width = params->width / params->columns;
    job->height = params->height / params->rows;
}

/* Adds the planes of the traced layers to the image. Returns false when out of memory. */
static bool add_planes(struct job *job, struct image *image)
{
    const uint32_t boundary = offsetof(struct ray_layer_values, boundary) / sizeof(float);
    const uint64_t layers = ray_layer_tracer_mask(job->tracer->params.layers);
    bool done = true;
    for (uint32_t i = 0; techniques_layer(i) && done; i++) {
        const struct frame_layer *layer = techniques_layer(i);
        if (!(layers & UINT64_C(1) << i))
            continue;
        done = accumulate_add_planes(image, layer);
        for (uint32_t p = 0; p < frame_layer_plane_count(layer) && done; p++) {
            float *texels = image_find(image, layer->planes[p]);
            if (layer->first_channel == boundary)
                job->boundary = texels;
            job->planes[job->plane_count].texels = texels;
            job->planes[job->plane_count++].value = layer->first_channel + p;
        }
    }
    if (done && job->boundary)
        job->first = malloc((size_t)job->width * job->height * sizeof(*job->first));
    return done && (!job->boundary || job->first);
}

static void trace(struct job *job)
{
    const uint32_t threads = machine_core_count();
    const struct traced_scene *traced = &job->tracer->traced;
    whitted_find_enclosing(&traced->tracing, traced->camera_rays.push.eye,
                           &job->tracing.camera_inside);
    parallel_for(job->height, threads, trace_row, job, NULL, NULL);
    if (job->boundary)
        parallel_for(job->height, threads, classify_row, job, NULL, NULL);
}

enum status ray_layer_tracer_draw(struct ray_layer_tracer *tracer, const struct renderer_shot *shot,
                                  struct image *image)
{
    struct job job = { .tracer = tracer };
    enum status status = prepare(tracer, shot);
    if (status != STATUS_OK)
        return status;
    job.tracing = tracer->traced.tracing;
    job.primary = (struct primary_hit_layers){ &tracer->traced.embree_scene,
                                               &tracer->traced.radiance, &tracer->traced.earlier };
    set_area(&job, shot->tile);
    if (!image->width)
        image_init(image, job.width, job.height);
    if (add_planes(&job, image))
        trace(&job);
    else
        status = log_out_of_memory("layers");
    free(job.first);
    return status;
}
