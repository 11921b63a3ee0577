/*
 * fuzz_camera.c: parses the input as camera options, one per line, such as "eye 1,2,3". Each is
 * taken or refused; a camera that comes of them sees: its matrices are finite, its axes unit and
 * square.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#include "src/app/app.h"
#include "src/render/frame/frame_uniforms.h"
#include "tests/fuzz/fuzz.h"

enum {
    LINE_COUNT = 8,
};

static const char *const names[] = { "eye", "target", "orbit", "fov", "size", "background" };

static bool is_unit(vec3s v)
{
    return fabsf(glms_vec3_norm(v) - 1) < 1e-3F;
}

static void check_matrix(mat4s matrix)
{
    for (int i = 0; i < 16; i++)
        FUZZ_CHECK(isfinite(matrix.raw[i / 4][i % 4]));
}

static void check_camera(const struct camera *camera, const struct setup_image *picture)
{
    const struct camera_basis basis = camera_basis(camera);
    FUZZ_CHECK(is_unit(basis.right) && is_unit(basis.up) && is_unit(basis.forward));
    FUZZ_CHECK(fabsf(glms_vec3_dot(basis.right, basis.forward)) < 1e-3F);
    FUZZ_CHECK(fabsf(glms_vec3_dot(basis.up, basis.forward)) < 1e-3F);
    check_matrix(camera_view_from_world(camera));
    check_matrix(camera_clip_from_world(camera, picture->width, picture->height, 0.01F,
                                        (vec2s){ { 0.5F, -0.5F } }));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct scene scene = { .box = { { { -1, -1, -1 } }, { { 1, 2, 1 } } } };
    struct setup_image picture = {
        .scene = { .settings = settings_default() },
        .refraction = techniques_refraction(0),
        .width = 64,
        .height = 48,
    };
    struct camera camera;
    char *text = fuzz_text(data, size);
    char *line = text;
    for (int i = 0; line && i < LINE_COUNT; i++) {
        char *end = strchr(line, '\n');
        char *value = strchr(line, ' ');
        if (end)
            *end = '\0';
        for (size_t k = 0; value && k < sizeof(names) / sizeof(names[0]); k++) {
            const size_t length = strlen(names[k]);
            if (strncmp(line, names[k], length) == 0 && line[length] == ' ')
                (void)!app_set_option(&picture, names[k], line + length + 1);
        }
        line = end ? end + 1 : NULL;
    }
    free(text);
    /* what a refused option leaves is not used */
    if (setup_camera(&camera, &scene, &picture) == STATUS_OK)
        check_camera(&camera, &picture);
    return 0;
}
