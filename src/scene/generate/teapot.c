/*
 * teapot.c: generates the Utah teapot as one closed surface.
 *
 * The 32 bicubic patches (Newell 1975, heights as scaled by Blinn, bottom by Crow) are 24 patches
 * of revolution, and two tubes of two patches and their mirror images. A profile and two lists of
 * cross-sections describe them exactly. A flat ring closes the gap between lid and rim. Handle and
 * spout are cut where they meet the body, and joined to holes in its grid, so that there are no
 * inner walls; the spout's mouth is closed. The surface has genus 1: its Euler characteristic is 0,
 * and it has twice as many triangles as vertices.
 *
 * With n cells along a patch's side, the body has 24 * 2 n^2 triangles (the ring adds as many as
 * the two poles lose). Spout and handle replace 2 * 4 patches. For n = 15, the spout has 27 rows *
 * 34 around * 2 + mouth 32 - hole 6 * 11 * 2 = 1736 triangles, and the handle 54 rows * 18 around *
 * 2 - holes 4 * 5 * 2 * 2 = 1864, which is 8 * 2 * 15^2, and 14400 in all.
 */
#include "src/scene/generate/generate.h"

#include <assert.h>
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

enum {
    PROFILE_PIECES = 6,
    UPPER = 3,     /* first of the two profile pieces to which handle and spout are joined */
    CELLS_MIN = 5, /* minimum for which the normals at the joints point outwards */
};

/* Bezier control points of the body's profile: radius, height. */
static const float profile[PROFILE_PIECES][4][2] = {
    { { 0, 3.15F }, { 0.8F, 3.15F }, { 0, 2.85F }, { 0.2F, 2.7F } },
    { { 0.2F, 2.7F }, { 0.4F, 2.55F }, { 1.3F, 2.55F }, { 1.3F, 2.4F } },
    { { 1.4F, 2.4F }, { 1.3375F, 2.53125F }, { 1.4375F, 2.53125F }, { 1.5F, 2.4F } },
    { { 1.5F, 2.4F }, { 1.75F, 1.875F }, { 2, 1.35F }, { 2, 0.9F } },
    { { 2, 0.9F }, { 2, 0.45F }, { 1.5F, 0.225F }, { 1.5F, 0.15F } },
    { { 1.5F, 0.15F }, { 1.5F, 0.075F }, { 1.425F, 0 }, { 0, 0 } },
};

/* Bezier control points of the spout: (x, y) of both seams between its halves, and half width. */
static const float spout_sections[7][5] = {
    { 1.7F, 1.425F, 1.7F, 0.6F, 0.66F },       { 2.6F, 1.425F, 3.1F, 0.825F, 0.66F },
    { 2.3F, 2.1F, 2.4F, 2.025F, 0.25F },       { 2.7F, 2.4F, 3.3F, 2.4F, 0.25F },
    { 2.8F, 2.475F, 3.525F, 2.49375F, 0.25F }, { 2.9F, 2.475F, 3.45F, 2.5125F, 0.15F },
    { 2.8F, 2.4F, 3.2F, 2.4F, 0.15F },
};

static const float handle_sections[7][5] = {
    { -1.6F, 2.025F, -1.5F, 2.25F, 0.3F }, { -2.3F, 2.025F, -2.5F, 2.25F, 0.3F },
    { -2.7F, 2.025F, -3, 2.25F, 0.3F },    { -2.7F, 1.8F, -3, 1.8F, 0.3F },
    { -2.7F, 1.575F, -3, 1.35F, 0.3F },    { -2.5F, 1.125F, -2.65F, 0.9375F, 0.3F },
    { -2, 0.9F, -1.9F, 0.6F, 0.3F },
};

/* Cells omitted from the body's grid: rows top..bottom, `reach` columns on both sides of `center`.
 */
struct hole {
    uint32_t center;
    uint32_t reach;
    uint32_t top, bottom;
};

struct teapot {
    struct mesh *mesh;
    uint32_t n;       /* cells along a patch's side */
    uint32_t columns; /* columns around the body: 4n */
    uint32_t lines;   /* number of circles of vertices on the body, including both poles */
    struct hole spout, handle_top, handle_bottom;
    /* number of rows of the spout from hole to mouth, and of the handle from hole to hole */
    uint32_t spout_rows, handle_rows;
    uint32_t *body;                         /* vertex indices of the body, by line and column */
    uint32_t *loop, *next_loop, *hole_loop; /* scratch memory for vertices around a tube */
    uint32_t vertex_count, index_count;
};

static void bernstein(float t, float weights[4])
{
    float s = 1 - t;
    weights[0] = s * s * s;
    weights[1] = 3 * s * s * t;
    weights[2] = 3 * s * t * t;
    weights[3] = t * t * t;
}

static vec2s profile_point(uint32_t piece, float t)
{
    float w[4];
    bernstein(t, w);
    vec2s p = { 0 };
    for (int i = 0; i < 4; i++) {
        p.x += w[i] * profile[piece][i][0];
        p.y += w[i] * profile[piece][i][1];
    }
    return p;
}

/* Returns a point of Newell's quarter circle, a Bezier curve with the control distance 0.56. */
static vec2s quarter_circle(float t)
{
    float w[4];
    bernstein(t, w);
    return (vec2s){ { w[0] + w[1] + 0.56F * w[2], 0.56F * w[1] + w[2] + w[3] } };
}

/* Returns a point of a tube. `u` is about 0 to 2 along the tube. `v` is 0 to 1 around half of the
 * cross-section. `side` (1 or -1) selects the half. */
static vec3s tube_point(const float (*sections)[5], float u, float v, float side)
{
    int patch = u < 1 ? 0 : 1;
    float along[4], around[4];
    bernstein(u - (float)patch, along);
    bernstein(v, around);
    float at[5] = { 0 };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++)
            at[k] += along[i] * sections[3 * patch + i][k];
    float begin = around[0] + around[1];
    float end = around[2] + around[3];
    return (vec3s){ {
        at[0] * begin + at[2] * end,
        at[1] * begin + at[3] * end,
        side * at[4] * (around[1] + around[2]),
    } };
}

/* Returns a point's horizontal distance from the body; negative inside. */
static float outside_body(vec3s p)
{
    const int steps = 24; /* bisections, for float precision */
    uint32_t piece = p.y > profile[UPPER][3][1] ? UPPER : UPPER + 1;
    float low = 0, high = 1;
    for (int i = 0; i < steps; i++) {
        float middle = (low + high) / 2;
        if (profile_point(piece, middle).y > p.y)
            low = middle;
        else
            high = middle;
    }
    float radius = profile_point(piece, low).x;

    vec2s direction = { 0 };
    low = 0;
    high = 1;
    for (int i = 0; i < steps; i++) {
        float middle = (low + high) / 2;
        direction = quarter_circle(middle);
        if (direction.y * fabsf(p.x) < direction.x * fabsf(p.z))
            low = middle;
        else
            high = middle;
    }
    return hypotf(p.x, p.z) - radius * glms_vec2_norm(direction);
}

/* Returns the u at which a tube leaves the body, by bisection from `inside` to `outside`. */
static float find_joint(const float (*sections)[5], float inside, float outside, float v)
{
    for (int i = 0; i < 24; i++) {
        float middle = (inside + outside) / 2;
        if (outside_body(tube_point(sections, middle, v, 1)) < 0)
            inside = middle;
        else
            outside = middle;
    }
    return outside;
}

static uint32_t loop_size(const struct hole *hole)
{
    return 2 * (2 * hole->reach + hole->bottom - hole->top);
}

static uint32_t hole_cells(const struct hole *hole)
{
    return 2 * hole->reach * (hole->bottom - hole->top);
}

static uint32_t percent_floor(uint32_t n, uint32_t percent)
{
    return n * percent / 100;
}

static uint32_t percent_ceil(uint32_t n, uint32_t percent)
{
    return (n * percent + 99) / 100;
}

/* Places the holes for spout and handle, in percent of a patch, with a margin around each joint.
 * The spout joins the body at 0.62 to 1.20 patches below the rim, the handle at 0.10 to 0.24 and
 * 1.00 to 1.24. Half widths are 0.153 patches for the spout, and 0.085 and 0.070 for the handle. */
static struct teapot plan(uint32_t n)
{
    struct teapot t = { .n = n, .columns = 4 * n, .lines = PROFILE_PIECES * n + 2 };
    uint32_t rim = UPPER * n + 1;
    t.spout = (struct hole){
        .center = 0,
        .reach = percent_ceil(n, 17),
        .top = rim + percent_floor(n, 57),
        .bottom = rim + percent_ceil(n, 125),
    };
    t.handle_bottom = (struct hole){
        .center = 2 * n,
        .reach = percent_ceil(n, 10),
        .top = rim + percent_floor(n, 96),
        .bottom = rim + percent_ceil(n, 126),
    };
    t.handle_top = t.handle_bottom; /* both handle holes have equal outlines */
    t.handle_top.top = rim + percent_floor(n, 8);
    t.handle_top.bottom = t.handle_top.top + t.handle_bottom.bottom - t.handle_bottom.top;
    t.spout_rows = 9 * n / 5;
    t.handle_rows = 18 * n / 5;
    return t;
}

/* Returns half the number of triangles, which equals the number of vertices for genus 1. */
static uint32_t half_count(const struct teapot *t)
{
    uint32_t body = t->columns * (t->lines - 2) - hole_cells(&t->spout) -
                    hole_cells(&t->handle_top) - hole_cells(&t->handle_bottom);
    uint32_t mouth = loop_size(&t->spout) / 2 - 1;
    return body + t->spout_rows * loop_size(&t->spout) + mouth +
           t->handle_rows * loop_size(&t->handle_top);
}

static struct teapot choose_plan(uint32_t triangles)
{
    uint32_t target = (triangles < GENERATE_TRIANGLES_MAX ? triangles : GENERATE_TRIANGLES_MAX) / 2;
    struct teapot fewer = plan(CELLS_MIN);
    struct teapot more = fewer;
    while (half_count(&more) < target) {
        fewer = more;
        more = plan(more.n + 1);
    }
    bool more_is_closer = half_count(&more) - target < target - half_count(&fewer);
    return more_is_closer || half_count(&fewer) > target ? more : fewer;
}

static uint32_t add_vertex(struct teapot *t, vec3s position)
{
    t->mesh->vertices[t->vertex_count] = (struct mesh_vertex){
        .position = position,
        .color = { { 1, 1, 1 } },
    };
    return t->vertex_count++;
}

static void add_triangle(struct teapot *t, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *out = t->mesh->indices + t->index_count;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    t->index_count += 3;
}

/* Returns a body vertex position. Columns run around from +X to -Z and -X. */
static vec3s body_point(const struct teapot *t, uint32_t line, uint32_t column)
{
    /* the ring between lid and rim adds one line of vertices */
    uint32_t cell = line <= 2 * t->n ? line : line - 1;
    uint32_t piece = line == 2 * t->n ? 1 : cell / t->n;
    piece = piece < PROFILE_PIECES ? piece : PROFILE_PIECES - 1;
    vec2s p = profile_point(piece, (float)(cell - piece * t->n) / (float)t->n);
    vec2s q = quarter_circle((float)(column % t->n) / (float)t->n);
    const vec2s rotated[4] = {
        { { q.x, -q.y } },
        { { -q.y, -q.x } },
        { { -q.x, q.y } },
        { { q.y, q.x } },
    };
    vec2s direction = rotated[column / t->n];
    return (vec3s){ { p.x * direction.x, p.y, p.x * direction.y } };
}

/* Returns the distance of a column from the hole's centre, in columns. */
static uint32_t columns_off(const struct teapot *t, const struct hole *hole, uint32_t column)
{
    uint32_t off = (column + t->columns - hole->center) % t->columns;
    return off < t->columns - off ? off : t->columns - off;
}

static bool hides_vertex(const struct teapot *t, const struct hole *hole, uint32_t line,
                         uint32_t column)
{
    return line > hole->top && line < hole->bottom && columns_off(t, hole, column) < hole->reach;
}

static bool hides_cell(const struct teapot *t, const struct hole *hole, uint32_t row,
                       uint32_t column)
{
    return row >= hole->top && row < hole->bottom && columns_off(t, hole, column) <= hole->reach &&
           columns_off(t, hole, (column + 1) % t->columns) <= hole->reach;
}

static uint32_t *body_vertex(struct teapot *t, uint32_t line, uint32_t column)
{
    return &t->body[line * t->columns + column % t->columns];
}

static void add_body_vertices(struct teapot *t)
{
    for (uint32_t line = 0; line < t->lines; line++) {
        bool pole = line == 0 || line == t->lines - 1;
        for (uint32_t column = 0; column < t->columns; column++) {
            if (hides_vertex(t, &t->spout, line, column) ||
                hides_vertex(t, &t->handle_top, line, column) ||
                hides_vertex(t, &t->handle_bottom, line, column))
                continue;
            *body_vertex(t, line, column) = pole && column > 0
                                                ? *body_vertex(t, line, 0)
                                                : add_vertex(t, body_point(t, line, column));
        }
    }
}

static void add_body(struct teapot *t)
{
    add_body_vertices(t);
    for (uint32_t row = 0; row + 1 < t->lines; row++) {
        for (uint32_t column = 0; column < t->columns; column++) {
            if (hides_cell(t, &t->spout, row, column) ||
                hides_cell(t, &t->handle_top, row, column) ||
                hides_cell(t, &t->handle_bottom, row, column))
                continue;
            uint32_t a = *body_vertex(t, row, column);
            uint32_t b = *body_vertex(t, row + 1, column);
            uint32_t c = *body_vertex(t, row + 1, column + 1);
            uint32_t d = *body_vertex(t, row, column + 1);
            if (b != c)
                add_triangle(t, a, b, c);
            if (a != d)
                add_triangle(t, a, c, d);
        }
    }
}

/* Lists the vertices around a hole, with the +Z half first. The list starts at the centre of the
 * upper edge. If `from_bottom`, the list starts at the centre of the lower edge. */
static void trace_hole(struct teapot *t, const struct hole *hole, bool from_bottom, uint32_t *loop)
{
    uint32_t size = loop_size(hole);
    uint32_t height = hole->bottom - hole->top;
    for (uint32_t i = 0; i < size; i++) {
        bool first_half = i <= size / 2;
        uint32_t step = first_half ? i : size - i;
        uint32_t off = step;
        uint32_t down = 0;
        if (step > hole->reach) {
            down = step - hole->reach < height ? step - hole->reach : height;
            off = down < height ? hole->reach : size / 2 - step;
        }
        uint32_t line = from_bottom ? hole->bottom - down : hole->top + down;
        /* +Z is towards lower columns at the spout, and towards higher ones at the handle */
        bool higher = first_half == (hole->center > 0);
        loop[i] = *body_vertex(t, line, hole->center + (higher ? off : t->columns - off));
    }
}

/* Joins two vertex loops by triangles. The loop `to` is farther along the tube. */
static void bridge(struct teapot *t, const uint32_t *from, const uint32_t *to, uint32_t size)
{
    for (uint32_t i = 0; i < size; i++) {
        uint32_t next = (i + 1) % size;
        add_triangle(t, from[i], from[next], to[next]);
        add_triangle(t, from[i], to[next], to[i]);
    }
}

struct tube {
    const float (*sections)[5];
    uint32_t size, rings;
    float begin_inside, begin_outside; /* u values inside and outside the body, for find_joint() */
    float end_inside, end_outside;     /* u range of the end joint; equal values mean an open end */
};

/* Adds the rings of a tube. Returns the index of the first vertex. */
static uint32_t add_tube_vertices(struct teapot *t, const struct tube *tube)
{
    uint32_t first = t->vertex_count;
    for (uint32_t i = 0; i < tube->size * tube->rings; i++)
        add_vertex(t, (vec3s){ 0 });
    uint32_t half = tube->size / 2;
    for (uint32_t i = 0; i < tube->size; i++) {
        float side = i <= half ? 1 : -1;
        float v = (float)(i <= half ? i : tube->size - i) / (float)half;
        float begin = find_joint(tube->sections, tube->begin_inside, tube->begin_outside, v);
        float end = find_joint(tube->sections, tube->end_inside, tube->end_outside, v);
        for (uint32_t ring = 0; ring < tube->rings; ring++) {
            float u = glm_lerp(begin, end, (float)ring / (float)(tube->rings - 1));
            t->mesh->vertices[first + ring * tube->size + i].position =
                tube_point(tube->sections, u, v, side);
        }
    }
    return first;
}

/* Joins t->loop to t->next_loop with triangles. t->next_loop then becomes t->loop. */
static void advance(struct teapot *t, uint32_t size)
{
    bridge(t, t->loop, t->next_loop, size);
    uint32_t *done = t->loop;
    t->loop = t->next_loop;
    t->next_loop = done;
}

/* Joins t->loop and a tube's rings with triangles; the last ring becomes t->loop. */
static void add_tube(struct teapot *t, const struct tube *tube, uint32_t first)
{
    for (uint32_t ring = 0; ring < tube->rings; ring++) {
        for (uint32_t i = 0; i < tube->size; i++)
            t->next_loop[i] = first + ring * tube->size + i;
        advance(t, tube->size);
    }
}

/* Adds a ring of vertices to the body just outside a tube's first ring. Stores the new ring in
 * t->next_loop. The new ring confines the smoothing of normals to the joint. */
static void add_skirt(struct teapot *t, const uint32_t *edge, uint32_t joint, uint32_t size)
{
    for (uint32_t i = 0; i < size; i++) {
        vec3s p = glms_vec3_lerp(t->mesh->vertices[edge[i]].position,
                                 t->mesh->vertices[joint + i].position, 0.75F);
        float radius = hypotf(p.x, p.z);
        float scale = (radius - outside_body(p)) / radius;
        t->next_loop[i] = add_vertex(t, (vec3s){ { p.x * scale, p.y, p.z * scale } });
    }
}

static void add_spout(struct teapot *t)
{
    uint32_t size = loop_size(&t->spout);
    const struct tube tube = { spout_sections, size, t->spout_rows - 1, 0, 0.5F, 2, 2 };
    uint32_t first = add_tube_vertices(t, &tube);
    trace_hole(t, &t->spout, false, t->loop);
    add_skirt(t, t->loop, first, size);
    advance(t, size);
    add_tube(t, &tube, first);

    const uint32_t *mouth = t->loop;
    add_triangle(t, mouth[0], mouth[1], mouth[size - 1]);
    for (uint32_t i = 1; i < size / 2 - 1; i++) {
        add_triangle(t, mouth[i], mouth[i + 1], mouth[size - i - 1]);
        add_triangle(t, mouth[i], mouth[size - i - 1], mouth[size - i]);
    }
    add_triangle(t, mouth[size / 2 - 1], mouth[size / 2], mouth[size / 2 + 1]);
}

static void add_handle(struct teapot *t)
{
    uint32_t size = loop_size(&t->handle_top);
    /* u ends beyond 2, since the point at u = 2 is just outside the body */
    const struct tube tube = {
        handle_sections, size, t->handle_rows - 3, 0, 0.5F, 2.12F, 1.5F,
    };
    uint32_t first = add_tube_vertices(t, &tube);
    trace_hole(t, &t->handle_top, true, t->loop);
    add_skirt(t, t->loop, first, size);
    advance(t, size);
    add_tube(t, &tube, first);

    trace_hole(t, &t->handle_bottom, false, t->hole_loop);
    add_skirt(t, t->hole_loop, first + (tube.rings - 1) * size, size);
    advance(t, size);
    bridge(t, t->loop, t->hole_loop, size);
}

bool generate_teapot(struct mesh *mesh, uint32_t triangles)
{
    struct teapot t = choose_plan(triangles);
    uint32_t loop = loop_size(&t.spout) + loop_size(&t.handle_top);
    uint32_t *scratch = calloc((size_t)t.lines * t.columns + 3 * (size_t)loop, sizeof(*scratch));
    if (scratch == NULL)
        return false;
    if (!mesh_init(mesh, half_count(&t), 6 * half_count(&t))) {
        free(scratch);
        return false;
    }
    t.mesh = mesh;
    t.body = scratch;
    t.loop = scratch + (size_t)t.lines * t.columns;
    t.next_loop = t.loop + loop;
    t.hole_loop = t.next_loop + loop;
    add_body(&t);
    add_spout(&t);
    add_handle(&t);
    assert(t.vertex_count == mesh->vertex_count && t.index_count == mesh->index_count);
    free(scratch);
    mesh_fit(mesh, 2);
    mesh_make_normals(mesh);
    return true;
}
