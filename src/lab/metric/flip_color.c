/* flip_color.c: colour spaces and colour distance of FLIP. */
#include "src/lab/metric/flip_color.h"
#include <math.h>

/* Row-major matrix from linear Rec.709 to XYZ relative to the D65 white point. */
static const float white_from_linear[3][3] = {
    { 0.433895389f, 0.376242373f, 0.189862239f },
    { 0.212636822f, 0.715182982f, 0.072180196f },
    { 0.017752423f, 0.109465629f, 0.872781948f },
};

/* The inverse of white_from_linear. */
static const float linear_from_white[3][3] = {
    { 3.080341988f, -1.537398969f, -0.542943019f },
    { -0.921178396f, 1.875929984f, 0.045248412f },
    { 0.052881293f, -0.204011206f, 1.151129913f },
};

static vec3s multiply(const float matrix[static 3][3], vec3s v)
{
    vec3s result;
    for (int i = 0; i < 3; i++)
        result.raw[i] = matrix[i][0] * v.x + matrix[i][1] * v.y + matrix[i][2] * v.z;
    return result;
}

/* Computes YCxCz from XYZ relative to white, or CIE L*a*b* from the cube roots of XYZ. */
static vec3s oppose(vec3s v)
{
    return (vec3s){ { 116.0f * v.y - 16.0f, 500.0f * (v.x - v.y), 200.0f * (v.y - v.z) } };
}

vec3s flip_color_opponent(vec3s linear)
{
    return oppose(multiply(white_from_linear, linear));
}

vec3s flip_color_linear(vec3s opponent)
{
    const float y = flip_color_luminance(opponent.x);
    const vec3s white = { { y + opponent.y / 500.0f, y, y - opponent.z / 200.0f } };
    return multiply(linear_from_white, white);
}

float flip_color_luminance(float y)
{
    return (y + 16.0f) / 116.0f;
}

/* Evaluates the nonlinearity of L*a*b*: a cube root, but linear near 0 (CIE 15:2004, 8.2.1). */
static float root(float x)
{
    const float delta = 6.0f / 29.0f;
    return x > delta * delta * delta ? cbrtf(x) : x / (3.0f * delta * delta) + 4.0f / 29.0f;
}

vec3s flip_color_hunt(vec3s linear)
{
    const vec3s white = multiply(white_from_linear, linear);
    vec3s lab = oppose((vec3s){ { root(white.x), root(white.y), root(white.z) } });
    lab.y *= 0.01f * lab.x;
    lab.z *= 0.01f * lab.x;
    return lab;
}

float flip_color_distance(vec3s a, vec3s b)
{
    const float y = a.y - b.y, z = a.z - b.z;
    return fabsf(a.x - b.x) + sqrtf(y * y + z * z);
}

float flip_color_error(float distance)
{
    const float distance_max = 41.2760984f; /* (HyAB distance green to blue)^0.7 */
    const float knee = 0.4f * distance_max, error_at_knee = 0.95f;
    const float power = powf(distance, 0.7f);
    if (power < knee)
        return error_at_knee / knee * power;
    return fminf(error_at_knee + (1.0f - error_at_knee) * (power - knee) / (distance_max - knee),
                 1.0f);
}
