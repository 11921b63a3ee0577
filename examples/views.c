/* views.c: renders views of a glass teapot with depth, by the library.
 *
 *     cc -o views views.c $(pkg-config --cflags --libs firn) -lm
 *     ./views              writes view0.ppm to view3.ppm, and prints the depth of their centres
 */
#include <firn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define WIDTH  320
#define HEIGHT 240

static uint8_t colors[HEIGHT][WIDTH][3];
static float depth[HEIGHT][WIDTH];

static void check(firn_status status, const firn *device)
{
    if (status == FIRN_OK)
        return;
    fprintf(stderr, "%s\n", firn_error(device));
    exit(status);
}

int main(void)
{
    const char *options[] = { "material", "glass", "env", "studio", NULL };
    const char *layers[] = { "display", "Z" };
    struct firn_renderer_options image = { sizeof(image), WIDTH, HEIGHT, 2, layers, 2 };
    struct firn_buffer buffers[] = {
        { sizeof(buffers[0]), "display", colors, FIRN_UINT8, 3, 0, 0 },
        { sizeof(buffers[0]), "Z", depth, FIRN_FLOAT32, 1, 0, 0 },
    };
    firn *device;
    firn_scene *scene;
    firn_renderer *renderer;
    check(firn_open(NULL, &device), NULL);
    check(firn_scene_load(device, "teapot", options, &scene), device);
    check(firn_renderer_create(scene, &image, &renderer), device);
    for (int i = 0; i < 4; i++) {
        struct firn_camera camera = { sizeof(camera), FIRN_CAMERA_LOOK_AT };
        camera.eye[0] = 5 * sin(0.5 * i);
        camera.eye[1] = 1;
        camera.eye[2] = 5 * cos(0.5 * i);
        camera.fov_deg = 30;
        check(firn_render(renderer, &camera, buffers, 2, NULL, NULL), device);
        char name[] = "view0.ppm";
        name[4] = (char)(name[4] + i);
        FILE *file = fopen(name, "wb");
        if (!file || fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) < 0 ||
            fwrite(colors, sizeof(colors), 1, file) != 1 || fclose(file) != 0)
            return 1;
        printf("%s: %.3f m\n", name, (double)depth[HEIGHT / 2][WIDTH / 2]);
    }
    firn_renderer_close(renderer);
    firn_scene_close(scene);
    firn_close(device);
}
