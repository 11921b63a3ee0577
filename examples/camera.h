/* camera.h: matrices of the examples, column-major (C17 and C++20). */
#ifndef CAMERA_H
#define CAMERA_H

#include <math.h>

struct matrix {
    float m[16];
};

static inline struct matrix multiply(const struct matrix *a, const struct matrix *b)
{
    struct matrix out = { { 0 } };
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            for (int k = 0; k < 4; k++)
                out.m[4 * column + row] += a->m[4 * k + row] * b->m[4 * column + k];
        }
    }
    return out;
}

static inline float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const float a[3], const float b[3], float out[3])
{
    const float length_1[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                a[0] * b[1] - a[1] * b[0] };
    const float length = sqrtf(dot(length_1, length_1));
    for (int i = 0; i < 3; i++)
        out[i] = length_1[i] / length;
}

/* Returns the view matrix of a camera at `eye` that looks at the origin: +Y is down, +Z ahead. */
static inline struct matrix view_from_world(const float eye[3])
{
    const float up[3] = { 0, 1, 0 };
    const float length = sqrtf(dot(eye, eye));
    const float ahead[3] = { -eye[0] / length, -eye[1] / length, -eye[2] / length };
    float right[3], down[3];
    cross(ahead, up, right);
    cross(ahead, right, down);
    const struct matrix out = { { right[0], down[0], ahead[0], 0, right[1], down[1], ahead[1], 0,
                                  right[2], down[2], ahead[2], 0, -dot(right, eye), -dot(down, eye),
                                  -dot(ahead, eye), 1 } };
    return out;
}

/* Returns the projection to Vulkan's clip space; `aspect` is height / width. */
static inline struct matrix clip_from_view(float aspect)
{
    const float near = 0.1f, far = 40.0f;
    const struct matrix out = { { 1.5f * aspect, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, far / (far - near),
                                  1, 0, 0, -near * far / (far - near), 0 } };
    return out;
}

#endif
