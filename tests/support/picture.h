/*
 * picture.h: scenes made by hand, pictures of them, and the rays of their pixels.
 *
 * Many scenes have *directions as colours*, (dir + 1) / 2 for the unit direction dir from the eye,
 * so that a picture contains the direction in which each pixel looks.
 */
#ifndef TESTS_PICTURE_H
#define TESTS_PICTURE_H

#include "src/render/renderer.h"
#include "tests/support/vec.h"

#define PICTURE_ALL_LAYERS UINT32_MAX

struct picture_request {
    const struct scene *scene;
    const struct settings *settings; /* NULL: those of picture_settings() */
    const char *refraction;          /* NULL: paper */
    struct camera camera;
    uint32_t width, height, samples, layers;
    bool display;
    float time; /* seconds */
    enum rg_sharing sharing;
};

/* The bit of a layer in a request. */
uint32_t picture_layer_bit(const char *name);

/* One picture, linear always; any failure or validation message fails the test. */
struct render_result picture_render(struct gpu *gpu, const struct picture_request *request);

/*
 * Several of one renderer, whose shaders are compiled once, which costs more than small pictures.
 * Of later requests camera, time and settings may differ, but for settings that shaders are
 * compiled for: asserted. Must not move once opened.
 */
struct picture_stage {
    struct gpu *gpu;
    struct picture_request request;
    struct settings settings;
    struct renderer *renderer;
};

void picture_begin(struct picture_stage *stage, struct gpu *gpu,
                   const struct picture_request *request);
struct render_result picture_take(struct picture_stage *stage,
                                  const struct picture_request *request);
/* The same renderer for another request of the same scene, whatever it asks for. */
void picture_change(struct picture_stage *stage, const struct picture_request *request);
void picture_end(struct picture_stage *stage);

/* The defaults but for smooth ice and no lights, with one setting changed: "refract.ior=1.5". */
struct settings picture_settings(const char *assignment);

/* Unit direction from the eye through a point of the picture; pixel i's centre is at i + 0.5. */
struct vec picture_ray(const struct picture_request *request, double x, double y);

/* The same through the centre of pixel i, rows from the top. */
struct vec picture_pixel_ray(const struct picture_request *request, size_t i);

/* Three planes of a picture: "N" are N.X N.Y N.Z, "refraction" .R .G .B, "" the beauty. */
struct picture_layer {
    const float *planes[3];
};

struct picture_layer picture_layer(const struct image *image, const char *name);
struct vec picture_at(struct picture_layer layer, size_t i);

/* Where refracted light leaves is never {0} on the object, and {0} elsewhere. */
bool picture_is_object(struct picture_layer exit, size_t i);

/* ---- scenes; the caller finishes them ---- */

struct vec picture_direction_color(struct vec dir);

/* A unit sphere as the object; its centre as given. */
struct scene picture_sphere_scene(vec3s center, uint32_t triangles);

/* A ball of unlit directions as colours around a point. */
void picture_add_directions(struct scene *scene, vec3s center, float radius);

/* Directions as colours at infinity, as an environment picture, width / 2 texels high. */
void picture_use_directions(struct scene *scene, uint32_t width);

struct picture_quad {
    vec3s top_left, right, down; /* the latter two to the other corners */
    vec3s color;
    uint32_t material;
};

/* Its normal is down x right: toward whoever sees it the right way round. */
void picture_add_quad(struct scene *scene, const struct picture_quad *quad);

/* Sorts, NaN last; q from 0 to 1. */
double picture_quantile(double *values, size_t count, double q);

#endif
