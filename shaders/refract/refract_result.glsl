/* refract_result.glsl: result of a refraction model: the path of light through the ice. */
#ifndef REFRACT_RESULT_GLSL
#define REFRACT_RESULT_GLSL
#include "lib/optics.glsl"
#include "refract/refract_front_face_input.glsl"

/* Path of light through the ice, traced from the camera. */
struct refract_path {
    vec3 dir;      /* exit direction */
    vec3 point;    /* exit point in world space */
    float path;    /* metres; 0 if not computed */
    float bounces; /* number of total internal reflections */
    float tir;     /* 1 if first face reflects totally */
};

/* Returns the path of colour channel `channel`, 0 to 2. Each model defines this function. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel);

vec3 refract_front_point()
{
    return refract_frame.eye + eye_to_point;
}

/* Returns a path that is refracted at the front face only. */
refract_path refract_leave_at_front(vec3 dir)
{
    return refract_path(dir, refract_front_point(), 0.0, 0.0, 0.0);
}

#endif
