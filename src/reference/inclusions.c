/* inclusions.c: normals of cracks. */
#include "src/reference/inclusions.h"
#include "shaders/cracks_noise.h"
#include "src/tech/cracks.h"

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings)
{
    const struct cracks_params *cracks_params = settings_of(settings, &cracks_settings);
    return (struct inclusions){
        .radiance = radiance,
        .world_from_object = glms_mat4_pick3(radiance->globals->world_from_object),
        .crack_slope = cracks_params->look.bump,
    };
}

/* Turns a direction of the world into the object's space. */
static vec3s to_object(const struct inclusions *inclusions, vec3s dir)
{
    return glms_mat3_mulv(glms_mat3_transpose(inclusions->world_from_object), dir);
}

/* ---- cracks ---- */

vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface)
{
    const struct globals *g = inclusions->radiance->globals;
    if (!(inclusions->crack_slope > 0.0f))
        return surface->normal;
    const vec3s moved = glms_vec3(g->world_from_object.col[3]);
    const vec3s at = to_object(inclusions, glms_vec3_sub(surface->position, moved));
    const vec3s bent = crack_bent(to_object(inclusions, surface->normal),
                                  glms_vec3_divs(at, g->radius), inclusions->crack_slope);
    return glms_mat3_mulv(inclusions->world_from_object, bent);
}
