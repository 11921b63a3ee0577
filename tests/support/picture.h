/*
 * picture.h: small test scenes, rendered images of them, and the camera rays of their pixels.
 *
 * Many scenes have *directions as colours*, (dir + 1) / 2 for the unit direction dir from the
 * camera, so that each pixel of an image shows the direction of its ray.
 */
#ifndef TESTS_PICTURE_H
#define TESTS_PICTURE_H

#include "src/render/renderer.h"
#include "tests/support/vec.h"

#define PICTURE_ALL_LAYERS UINT64_MAX

struct picture_request {
    const struct scene *scene;
    const struct settings *settings; /* NULL for those of picture_settings() */
    const char *refraction;          /* refraction model; NULL for paper */
    struct camera camera;
    uint32_t width, height, samples;
    uint64_t layers;
    bool display;
    float time; /* seconds */
    enum rg_sharing sharing;
};

/* Returns a layer's bit in picture_request.layers. */
uint64_t picture_layer_bit(const char *name);

/* Renders one linear image; any failure or validation message fails the test. */
struct render_result picture_render(struct gpu *gpu, const struct picture_request *request);

/*
 * A renderer for several images, because compiling shaders costs more than rendering a small image.
 *
 * Later requests may differ in camera, time and settings, except settings that change the shaders
 * (asserted). Must not be moved while open.
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
/* Changes the renderer to any other request of the same scene. */
void picture_change(struct picture_stage *stage, const struct picture_request *request);
void picture_end(struct picture_stage *stage);

/* Returns default settings with smooth ice, no lights and an assignment like "refract.ior=1.5". */
struct settings picture_settings(const char *assignment);

/* Returns the unit camera ray direction through an image point; pixel i's centre is at i + 0.5. */
struct vec picture_ray(const struct picture_request *request, double x, double y);

/* Returns the camera ray through the centre of pixel i, counted by rows from the top. */
struct vec picture_pixel_ray(const struct picture_request *request, size_t i);

/* Three planes of an image: N.X, N.Y and N.Z for layer "N"; R, G and B for the name "". */
struct picture_layer {
    const float *planes[3];
};

struct picture_layer picture_layer(const struct image *image, const char *name);
struct vec picture_at(struct picture_layer layer, size_t i);

/* Returns true if the object covers pixel i, where the exit layer is not zero. */
bool picture_is_object(struct picture_layer exit, size_t i);

/* ---- scenes; the caller frees them with scene_finish() ---- */

struct vec picture_direction_color(struct vec dir);

/* Returns a scene whose object is a unit sphere at the given centre. */
struct scene picture_sphere_scene(vec3s center, uint32_t triangles);

/* Adds an unlit ball around `center`, coloured by direction. */
void picture_add_directions(struct scene *scene, vec3s center, float radius);

/* Sets an environment map coloured by direction, width / 2 texels high. */
void picture_use_directions(struct scene *scene, uint32_t width);

struct picture_quad {
    vec3s top_left, right, down; /* `right` and `down` are the edges from the top left corner */
    vec3s color;
    uint32_t material;
};

/* Adds a quad to the surroundings. Its normal is cross(down, right). */
void picture_add_quad(struct scene *scene, const struct picture_quad *quad);

/* Returns the q-quantile, q from 0 to 1. Sorts `values`, NaN last. */
double picture_quantile(double *values, size_t count, double q);

#endif
