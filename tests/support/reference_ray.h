/* reference_ray.h: layers of the reference renderer for one ray, and formulas to compare with. */
#ifndef TESTS_SUPPORT_REFERENCE_RAY_H
#define TESTS_SUPPORT_REFERENCE_RAY_H

#include "src/lab/reference/reference.h"
#include "tests/support/vec.h"

#define REFERENCE_RAY_PI 3.141592653589793

/* Values of the reference renderer's layers for one ray. */
struct reference_ray {
    struct vec color, exit, refraction, reflection, remaining, normal, position;
    double fresnel, path, bounces, tir, inclusion_bits, z;
};

/* Returns default settings with a NULL-terminated list of assignments like "refract.ior=1.5". */
struct settings reference_ray_settings(const char *const *assignments);
#define SETTINGS(...) reference_ray_settings((const char *const[]){ __VA_ARGS__, NULL })

/* Returns the bit mask of all layers that the reference renderer computes. */
uint64_t reference_ray_layers(void);

/* Renders an image with the reference; any failure fails the test. */
struct render_result reference_ray_render_image(const struct reference_request *request,
                                                const struct renderer_shot *shot);

/* Traces one ray, as an image of one pixel. */
struct reference_ray reference_ray_trace(const struct scene *scene, const struct settings *settings,
                                         struct vec eye, struct vec dir);

/* Returns the Fresnel reflectance of unpolarised light from index n1 to n2; `angle` in radians. */
double reference_ray_fresnel(double angle, double n1, double n2);

/* Returns -Z rotated about +Y towards +X by `angle`, in radians. */
struct vec reference_ray_direction(double angle);

#endif
