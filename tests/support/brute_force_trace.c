/* brute_force_trace.c: brute-force ray tracer: Moeller-Trumbore intersection (1997) with every
 * triangle. */
#include "tests/support/brute_force_trace.h"

struct crossing {
    double t; /* distance; HUGE_VAL if nothing is hit */
    struct vec normal;
};

static struct vec position(const struct mesh *mesh, uint32_t corner)
{
    return vec_from(mesh->vertices[mesh->indices[corner]].position);
}

static struct vec normal_at(const struct mesh *mesh, uint32_t first, double u, double v)
{
    const struct mesh_vertex *vertices = mesh->vertices;
    struct vec n = vec_scale(vec_from(vertices[mesh->indices[first]].normal), 1 - u - v);
    n = vec_add(n, u, vec_from(vertices[mesh->indices[first + 1]].normal));
    return vec_unit(vec_add(n, v, vec_from(vertices[mesh->indices[first + 2]].normal)));
}

/* Returns the nearest hit of a triangle through which the ray leaves (`side` 1) or enters (-1). */
static struct crossing intersect_mesh(const struct mesh *mesh, struct vec from, struct vec dir,
                                      double side)
{
    struct crossing nearest = { .t = HUGE_VAL };
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const struct vec a = position(mesh, i);
        const struct vec ab = vec_add(position(mesh, i + 1), -1, a);
        const struct vec ac = vec_add(position(mesh, i + 2), -1, a);
        const double facing = vec_dot(vec_cross(ab, ac), dir);
        if (!(facing * side > 0))
            continue;
        const struct vec p = vec_cross(dir, ac);
        const struct vec s = vec_add(from, -1, a);
        const struct vec q = vec_cross(s, ab);
        const double determinant = vec_dot(ab, p);
        const double u = vec_dot(s, p) / determinant;
        const double v = vec_dot(dir, q) / determinant;
        const double t = vec_dot(ac, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 1e-6 && t < nearest.t)
            nearest = (struct crossing){ t, normal_at(mesh, i, u, v) };
    }
    return nearest;
}

/* Refracts `dir` at the normal `n` facing it, or reflects it totally and returns true. */
static bool refract(struct vec *dir, struct vec n, double eta)
{
    const double c = vec_dot(n, *dir);
    const double k = 1 - eta * eta * (1 - c * c);
    if (k < 0)
        *dir = vec_unit(vec_add(*dir, -2 * c, n));
    else
        *dir = vec_unit(vec_add(vec_scale(*dir, eta), -(eta * c + sqrt(k)), n));
    return k < 0;
}

struct trace_path trace_transmitted(const struct mesh *mesh, struct vec eye, struct vec dir,
                                    double eta, int bounces)
{
    struct trace_path path = { .dir = dir };
    struct crossing c = intersect_mesh(mesh, eye, dir, -1);
    path.hit = c.t < HUGE_VAL;
    if (!path.hit)
        return (struct trace_path){ 0 };
    struct vec point = vec_add(eye, c.t, dir);
    refract(&path.dir, c.normal, eta);
    for (;;) {
        c = intersect_mesh(mesh, point, path.dir, 1);
        if (c.t == HUGE_VAL)
            return path;
        point = vec_add(point, c.t, path.dir);
        path.path += c.t;
        path.left = !refract(&path.dir, vec_scale(c.normal, -1), 1 / eta);
        if (path.left || path.bounces == bounces)
            return path;
        path.bounces++;
    }
}
