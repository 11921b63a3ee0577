/* seen.h: what the traced reference sees along one ray, and what the laws of optics say. */
#ifndef TESTS_SEEN_H
#define TESTS_SEEN_H

#include "src/reference/reference.h"
#include "tests/support/vec.h"

#define SEEN_PI 3.141592653589793

/* What one ray gives. */
struct seen {
    struct vec color, exit, refraction, reflection, remaining, normal, position;
    double fresnel, path, bounces, tir, met, z;
};

/* The defaults with assignments, "refract.ior=1.5"; the list ends at NULL. */
struct settings seen_settings(const char *const *assignments);
#define SETTINGS(...) seen_settings((const char *const[]){ __VA_ARGS__, NULL })

/* All layers that the reference has. */
uint32_t seen_layers(void);

/* Traces a picture; any failure fails the test. */
struct render_result seen_trace(const struct reference_request *request,
                                const struct renderer_shot *shot);

/* Traces a picture of one pixel. */
struct seen seen_look(const struct scene *scene, const struct settings *settings, struct vec eye,
                      struct vec dir);

/* The reflectance of light at an angle of incidence, radians, from n1 to n2. */
double seen_fresnel(double angle, double n1, double n2);

/* Turned about +Y from -Z toward +X; radians. */
struct vec seen_direction(double angle);

#endif
