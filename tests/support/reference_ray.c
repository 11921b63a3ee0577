/* reference_ray.c: traces single rays with the reference renderer, as images of one pixel. */
#include "tests/support/reference_ray.h"
#include <math.h>
#include "src/lab/reference/reference_aov_table.h"
#include "tests/support/assertions.h"
#include "tests/support/picture.h"

struct settings reference_ray_settings(const char *const *assignments)
{
    struct settings settings = settings_default();
    for (; *assignments; assignments++)
        assert_int_equal(settings_assign(&settings, *assignments, SETTING_USER, NULL), STATUS_OK);
    return settings;
}

uint64_t reference_ray_layers(void)
{
    uint64_t layers = 0;
    for (uint32_t i = 0; techniques_layer(i); i++)
        layers |= reference_has_layer(techniques_layer(i)) ? UINT64_C(1) << i : 0;
    return layers;
}

struct render_result reference_ray_render_image(const struct reference_request *request,
                                                const struct renderer_shot *shot)
{
    struct reference *reference;
    struct render_result result = { 0 };
    assert_int_equal(reference_create(&reference, request), STATUS_OK);
    assert_int_equal(reference_render(reference, shot, &result, NULL, NULL), STATUS_OK);
    reference_destroy(reference);
    return result;
}

static double value(const struct image *image, const char *plane)
{
    const float *texels = image_find(image, plane);
    assert_non_null(texels);
    return (double)texels[0];
}

struct reference_ray reference_ray_trace(const struct scene *scene, const struct settings *settings,
                                         struct vec eye, struct vec dir)
{
    const struct vec target = vec_add(eye, 1, dir);
    const struct reference_request request = {
        .scene = scene,
        .settings = settings,
        .width = 1,
        .height = 1,
        .layers = reference_ray_layers(),
        .linear = true,
        .threads = 1,
    };
    const struct renderer_shot shot = {
        .camera = {
            .eye = { { (float)eye.x, (float)eye.y, (float)eye.z } },
            .target = { { (float)target.x, (float)target.y, (float)target.z } },
            .fov_deg = 1,
        },
    };
    struct render_result result = reference_ray_render_image(&request, &shot);
    const struct image *image = &result.image;
    const struct reference_ray reference_ray = {
        .color = picture_at(picture_layer(image, ""), 0),
        .exit = picture_at(picture_layer(image, "exit"), 0),
        .refraction = picture_at(picture_layer(image, "refraction"), 0),
        .reflection = picture_at(picture_layer(image, "reflection"), 0),
        .remaining = picture_at(picture_layer(image, "remaining"), 0),
        .normal = picture_at(picture_layer(image, "N"), 0),
        .position = picture_at(picture_layer(image, "P"), 0),
        .fresnel = value(image, "fresnel.Z"),
        .path = value(image, "path.Z"),
        .bounces = value(image, "bounces.Z"),
        .tir = value(image, "tir.Z"),
        .inclusion_bits = value(image, "inclusions.Z"),
        .z = value(image, "Z"),
    };
    render_result_finish(&result);
    return reference_ray;
}

double reference_ray_fresnel(double angle, double n1, double n2)
{
    const double ci = cos(angle);
    const double s = n1 / n2 * sin(angle);
    const double ct = sqrt(1 - s * s);
    const double rs = (n1 * ci - n2 * ct) / (n1 * ci + n2 * ct);
    const double rp = (n2 * ci - n1 * ct) / (n2 * ci + n1 * ct);
    return (rs * rs + rp * rp) / 2;
}

struct vec reference_ray_direction(double angle)
{
    return (struct vec){ sin(angle), 0, -cos(angle) };
}
