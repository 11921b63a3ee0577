/* room.c: generates a closed room with a table, whose straight lines show the refraction of ice.
 * All geometry is axis-aligned boxes. Lighting is baked into vertex colours: a lamp, a window,
 * shadows of furniture, and constant ambient light. */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/generate.h"

static const struct box walls = {
    .min = { { -4.5F, -2.7F, -3.6F } },
    .max = { { 7.2F, 3.6F, 6.3F } },
};
static const float tile = 0.9F;
static const float line = 0.03F; /* half width of the grout lines, metres */

enum {
    BREAKS_MAX = 64,
    FURNITURE_MAX = 9,
    TABLE_PARTS = 5,
    LIGHT_SAMPLES = 3, /* samples along each side of an area light */
};

/* Area light that covers whole tiles of one side of the room. */
struct light {
    int axis;
    bool high; /* true for the room's side with the greater coordinate along `axis` */
    struct box box;
    vec3s radiance;
};

static const struct light lights[] = {
    {
        .axis = 1, /* ceiling lamp */
        .high = true,
        .box = { { { 0.9F, 3.6F, 0.0F } }, { { 2.7F, 3.6F, 1.8F } } },
        .radiance = { { 15.0F, 13.5F, 11.5F } },
    },
    {
        .axis = 2, /* window behind the ice */
        .high = false,
        .box = { { { -0.9F, 0.0F, -3.6F } }, { { 1.8F, 2.7F, -3.6F } } },
        .radiance = { { 2.4F, 3.2F, 4.4F } },
    },
};

struct room {
    struct box furniture[FURNITURE_MAX];
    struct mesh *mesh;
};

/* One of the six sides of a box, seen from inside or outside. */
struct side {
    struct box box;
    int axis;
    bool high;
    bool inside;  /* true for a side of the room, false for furniture */
    vec3s albedo; /* albedo of furniture */
};

/* Ascending coordinates of cell boundaries along one axis of a box's side. */
struct breaks {
    float at[BREAKS_MAX];
    uint32_t count;
};

static const vec3s wall_colors[3][2] = {
    { { { 0.75F, 0.08F, 0.06F } }, { { 0.05F, 0.45F, 0.50F } } }, /* wall colours: left, right */
    { { { 0.10F, 0.10F, 0.12F } }, { { 0.45F, 0.35F, 0.10F } } }, /* floor and ceiling */
    { { { 0.06F, 0.20F, 0.70F } }, { { 0.10F, 0.50F, 0.12F } } }, /* back wall, front wall */
};

static const vec3s furniture_colors[] = {
    { { 0.42F, 0.24F, 0.11F } }, /* albedo of the table */
    { { 0.80F, 0.28F, 0.05F } }, { { 0.55F, 0.50F, 0.45F } },
    { { 0.75F, 0.60F, 0.10F } }, { { 0.12F, 0.38F, 0.22F } },
};

/* Returns the cell boundaries of a side of the room along an axis. Grout lines are separate cells.
 */
static struct breaks room_breaks(int axis)
{
    struct breaks b = { { walls.min.raw[axis] }, 1 };
    uint32_t tiles = (uint32_t)lroundf((walls.max.raw[axis] - walls.min.raw[axis]) / tile);
    for (uint32_t i = 0; i < tiles; i++) {
        float start = walls.min.raw[axis] + tile * (float)i;
        b.at[b.count++] = start + line;
        b.at[b.count++] = start + 0.5F * tile;
        b.at[b.count++] = start + tile - line;
    }
    b.at[b.count++] = walls.max.raw[axis];
    return b;
}

/* Returns the cell boundaries of a piece of furniture, at most 0.25 m apart. */
static struct breaks furniture_breaks(struct box box, int axis)
{
    struct breaks b = { { 0 }, 0 };
    float low = box.min.raw[axis];
    float extent = box.max.raw[axis] - low;
    uint32_t cells = (uint32_t)ceilf(extent / 0.25F);
    if (cells > BREAKS_MAX - 1)
        cells = BREAKS_MAX - 1;
    for (uint32_t i = 0; i <= cells; i++)
        b.at[b.count++] = low + extent * (float)i / (float)cells;
    return b;
}

/* Returns true if furniture occludes the segment between two points. */
static bool is_hidden(const struct room *room, vec3s from, vec3s to)
{
    vec3s offset = glms_vec3_sub(to, from);
    for (size_t i = 0; i < FURNITURE_MAX; i++) {
        float first = 1e-3F;
        float last = 1.0F - 1e-3F;
        for (int axis = 0; axis < 3; axis++) {
            float low = room->furniture[i].min.raw[axis] + 1e-4F - from.raw[axis];
            float high = room->furniture[i].max.raw[axis] - 1e-4F - from.raw[axis];
            float speed = fabsf(offset.raw[axis]) > 1e-9F ? offset.raw[axis] : 1e-9F;
            first = fmaxf(first, fminf(low / speed, high / speed));
            last = fminf(last, fmaxf(low / speed, high / speed));
        }
        if (first < last)
            return true;
    }
    return false;
}

/* Returns the radiance of a white diffuse surface lit by an area light, by sampling a few points.
 */
static vec3s light_from(const struct room *room, const struct light *light, vec3s point,
                        vec3s normal)
{
    int u = (light->axis + 1) % 3;
    int v = (light->axis + 2) % 3;
    vec3s extent = glms_vec3_sub(light->box.max, light->box.min);
    float form_factor = 0.0F;
    for (int i = 0; i < LIGHT_SAMPLES * LIGHT_SAMPLES; i++) {
        int column = i % LIGHT_SAMPLES;
        int row = i / LIGHT_SAMPLES;
        vec3s at = light->box.min;
        at.raw[u] += extent.raw[u] * ((float)column + 0.5F) / LIGHT_SAMPLES;
        at.raw[v] += extent.raw[v] * ((float)row + 0.5F) / LIGHT_SAMPLES;
        vec3s offset = glms_vec3_sub(at, point);
        float distance2 = fmaxf(glms_vec3_norm2(offset), 0.05F);
        float cosines = glms_vec3_dot(offset, normal) * fabsf(offset.raw[light->axis]) / distance2;
        if (cosines > 0.0F && !is_hidden(room, point, at))
            form_factor += cosines / distance2;
    }
    float area = extent.raw[u] * extent.raw[v] / (LIGHT_SAMPLES * LIGHT_SAMPLES);
    return glms_vec3_scale(light->radiance, form_factor * area / 3.14159265F);
}

static vec3s light_at(const struct room *room, vec3s point, vec3s normal)
{
    vec3s sum = { { 0.27F, 0.27F, 0.28F } };
    for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++)
        sum = glms_vec3_add(sum, light_from(room, &lights[i], point, normal));
    return sum;
}

static const struct light *find_light(const struct side *side, vec3s middle)
{
    for (size_t i = 0; side->inside && i < sizeof(lights) / sizeof(lights[0]); i++) {
        const struct light *l = &lights[i];
        bool on_it = l->axis == side->axis && l->high == side->high;
        for (int axis = 0; axis < 3 && on_it; axis++)
            on_it = axis == side->axis || (middle.raw[axis] > l->box.min.raw[axis] &&
                                           middle.raw[axis] < l->box.max.raw[axis]);
        if (on_it)
            return l;
    }
    return NULL;
}

static bool is_line(const struct side *side, vec3s middle)
{
    for (int axis = 0; side->inside && axis < 3; axis++) {
        float at = (middle.raw[axis] - walls.min.raw[axis]) / tile;
        if (axis != side->axis && fabsf(at - roundf(at)) * tile < line)
            return true;
    }
    return false;
}

static vec3s albedo_of(const struct side *side, vec3s middle)
{
    if (!side->inside)
        return side->albedo;
    if (is_line(side, middle))
        return wall_colors[side->axis][side->high];
    return (vec3s){ { 0.72F, 0.70F, 0.66F } };
}

/* Writes a cell's four vertices and two triangles, wound so that the visible side is the front. */
static void set_cell(const struct room *room, const struct side *side, uint32_t cell, vec3s low,
                     vec3s high)
{
    static const uint32_t corners[2][6] = { { 0, 2, 1, 1, 2, 3 }, { 0, 1, 2, 2, 1, 3 } };
    int u = (side->axis + 1) % 3;
    int v = (side->axis + 2) % 3;
    vec3s middle = glms_vec3_lerp(low, high, 0.5F);
    vec3s normal = { 0 };
    bool rising = side->high != side->inside;
    normal.raw[side->axis] = rising ? 1.0F : -1.0F;
    const struct light *light = find_light(side, middle);
    bool is_emitter = light && !is_line(side, middle);
    for (uint32_t i = 0; i < 4; i++) {
        struct mesh_vertex *vertex = &room->mesh->vertices[cell * 4 + i];
        vertex->position = low;
        vertex->position.raw[u] = i & 1 ? high.raw[u] : low.raw[u];
        vertex->position.raw[v] = i & 2 ? high.raw[v] : low.raw[v];
        vertex->normal = normal;
        vertex->material = MESH_UNLIT;
        vertex->color = is_emitter ? light->radiance
                                   : glms_vec3_mul(albedo_of(side, middle),
                                                   light_at(room, vertex->position, normal));
    }
    for (uint32_t i = 0; i < 6; i++)
        room->mesh->indices[cell * 6 + i] = cell * 4 + corners[rising][i];
}

static bool add_side(const struct room *room, const struct side *side)
{
    int u = (side->axis + 1) % 3;
    int v = (side->axis + 2) % 3;
    const struct breaks us = side->inside ? room_breaks(u) : furniture_breaks(side->box, u);
    const struct breaks vs = side->inside ? room_breaks(v) : furniture_breaks(side->box, v);
    uint32_t cells = (us.count - 1) * (vs.count - 1);
    struct mesh mesh = { 0 };
    struct room part = *room;
    part.mesh = &mesh;
    if (!mesh_init(&mesh, cells * 4, cells * 6))
        return false;
    for (uint32_t cell = 0; cell < cells; cell++) {
        uint32_t i = cell % (us.count - 1);
        uint32_t j = cell / (us.count - 1);
        vec3s low;
        vec3s high;
        low.raw[side->axis] = high.raw[side->axis] =
            side->high ? side->box.max.raw[side->axis] : side->box.min.raw[side->axis];
        low.raw[u] = us.at[i];
        low.raw[v] = vs.at[j];
        high.raw[u] = us.at[i + 1];
        high.raw[v] = vs.at[j + 1];
        set_cell(&part, side, cell, low, high);
    }
    bool done = mesh_append(room->mesh, &mesh);
    mesh_finish(&mesh);
    return done;
}

static bool add_box(const struct room *room, struct side side)
{
    bool done = true;
    for (int i = 0; i < 6 && done; i++) {
        side.axis = i / 2;
        side.high = i % 2;
        done = add_side(room, &side);
    }
    return done;
}

static struct box box_between(float x0, float y0, float z0, float x1, float y1, float z1)
{
    return (struct box){ { { x0, y0, z0 } }, { { x1, y1, z1 } } };
}

/* Fills the list of furniture boxes; the parts of the table come first. */
static void furnish(struct room *room, float table)
{
    const struct box top = box_between(-1.7F, table - 0.14F, -1.7F, 2.6F, table, 1.5F);
    const float leg = 0.16F;
    float floor = walls.min.y;
    struct box *f = room->furniture;
    f[0] = top;
    for (int i = 0; i < 4; i++) {
        float x = i & 1 ? top.max.x - leg : top.min.x;
        float z = i & 2 ? top.max.z - leg : top.min.z;
        f[1 + i] = box_between(x, floor, z, x + leg, top.min.y, z + leg);
    }
    f[5] = box_between(1.5F, table, -1.1F, 2.1F, table + 0.6F, -0.5F); /* box beside the ice */
    f[6] = box_between(-4.5F, floor, -3.6F, -2.7F, 1.8F, -2.3F);       /* cabinet */
    f[7] = box_between(4.0F, floor, -2.9F, 5.8F, floor + 1.3F, -1.1F); /* crates */
    f[8] = box_between(-3.9F, floor, 1.4F, -2.6F, floor + 2.0F, 2.7F);
}

bool generate_room(struct mesh *mesh, struct box object)
{
    struct room room = { .mesh = mesh };
    *mesh = (struct mesh){ 0 };
    furnish(&room, object.min.y);
    bool done = add_box(&room, (struct side){ .box = walls, .inside = true });
    for (size_t i = 0; i < FURNITURE_MAX && done; i++) {
        size_t color = i < TABLE_PARTS ? 0 : i - TABLE_PARTS + 1;
        done = add_box(
            &room, (struct side){ .box = room.furniture[i], .albedo = furniture_colors[color] });
    }
    if (!done)
        mesh_finish(mesh);
    return done;
}
