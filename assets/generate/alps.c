/*
 * alps.c: renders alps.exr, a panorama of mountains around a lake under a clear sky, without the
 * sun's disc, by marching over a height field (alps_terrain.c).
 *
 * Usage: alps FILE [WIDTH], WIDTH: pixels, even, default 3456; the height is half. Below 1024 the
 * height field is coarser, too.
 *
 * Radiance is linear; 1 is that of a white horizontal surface. Sky, aerial perspective and ground
 * lighting use one atmosphere model (src/scene/environment/atmosphere.h). The file stores the sun
 * as ENVIRONMENT_SUN_TEXT (src/scene/environment/environment.h).
 */
#include "assets/generate/alps.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/file/exr.h"
#include "src/scene/environment/atmosphere.h"
#include "src/scene/environment/environment.h"

#define PI 3.14159265358979F

enum {
    SKY_COLUMNS = 512,
    SKY_ROWS = 256,
    SUPERSAMPLING = 2,
    SHADOW_STEPS = 90
};

static const float sun_azimuth = 248.0F, sun_elevation = 22.0F; /* degrees, as in firn's settings */
static const float sun_irradiance = 10.5F; /* irradiance above the atmosphere, per colour channel */
static const float turbidity = 5.5F, ground_albedo = 0.3F;
static const float eye_height = 900.0F, lake_height_km = 1.2F; /* camera over lake; lake over sea */
static const float planet = 6360e3F;                           /* radius of the planet, metres */
static const float farthest = 52e3F;

struct scene {
    struct alps alps;
    struct atmosphere atmosphere;
    vec3s sun, sun_light, balance; /* sun direction; irradiance facing the sun; white balance */
    vec3s ambient;                 /* sky irradiance on horizontal ground / pi */
    vec3s sky[SKY_ROWS][SKY_COLUMNS];
};

/* A visible point of the ground. */
struct ground {
    vec3s point, normal;
    float distance, flow;
    float level;  /* cosine of the slope angle, averaged over tens of metres */
    float across; /* position across the fall line, metres */
};

static vec3s color(float r, float g, float b)
{
    return (vec3s){ { r, g, b } };
}

static vec3s direction(float azimuth, float elevation)
{
    return color(sinf(azimuth) * cosf(elevation), sinf(elevation), cosf(azimuth) * cosf(elevation));
}

/* Interpolates the sky radiance in a table that is finer near the horizon. */
static vec3s sky_radiance(const struct scene *scene, vec3s dir)
{
    const float turn = atan2f(dir.x, dir.z) / (2.0F * PI);
    const float x = (turn - floorf(turn)) * SKY_COLUMNS;
    const float up = sqrtf(fmaxf(asinf(glm_clamp(dir.y, 0.0F, 1.0F)) / (0.5F * PI), 0.0F));
    const float y = fminf(up * (SKY_ROWS - 1), SKY_ROWS - 1.001F);
    const int x0 = (int)x % SKY_COLUMNS, x1 = (x0 + 1) % SKY_COLUMNS, y0 = (int)y;
    const vec3s low = glms_vec3_lerp(scene->sky[y0][x0], scene->sky[y0][x1], x - floorf(x));
    const vec3s high =
        glms_vec3_lerp(scene->sky[y0 + 1][x0], scene->sky[y0 + 1][x1], x - floorf(x));
    return glms_vec3_lerp(low, high, y - (float)y0);
}

static void make_light(struct scene *scene)
{
    atmosphere_make(&scene->atmosphere, turbidity, ground_albedo);
    scene->sun = direction(sun_azimuth * PI / 180.0F, sun_elevation * PI / 180.0F);
    scene->sun_light = glms_vec3_scale(
        atmosphere_transmittance(&scene->atmosphere, lake_height_km, scene->sun.y), sun_irradiance);
    vec3s sum = color(0.0F, 0.0F, 0.0F);
    float weights = 0.0F;
    for (int y = 0; y < SKY_ROWS; y++) {
        const float share = (float)y / (SKY_ROWS - 1), up = 0.5F * PI * share * share;
        for (int x = 0; x < SKY_COLUMNS; x++) {
            const vec3s dir = direction(2.0F * PI * (float)x / SKY_COLUMNS, fmaxf(up, 1e-4F));
            scene->sky[y][x] = glms_vec3_scale(
                atmosphere_radiance(&scene->atmosphere, lake_height_km, dir, scene->sun),
                sun_irradiance);
            const float weight = share * cosf(up) * sinf(up);
            sum = glms_vec3_add(sum, glms_vec3_scale(scene->sky[y][x], weight));
            weights += weight;
        }
    }
    scene->ambient = glms_vec3_scale(sum, 1.0F / weights);
    const vec3s white =
        glms_vec3_add(glms_vec3_scale(scene->sun_light, scene->sun.y / PI), scene->ambient);
    scene->balance = glms_vec3_lerp(color(1.0F, 1.0F, 1.0F),
                                    color(white.y / white.x, 1.0F, white.y / white.z), 0.6F);
}

static float drop(float distance)
{
    return distance * distance / (2.0F * planet);
}

/* Returns the fraction of the sun's disc visible from a point, for soft shadows of mountains. */
static float sunlit(const struct scene *scene, vec3s point)
{
    float lit = 1.0F, t = 12.0F, flow = 0.0F;
    for (int i = 0; i < SHADOW_STEPS && t < 14000.0F && lit > 0.0F; i++, t *= 1.085F) {
        const vec3s at = glms_vec3_add(point, glms_vec3_scale(scene->sun, t));
        const float above = at.y - alps_height(&scene->alps, at.x, at.z, &flow);
        lit = fminf(lit, 0.5F + above / (t * 0.00465F * 2.0F)); /* sun's angular radius */
        if (at.y > 3600.0F)
            break;
    }
    return glm_clamp(lit, 0.0F, 1.0F);
}

static vec3s ground_albedo_at(const struct ground *g)
{
    const float x = g->point.x, z = g->point.z, height = g->point.y;
    const float patch = alps_noise(x, z, 900.0F, 5, 91), fine = alps_noise(x, z, 60.0F, 5, 97);
    const float level = g->level, moist = glm_clamp(logf(1.0F + g->flow) / 4.0F, 0.0F, 1.0F);
    const vec3s rock = glms_vec3_lerp(color(0.12F, 0.122F, 0.122F), color(0.25F, 0.245F, 0.235F),
                                      glm_clamp(0.5F + 0.7F * patch + 0.4F * fine, 0.0F, 1.0F));
    const vec3s scree = glms_vec3_scale(color(0.21F, 0.20F, 0.185F), 1.0F + 0.25F * fine);
    const vec3s meadow = glms_vec3_lerp(color(0.055F, 0.075F, 0.026F), color(0.10F, 0.095F, 0.045F),
                                        glm_clamp(0.5F + patch + 0.5F * fine, 0.0F, 1.0F));
    const float crowns = alps_noise(x, z, 26.0F, 2, 113); /* single trees, gaps */
    const vec3s forest =
        glms_vec3_scale(color(0.018F, 0.028F, 0.016F), 1.0F + 0.5F * fine + 0.8F * crowns);
    const vec3s snow = color(0.74F, 0.76F, 0.80F); /* old snow with dust */
    vec3s c = glms_vec3_lerp(rock, scree, glm_smoothstep(0.70F, 0.80F, level + 0.05F * fine));
    const float grown = glm_smoothstep(0.74F, 0.88F, level + 0.08F * patch + 0.05F * moist) *
                        (1.0F - glm_smoothstep(900.0F, 1500.0F, height + 500.0F * patch));
    c = glms_vec3_lerp(c, meadow, grown);
    /* Avalanches and rockfall have cleared lanes in the forest. */
    const float lane =
        glm_smoothstep(0.1F, 0.3F, alps_noise(g->across, 0.1F * height, 170.0F, 3, 59));
    const float wooded =
        glm_smoothstep(-0.16F, -0.06F,
                       alps_noise(x, z, 1500.0F, 6, 53) + 0.35F * crowns - 0.16F * lane) *
        glm_smoothstep(0.55F, 0.70F, level) * glm_smoothstep(8.0F, 40.0F, height) *
        (1.0F - glm_smoothstep(650.0F, 1050.0F, height + 350.0F * patch + 250.0F * crowns));
    c = glms_vec3_lerp(c, forest, wooded);
    /* Snow lies on ledges and in gullies; the strata dip to the east and break off in bands. */
    const float strata = alps_noise(0.0F, height + 0.12F * x + 60.0F * patch, 75.0F, 3, 103);
    const float line = 1750.0F + 420.0F * patch - 420.0F * moist;
    const float even = 0.45F * level + 0.55F * g->normal.y;
    const float track = alps_noise(g->across, 0.08F * height, 70.0F, 3, 109); /* avalanche tracks */
    const float lying =
        glm_smoothstep(line - 160.0F, line + 420.0F, height + 140.0F * fine) *
        glm_smoothstep(0.70F, 0.80F,
                       even + 0.08F * fine + 0.10F * strata + 0.06F * moist + 0.16F * track);
    return glms_vec3_lerp(c, glms_vec3_scale(snow, 1.0F + 0.12F * track), lying);
}

/* Applies aerial perspective: extinction along the path and in-scattered light, in one step with
 * the air density at the mean height of camera and point (Rayleigh and Cornette-Shanks phase
 * functions). */
static vec3s aerial_perspective(const struct scene *scene, vec3s light, vec3s dir, float metres,
                                float height)
{
    const float low = lake_height_km + 0.001F * eye_height;
    const float high = lake_height_km + 0.001F * fmaxf(height, 0.0F);
    const float middle = 0.5F * (low + high);
    const float c = glms_vec3_dot(dir, scene->sun), g = 0.8F;
    const vec3s rayleigh =
        glms_vec3_scale(color(0.005802F, 0.013558F, 0.0331F), expf(-middle / 8.0F));
    const vec3s by_haze = glms_vec3_scale(scene->atmosphere.haze, expf(-middle / 1.2F));
    const float air_phase = 3.0F / (16.0F * PI) * (1.0F + c * c);
    const float haze_phase = 3.0F / (8.0F * PI) * (1.0F - g * g) * (1.0F + c * c) /
                             ((2.0F + g * g) * powf(1.0F + g * g - 2.0F * g * c, 1.5F));
    const vec3s out = glms_vec3_add(rayleigh, glms_vec3_scale(by_haze, 1.0F / 0.9F));
    const vec3s direct =
        glms_vec3_mul(scene->sun_light, glms_vec3_add(glms_vec3_scale(rayleigh, air_phase),
                                                      glms_vec3_scale(by_haze, haze_phase)));
    /* in-scattering of sky and ground light, assumed isotropic */
    const vec3s around =
        glms_vec3_scale(glms_vec3_mul(scene->ambient, glms_vec3_add(rayleigh, by_haze)), 0.7F);
    vec3s sum;
    for (int i = 0; i < 3; i++) {
        const float kept = expf(-out.raw[i] * metres * 0.001F);
        sum.raw[i] =
            light.raw[i] * kept + (direct.raw[i] + around.raw[i]) * (1.0F - kept) / out.raw[i];
    }
    return sum;
}

/* Returns the slopes to the east in .x and to the south in .z, from differences over 2 e metres. */
static vec3s slope_at(const struct scene *scene, float x, float z, float e)
{
    const struct alps *alps = &scene->alps;
    float flow = 0.0F;
    const float dx = alps_height(alps, x + e, z, &flow) - alps_height(alps, x - e, z, &flow);
    const float dz = alps_height(alps, x, z + e, &flow) - alps_height(alps, x, z - e, &flow);
    return color(dx / (2.0F * e), 0.0F, dz / (2.0F * e));
}

static vec3s normal_at(const struct scene *scene, float x, float z, float distance)
{
    const vec3s slope = slope_at(scene, x, z, fmaxf(3.0F, 0.0016F * distance));
    /* normal perturbation by detail finer than the grid, faded out with distance */
    const float fine = glm_clamp(1.5F - distance / 9000.0F, 0.0F, 1.0F) * 1.5F;
    const float nx = alps_noise(x + 2.0F, z, 24.0F, 3, 7) - alps_noise(x - 2.0F, z, 24.0F, 3, 7);
    const float nz = alps_noise(x, z + 2.0F, 24.0F, 3, 7) - alps_noise(x, z - 2.0F, 24.0F, 3, 7);
    return glms_vec3_normalize(color(-slope.x - fine * nx, 1.0F, -slope.z - fine * nz));
}

static vec3s ground_radiance(const struct scene *scene, const struct ground *g, vec3s dir)
{
    const vec3s albedo = ground_albedo_at(g);
    const float facing = fmaxf(0.0F, glms_vec3_dot(g->normal, scene->sun));
    const float lit = facing > 0.0F ? sunlit(scene, g->point) * facing / PI : 0.0F;
    const float open = 0.5F + 0.5F * g->normal.y;
    vec3s light = glms_vec3_add(glms_vec3_scale(scene->sun_light, lit),
                                glms_vec3_scale(scene->ambient, open));
    /* indirect light from the surrounding ground, with a mean albedo of 0.15 */
    light = glms_vec3_add(
        light, glms_vec3_scale(scene->sun_light, (1.0F - open) * 0.15F * scene->sun.y / PI));
    return aerial_perspective(scene, glms_vec3_mul(albedo, light), dir, g->distance, g->point.y);
}

/* Draws the land of one pixel column, marching over the height field away from the camera. */
static void paint_land(const struct scene *scene, float azimuth, uint32_t rows, vec3s *column,
                       bool *drawn)
{
    const float ax = sinf(azimuth), az = cosf(azimuth);
    int painted = (int)rows; /* topmost row drawn so far; row 0 is the top */
    float t = 40.0F;
    while ((t += fmaxf(1.5F, 0.0016F * t)) < farthest) {
        struct ground g = { .distance = t };
        const float height = alps_height(&scene->alps, ax * t, az * t, &g.flow);
        if (height < 0.0F)
            continue; /* lake, drawn by paint_lake() */
        const float up = atanf((height - eye_height - drop(t)) / t);
        const int row = (int)ceilf((0.5F - up / PI) * (float)rows - 0.5F);
        if (row >= painted)
            continue;
        g.point = color(ax * t, height, az * t);
        g.normal = normal_at(scene, g.point.x, g.point.z, t);
        const vec3s slope = slope_at(scene, g.point.x, g.point.z, fmaxf(35.0F, 0.004F * t));
        const float steep = sqrtf(slope.x * slope.x + slope.z * slope.z);
        g.level = 1.0F / sqrtf(1.0F + steep * steep);
        g.across = (g.point.x * slope.z - g.point.z * slope.x) / fmaxf(steep, 1e-3F);
        const vec3s light = ground_radiance(scene, &g, direction(azimuth, up));
        for (int y = row < 0 ? 0 : row; y < painted; y++) {
            column[y] = light;
            drawn[y] = true;
        }
        painted = row;
    }
}

/* Returns the radiance of wet gravel, which covers the nadir and lights objects from below. */
static vec3s gravel(const struct scene *scene, float x, float z)
{
    const float stones = 0.5F * alps_noise(x, z, 6.0F, 2, 101);
    const vec3s light =
        glms_vec3_add(glms_vec3_scale(scene->sun_light, scene->sun.y / PI), scene->ambient);
    return glms_vec3_scale(glms_vec3_mul(color(0.135F, 0.13F, 0.12F), light), 1.0F + stones);
}

/* Draws the lake of one pixel column, with reflections of the column itself, and deep water. */
static void paint_lake(const struct scene *scene, float azimuth, uint32_t rows, vec3s *column,
                       bool *drawn)
{
    for (uint32_t y = rows / 2; y < rows; y++) {
        const float down = (((float)y + 0.5F) / (float)rows - 0.5F) * PI;
        const float t = eye_height / tanf(down);
        float flow = 0.0F;
        const float x = sinf(azimuth) * t, z = cosf(azimuth) * t;
        if (t > 2000.0F || alps_height(&scene->alps, x, z, &flow) >= 0.0F)
            continue;
        drawn[y] = true;
        if (t < 15.0F * (1.0F + 0.4F * alps_noise(x, z, 8.0F, 4, 83))) {
            column[y] = gravel(scene, x, z);
            continue;
        }
        const float slope = 0.02F * alps_noise(x, z, 9.0F, 4, 61); /* ripples */
        const float up = fmaxf(down + 2.0F * slope, 1e-3F);
        const uint32_t mirrored = (uint32_t)((0.5F - up / PI) * (float)rows);
        const float cosine = sinf(fmaxf(down + slope, 1e-3F));
        const float fresnel = 0.02F + 0.98F * powf(1.0F - cosine, 5.0F);
        const vec3s sky =
            drawn[mirrored] ? column[mirrored] : sky_radiance(scene, direction(azimuth, up));
        const vec3s deep = glms_vec3_mul(color(0.012F, 0.030F, 0.032F), scene->ambient);
        column[y] = glms_vec3_lerp(glms_vec3_scale(deep, 4.0F), sky, fresnel);
    }
}

static void paint_column(const struct scene *scene, float azimuth, uint32_t rows, vec3s *column,
                         bool *drawn)
{
    for (uint32_t y = 0; y < rows; y++)
        drawn[y] = false;
    paint_land(scene, azimuth, rows, column, drawn);
    paint_lake(scene, azimuth, rows, column, drawn);
    for (uint32_t y = 0; y < rows; y++) {
        const float up = (0.5F - ((float)y + 0.5F) / (float)rows) * PI;
        if (!drawn[y])
            column[y] = sky_radiance(scene, direction(azimuth, fmaxf(up, 0.0F)));
        column[y] = glms_vec3_mul(column[y], scene->balance);
    }
}

/* Renders all columns, SUPERSAMPLING^2 samples per pixel; -Z is in the centre of the panorama. */
static bool paint(const struct scene *scene, struct image *image)
{
    float *planes[3];
    for (size_t c = 0; c < 3; c++)
        planes[c] = image_add_plane(image, (const char *[]){ "R", "G", "B" }[c], true);
    const uint32_t rows = image->height * SUPERSAMPLING;
    vec3s *column = malloc(rows * sizeof(*column));
    bool *drawn = malloc(rows * sizeof(*drawn));
    const bool ok = column && drawn && planes[0] && planes[1] && planes[2];
    for (uint32_t x = 0; ok && x < image->width * SUPERSAMPLING; x++) {
        const float u = ((float)x + 0.5F) / (float)(image->width * SUPERSAMPLING);
        paint_column(scene, PI - 2.0F * PI * (u - 0.5F), rows, column, drawn);
        for (uint32_t y = 0; y < rows; y++)
            for (size_t c = 0; c < 3; c++)
                planes[c][(size_t)(y / SUPERSAMPLING) * image->width + x / SUPERSAMPLING] +=
                    column[y].raw[c] / (SUPERSAMPLING * SUPERSAMPLING);
    }
    free(column);
    free(drawn);
    return ok;
}

/* Rounds texels to 7 mantissa bits, or 6 if the next texel differs by over 3 %, so that the
 * file compresses to a quarter of its size without visible steps. */
static void round_texels(struct image *image)
{
    const size_t count = (size_t)image->width * image->height;
    for (uint32_t p = 0; p < image->plane_count; p++) {
        float *texels = image->planes[p].texels;
        for (size_t i = 0; i < count; i++) {
            const float next = texels[i + 1 < count ? i + 1 : i];
            const float steps = fabsf(next - texels[i]) > 0.03F * texels[i] ? 128.0F : 256.0F;
            int exponent = 0;
            const float mantissa = frexpf(texels[i], &exponent);
            texels[i] = ldexpf(roundf(mantissa * steps) / steps, exponent);
        }
    }
}

/* Writes the sun as text: azimuth, elevation, and radiance of a white surface that faces it. */
static void describe_sun(const struct scene *scene, char *text, size_t size)
{
    const vec3s light = glms_vec3_mul(scene->balance, glms_vec3_scale(scene->sun_light, 1.0F / PI));
    snprintf(text, size, "%g %g %.4g %.4g %.4g", (double)sun_azimuth, (double)sun_elevation,
             (double)light.x, (double)light.y, (double)light.z);
}

static bool write_file(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    const bool written = file && fwrite(data, 1, size, file) == size;
    return (file ? fclose(file) == 0 : false) && written;
}

int main(int argc, char **argv)
{
    char *end = NULL;
    const long width = argc == 3 ? strtol(argv[2], &end, 10) : 3456;
    if (argc < 2 || argc > 3 || (end && *end) || width < 64 || width > 16384 || width % 2) {
        fputs("usage: alps FILE [WIDTH]\n", stderr);
        return 2;
    }
    struct scene *scene = malloc(sizeof(*scene));
    struct image image;
    char sun[80];
    void *data = NULL;
    size_t size = 0;
    image_init(&image, (uint32_t)width, (uint32_t)width / 2);
    const uint32_t side = width < 1024 ? 257 : 1025;
    bool ok = scene && alps_make(&scene->alps, side);
    if (ok) {
        make_light(scene);
        ok = paint(scene, &image);
    }
    if (ok)
        round_texels(&image);
    if (ok)
        describe_sun(scene, sun, sizeof(sun));
    const struct image_text text = { ENVIRONMENT_SUN_TEXT, sun };
    const struct exr_header header = { .texts = &text, .text_count = 1 };
    ok = ok && !exr_encode(&image, &header, &data, &size) && write_file(argv[1], data, size);
    if (!ok)
        fprintf(stderr, "alps: cannot make '%s'\n", argv[1]);
    free(data);
    image_finish(&image);
    if (scene)
        alps_free(&scene->alps);
    free(scene);
    return ok ? 0 : 1;
}
