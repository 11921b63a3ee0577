/* contact_hits.c: enumerates the hits at a contact by further queries along the same ray. */
#include "src/lab/reference/contact_hits.h"
#include <cglm/struct.h>
#include <math.h>

enum {
    HITS_MAX = 8 /* maximum number of hits at a contact */
};

#define ROUNDING 5e-7f /* relative rounding error of distances */

static bool is_entering(const struct embree_scene_hit *hit, vec3s dir)
{
    return dielectric_split_dot(hit->facet, dir) < 0.0;
}

/* Returns the media on both sides of an object's surface. If the object is a thin wall, both are
 * the surrounding medium, because a thin wall has no interior. */
static void cross_one(const struct tracer *tracing, vec3s dir,
                      const struct nested_media_set *inside, struct surface_hit *surface_hit)
{
    const struct embree_scene_hit *hit = &surface_hit->hit;
    const bool enters = is_entering(hit, dir);
    struct nested_media_crossing *crossing = &surface_hit->crossing;
    *crossing = nested_media_cross(tracing->media, inside, hit->object, enters);
    surface_hit->changes.entered.count = 0;
    surface_hit->changes.left.count = 0;
    if (tracer_medium(tracing, hit->object)->is_thin) {
        crossing->before = nested_media_top(tracing->media, inside, hit->object);
        crossing->after = crossing->before;
    } else {
        nested_media_set_update(enters ? &surface_hit->changes.entered : &surface_hit->changes.left,
                                hit->object, true);
    }
}

/* Finds all hits at the contact of a ray's closest hit, that one first. Returns their number. */
static uint32_t find_all(const struct tracer *tracing, struct embree_scene_ray ray,
                         const struct nested_media_set *inside,
                         const struct embree_scene_hit *first,
                         struct embree_scene_hit hits[static HITS_MAX])
{
    const float cosine = fabsf((float)dielectric_split_dot(first->facet, ray.dir));
    const float reach = (tracing->radiance->scene->contacts.epsilon + ROUNDING * first->distance) /
                        fmaxf(cosine, COINCIDENT_COSINE_MIN);
    struct embree_scene_search search = { .count = 0 };
    uint32_t count = 1;
    hits[0] = *first;
    embree_scene_search_add(&search, first->triangle);
    ray.near = fmaxf(first->distance - reach, ray.near);
    ray.far = first->distance + reach;
    ray.search = &search;
    ray.inside = inside;
    while (count < HITS_MAX && search.count < EMBREE_SCENE_FOUND_MAX &&
           embree_scene_intersect(tracing->embree_scene, &ray, &hits[count]) &&
           hits[count].kind == EMBREE_SCENE_OBJECT) {
        embree_scene_search_add(&search, hits[count].triangle);
        count += embree_scene_is_at_contact(tracing->embree_scene, &hits[count]);
    }
    return count;
}

/* Returns the hit of highest priority on an object that the changes contain, or NULL. */
static const struct embree_scene_hit *find_decisive(const struct tracer *tracing,
                                                    const struct nested_media_changes *changes,
                                                    const struct embree_scene_hit *hits,
                                                    uint32_t count)
{
    const struct embree_scene_hit *decisive = NULL;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t object = hits[i].object;
        if ((nested_media_set_has(&changes->entered, object) ||
             nested_media_set_has(&changes->left, object)) &&
            (!decisive ||
             tracer_medium(tracing, object)->rank > tracer_medium(tracing, decisive->object)->rank))
            decisive = &hits[i];
    }
    return decisive;
}

/* Returns a hit of a ray that enters and leaves the same objects: one where it leaves an object, so
 * that the continued ray ignores that face. Its facet faces the ray, because the ray stays inside
 * the object. */
static struct embree_scene_hit find_passed(const struct embree_scene_hit *hits, uint32_t count,
                                           vec3s dir)
{
    for (uint32_t i = 0; i < count; i++) {
        struct embree_scene_hit hit = hits[i];
        if (is_entering(&hit, dir))
            continue;
        hit.facet = glms_vec3_negate(hit.facet);
        return hit;
    }
    return hits[0];
}

void contact_hits_cross(const struct tracer *tracing, const struct embree_scene_ray *ray,
                        const struct nested_media_set *inside, struct surface_hit *surface_hit)
{
    struct embree_scene_hit hits[HITS_MAX];
    struct nested_media_changes *changes = &surface_hit->changes;
    uint32_t media_count = 0;
    cross_one(tracing, ray->dir, inside, surface_hit);
    if (!embree_scene_is_at_contact(tracing->embree_scene, &surface_hit->hit))
        return;
    const uint32_t count = find_all(tracing, *ray, inside, &surface_hit->hit, hits);
    for (uint32_t i = 0; i < count; i++) {
        if (tracer_medium(tracing, hits[i].object)->is_thin)
            continue;
        media_count++;
        nested_media_set_update(is_entering(&hits[i], ray->dir) ? &changes->entered
                                                                : &changes->left,
                                hits[i].object, true);
    }
    if (!media_count)
        return;
    nested_media_changes_cancel(changes);
    const struct embree_scene_hit *decisive = find_decisive(tracing, changes, hits, count);
    struct nested_media_set before = *inside, after = *inside;
    nested_media_set_apply(&before, changes, false);
    nested_media_set_apply(&after, changes, true);
    surface_hit->hit = decisive ? *decisive : find_passed(hits, count, ray->dir);
    surface_hit->crossing = (struct nested_media_crossing){
        .before = nested_media_top(tracing->media, &before, NESTED_MEDIA_NONE),
        .after = nested_media_top(tracing->media, &after, NESTED_MEDIA_NONE),
        .is_entering = is_entering(&surface_hit->hit, ray->dir),
    };
}
