/*
 * brute_force_trace.h: brute-force ray tracer: exact refracted paths through a mesh.
 *
 * Normals are interpolated between vertices, as by the rasteriser.
 */
#ifndef TESTS_SUPPORT_BRUTE_FORCE_TRACE_H
#define TESTS_SUPPORT_BRUTE_FORCE_TRACE_H

#include "src/scene/geometry/mesh.h"
#include "tests/support/vec.h"

struct trace_path {
    bool hit;       /* the ray hits the mesh; all other members are 0 if not */
    bool left;      /* the path leaves the mesh within the bounces allowed */
    struct vec dir; /* direction in which it leaves, unit */
    double path;    /* path length inside */
    int bounces;    /* total internal reflections */
};

/* Traces a ray that starts outside. `eta` is the refractive index outside over that inside. */
struct trace_path trace_transmitted(const struct mesh *mesh, struct vec eye, struct vec dir,
                                    double eta, int bounces);

#endif
