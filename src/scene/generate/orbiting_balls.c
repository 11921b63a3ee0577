/* orbiting_balls.c: generates balls that orbit an object, as moving surroundings. */
#include <cglm/struct.h>
#include <math.h>
#include "src/scene/generate/generate.h"

enum {
    BALL_TRIANGLES = 320
};

/* Returns the fully saturated colour of a hue, 0 to 1. */
static vec3s hue(float hue_angle)
{
    vec3s color;
    for (int i = 0; i < 3; i++)
        color.raw[i] = 0.45f + 0.4f * cosf(6.2831853f * (hue_angle + (float)i / 3.0f));
    return color;
}

static bool add_ball(struct mesh *mesh, vec3s center, float radius, vec3s color)
{
    struct mesh ball = { 0 };
    bool done = generate_sphere(&ball, BALL_TRIANGLES);
    for (uint32_t i = 0; done && i < ball.vertex_count; i++) {
        struct mesh_vertex *v = &ball.vertices[i];
        v->position = glms_vec3_add(glms_vec3_scale(v->position, radius), center);
        v->color = color;
        v->material = MESH_ORBITS;
    }
    done = done && mesh_append(mesh, &ball);
    mesh_finish(&ball);
    return done;
}

bool generate_orbiting_balls(struct mesh *mesh, struct box box, uint32_t count)
{
    vec3s center = box_center(box);
    float around = box_diagonal(box) / 2.0f;
    float radius = around * 0.2f;
    bool done = true;
    *mesh = (struct mesh){ 0 };
    for (uint32_t i = 0; i < count && done; i++) {
        float hue_angle = (float)i / (float)count;
        float angle = 6.2831853f * hue_angle;
        float distance = around * (1.4f + 0.3f * (float)(i % 3));
        vec3s at = { { distance * sinf(angle), around * (0.35f * (float)(i % 4) - 0.4f),
                       distance * cosf(angle) } };
        done = add_ball(mesh, glms_vec3_add(center, at), radius, hue(hue_angle));
    }
    if (!done)
        mesh_finish(mesh);
    return done;
}
