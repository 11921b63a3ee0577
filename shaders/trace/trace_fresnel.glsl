/* trace_fresnel.glsl: Fresnel reflection and refraction (C: src/lab/reference/dielectric_split.c).
 */
#ifndef TRACE_FRESNEL_GLSL
#define TRACE_FRESNEL_GLSL

/* Directions, reflectance and sampling weights of a surface's reflected and refracted path. */
struct trace_fresnel_split {
    vec3 reflected, refracted;
    float fresnel, reflected_weight, refracted_weight;
};

/* Returns the Fresnel reflectance, and sets the reflected and refracted directions. `n` points to
 * the incident side. `eta` is the incident index of refraction divided by the transmitted one. If
 * `is_thin`, the reflectance includes interreflections: 2F / (1 + F). */
float trace_fresnel(vec3 d, vec3 n, float eta, bool is_thin, out vec3 reflected, out vec3 refracted)
{
    float ci = min(-dot(d, n), 1.0);
    float sin2 = eta * eta * (1.0 - ci * ci);
    float ct = sqrt(max(1.0 - sin2, 0.0));
    float rs = (eta * ci - ct) / (eta * ci + ct);
    float rp = (ci - eta * ct) / (ci + eta * ct);
    float fresnel = sin2 < 1.0 ? 0.5 * (rs * rs + rp * rp) : 1.0;
    reflected = normalize(d + 2.0 * ci * n);
    refracted = is_thin ? d : normalize(eta * d + (eta * ci - ct) * n);
    return is_thin ? 2.0 * fresnel / (1.0 + fresnel) : fresnel;
}

/* Corrects directions that a normal map sends to the wrong side of the triangle. On rough surfaces,
 * such directions get weight 0. On smooth surfaces, the geometric normal is used instead. */
void trace_correct_sides(inout trace_fresnel_split p, vec3 d, vec3 facet, float eta, bool is_rough)
{
    vec3 facet_reflected, facet_refracted;
    float facet_fresnel = trace_fresnel(d, facet, eta, false, facet_reflected, facet_refracted);
    bool is_lost = p.fresnel < 1.0 && dot(p.refracted, facet) >= 0.0;
    p.refracted_weight = is_lost && is_rough ? 0.0 : p.refracted_weight;
    if (is_lost && !is_rough) {
        p.refracted = facet_refracted;
        p.fresnel = facet_fresnel < 1.0 ? p.fresnel : 1.0;
    }
    if (dot(p.reflected, facet) <= 0.0 || (p.fresnel >= 1.0 && is_lost)) {
        p.reflected_weight = is_rough ? 0.0 : p.reflected_weight;
        p.reflected = facet_reflected;
    }
}

#endif
