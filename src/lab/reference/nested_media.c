/* nested_media.c: resolves nested dielectrics by medium priority. */
#include "src/lab/reference/nested_media.h"
#include <stdlib.h>

bool nested_media_init(struct nested_media *media, const struct scene *scene,
                       const struct settings *settings)
{
    const uint32_t count = frame_media_count(scene);
    *media = (struct nested_media){ .outside = count - 1, .bubble = count };
    media->all = count < UINT16_MAX ? calloc((size_t)count + 1, sizeof(*media->all)) : NULL;
    if (!media->all)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        media->all[i] = frame_medium_at(scene, settings, i);
        media->is_dispersive |= media->all[i].ior[0] != media->all[i].ior[2];
    }
    media->all[media->bubble] = media->all[media->outside];
    for (int c = 0; c < 3; c++)
        media->all[media->bubble].ior[c] = frame_media_air(scene);
    media->all[media->bubble].rank = UINT32_MAX;
    return true;
}

void nested_media_finish(struct nested_media *media)
{
    free(media->all);
    *media = (struct nested_media){ 0 };
}

uint32_t nested_media_top(const struct nested_media *media, const struct nested_media_set *set,
                          uint32_t except)
{
    uint32_t top = media->outside;
    for (uint32_t i = 0; i < set->count; i++) {
        const uint32_t object = set->objects[i];
        if (object != except && media->all[object].rank > media->all[top].rank)
            top = object;
    }
    return top;
}

bool nested_media_are_equal(const struct nested_media *media, uint32_t a, uint32_t b)
{
    const bool are_air =
        (a == media->outside && b == media->bubble) || (a == media->bubble && b == media->outside);
    const bool are_objects = a < media->outside && b < media->outside;
    return a == b || (are_air && media->all[a].ior[0] == media->all[b].ior[0]) ||
           (are_objects && frame_media_are_equal(&media->all[a], &media->all[b]));
}

/* Returns the object's index in the set, or the set's size if it is not a member. */
static uint32_t find(const struct nested_media_set *set, uint32_t object)
{
    uint32_t i = 0;
    while (i < set->count && set->objects[i] != object)
        i++;
    return i;
}

bool nested_media_set_has(const struct nested_media_set *set, uint32_t object)
{
    return find(set, object) < set->count;
}

void nested_media_set_update(struct nested_media_set *set, uint32_t object, bool is_inside)
{
    const uint32_t i = find(set, object);
    if (is_inside && i == set->count && i < NESTED_MEDIA_MAX)
        set->objects[set->count++] = (uint16_t)object;
    else if (!is_inside && i < set->count)
        set->objects[i] = set->objects[--set->count];
}

void nested_media_changes_cancel(struct nested_media_changes *changes)
{
    for (uint32_t i = changes->entered.count; i-- > 0;) {
        const uint32_t object = changes->entered.objects[i];
        if (!nested_media_set_has(&changes->left, object))
            continue;
        nested_media_set_update(&changes->entered, object, false);
        nested_media_set_update(&changes->left, object, false);
    }
}

void nested_media_set_apply(struct nested_media_set *set,
                            const struct nested_media_changes *changes, bool is_behind)
{
    const struct nested_media_set *added = is_behind ? &changes->entered : &changes->left;
    const struct nested_media_set *removed = is_behind ? &changes->left : &changes->entered;
    for (uint32_t i = 0; i < removed->count; i++)
        nested_media_set_update(set, removed->objects[i], false);
    for (uint32_t i = 0; i < added->count; i++)
        nested_media_set_update(set, added->objects[i], true);
}

struct nested_media_crossing nested_media_cross(const struct nested_media *media,
                                                const struct nested_media_set *set, uint32_t object,
                                                bool is_entering)
{
    const uint32_t without = nested_media_top(media, set, object);
    const bool is_top = media->all[object].rank > media->all[without].rank;
    const uint32_t with = is_top ? object : without;
    return is_entering ? (struct nested_media_crossing){ without, with, true }
                       : (struct nested_media_crossing){ with, without, false };
}
