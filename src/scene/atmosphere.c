/* atmosphere.c: tables of an atmosphere, and radiance by them. */
#include "src/scene/atmosphere.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979F

/* Kilometres. */
static const float ground_radius = 6360.0F, air_radius = 6460.0F;
static const float air_scale = 8.0F, haze_scale = 1.2F;      /* heights where density is 1/e */
static const float ozone_middle = 25.0F, ozone_half = 15.0F; /* a tent */

/* 1/km, at 680, 550 and 440 nm. */
static const vec3s air_scattering = { { 0.005802F, 0.013558F, 0.033100F } };
static const vec3s ozone_absorption = { { 0.000650F, 0.001881F, 0.000085F } };
static const float haze_unit = 0.003996F;                   /* scattering at turbidity 1.05 */
static const vec3s haze_color = { { 0.76F, 1.0F, 1.34F } }; /* wavelength to the power -1.3 */
static const float haze_per_turbidity = 20.4F;              /* haze_units */
static const float haze_single_albedo = 0.9F, haze_mean_cosine = 0.8F;

enum {
    PATH_STEPS = 40,
    GLOW_STEPS = 40,
    SKY_STEPS = 64,
    GLOW_TURNS = 8,
    GLOW_RINGS = 8
};

/* What a kilometre of air does at a height. */
struct medium {
    vec3s by_air, by_haze; /* scattering coefficients */
    vec3s scattering, extinction;
};

/* A point over the ground, seen in the plane of its zenith. */
struct place {
    float radius; /* from the planet's middle */
    float sun;    /* cosine of the angle from zenith to sun */
};

struct ray {
    vec3s origin, dir; /* from the planet's middle */
    float length;      /* to the ground or the end of the air */
    bool meets_ground;
};

static vec3s exp_minus(vec3s depth)
{
    return (vec3s){ { expf(-depth.x), expf(-depth.y), expf(-depth.z) } };
}

static struct medium medium_at(const struct atmosphere *a, float height)
{
    const float ozone = fmaxf(0.0F, 1.0F - fabsf(height - ozone_middle) / ozone_half);
    struct medium m = {
        .by_air = glms_vec3_scale(air_scattering, expf(-height / air_scale)),
        .by_haze = glms_vec3_scale(a->haze, expf(-height / haze_scale)),
    };
    m.scattering = glms_vec3_add(m.by_air, m.by_haze);
    m.extinction = glms_vec3_add(m.by_air, glms_vec3_scale(m.by_haze, 1.0F / haze_single_albedo));
    m.extinction = glms_vec3_add(m.extinction, glms_vec3_scale(ozone_absorption, ozone));
    return m;
}

/* Distance along a ray to the end of the air. */
static float to_space(float radius, float cosine)
{
    const float d = radius * radius * (cosine * cosine - 1.0F) + air_radius * air_radius;
    return fmaxf(0.0F, sqrtf(fmaxf(d, 0.0F)) - radius * cosine);
}

/* Distance along a ray to the ground; negative where it meets none. */
static float to_ground(float radius, float cosine)
{
    const float d = radius * radius * (cosine * cosine - 1.0F) + ground_radius * ground_radius;
    return cosine < 0.0F && d >= 0.0F ? fmaxf(0.0F, -radius * cosine - sqrtf(d)) : -1.0F;
}

/* Bruneton's mapping: distances to the end of the air between the shortest and the longest. */
static void path_place(float u, float v, float *radius, float *cosine)
{
    const float whole = sqrtf(air_radius * air_radius - ground_radius * ground_radius);
    const float horizon = v * whole;
    *radius = sqrtf(horizon * horizon + ground_radius * ground_radius);
    const float least = air_radius - *radius, d = least + u * (horizon + whole - least);
    *cosine = d > 0.0F ? (whole * whole - horizon * horizon - d * d) / (2.0F * *radius * d) : 1.0F;
    *cosine = glm_clamp(*cosine, -1.0F, 1.0F);
}

static vec3s optical_depth(const struct atmosphere *a, float radius, float cosine)
{
    const float length = to_space(radius, cosine);
    vec3s depth = { { 0.0F, 0.0F, 0.0F } };
    float before = 0.0F;
    for (int i = 1; i <= PATH_STEPS;
         i++) { /* short where the air is dense: rays leave the ground */
        const float share = (float)i / PATH_STEPS, after = length * share * share;
        const float t = 0.5F * (before + after);
        const float r = sqrtf(radius * radius + t * t + 2.0F * radius * cosine * t);
        const struct medium m = medium_at(a, r - ground_radius);
        depth = glms_vec3_add(depth, glms_vec3_scale(m.extinction, after - before));
        before = after;
    }
    return depth;
}

static vec3s path_texel(const struct atmosphere *a, float x, float y)
{
    const int x0 = (int)x, y0 = (int)y;
    const int x1 = x0 + 1 < ATMOSPHERE_PATH_WIDTH ? x0 + 1 : x0;
    const int y1 = y0 + 1 < ATMOSPHERE_PATH_HEIGHT ? y0 + 1 : y0;
    const vec3s low = glms_vec3_lerp(a->path[y0][x0], a->path[y0][x1], x - (float)x0);
    const vec3s high = glms_vec3_lerp(a->path[y1][x0], a->path[y1][x1], x - (float)x0);
    return glms_vec3_lerp(low, high, y - (float)y0);
}

static vec3s transmittance(const struct atmosphere *a, float radius, float cosine)
{
    if (to_ground(radius, cosine) >= 0.0F)
        return (vec3s){ { 0.0F, 0.0F, 0.0F } };
    const float whole = sqrtf(air_radius * air_radius - ground_radius * ground_radius);
    const float above = radius * radius - ground_radius * ground_radius;
    const float horizon = sqrtf(fmaxf(above, 0.0F));
    const float least = air_radius - radius;
    const float u = (to_space(radius, cosine) - least) / (horizon + whole - least);
    return path_texel(a, glm_clamp(u, 0.0F, 1.0F) * (ATMOSPHERE_PATH_WIDTH - 1),
                      glm_clamp(horizon / whole, 0.0F, 1.0F) * (ATMOSPHERE_PATH_HEIGHT - 1));
}

vec3s atmosphere_transmittance(const struct atmosphere *atmosphere, float height, float cosine)
{
    return transmittance(atmosphere, ground_radius + height, cosine);
}

/* All further orders of scattering, over the scattering coefficient. */
static vec3s glow(const struct atmosphere *a, struct place at)
{
    const float side = ATMOSPHERE_GLOW_SIDE - 1;
    const float x = glm_clamp(at.sun * 0.5F + 0.5F, 0.0F, 1.0F) * side;
    const float share = (at.radius - ground_radius) / (air_radius - ground_radius);
    const float y = glm_clamp(share, 0.0F, 1.0F) * side;
    const int x0 = (int)x, y0 = (int)y;
    const int x1 = x0 + 1 < ATMOSPHERE_GLOW_SIDE ? x0 + 1 : x0;
    const int y1 = y0 + 1 < ATMOSPHERE_GLOW_SIDE ? y0 + 1 : y0;
    const vec3s low = glms_vec3_lerp(a->glow[y0][x0], a->glow[y0][x1], x - (float)x0);
    const vec3s high = glms_vec3_lerp(a->glow[y1][x0], a->glow[y1][x1], x - (float)x0);
    return glms_vec3_lerp(low, high, y - (float)y0);
}

static struct ray ray_from(float radius, vec3s dir)
{
    struct ray ray = { .origin = { { 0.0F, radius, 0.0F } }, .dir = dir };
    const float ground = to_ground(radius, dir.y);
    ray.meets_ground = ground >= 0.0F;
    ray.length = ray.meets_ground ? ground : to_space(radius, dir.y);
    return ray;
}

static struct place place_at(const struct ray *ray, float t, vec3s sun)
{
    const vec3s point = glms_vec3_add(ray->origin, glms_vec3_scale(ray->dir, t));
    const float radius = glms_vec3_norm(point);
    return (struct place){ radius, glms_vec3_dot(point, sun) / radius };
}

/* The sun's light that the ground at the end of a ray sends back, before the air dims it. */
static vec3s lit_ground(const struct atmosphere *a, const struct ray *ray, vec3s sun)
{
    struct place at = place_at(ray, ray->length, sun);
    at.radius = ground_radius + 1e-3F; /* not below itself */
    const float share = a->albedo / PI * fmaxf(at.sun, 0.0F);
    return glms_vec3_scale(transmittance(a, at.radius, at.sun), share);
}

/* Of one step: `source` is emitted evenly along it and dimmed by its own extinction. */
static vec3s emitted(vec3s source, vec3s extinction, float step)
{
    const vec3s kept = exp_minus(glms_vec3_scale(extinction, step));
    return glms_vec3_div(glms_vec3_sub(source, glms_vec3_mul(source, kept)), extinction);
}

/* One ray of the table of further orders: adds to the light of the second order and to the share
 * that each order passes on to the next (Hillaire's equations 5 and 7). */
static void add_orders(const struct atmosphere *a, const struct ray *ray, vec3s sun, vec3s *second,
                       vec3s *passed_on)
{
    vec3s through = { { 1.0F, 1.0F, 1.0F } };
    float before = 0.0F;
    for (int i = 1; i <= GLOW_STEPS; i++) {
        const float share = (float)i / GLOW_STEPS, after = ray->length * share * share;
        const float step = after - before;
        const struct place at = place_at(ray, before + 0.3F * step, sun);
        const struct medium m = medium_at(a, at.radius - ground_radius);
        const vec3s whole = emitted(m.scattering, m.extinction, step);
        const vec3s arrives = glms_vec3_scale(transmittance(a, at.radius, at.sun), 0.25F / PI);
        const vec3s lit = glms_vec3_mul(whole, arrives);
        *second = glms_vec3_add(*second, glms_vec3_mul(through, lit));
        *passed_on = glms_vec3_add(*passed_on, glms_vec3_mul(through, whole));
        through = glms_vec3_mul(through, exp_minus(glms_vec3_scale(m.extinction, step)));
        before = after;
    }
    if (ray->meets_ground)
        *second = glms_vec3_add(*second, glms_vec3_mul(through, lit_ground(a, ray, sun)));
}

static vec3s glow_at(const struct atmosphere *a, float radius, float sun_cosine)
{
    const vec3s sun = { { sqrtf(fmaxf(0.0F, 1.0F - sun_cosine * sun_cosine)), sun_cosine, 0.0F } };
    vec3s second = { { 0.0F, 0.0F, 0.0F } }, passed_on = second;
    for (int ring = 0; ring < GLOW_RINGS; ring++) {
        const float y = 1.0F - 2.0F * ((float)ring + 0.5F) / GLOW_RINGS;
        const float across = sqrtf(1.0F - y * y);
        for (int turn = 0; turn < GLOW_TURNS; turn++) {
            const float angle = 2.0F * PI * ((float)turn + 0.5F) / GLOW_TURNS;
            const vec3s dir = { { across * cosf(angle), y, across * sinf(angle) } };
            const struct ray ray = ray_from(radius, dir);
            add_orders(a, &ray, sun, &second, &passed_on);
        }
    }
    const float mean = 1.0F / (GLOW_RINGS * GLOW_TURNS);
    const vec3s kept = glms_vec3_scale(passed_on, -mean);
    return glms_vec3_div(glms_vec3_scale(second, mean), glms_vec3_adds(kept, 1.0F));
}

void atmosphere_make(struct atmosphere *atmosphere, float turbidity, float albedo)
{
    const float units = haze_per_turbidity * (turbidity - 1.0F);
    atmosphere->haze = glms_vec3_scale(haze_color, haze_unit * units);
    atmosphere->albedo = albedo;
    for (int y = 0; y < ATMOSPHERE_PATH_HEIGHT; y++) {
        for (int x = 0; x < ATMOSPHERE_PATH_WIDTH; x++) {
            float radius = 0.0F, cosine = 0.0F;
            path_place((float)x / (ATMOSPHERE_PATH_WIDTH - 1),
                       (float)y / (ATMOSPHERE_PATH_HEIGHT - 1), &radius, &cosine);
            atmosphere->path[y][x] = exp_minus(optical_depth(atmosphere, radius, cosine));
        }
    }
    const float side = ATMOSPHERE_GLOW_SIDE - 1, depth = air_radius - ground_radius;
    for (int y = 0; y < ATMOSPHERE_GLOW_SIDE; y++) {
        const float height = glm_clamp((float)y / side * depth, 1e-3F, depth - 1e-3F);
        for (int x = 0; x < ATMOSPHERE_GLOW_SIDE; x++)
            atmosphere->glow[y][x] =
                glow_at(atmosphere, ground_radius + height, 2.0F * (float)x / side - 1.0F);
    }
}

vec3s atmosphere_radiance(const struct atmosphere *atmosphere, float height, vec3s dir, vec3s sun)
{
    const struct ray ray = ray_from(ground_radius + height, dir);
    const float c = glms_vec3_dot(dir, sun), g = haze_mean_cosine;
    const float by_air = 3.0F / (16.0F * PI) * (1.0F + c * c);
    const float by_haze = 3.0F / (8.0F * PI) * (1.0F - g * g) * (1.0F + c * c) /
                          ((2.0F + g * g) * powf(1.0F + g * g - 2.0F * g * c, 1.5F));
    vec3s through = { { 1.0F, 1.0F, 1.0F } }, light = { { 0.0F, 0.0F, 0.0F } };
    float before = 0.0F;
    for (int i = 1; i <= SKY_STEPS; i++) { /* short near the eye, where the air is dense */
        const float share = (float)i / SKY_STEPS, after = ray.length * share * share;
        const float step = after - before;
        const struct place at = place_at(&ray, before + 0.3F * step, sun);
        const struct medium m = medium_at(atmosphere, at.radius - ground_radius);
        const vec3s phases =
            glms_vec3_add(glms_vec3_scale(m.by_air, by_air), glms_vec3_scale(m.by_haze, by_haze));
        const vec3s direct = glms_vec3_mul(transmittance(atmosphere, at.radius, at.sun), phases);
        const vec3s further = glms_vec3_mul(glow(atmosphere, at), m.scattering);
        const vec3s added = emitted(glms_vec3_add(direct, further), m.extinction, step);
        light = glms_vec3_add(light, glms_vec3_mul(through, added));
        through = glms_vec3_mul(through, exp_minus(glms_vec3_scale(m.extinction, step)));
        before = after;
    }
    if (ray.meets_ground)
        light = glms_vec3_add(light, glms_vec3_mul(through, lit_ground(atmosphere, &ray, sun)));
    return light;
}
