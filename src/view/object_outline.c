/* object_outline.c: silhouette of an object in the image: a mask of its projected triangles, and
 * the mask's contour by marching squares. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/view/scene_objects.h"

enum {
    MASK_SIDE = 400, /* cells along the longer side of the mask */
};

static const float contour = 2.5f; /* isovalue: set cells among a cell and its 8 neighbours */

struct mask {
    uint8_t *cells;
    int width, height;
    mat4s clip_from_mesh;
};

static float edge(vec2s a, vec2s b, float x, float y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/* Sets the cells whose centres a projected triangle of either winding covers. */
static void fill_triangle(struct mask *mask, const vec2s p[static 3])
{
    const float area = edge(p[0], p[1], p[2].x, p[2].y);
    const float left = fminf(fminf(p[0].x, p[1].x), p[2].x);
    const float right = fmaxf(fmaxf(p[0].x, p[1].x), p[2].x);
    const float top = fminf(fminf(p[0].y, p[1].y), p[2].y);
    const float bottom = fmaxf(fmaxf(p[0].y, p[1].y), p[2].y);
    if (!(right > 0.0f && left < (float)mask->width && bottom > 0.0f && top < (float)mask->height))
        return;
    const int x1 = (int)fminf(right, (float)mask->width - 1.0f);
    const int y1 = (int)fminf(bottom, (float)mask->height - 1.0f);
    for (int y = (int)fmaxf(top, 0.0f); y <= y1; y++) {
        for (int x = (int)fmaxf(left, 0.0f); x <= x1; x++) {
            const float fx = (float)x + 0.5f;
            const float fy = (float)y + 0.5f;
            const float a = edge(p[0], p[1], fx, fy) * area;
            const float b = edge(p[1], p[2], fx, fy) * area;
            const float c = edge(p[2], p[0], fx, fy) * area;
            if (a >= 0.0f && b >= 0.0f && c >= 0.0f)
                mask->cells[y * mask->width + x] = 1;
        }
    }
}

/* Projects a triangle. Triangles that reach behind the camera are left out. */
static void add_triangle(struct mask *mask, const struct mesh *mesh, uint32_t index)
{
    vec2s p[3];
    for (uint32_t k = 0; k < 3; k++) {
        const vec3s v = mesh->vertices[mesh->indices[index + k]].position;
        const vec4s clip = glms_mat4_mulv(mask->clip_from_mesh, (vec4s){ { v.x, v.y, v.z, 1.0f } });
        if (!(clip.w > 0.0f))
            return;
        p[k] = (vec2s){ { (clip.x / clip.w * 0.5f + 0.5f) * (float)mask->width,
                          (clip.y / clip.w * 0.5f + 0.5f) * (float)mask->height } };
    }
    fill_triangle(mask, p);
}

static void add_object(struct mask *mask, const struct viewport *p, float time, uint32_t object)
{
    const struct model *model = &p->scene.model;
    const struct mesh *opaque = &model->surroundings;
    if (object < model->object_count) {
        const struct object *one = &model->objects[object];
        mask->clip_from_mesh = glms_mat4_mul(mask->clip_from_mesh, scene_objects_matrix(p, time));
        for (uint32_t i = 0; i + 2 < one->index_count; i += 3)
            add_triangle(mask, &model->object, one->first_index + i);
        return;
    }
    for (uint32_t i = 0; i + 2 < opaque->index_count; i += 3) {
        if (model_surroundings_find_object(model, opaque->indices[i]) ==
            object - model->object_count)
            add_triangle(mask, opaque, i);
    }
}

/* ---- contour ---- */

/* Returns the number of set cells around a cell, with itself: smooths the contour. */
static float cover(const struct mask *mask, int x, int y)
{
    uint32_t sum = 0;
    for (int dy = y - 1; dy <= y + 1; dy++) {
        for (int dx = x - 1; dx <= x + 1; dx++) {
            if (dx >= 0 && dy >= 0 && dx < mask->width && dy < mask->height)
                sum += mask->cells[dy * mask->width + dx];
        }
    }
    return (float)sum;
}

static void add_line(struct object_outline *outline, const struct mask *mask, vec2s from, vec2s to)
{
    const float width = (float)mask->width;
    const float height = (float)mask->height;
    if (outline->count == OBJECT_OUTLINE_MAX)
        return;
    outline->lines[outline->count++] =
        (vec4s){ { from.x / width, from.y / height, to.x / width, to.y / height } };
}

/* Adds the segments between the centres of four neighbouring cells, from (x, y) on. */
static void add_square(struct object_outline *outline, const struct mask *mask, int x, int y)
{
    static const int corners[5][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };

    float covers[5];
    vec2s points[4];
    uint32_t count = 0;
    for (int i = 0; i < 4; i++)
        covers[i] = cover(mask, x + corners[i][0], y + corners[i][1]);
    covers[4] = covers[0];
    for (int i = 0; i < 4; i++) {
        if ((covers[i] > contour) == (covers[i + 1] > contour))
            continue;
        const float t = (contour - covers[i]) / (covers[i + 1] - covers[i]);
        const int *a = corners[i];
        const int *b = corners[i + 1];
        points[count++] = (vec2s){ { (float)(x + a[0]) + 0.5f + t * (float)(b[0] - a[0]),
                                     (float)(y + a[1]) + 0.5f + t * (float)(b[1] - a[1]) } };
    }
    for (uint32_t i = 0; i + 1 < count; i += 2)
        add_line(outline, mask, points[i], points[i + 1]);
}

static bool is_current(const struct object_outline *outline, const struct viewport *p, float time,
                       uint32_t object)
{
    return outline->object == object && outline->version == p->version &&
           camera_is_equal(&outline->camera, &p->camera) &&
           !(outline->time < time || outline->time > time);
}

void object_outline_update(struct object_outline *outline, const struct viewport *p, float time,
                           uint32_t object)
{
    const float longer =
        (float)(p->state.width > p->state.height ? p->state.width : p->state.height);
    struct mask mask = {
        .width = (int)fmaxf((float)p->state.width * MASK_SIDE / longer, 1.0f),
        .height = (int)fmaxf((float)p->state.height * MASK_SIDE / longer, 1.0f),
        .clip_from_mesh =
            camera_clip_from_world(&p->camera, p->state.width, p->state.height,
                                   scene_near_plane(&p->scene), (vec2s){ { 0.0f, 0.0f } }),
    };
    if (is_current(outline, p, time, object))
        return;
    outline->count = 0;
    outline->object = object;
    outline->version = p->version;
    outline->camera = p->camera;
    outline->time = time;
    if (object == SCENE_OBJECT_NONE)
        return;
    mask.cells = calloc((size_t)mask.width, (size_t)mask.height);
    if (!mask.cells)
        return;
    add_object(&mask, p, time, object);
    for (int y = -2; y <= mask.height; y++) {
        for (int x = -2; x <= mask.width; x++)
            add_square(outline, &mask, x, y);
    }
    free(mask.cells);
}
