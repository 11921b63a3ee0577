/* atmosphere.c: transmittance and multiple-scattering tables, and ray marching of the sky. */
#include "src/scene/environment/atmosphere.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979F

/* planet and atmosphere radius, km */
static const float ground_radius = 6360.0F, air_radius = 6460.0F;
/* scale heights of Rayleigh and Mie scattering, km */
static const float air_scale = 8.0F, haze_scale = 1.2F;
static const float ozone_center = 25.0F, ozone_half = 15.0F; /* triangular ozone profile, km */

/* Scattering and absorption coefficients in 1/km, for wavelengths of 680, 550 and 440 nm. */
static const vec3s air_scattering = { { 0.005802F, 0.013558F, 0.033100F } };
static const vec3s ozone_absorption = { { 0.000650F, 0.001881F, 0.000085F } };
static const float haze_unit = 0.003996F; /* Mie scattering coefficient at turbidity 1.05, 1/km */
/* spectrum of Mie scattering: wavelength^-1.3 */
static const vec3s haze_color = { { 0.76F, 1.0F, 1.34F } };
static const float haze_per_turbidity = 20.4F; /* haze units per unit of turbidity */
static const float haze_single_albedo = 0.9F, haze_g = 0.8F;

enum {
    PATH_STEPS = 40,
    GLOW_STEPS = 40,
    SKY_STEPS = 64,
    GLOW_AZIMUTHS = 8,
    GLOW_RINGS = 8
};

/* Coefficients of the atmosphere at a height, 1/km. */
struct medium {
    vec3s rayleigh, mie; /* Rayleigh and Mie scattering coefficients */
    vec3s scattering, extinction;
};

/* Point in the atmosphere. By symmetry, height and sun angle determine the light at the point. */
struct sample_point {
    float radius; /* distance from the planet's centre */
    float sun;    /* cosine of the sun's zenith angle */
};

struct ray {
    vec3s origin, dir; /* relative to the planet's centre */
    float length;      /* distance to the ground or to the top of the atmosphere, km */
    bool hits_ground;
};

static vec3s exp_minus(vec3s depth)
{
    return (vec3s){ { expf(-depth.x), expf(-depth.y), expf(-depth.z) } };
}

static struct medium medium_at(const struct atmosphere *a, float height)
{
    const float ozone = fmaxf(0.0F, 1.0F - fabsf(height - ozone_center) / ozone_half);
    struct medium m = {
        .rayleigh = glms_vec3_scale(air_scattering, expf(-height / air_scale)),
        .mie = glms_vec3_scale(a->haze, expf(-height / haze_scale)),
    };
    m.scattering = glms_vec3_add(m.rayleigh, m.mie);
    m.extinction = glms_vec3_add(m.rayleigh, glms_vec3_scale(m.mie, 1.0F / haze_single_albedo));
    m.extinction = glms_vec3_add(m.extinction, glms_vec3_scale(ozone_absorption, ozone));
    return m;
}

/* Returns the distance along a ray to the top of the atmosphere. */
static float distance_to_top(float radius, float cosine)
{
    const float d = radius * radius * (cosine * cosine - 1.0F) + air_radius * air_radius;
    return fmaxf(0.0F, sqrtf(fmaxf(d, 0.0F)) - radius * cosine);
}

/* Returns the distance along a ray to the ground; negative if it misses the ground. */
static float distance_to_ground(float radius, float cosine)
{
    const float d = radius * radius * (cosine * cosine - 1.0F) + ground_radius * ground_radius;
    return cosine < 0.0F && d >= 0.0F ? fmaxf(0.0F, -radius * cosine - sqrtf(d)) : -1.0F;
}

/* Maps texture coordinates (u, v) of the transmittance table (Bruneton) to a radius and a cosine. u
 * is 0 at the minimum distance to the top of the atmosphere, and 1 at the maximum distance. */
static void transmittance_params(float u, float v, float *radius, float *cosine)
{
    const float whole = sqrtf(air_radius * air_radius - ground_radius * ground_radius);
    const float horizon = v * whole;
    *radius = sqrtf(horizon * horizon + ground_radius * ground_radius);
    const float shortest = air_radius - *radius, d = shortest + u * (horizon + whole - shortest);
    *cosine = d > 0.0F ? (whole * whole - horizon * horizon - d * d) / (2.0F * *radius * d) : 1.0F;
    *cosine = glm_clamp(*cosine, -1.0F, 1.0F);
}

static vec3s optical_depth(const struct atmosphere *a, float radius, float cosine)
{
    const float length = distance_to_top(radius, cosine);
    vec3s depth = { { 0.0F, 0.0F, 0.0F } };
    float before = 0.0F;
    /* Takes short steps near the ground, where air is dense. */
    for (int i = 1; i <= PATH_STEPS; i++) {
        const float fraction = (float)i / PATH_STEPS, after = length * fraction * fraction;
        const float t = 0.5F * (before + after);
        const float r = sqrtf(radius * radius + t * t + 2.0F * radius * cosine * t);
        const struct medium m = medium_at(a, r - ground_radius);
        depth = glms_vec3_add(depth, glms_vec3_scale(m.extinction, after - before));
        before = after;
    }
    return depth;
}

static vec3s transmittance_texel(const struct atmosphere *a, float x, float y)
{
    const int x0 = (int)x, y0 = (int)y;
    const int x1 = x0 + 1 < ATMOSPHERE_TRANSMITTANCE_WIDTH ? x0 + 1 : x0;
    const int y1 = y0 + 1 < ATMOSPHERE_TRANSMITTANCE_HEIGHT ? y0 + 1 : y0;
    const vec3s low = glms_vec3_lerp(a->transmittance_table[y0][x0], a->transmittance_table[y0][x1],
                                     x - (float)x0);
    const vec3s high = glms_vec3_lerp(a->transmittance_table[y1][x0],
                                      a->transmittance_table[y1][x1], x - (float)x0);
    return glms_vec3_lerp(low, high, y - (float)y0);
}

static vec3s transmittance(const struct atmosphere *a, float radius, float cosine)
{
    if (distance_to_ground(radius, cosine) >= 0.0F)
        return (vec3s){ { 0.0F, 0.0F, 0.0F } };
    const float whole = sqrtf(air_radius * air_radius - ground_radius * ground_radius);
    const float above = radius * radius - ground_radius * ground_radius;
    const float horizon = sqrtf(fmaxf(above, 0.0F));
    const float shortest = air_radius - radius;
    const float u = (distance_to_top(radius, cosine) - shortest) / (horizon + whole - shortest);
    return transmittance_texel(a, glm_clamp(u, 0.0F, 1.0F) * (ATMOSPHERE_TRANSMITTANCE_WIDTH - 1),
                               glm_clamp(horizon / whole, 0.0F, 1.0F) *
                                   (ATMOSPHERE_TRANSMITTANCE_HEIGHT - 1));
}

vec3s atmosphere_transmittance(const struct atmosphere *atmosphere, float height, float cosine)
{
    return transmittance(atmosphere, ground_radius + height, cosine);
}

/* Returns radiance scattered at least twice, divided by the scattering coefficient. */
static vec3s multiple_scattering(const struct atmosphere *a, struct sample_point at)
{
    const float side = ATMOSPHERE_MULTIPLE_SCATTERING_SIZE - 1;
    const float x = glm_clamp(at.sun * 0.5F + 0.5F, 0.0F, 1.0F) * side;
    const float fraction = (at.radius - ground_radius) / (air_radius - ground_radius);
    const float y = glm_clamp(fraction, 0.0F, 1.0F) * side;
    const int x0 = (int)x, y0 = (int)y;
    const int x1 = x0 + 1 < ATMOSPHERE_MULTIPLE_SCATTERING_SIZE ? x0 + 1 : x0;
    const int y1 = y0 + 1 < ATMOSPHERE_MULTIPLE_SCATTERING_SIZE ? y0 + 1 : y0;
    const vec3s low = glms_vec3_lerp(a->multiple_scattering[y0][x0], a->multiple_scattering[y0][x1],
                                     x - (float)x0);
    const vec3s high = glms_vec3_lerp(a->multiple_scattering[y1][x0],
                                      a->multiple_scattering[y1][x1], x - (float)x0);
    return glms_vec3_lerp(low, high, y - (float)y0);
}

static struct ray ray_from(float radius, vec3s dir)
{
    struct ray ray = { .origin = { { 0.0F, radius, 0.0F } }, .dir = dir };
    const float ground = distance_to_ground(radius, dir.y);
    ray.hits_ground = ground >= 0.0F;
    ray.length = ray.hits_ground ? ground : distance_to_top(radius, dir.y);
    return ray;
}

static struct sample_point point_at(const struct ray *ray, float t, vec3s sun)
{
    const vec3s point = glms_vec3_add(ray->origin, glms_vec3_scale(ray->dir, t));
    const float radius = glms_vec3_norm(point);
    return (struct sample_point){ radius, glms_vec3_dot(point, sun) / radius };
}

/* Returns the sunlight reflected by the ground at a ray's end, before attenuation along the ray. */
static vec3s ground_radiance(const struct atmosphere *a, const struct ray *ray, vec3s sun)
{
    struct sample_point at = point_at(ray, ray->length, sun);
    at.radius = ground_radius + 1e-3F; /* avoids self-occlusion by rounding */
    const float fraction = a->albedo / PI * fmaxf(at.sun, 0.0F);
    return glms_vec3_scale(transmittance(a, at.radius, at.sun), fraction);
}

/* Integrates uniform emission `source` over a step, attenuated by extinction within the step. */
static vec3s integrate_step(vec3s source, vec3s extinction, float step)
{
    const vec3s kept = exp_minus(glms_vec3_scale(extinction, step));
    return glms_vec3_div(glms_vec3_sub(source, glms_vec3_mul(source, kept)), extinction);
}

/* Adds a ray's contribution to *second and *transfer (Hillaire 2020, equations 5 and 7). *second is
 * second-order scattering. *transfer is the fraction that each order passes to the next order. */
static void add_orders(const struct atmosphere *a, const struct ray *ray, vec3s sun, vec3s *second,
                       vec3s *transfer)
{
    vec3s throughput = { { 1.0F, 1.0F, 1.0F } };
    float before = 0.0F;
    for (int i = 1; i <= GLOW_STEPS; i++) {
        const float fraction = (float)i / GLOW_STEPS, after = ray->length * fraction * fraction;
        const float step = after - before;
        const struct sample_point at = point_at(ray, before + 0.3F * step, sun);
        const struct medium m = medium_at(a, at.radius - ground_radius);
        const vec3s whole = integrate_step(m.scattering, m.extinction, step);
        const vec3s arrives = glms_vec3_scale(transmittance(a, at.radius, at.sun), 0.25F / PI);
        const vec3s lit = glms_vec3_mul(whole, arrives);
        *second = glms_vec3_add(*second, glms_vec3_mul(throughput, lit));
        *transfer = glms_vec3_add(*transfer, glms_vec3_mul(throughput, whole));
        throughput = glms_vec3_mul(throughput, exp_minus(glms_vec3_scale(m.extinction, step)));
        before = after;
    }
    if (ray->hits_ground)
        *second = glms_vec3_add(*second, glms_vec3_mul(throughput, ground_radiance(a, ray, sun)));
}

static vec3s compute_multiple_scattering(const struct atmosphere *a, float radius, float sun_cosine)
{
    const vec3s sun = { { sqrtf(fmaxf(0.0F, 1.0F - sun_cosine * sun_cosine)), sun_cosine, 0.0F } };
    vec3s second = { { 0.0F, 0.0F, 0.0F } }, transfer = second;
    for (int ring = 0; ring < GLOW_RINGS; ring++) {
        const float y = 1.0F - 2.0F * ((float)ring + 0.5F) / GLOW_RINGS;
        const float across = sqrtf(1.0F - y * y);
        for (int azimuth = 0; azimuth < GLOW_AZIMUTHS; azimuth++) {
            const float angle = 2.0F * PI * ((float)azimuth + 0.5F) / GLOW_AZIMUTHS;
            const vec3s dir = { { across * cosf(angle), y, across * sinf(angle) } };
            const struct ray ray = ray_from(radius, dir);
            add_orders(a, &ray, sun, &second, &transfer);
        }
    }
    const float mean = 1.0F / (GLOW_RINGS * GLOW_AZIMUTHS);
    const vec3s kept = glms_vec3_scale(transfer, -mean);
    return glms_vec3_div(glms_vec3_scale(second, mean), glms_vec3_adds(kept, 1.0F));
}

void atmosphere_make(struct atmosphere *atmosphere, float turbidity, float albedo)
{
    const float units = haze_per_turbidity * (turbidity - 1.0F);
    atmosphere->haze = glms_vec3_scale(haze_color, haze_unit * units);
    atmosphere->albedo = albedo;
    for (int y = 0; y < ATMOSPHERE_TRANSMITTANCE_HEIGHT; y++) {
        for (int x = 0; x < ATMOSPHERE_TRANSMITTANCE_WIDTH; x++) {
            float radius = 0.0F, cosine = 0.0F;
            transmittance_params((float)x / (ATMOSPHERE_TRANSMITTANCE_WIDTH - 1),
                                 (float)y / (ATMOSPHERE_TRANSMITTANCE_HEIGHT - 1), &radius,
                                 &cosine);
            atmosphere->transmittance_table[y][x] =
                exp_minus(optical_depth(atmosphere, radius, cosine));
        }
    }
    const float side = ATMOSPHERE_MULTIPLE_SCATTERING_SIZE - 1, depth = air_radius - ground_radius;
    for (int y = 0; y < ATMOSPHERE_MULTIPLE_SCATTERING_SIZE; y++) {
        const float height = glm_clamp((float)y / side * depth, 1e-3F, depth - 1e-3F);
        for (int x = 0; x < ATMOSPHERE_MULTIPLE_SCATTERING_SIZE; x++)
            atmosphere->multiple_scattering[y][x] = compute_multiple_scattering(
                atmosphere, ground_radius + height, 2.0F * (float)x / side - 1.0F);
    }
}

vec3s atmosphere_radiance(const struct atmosphere *atmosphere, float height, vec3s dir, vec3s sun)
{
    const struct ray ray = ray_from(ground_radius + height, dir);
    const float c = glms_vec3_dot(dir, sun), g = haze_g;
    const float rayleigh = 3.0F / (16.0F * PI) * (1.0F + c * c);
    const float mie = 3.0F / (8.0F * PI) * (1.0F - g * g) * (1.0F + c * c) /
                      ((2.0F + g * g) * powf(1.0F + g * g - 2.0F * g * c, 1.5F));
    vec3s throughput = { { 1.0F, 1.0F, 1.0F } }, light = { { 0.0F, 0.0F, 0.0F } };
    float before = 0.0F;
    for (int i = 1; i <= SKY_STEPS; i++) { /* short steps near the camera */
        const float fraction = (float)i / SKY_STEPS, after = ray.length * fraction * fraction;
        const float step = after - before;
        const struct sample_point at = point_at(&ray, before + 0.3F * step, sun);
        const struct medium m = medium_at(atmosphere, at.radius - ground_radius);
        const vec3s phases =
            glms_vec3_add(glms_vec3_scale(m.rayleigh, rayleigh), glms_vec3_scale(m.mie, mie));
        const vec3s direct = glms_vec3_mul(transmittance(atmosphere, at.radius, at.sun), phases);
        const vec3s higher_orders =
            glms_vec3_mul(multiple_scattering(atmosphere, at), m.scattering);
        const vec3s added =
            integrate_step(glms_vec3_add(direct, higher_orders), m.extinction, step);
        light = glms_vec3_add(light, glms_vec3_mul(throughput, added));
        throughput = glms_vec3_mul(throughput, exp_minus(glms_vec3_scale(m.extinction, step)));
        before = after;
    }
    if (ray.hits_ground)
        light =
            glms_vec3_add(light, glms_vec3_mul(throughput, ground_radiance(atmosphere, &ray, sun)));
    return light;
}
