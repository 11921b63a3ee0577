/* photons.c: emits and traces photons, sorts them into a hash grid, estimates irradiance. */
#include "src/lab/reference/photons.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/microfacet.h"
#include "src/base/log.h"
#include "src/lab/reference/ray_branch.h"

enum {
    CHUNK = 4096,         /* photons per task of a thread */
    CROSSINGS_MAX = 4096, /* maximum surfaces along a shadow ray */
    POSITION_SEED = 11,   /* seed constant for emission */
    SUN_SEED,
    PATH_SEED,
};

#define RADIUS         1.0f  /* of one photon, in objects' radii */
#define PLANE_DISTANCE 0.25f /* max. tangent plane distance, search radii */

/* Surface hits stored for one chunk of CHUNK emitted photons. */
struct stored_hits {
    struct photon *photons;
    uint32_t count, capacity;
    bool is_full; /* an allocation has failed */
};

struct job {
    const struct tracer *tracing;
    const struct photons_params *params;
    float sun;
    struct stored_hits *chunks;
    uint32_t chunk_count;
};

/* Samples a direction to the sun's disc. `tangent` is the tangent of the disc's angular radius. */
static vec3s to_sun(vec3s sun_dir, float tangent, vec2s at)
{
    const float offset = tangent * sqrtf(at.x);
    const float angle = 6.28318531f * at.y;
    const struct microfacet_tangents t = microfacet_tangents_of(sun_dir);
    return glms_vec3_normalize(glms_vec3_muladds(
        t.x, offset * cosf(angle), glms_vec3_muladds(t.y, offset * sinf(angle), sun_dir)));
}

/* Emits photon `index` from the sun, through the disc that covers the objects' bounding sphere. */
static struct ray_branch emit(const struct job *job, uint32_t index, vec3s channels)
{
    const struct globals *g = job->tracing->radiance->globals;
    const vec2s at = microfacet_point(index, POSITION_SEED);
    const vec3s up = to_sun(g->sun_dir, job->sun, microfacet_point(index, SUN_SEED));
    const float out = g->radius * sqrtf(at.x);
    const float angle = 6.28318531f * at.y;
    const float area = 3.14159265f * g->radius * g->radius / (float)job->params->count;
    const struct microfacet_tangents t = microfacet_tangents_of(up);
    const vec3s side = glms_vec3_add(glms_vec3_scale(t.x, out * cosf(angle)),
                                     glms_vec3_scale(t.y, out * sinf(angle)));
    return (struct ray_branch){
        .ray = {
            .origin = glms_vec3_muladds(up, 1.01f * g->radius, glms_vec3_add(g->center, side)),
            .dir = glms_vec3_negate(up),
            .from = EMBREE_SCENE_NO_ORIGIN,
        },
        .throughput = glms_vec3_scale(channels, area),
        .seed = PATH_SEED,
    };
}

static void store_hit(struct stored_hits *stored_hits, const struct ray_branch *b, vec3s position,
                      float fraction)
{
    if (stored_hits->count == stored_hits->capacity) {
        const uint32_t capacity = stored_hits->capacity ? 2 * stored_hits->capacity : CHUNK / 4;
        struct photon *grown = realloc(stored_hits->photons, capacity * sizeof(*grown));
        stored_hits->is_full = stored_hits->is_full || !grown;
        if (!grown)
            return;
        stored_hits->photons = grown;
        stored_hits->capacity = capacity;
    }
    stored_hits->photons[stored_hits->count++] =
        (struct photon){ position, b->ray.dir, glms_vec3_scale(b->throughput, fraction) };
}

/* Traces a photon. Stores its hits on the surroundings only after it has hit an object, because
 * shadow rays already sample direct sunlight. */
static void trace_photon(const struct tracer *tracing, struct ray_branch b, uint32_t channel,
                         struct stored_hits *stored_hits)
{
    const float cutoff = tracing->params.cutoff * glms_vec3_max(b.throughput);
    struct surface_hit surface_hit = { .channel = channel };
    bool has_hit_object = false;
    while (glms_vec3_max(b.throughput) > cutoff && ray_branch_advance(tracing, &b, &surface_hit)) {
        const struct embree_scene_hit *hit = &surface_hit.hit;
        if (hit->kind != EMBREE_SCENE_SURROUNDINGS) {
            const struct fork fork = ray_branch_split(tracing, &b, &surface_hit);
            b = ray_branch_choose(tracing, &b, &fork);
            has_hit_object = true;
            continue;
        }
        const float passing = radiance_transmittance(tracing->radiance, &hit->surface);
        if (has_hit_object)
            store_hit(stored_hits, &b, hit->surface.position, 1.0f - passing);
        ray_branch_pass(tracing, &b, hit, passing);
    }
}

static void trace_chunk(void *user, uint32_t chunk)
{
    const struct job *job = user;
    const uint32_t end =
        job->params->count - chunk * CHUNK < CHUNK ? job->params->count : (chunk + 1) * CHUNK;
    const uint32_t channels = tracer_channel_count(job->tracing);
    for (uint32_t i = chunk * CHUNK; i < end; i++) {
        struct tracer tracing = *job->tracing;
        tracing.sample = i;
        for (uint32_t c = 0; c < channels; c++) {
            const vec3s of_channel = tracer_channels(job->tracing, c);
            trace_photon(&tracing, emit(job, i, of_channel), c, &job->chunks[chunk]);
        }
    }
}

struct cell {
    int32_t at[3];
};

/* Returns the grid cell of a point. Cells are as wide as the search diameter, so a search overlaps
 * at most two cells along each axis. */
static struct cell cell_of(const struct photons *photons, vec3s point)
{
    struct cell cell;
    for (int k = 0; k < 3; k++) {
        const float at = floorf(point.raw[k] / (2.0f * photons->radius));
        cell.at[k] = (int32_t)glm_clamp(at, -1e9f, 1e9f);
    }
    return cell;
}

static uint32_t bucket_of(const struct photons *photons, struct cell cell)
{
    const uint32_t across = microfacet_hash((uint32_t)cell.at[0], (uint32_t)cell.at[2]);
    return microfacet_hash(across, (uint32_t)cell.at[1]) & (photons->bucket_count - 1);
}

/* Sorts the photons of all chunks into the hash grid, by counting sort. The order within a bucket
 * does not depend on the number of threads. Returns false if out of memory. */
static bool sort(struct photons *photons, const struct job *job)
{
    bool done = true;
    for (uint32_t i = 0; i < job->chunk_count; i++) {
        photons->count += job->chunks[i].count;
        done = done && !job->chunks[i].is_full;
    }
    photons->bucket_count = 1;
    while (photons->bucket_count < photons->count)
        photons->bucket_count *= 2;
    photons->all = malloc((photons->count + 1) * sizeof(*photons->all));
    photons->first = calloc((size_t)photons->bucket_count + 2, sizeof(*photons->first));
    if (!done || !photons->all || !photons->first)
        return false;
    uint32_t *next = photons->first + 1; /* write position of each bucket */
    for (uint32_t i = 0; i < job->chunk_count; i++) {
        for (uint32_t k = 0; k < job->chunks[i].count; k++)
            next[bucket_of(photons, cell_of(photons, job->chunks[i].photons[k].position)) + 1]++;
    }
    for (uint32_t b = 0; b < photons->bucket_count; b++)
        next[b + 1] += next[b];
    for (uint32_t i = 0; i < job->chunk_count; i++) {
        for (uint32_t k = 0; k < job->chunks[i].count; k++) {
            const struct photon *photon = &job->chunks[i].photons[k];
            photons->all[next[bucket_of(photons, cell_of(photons, photon->position))]++] = *photon;
        }
    }
    return true;
}

enum status photons_init(struct photons *photons, const struct tracer *tracing,
                         const struct photons_params *params)
{
    const struct globals *g = tracing->radiance->globals;
    struct job job = {
        .tracing = tracing,
        .params = params,
        .sun = tanf(0.5f * params->sun_deg * 0.01745329252f),
        .chunk_count = (params->count + CHUNK - 1) / CHUNK,
    };
    *photons = (struct photons){
        .radius = RADIUS * g->radius / cbrtf((float)params->count),
        .sun = job.sun,
        .has_shadow = params->has_shadow,
    };
    job.chunks = calloc(job.chunk_count + 1, sizeof(*job.chunks));
    bool done = job.chunks != NULL;
    const bool goes_on = !done || parallel_for(job.chunk_count, params->threads, trace_chunk, &job,
                                               params->progress, params->user);
    if (done && goes_on)
        done = sort(photons, &job);
    for (uint32_t i = 0; job.chunks && i < job.chunk_count; i++)
        free(job.chunks[i].photons);
    free(job.chunks);
    if (done && goes_on)
        return STATUS_OK;
    photons_finish(photons);
    return goes_on ? log_out_of_memory("photons") : STATUS_FAILED;
}

void photons_finish(struct photons *photons)
{
    free(photons->all);
    free(photons->first);
    *photons = (struct photons){ 0 };
}

/* Density estimate: the search disc and the sums over the photons in it. */
struct disc {
    vec3s center, normal;
    vec3s light, direction_sum; /* flux; direction weighted by flux */
};

/* Adds the photons of a cell, weighted by an Epanechnikov kernel (0 at the search radius). */
static void gather_cell(const struct photons *photons, struct cell cell, struct disc *disc)
{
    const float radius2 = photons->radius * photons->radius;
    const uint32_t bucket = bucket_of(photons, cell);
    for (uint32_t i = photons->first[bucket]; i < photons->first[bucket + 1]; i++) {
        const struct photon *photon = &photons->all[i];
        const vec3s offset = glms_vec3_sub(photon->position, disc->center);
        const float distance2 = glms_vec3_norm2(offset);
        const struct cell photon_cell = cell_of(photons, photon->position);
        if (!(distance2 < radius2) || memcmp(&photon_cell, &cell, sizeof(cell)) != 0 ||
            fabsf(glms_vec3_dot(offset, disc->normal)) > PLANE_DISTANCE * photons->radius ||
            glms_vec3_dot(photon->dir, disc->normal) >= 0.0f)
            continue;
        const float weight = 2.0f * (1.0f - distance2 / radius2);
        disc->light = glms_vec3_muladds(photon->flux, weight, disc->light);
        disc->direction_sum = glms_vec3_muladds(photon->dir, -weight * glms_vec3_max(photon->flux),
                                                disc->direction_sum);
    }
}

/* Estimates the caustic irradiance at a point, relative to sunlight at normal incidence. */
static struct disc estimate(const struct photons *photons, vec3s point, vec3s normal)
{
    const float radius = photons->radius;
    const struct cell first = cell_of(photons, glms_vec3_subs(point, radius));
    struct disc disc = { .center = point, .normal = normal };
    for (int i = 0; i < 8 && photons->count; i++) {
        const struct cell cell = { { first.at[0] + (i & 1), first.at[1] + (i >> 1 & 1),
                                     first.at[2] + (i >> 2) } };
        gather_cell(photons, cell, &disc);
    }
    disc.light = glms_vec3_scale(disc.light, 1.0f / (3.14159265f * radius * radius));
    return disc;
}

/* Returns true if an object occludes the ray from a point to infinity. */
static bool is_occluded(const struct tracer *tracing, vec3s point, vec3s dir)
{
    struct embree_scene_hit hit;
    struct embree_scene_ray ray = { .origin = point,
                                    .dir = dir,
                                    .near = tracing->embree_scene->epsilon,
                                    .from = EMBREE_SCENE_NO_ORIGIN };
    for (uint32_t i = 0;
         i < CROSSINGS_MAX && embree_scene_intersect(tracing->embree_scene, &ray, &hit); i++) {
        if (hit.kind == EMBREE_SCENE_OBJECT)
            return true;
        ray.origin = hit.surface.position;
    }
    return false;
}

struct radiance_sun photons_sun_at(const struct tracer *tracing, vec3s point, vec3s normal,
                                   uint32_t seed)
{
    const struct photons *photons = tracing->photons;
    const vec3s sun_dir = tracing->radiance->globals->sun_dir;
    const vec2s at = microfacet_point(tracing->sample, microfacet_hash(seed, SUN_SEED));
    const struct disc disc = estimate(photons, point, normal);
    struct radiance_sun sun = {
        .sky = glms_vec3_one(), .direct = 1.0f, .refracted = disc.light, .refracted_dir = sun_dir
    };
    if (photons->has_shadow && is_occluded(tracing, point, to_sun(sun_dir, photons->sun, at)))
        sun.direct = 0.0f;
    if (glms_vec3_norm2(disc.direction_sum) > 0.0f)
        sun.refracted_dir = glms_vec3_normalize(disc.direction_sum);
    return sun;
}
