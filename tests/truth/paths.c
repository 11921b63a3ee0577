/*
 * paths.c: a path tracer of its own, to compare firn's reference with: it shares no code with firn.
 *
 * Usage: paths SCENE PICTURE   SCENE: made by beside.py, which says what is in it.
 * Writes 7 floats a pixel, rows from the top: the means of the even samples (R G B), those of the
 * odd ones, and 1 where the middle of the pixel sees a clear surface first.
 *
 * Every number is a double, and no hit is moved along its ray: the triangle that light has just met
 * is left out instead. A ray counts how often it has entered each object: overlapping parts of one
 * object are one body. Of the objects that it is inside, that of the greatest priority is there.
 * Surfaces of several objects that coincide are one: all of them are crossed before the media on
 * both sides are compared; the object of the greatest priority that begins or ends has the normal.
 * Where an interpolated normal would send light to the wrong side of its triangle, that of the
 * triangle is used.
 */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_OBJECTS = 32,
    LEAF_TRIANGLES = 4,
    BINS = 16,
    MAX_SURFACES = 2000, /* that light may meet; the rest is lost */
    MAX_TOUCHING = 8,    /* surfaces that coincide */
};

static const double split_weight = 0.05; /* above it, light goes both ways at a surface */
static const double weak = 0.01;         /* weight below which a path ends by chance */
static const double touching = 1e-4;     /* distance of surfaces, in radii of the least object */

struct vec {
    double x, y, z;
};

struct picture { /* linear; rows from the top */
    int32_t width, height;
    struct vec *texels;
};

struct object {
    int32_t is_clear, priority;
    double index;         /* of refraction */
    struct vec absorbed;  /* of each colour, 1/metre */
    struct picture image; /* times the vertices' colours: the light that it sends */
};

struct corner {
    struct vec at, normal, color;
    double u, v;
};

struct triangle {
    struct corner corners[3];
    struct vec middle;
    int32_t object;
};

struct node { /* of a tree of boxes: of triangles, if there are some, else of two nodes */
    struct vec low, high;
    int32_t first, count;
};

struct scene {
    struct {
        int32_t width, height, samples, at_middle, is_flat, seed, objects, triangles;
    } counts;
    struct vec eye, right, up, back;
    double tangent; /* of half of the vertical field of view */
    struct object objects[MAX_OBJECTS];
    struct triangle *triangles;
    struct picture around; /* equirectangular, -Z in its middle */
    struct node *nodes;
    int32_t node_count;
    double reach; /* distance within which surfaces coincide */
};

struct hit {
    double t, u, v;
    int32_t triangle; /* -1: none */
};

struct path {
    struct vec at, way, weight;
    int32_t left[2 * MAX_TOUCHING]; /* the triangles that it has just met, or -1 */
    int32_t surfaces;
    int16_t inside[MAX_OBJECTS];
};

static struct vec plus(struct vec a, struct vec b, double s)
{
    return (struct vec){ a.x + b.x * s, a.y + b.y * s, a.z + b.z * s };
}

static struct vec times(struct vec a, struct vec b)
{
    return (struct vec){ a.x * b.x, a.y * b.y, a.z * b.z };
}

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static struct vec scaled(struct vec a, double s)
{
    return (struct vec){ a.x * s, a.y * s, a.z * s };
}

static struct vec unit(struct vec a)
{
    return scaled(a, 1 / sqrt(dot(a, a)));
}

static double axis_of(struct vec a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

static double largest(struct vec a)
{
    return fmax(a.x, fmax(a.y, a.z));
}

static double chance(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    uint64_t x = *state;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93u;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93u;
    return (double)((x ^ x >> 32) >> 11) * 0x1p-53;
}

/* ---- reading ---- */

static void read_all(void *to, size_t size, FILE *file)
{
    if (fread(to, 1, size, file) != size) {
        fputs("paths: the scene ends too early\n", stderr);
        exit(1);
    }
}

static void *room_for(size_t count, size_t size)
{
    void *room = calloc(count, size);
    if (!room) {
        fputs("paths: out of memory\n", stderr);
        exit(1);
    }
    return room;
}

static struct picture read_picture(FILE *file)
{
    struct picture picture = { 0 };
    read_all(&picture.width, sizeof(picture.width), file);
    read_all(&picture.height, sizeof(picture.height), file);
    const size_t count = (size_t)picture.width * (size_t)picture.height;
    picture.texels = room_for(count, sizeof(*picture.texels));
    read_all(picture.texels, count * sizeof(*picture.texels), file);
    return picture;
}

static void read_scene(struct scene *scene, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(1);
    }
    read_all(&scene->counts, sizeof(scene->counts), file);
    struct vec view[4];
    read_all(view, sizeof(view), file);
    scene->right = view[0], scene->up = view[1], scene->back = view[2], scene->eye = view[3];
    read_all(&scene->tangent, sizeof(scene->tangent), file);
    scene->around = read_picture(file);
    for (int i = 0; i < scene->counts.objects; i++) {
        struct object *object = &scene->objects[i];
        read_all(&object->is_clear, sizeof(object->is_clear), file);
        read_all(&object->priority, sizeof(object->priority), file);
        read_all(&object->index, sizeof(object->index), file);
        read_all(&object->absorbed, sizeof(object->absorbed), file);
        object->image = read_picture(file);
    }
    scene->triangles = room_for((size_t)scene->counts.triangles, sizeof(*scene->triangles));
    for (int i = 0; i < scene->counts.triangles; i++) {
        struct triangle *triangle = &scene->triangles[i];
        read_all(&triangle->object, sizeof(triangle->object), file);
        read_all(triangle->corners, sizeof(triangle->corners), file);
        for (int k = 0; k < 3; k++)
            triangle->middle = plus(triangle->middle, triangle->corners[k].at, 1.0 / 3);
    }
    fclose(file);
}

/* ---- the tree ---- */

static void grow(struct node *node, struct vec p)
{
    node->low =
        (struct vec){ fmin(node->low.x, p.x), fmin(node->low.y, p.y), fmin(node->low.z, p.z) };
    node->high =
        (struct vec){ fmax(node->high.x, p.x), fmax(node->high.y, p.y), fmax(node->high.z, p.z) };
}

static double half_area(const struct node *node)
{
    const struct vec size = plus(node->high, node->low, -1);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

static const struct node nothing = { { 1e9, 1e9, 1e9 }, { -1e9, -1e9, -1e9 }, 0, 0 };

static int bin_of(const struct triangle *triangle, const struct node *middles, int axis)
{
    const double low = axis_of(middles->low, axis), high = axis_of(middles->high, axis);
    return (int)((axis_of(triangle->middle, axis) - low) / (high - low) * 0.9999 * BINS);
}

static void grow_all(struct node *node, const struct triangle *triangle)
{
    for (int k = 0; k < 3; k++)
        grow(node, triangle->corners[k].at);
}

/* Finds the axis and the first bin of the second half that rays meet least (areas times counts). */
static double find_split(const struct scene *scene, const struct node *all,
                         const struct node *middles, int *split)
{
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        struct node bins[BINS];
        if (axis_of(middles->high, axis) <= axis_of(middles->low, axis))
            continue;
        for (int b = 0; b < BINS; b++)
            bins[b] = nothing;
        for (int32_t i = all->first; i < all->first + all->count; i++) {
            struct node *bin = &bins[bin_of(&scene->triangles[i], middles, axis)];
            grow_all(bin, &scene->triangles[i]);
            bin->count++;
        }
        for (int b = 1; b < BINS; b++) {
            struct node halves[2] = { nothing, nothing };
            for (int k = 0; k < BINS; k++) {
                struct node *half = &halves[k >= b];
                if (bins[k].count)
                    grow(half, bins[k].low), grow(half, bins[k].high);
                half->count += bins[k].count;
            }
            double cost = 0;
            for (int k = 0; k < 2; k++)
                cost += halves[k].count ? half_area(&halves[k]) * halves[k].count : INFINITY;
            if (cost < least)
                least = cost, split[0] = axis, split[1] = b;
        }
    }
    return least;
}

/* Makes the node of triangles `first` and on. */
static void build(struct scene *scene, int32_t at, int32_t first, int32_t count)
{
    struct node *node = &scene->nodes[at];
    struct node middles = nothing;
    *node = nothing;
    for (int32_t i = first; i < first + count; i++) {
        grow(&middles, scene->triangles[i].middle);
        grow_all(node, &scene->triangles[i]);
    }
    node->first = first;
    node->count = count;
    int split[2];
    if (count <= LEAF_TRIANGLES || find_split(scene, node, &middles, split) == INFINITY)
        return;
    int32_t second = first;
    for (int32_t i = first; i < first + count; i++) {
        struct triangle triangle = scene->triangles[i];
        if (bin_of(&triangle, &middles, split[0]) >= split[1])
            continue;
        scene->triangles[i] = scene->triangles[second];
        scene->triangles[second++] = triangle;
    }
    const int32_t children = scene->node_count;
    scene->node_count += 2;
    node->first = children;
    node->count = 0;
    build(scene, children, first, second - first);
    build(scene, children + 1, second, first + count - second);
}

/* Where a ray enters a box, or infinity. */
static double enter(const struct node *node, struct vec at, struct vec inverse, double nearest)
{
    const double ax = (node->low.x - at.x) * inverse.x, bx = (node->high.x - at.x) * inverse.x;
    const double ay = (node->low.y - at.y) * inverse.y, by = (node->high.y - at.y) * inverse.y;
    const double az = (node->low.z - at.z) * inverse.z, bz = (node->high.z - at.z) * inverse.z;
    const double from = fmax(fmax(fmin(ax, bx), fmin(ay, by)), fmax(fmin(az, bz), 0));
    const double to = fmin(fmin(fmax(ax, bx), fmax(ay, by)), fmin(fmax(az, bz), nearest));
    return from <= to * (1 + 1e-12) ? from : INFINITY;
}

/* Moeller and Trumbore's test. */
static void meet(const struct scene *scene, const struct path *path, int32_t i, struct hit *hit)
{
    const struct corner *c = scene->triangles[i].corners;
    const struct vec ab = plus(c[1].at, c[0].at, -1), ac = plus(c[2].at, c[0].at, -1);
    const struct vec p = cross(path->way, ac);
    const double det = dot(ab, p);
    for (int k = 0; k < 2 * MAX_TOUCHING; k++) {
        if (i == path->left[k])
            return;
    }
    if (det == 0)
        return;
    const struct vec from = plus(path->at, c[0].at, -1);
    const double u = dot(from, p) / det;
    const struct vec q = cross(from, ab);
    const double v = dot(path->way, q) / det, t = dot(ac, q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < hit->t)
        *hit = (struct hit){ t, u, v, i };
}

static struct hit find_hit(const struct scene *scene, const struct path *path)
{
    const struct vec inverse = { 1 / path->way.x, 1 / path->way.y, 1 / path->way.z };
    struct hit hit = { INFINITY, 0, 0, -1 };
    int32_t stack[128] = { 0 };
    for (int depth = 1; depth > 0;) {
        const struct node *node = &scene->nodes[stack[--depth]];
        if (enter(node, path->at, inverse, hit.t) == INFINITY)
            continue;
        for (int32_t i = node->first; i < node->first + node->count; i++)
            meet(scene, path, i, &hit);
        if (node->count)
            continue;
        const struct node *a = &scene->nodes[node->first];
        const double to_a = enter(a, path->at, inverse, hit.t);
        const bool a_is_nearer = to_a <= enter(a + 1, path->at, inverse, hit.t);
        stack[depth++] = node->first + (a_is_nearer ? 1 : 0);
        stack[depth++] = node->first + (a_is_nearer ? 0 : 1);
    }
    return hit;
}

/* ---- light ---- */

static int wrapped(int i, int count)
{
    return (i % count + count) % count;
}

/* Between the middles of four texels; u goes on at its ends, v only if `repeats`. */
static struct vec look_up(const struct picture *picture, double u, double v, bool repeats)
{
    const double x = u * picture->width - 0.5, y = v * picture->height - 0.5;
    struct vec sum = { 0, 0, 0 };
    for (int k = 0; k < 4; k++) {
        const int column = (int)floor(x) + k % 2, row = (int)floor(y) + k / 2;
        const int last = picture->height - 1;
        const int c = wrapped(column, picture->width);
        const int r = repeats      ? wrapped(row, picture->height)
                      : row < 0    ? 0
                      : row > last ? last
                                   : row;
        sum = plus(sum, picture->texels[r * picture->width + c],
                   (1 - fabs(x - column)) * (1 - fabs(y - row)));
    }
    return sum;
}

static struct vec light_from(const struct scene *scene, struct vec way)
{
    const double pi = acos(-1);
    return look_up(&scene->around, 0.5 + atan2(way.x, -way.z) / (2 * pi),
                   acos(fmax(-1, fmin(way.y, 1))) / pi, false);
}

static struct vec blend(struct vec a, struct vec b, struct vec c, const struct hit *hit)
{
    return plus(plus(scaled(a, 1 - hit->u - hit->v), b, hit->u), c, hit->v);
}

static struct vec emitted(const struct scene *scene, const struct hit *hit)
{
    const struct triangle *triangle = &scene->triangles[hit->triangle];
    const struct corner *c = triangle->corners;
    const double rest = 1 - hit->u - hit->v;
    return times(blend(c[0].color, c[1].color, c[2].color, hit),
                 look_up(&scene->objects[triangle->object].image,
                         rest * c[0].u + hit->u * c[1].u + hit->v * c[2].u,
                         rest * c[0].v + hit->u * c[1].v + hit->v * c[2].v, true));
}

/* The object whose medium is where a ray is, or NULL: air. */
static const struct object *medium(const struct scene *scene, const int16_t *inside)
{
    const struct object *top = NULL;
    for (int i = 0; i < scene->counts.objects; i++) {
        if (inside[i] > 0 && (!top || scene->objects[i].priority >= top->priority))
            top = &scene->objects[i];
    }
    return top;
}

/* Turns both ways at a surface whose normal faces the path; returns the share that is reflected. */
static double bend(struct vec way, struct vec normal, double ratio, struct vec *back,
                   struct vec *through)
{
    const double c = -dot(way, normal), sine2 = ratio * ratio * (1 - c * c);
    *back = unit(plus(way, normal, 2 * c));
    if (sine2 >= 1)
        return 1;
    const double k = sqrt(1 - sine2);
    *through = unit(plus(scaled(way, ratio), normal, ratio * c - k));
    const double across = (ratio * c - k) / (ratio * c + k);
    const double along = (c - ratio * k) / (c + ratio * k);
    return (across * across + along * along) / 2;
}

static struct vec follow(const struct scene *scene, struct path *path, uint64_t *random);

/* What comes along both ways, or along one by chance. */
static struct vec part(const struct scene *scene, struct path *path, struct path *back,
                       double share, uint64_t *random)
{
    if (share >= 1)
        return follow(scene, back, random);
    const double least = fmin(share, 1 - share) * largest(path->weight);
    if (least < split_weight || path->surfaces > 40)
        return follow(scene, chance(random) < share ? back : path, random);
    back->weight = scaled(back->weight, share);
    path->weight = scaled(path->weight, 1 - share);
    const struct vec light = follow(scene, back, random);
    return plus(light, follow(scene, path, random), 1);
}

static struct vec flat_normal(const struct scene *scene, const struct hit *hit)
{
    const struct corner *c = scene->triangles[hit->triangle].corners;
    return unit(cross(plus(c[1].at, c[0].at, -1), plus(c[2].at, c[0].at, -1)));
}

/* Finds the hits that coincide with one, which is the first of them. Returns their number; 1 if
 * all are of one object. */
static int find_touching(const struct scene *scene, const struct path *path,
                         struct hit hits[static MAX_TOUCHING])
{
    struct path probe = *path;
    const int32_t first = scene->triangles[hits[0].triangle].object;
    const double slope = fmax(fabs(dot(flat_normal(scene, &hits[0]), path->way)), 1.0 / 16);
    int count = 1;
    bool is_one = true;
    for (; count < MAX_TOUCHING; count++) {
        probe.left[MAX_TOUCHING + count] = hits[count - 1].triangle;
        const struct hit hit = find_hit(scene, &probe);
        if (hit.triangle < 0 || hit.t > hits[0].t + scene->reach / slope ||
            !scene->objects[scene->triangles[hit.triangle].object].is_clear)
            break;
        hits[count] = hit;
        is_one = is_one && scene->triangles[hit.triangle].object == first;
    }
    return is_one ? 1 : count;
}

/* Crosses all hits. Returns the one that has the normal. */
static const struct hit *cross_all(const struct scene *scene, struct path *path,
                                   const struct hit *hits, int count)
{
    const struct object *before = medium(scene, path->inside);
    for (int i = 0; i < count; i++) {
        int16_t *inside = &path->inside[scene->triangles[hits[i].triangle].object];
        *inside = (int16_t)(*inside + (dot(flat_normal(scene, &hits[i]), path->way) < 0 ? 1 : -1));
    }
    const struct object *after = medium(scene, path->inside);
    const struct object *top =
        !after || (before && (before->priority > after->priority ||
                              (before->priority == after->priority && before > after)))
            ? before
            : after;
    for (int i = 0; i < count; i++) {
        if (&scene->objects[scene->triangles[hits[i].triangle].object] == top)
            return &hits[i];
    }
    return hits;
}

static bool are_same(const struct object *a, const struct object *b)
{
    return a == b || (a && b && a->index == b->index && a->absorbed.x == b->absorbed.x &&
                      a->absorbed.y == b->absorbed.y && a->absorbed.z == b->absorbed.z);
}

/* At surfaces between two media: `path` becomes the refracted one. */
static struct vec cross_surface(const struct scene *scene, struct path *path,
                                const struct hit *hits, int count, uint64_t *random)
{
    struct path back = *path;
    const struct object *before = medium(scene, path->inside);
    const struct hit *hit = cross_all(scene, path, hits, count);
    const struct object *after = medium(scene, path->inside);
    const struct corner *c = scene->triangles[hit->triangle].corners;
    struct vec flat = flat_normal(scene, hit);
    struct vec normal = unit(blend(c[0].normal, c[1].normal, c[2].normal, hit));
    const bool enters = dot(flat, path->way) < 0;
    if (are_same(before, after))
        return follow(scene, path, random);
    if (!enters)
        flat = scaled(flat, -1), normal = scaled(normal, -1);
    const double ratio = (before ? before->index : 1) / (after ? after->index : 1);
    if (scene->counts.is_flat || dot(normal, path->way) >= 0)
        normal = flat;
    struct vec reflected, through = path->way;
    double share = bend(path->way, normal, ratio, &reflected, &through);
    const bool is_on_wrong_side =
        dot(reflected, flat) <= 0 || (share < 1 && dot(through, flat) >= 0);
    if (is_on_wrong_side)
        share = bend(path->way, flat, ratio, &reflected, &through);
    back.way = reflected;
    path->way = through;
    return part(scene, path, &back, share, random);
}

/* The light that comes to a path's start against its way, times its weight. */
static struct vec follow(const struct scene *scene, struct path *path, uint64_t *random)
{
    const double most = largest(path->weight);
    if (most < weak) {
        if (chance(random) * weak >= most)
            return (struct vec){ 0, 0, 0 };
        path->weight = scaled(path->weight, weak / most);
    }
    struct hit hits[MAX_TOUCHING] = { find_hit(scene, path) };
    const struct hit hit = hits[0];
    if (hit.triangle < 0)
        return times(path->weight, light_from(scene, path->way));
    const struct object *here = medium(scene, path->inside);
    if (here) {
        const struct vec kept = { exp(-here->absorbed.x * hit.t), exp(-here->absorbed.y * hit.t),
                                  exp(-here->absorbed.z * hit.t) };
        path->weight = times(path->weight, kept);
    }
    if (!scene->objects[scene->triangles[hit.triangle].object].is_clear)
        return times(path->weight, emitted(scene, &hit));
    if (++path->surfaces > MAX_SURFACES)
        return (struct vec){ 0, 0, 0 };
    const int count = find_touching(scene, path, hits);
    path->at = plus(path->at, path->way, hit.t);
    for (int i = 0; i < 2 * MAX_TOUCHING; i++)
        path->left[i] = i < count ? hits[i].triangle : -1;
    return cross_surface(scene, path, hits, count, random);
}

/* Finds the distance of surfaces that coincide, of the size of the least clear object. */
static void measure(struct scene *scene)
{
    double least = INFINITY;
    for (int32_t i = 0; i < scene->counts.objects; i++) {
        struct node box = nothing;
        for (int32_t k = 0; k < scene->counts.triangles; k++) {
            if (scene->triangles[k].object == i && scene->objects[i].is_clear)
                grow_all(&box, &scene->triangles[k]);
        }
        const struct vec size = plus(box.high, box.low, -1);
        if (size.x >= 0)
            least = fmin(least, sqrt(dot(size, size)) / 2);
    }
    scene->reach = touching * least;
}

/* ---- the picture ---- */

static struct path from_eye(const struct scene *scene, double x, double y)
{
    const double height = scene->counts.height, width = scene->counts.width;
    const double right = (2 * x - width) / height * scene->tangent;
    const double up = (1 - 2 * y / height) * scene->tangent;
    struct path path = { .at = scene->eye, .weight = { 1, 1, 1 } };
    memset(path.left, -1, sizeof(path.left));
    path.way = unit(plus(plus(scaled(scene->right, right), scene->up, up), scene->back, -1));
    return path;
}

/* Samples lie evenly in the pixel (steps of the plastic number), or all in its middle. */
static void draw_pixel(const struct scene *scene, int x, int y, float *out)
{
    uint64_t random = ((uint64_t)scene->counts.seed << 40) ^
                      (uint64_t)(y * scene->counts.width + x) * 0x9e3779b97f4a7c15u;
    const double dx = chance(&random), dy = chance(&random);
    struct path middle = from_eye(scene, x + 0.5, y + 0.5);
    const struct hit first = find_hit(scene, &middle);
    out[6] =
        first.triangle >= 0 && scene->objects[scene->triangles[first.triangle].object].is_clear;
    struct vec sums[2] = { { 0, 0, 0 }, { 0, 0, 0 } };
    for (int i = 0; i < scene->counts.samples; i++) {
        const double u = fmod(dx + i * 0.7548776662466927, 1);
        const double v = fmod(dy + i * 0.5698402909980532, 1);
        const bool at_middle = scene->counts.at_middle;
        struct path path = from_eye(scene, x + (at_middle ? 0.5 : u), y + (at_middle ? 0.5 : v));
        sums[i % 2] = plus(sums[i % 2], follow(scene, &path, &random), 1);
    }
    for (int k = 0; k < 2; k++) {
        const struct vec mean = scaled(sums[k], 2.0 / scene->counts.samples);
        out[3 * k] = (float)mean.x, out[3 * k + 1] = (float)mean.y, out[3 * k + 2] = (float)mean.z;
    }
}

int main(int argc, char **argv)
{
    static struct scene scene;
    if (argc != 3) {
        fputs("usage: paths SCENE PICTURE\n", stderr);
        return 2;
    }
    read_scene(&scene, argv[1]);
    measure(&scene);
    scene.nodes = room_for(2 * (size_t)scene.counts.triangles + 1, sizeof(*scene.nodes));
    scene.node_count = 1;
    build(&scene, 0, 0, scene.counts.triangles);
    const int width = scene.counts.width, height = scene.counts.height;
    float *out = room_for((size_t)width * (size_t)height, 7 * sizeof(*out));
#pragma omp parallel for schedule(dynamic)
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++)
            draw_pixel(&scene, x, y, out + 7 * (y * width + x));
    }
    FILE *file = fopen(argv[2], "wb");
    if (!file ||
        fwrite(out, 7 * sizeof(*out), (size_t)width * (size_t)height, file) !=
            (size_t)width * (size_t)height ||
        fclose(file)) {
        perror(argv[2]);
        return 1;
    }
    free(out);
    return 0;
}
