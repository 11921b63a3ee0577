/*
 * refract_bubbles.glsl: intersects path segments inside the ice with the BVH of the bubbles.
 *
 * A bubble covers a ray by the fraction of the ray's footprint that the bubble's outline overlaps,
 * so that outlines are antialiased and bubbles thinner than a pixel keep their projected area.
 *
 * The light that bubbles deflect is looked up in the environment along its refracted direction,
 * without refraction at the surface, and blurred by the inverse of the bubble's radius in pixels,
 * because a bubble shows all surroundings in its disc. `mean` is the surroundings' mean radiance.
 */
#ifndef REFRACT_BUBBLES_GLSL
#define REFRACT_BUBBLES_GLSL
#include "inclusions/bubbles.h"
#include "lib/bubble_intersect.glsl"
#ifdef REFRACT_MEDIUM
#include "refract/refract_medium.glsl"
#endif

layout(set = 0, binding = REFRACT_BUBBLES) uniform usamplerBuffer bubble_nodes;

/* Maximum number of bubbles that attenuate a path between two faces. */
const uint bubbles_hits_max = 4u;

/* Radii between which a bubble changes from a part of the scattering medium to a refracting
 * surface, in footprints. */
const vec2 bubbles_medium_radii = vec2(0.7, 1.4);

/* Radius of the blur of light that a bubble of the scattering medium deflects, about 40 degrees. */
const float bubbles_medium_blur = 0.7;

/* Henyey-Greenstein g of a bubble, averaged over its disc. */
const float bubbles_g = 0.71;

/* Segment of a path inside a medium. */
struct bubbles_segment {
    vec3 from, dir;
    float t;     /* length */
    float width; /* width of the ray's footprint, metres */
    float eta;   /* relative index, medium to air */
    vec3 absorb; /* absorption coefficients, 1 / metre */
#ifdef REFRACT_MEDIUM
    medium_field medium;
#endif
};

struct bubbles_hit {
    float t;     /* distance to the ray's closest approach to the bubble's centre or axis */
    float cover; /* fraction of the ray's footprint that the bubble covers; 0 without hit */
    uint index;  /* of the node */
};

bubbles_node bubbles_node_at(uint index)
{
    uvec4 first = texelFetch(bubble_nodes, int(BUBBLES_NODE_TEXELS * index));
    uvec4 second = texelFetch(bubble_nodes, int(BUBBLES_NODE_TEXELS * index + 1u));
    return bubbles_node(uintBitsToFloat(first.xyz), first.w, uintBitsToFloat(second.xyz),
                        uintBitsToFloat(second.w));
}

bool bubbles_is_capsule(bubbles_node node)
{
    return (node.link & BUBBLES_NODE_KIND) == BUBBLES_NODE_CAPSULE;
}

/* Returns the fraction of a footprint of width `width` that a node's bubble covers. Sets `t`. */
float bubbles_cover(bubbles_node node, vec3 from, vec3 dir, float width, out float t)
{
    float radius = length(node.axis);
    vec3 axis = node.axis / radius, gap;
    float slope = dot(dir, axis);
    from -= node.center;
    float across = 1.0 - slope * slope;
    if (bubbles_is_capsule(node)) {
        float along = dot(from, dir);
        float at = (dot(from, axis) - slope * along) / max(across, 1e-6);
        at = clamp(at, -node.stretch, node.stretch);
        t = slope * at - along;
        gap = from + t * dir - at * axis;
    } else {
        vec3 scaled_from = bubble_to_sphere(from, axis, node.stretch, radius);
        vec3 scaled_dir = bubble_to_sphere(dir, axis, node.stretch, radius);
        t = -dot(scaled_from, scaled_dir) / max(dot(scaled_dir, scaled_dir), 1e-20);
        gap = scaled_from + t * scaled_dir;
    }
    float dist = length(gap);
    float reach = radius + max(node.stretch, 0.0) * sqrt(max(across, 0.0));
    float near = clamp(0.5 + (radius - dist) / width, 0.0, 1.0);
    float far = clamp(0.5 + (radius + dist) / width, 0.0, 1.0);
    /* A footprint wider than the bubble is long: the ratio of a disc's area to a square's. */
    return (near + far - 1.0) * min(1.5708 * reach / width, 1.0);
}

/* Returns true if a ray enters a node's box, widened by `margin`, between `min_t` and `max_t`. */
bool bubbles_enters(bubbles_node node, vec3 from, vec3 inverse_dir, float margin, vec2 range)
{
    vec3 center = (node.center - from) * inverse_dir;
    vec3 half_size = (node.axis + margin) * abs(inverse_dir);
    vec3 enter = center - half_size, leave = center + half_size;
    return max(max(enter.x, enter.y), max(enter.z, range.x)) <=
           min(min(leave.x, leave.y), min(leave.z, range.y));
}

/* Returns the first bubble that covers a ray of footprint `width` between the distances `range`. */
bubbles_hit bubbles_find(vec3 from, vec3 dir, float width, vec2 range)
{
    vec3 inverse_dir = 1.0 / mix(dir, vec3(1e-9), lessThan(abs(dir), vec3(1e-9)));
    bubbles_hit hit = bubbles_hit(range.y, 0.0, 0u);
    uint count = bubbles_node_at(0u).link >> BUBBLES_NODE_SHIFT;
    for (uint i = 0u; i < count;) {
        bubbles_node node = bubbles_node_at(i);
        uint next = i + 1u;
        if ((node.link & BUBBLES_NODE_KIND) == BUBBLES_NODE_BOX) {
            if (!bubbles_enters(node, from, inverse_dir, 0.5 * width, vec2(range.x, hit.t)))
                next = node.link >> BUBBLES_NODE_SHIFT;
        } else {
            float t;
            float cover = bubbles_cover(node, from, dir, width, t);
            if (cover > 0.0 && t > range.x && t < hit.t)
                hit = bubbles_hit(t, cover, i);
        }
        i = next;
    }
    return hit;
}

/* Returns the width of a pixel at a point. */
float bubbles_pixel_width(vec3 point)
{
    mat4 m = refract_frame.clip_from_world;
    float height = float(textureSize(shading, 0).y);
    float w = (m * vec4(point, 1.0)).w;
    return 2.0 * w / (height * length(vec3(m[0].y, m[1].y, m[2].y)));
}

/* Returns the environment's radiance from around `dir`, by four lookups at an angle whose tangent
 * is `blur`. */
vec3 bubbles_blurred(vec3 dir, float blur)
{
    vec3 right = normalize(cross(dir, abs(dir.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    vec3 up = cross(right, dir);
    vec3 sum = textureLod(env_cube, dir + blur * right, 0.0).rgb;
    sum += textureLod(env_cube, dir - blur * right, 0.0).rgb;
    sum += textureLod(env_cube, dir + blur * up, 0.0).rgb;
    sum += textureLod(env_cube, dir - blur * up, 0.0).rgb;
    return 0.25 * sum;
}

/* Refraction of a path at a bubble. */
struct bubbles_crossing {
    vec3 n;           /* outward normal where the path enters */
    vec3 transmitted; /* direction behind the bubble */
    float reflectance;
};

/* Refracts a segment at a bubble. `t` is the distance to the closest approach. */
bubbles_crossing bubbles_cross(bubbles_node node, bubbles_segment segment, float t)
{
    bool is_capsule = bubbles_is_capsule(node);
    float radius = length(node.axis);
    vec3 axis = node.axis / radius, dir = segment.dir, from = segment.from - node.center;
    vec2 at = bubble_intersect(from, dir, axis, node.stretch, radius, is_capsule);
    bubbles_crossing crossed;
    vec3 enter = from + (at.x <= at.y ? at.x : t) * dir; /* the closest point if it misses */
    crossed.n = bubble_normal(enter, axis, node.stretch, radius, is_capsule);
    float along = max(dot(crossed.n, dir), 0.0);
    crossed.n = normalize(crossed.n - along * dir); /* the nearest normal that faces the ray */
    crossed.reflectance = optics_fresnel(dir, crossed.n, segment.eta);
    crossed.transmitted = dir;
    if (crossed.reflectance < 1.0) {
        vec3 inside = refract(dir, crossed.n, segment.eta);
        vec2 through = bubble_intersect(enter, inside, axis, node.stretch, radius, is_capsule);
        vec3 leave = enter + max(through.y, 0.0) * inside;
        vec3 last = bubble_normal(leave, axis, node.stretch, radius, is_capsule);
        crossed.transmitted = refract(inside, -last, 1.0 / segment.eta);
    }
    return crossed;
}

/* Returns the light that a bubble sends along a ray, looked up in the environment. `radius` is in
 * footprints. */
vec3 bubbles_light(bubbles_crossing crossed, vec3 dir, float radius)
{
    float sharp = smoothstep(bubbles_medium_radii.x, bubbles_medium_radii.y, radius);
    float blur = min(1.0 / radius, bubbles_medium_blur);
    vec3 light = vec3(0.0);
    if (sharp > 0.0)
        light = mix(bubbles_blurred(crossed.transmitted, blur),
                    bubbles_blurred(reflect(dir, crossed.n), blur), crossed.reflectance);
    if (sharp < 1.0)
        light = mix(mix(mean, bubbles_blurred(dir, bubbles_medium_blur), bubbles_g), light, sharp);
    return light;
}

/* Adds the light that the medium scatters into a part of a segment. */
void bubbles_add_scattered(bubbles_segment segment, vec2 part, vec3 weight,
                           inout float transmittance, inout vec3 light)
{
#ifdef REFRACT_MEDIUM
    light += weight * exp(-segment.absorb * part.x) *
             refract_in_scatter(segment.medium, segment.from + part.x * segment.dir, segment.dir,
                                part.y - part.x, transmittance);
#endif
}

/* Adds the light of the bubbles and of the scattering medium along a segment, weighted by `weight`
 * and `transmittance`, to `light`. Multiplies `transmittance` by that of the medium. Returns the
 * fraction of the path's footprint that bubbles do not cover. */
float bubbles_gather(bubbles_segment segment, vec3 weight, inout float transmittance,
                     inout vec3 light)
{
    float rest = 1.0, from_t = 0.0;
    uint hits_max = constant_bubbles_traced != 0u ? bubbles_hits_max : 0u;
    for (uint i = 0u; i < hits_max && rest * dot(weight, vec3(1.0 / 3.0)) > 0.01; i++) {
        bubbles_hit hit =
            bubbles_find(segment.from, segment.dir, segment.width, vec2(from_t, segment.t));
        if (hit.cover <= 0.0)
            break;
        bubbles_add_scattered(segment, vec2(from_t, hit.t), rest * weight, transmittance, light);
        bubbles_node node = bubbles_node_at(hit.index);
        bubbles_crossing crossed = bubbles_cross(node, segment, hit.t);
        light += rest * hit.cover * transmittance * weight * exp(-segment.absorb * hit.t) *
                 bubbles_light(crossed, segment.dir, length(node.axis) / segment.width);
        rest *= 1.0 - hit.cover;
        from_t = hit.t;
    }
    bubbles_add_scattered(segment, vec2(from_t, segment.t), rest * weight, transmittance, light);
    return rest;
}

#endif
