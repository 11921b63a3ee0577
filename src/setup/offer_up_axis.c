/* offer_up_axis.c: suggests --up z for a model that lies on its side. */
#include "src/setup/offer_up_axis.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/base/log.h"
#include "src/base/path.h"

/* Thickness of the slab above the lowest point that counts as the base, as a fraction of the
 * bounding box along the axis. */
#define BASE_THICKNESS 0.01f
/* Least area of a base, relative to the bounding box seen along the axis. */
#define BASE_AREA 0.1f
/* Ratio by which the base of one axis must exceed that of the other. */
#define BASE_RATIO 4.0f

/* Returns the area of the triangles at the low end of an axis, projected along the axis, relative
 * to the bounding box. */
static float base_area(const struct mesh *mesh, const struct box *box, int axis)
{
    const vec3s extent = glms_vec3_sub(box->max, box->min);
    const float level = box->min.raw[axis] + BASE_THICKNESS * extent.raw[axis];
    const float all = extent.raw[(axis + 1) % 3] * extent.raw[(axis + 2) % 3];
    double sum = 0.0;
    for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
        vec3s p[3];
        bool is_low = true;
        for (uint32_t k = 0; k < 3; k++) {
            p[k] = mesh->vertices[mesh->indices[i + k]].position;
            is_low = is_low && p[k].raw[axis] <= level;
        }
        const vec3s n = glms_vec3_cross(glms_vec3_sub(p[1], p[0]), glms_vec3_sub(p[2], p[0]));
        if (is_low)
            sum += 0.5 * (double)fabsf(n.raw[axis]);
    }
    return all > 0.0f ? (float)sum / all : 0.0f;
}

/* Returns true if a mesh has a flat base towards -Z and none towards -Y, and is not a plaque that
 * is thin along Z. */
static bool stands_on_z(const struct mesh *mesh)
{
    const struct box box = mesh_box(mesh);
    const vec3s extent = glms_vec3_sub(box.max, box.min);
    const float base = base_area(mesh, &box, 2);
    return extent.z >= 0.5f * glms_vec3_max(extent) && base >= BASE_AREA &&
           base >= BASE_RATIO * base_area(mesh, &box, 1);
}

void offer_up_axis(const char *path, const struct mesh *mesh)
{
    static const char *const suffixes[] = { ".obj", ".ply", ".stl" };
    bool has_axis = true;
    for (size_t i = 0; i < sizeof(suffixes) / sizeof(suffixes[0]); i++)
        has_axis = has_axis && !path_ends_in(path, suffixes[i]);
    if (!has_axis && stands_on_z(mesh))
        log_note("%s: its flat base faces -Z, so it seems to lie on its side; if its up axis is Z, "
                 "use --up z",
                 path);
}
