/*
 * optics.glsl: reflection and refraction at a smooth interface between two media.
 *
 * Equations are those of Seipel and Nivfors 2006, Efficient Rendering of Multiple Refractions and
 * Reflections in Natural Objects, with the paper's letters. e: unit vector from camera to surface
 * point. n_f: unit outward normal of the front face, n_f.e < 0. n_b: unit outward normal of the
 * back face behind it, n_b.e > 0, never flipped towards the viewer. eta: refractive index of the
 * incident medium over that of the other one.
 */
#ifndef LIB_OPTICS_GLSL
#define LIB_OPTICS_GLSL

/* Blends front and back normals (Seipel and Nivfors, eq. 1). The result is not normalised. */
vec3 optics_blend_normals(vec3 n_f, vec3 n_b, float a)
{
    return n_f * (1.0 - a) - n_b * a;
}

/* Returns the radicand in Snell's law (Seipel and Nivfors, eq. 2), negative on total reflection. */
float optics_refract_k(vec3 e, vec3 n, float eta)
{
    float c = dot(n, e);
    return 1.0 - eta * eta * (1.0 - c * c);
}

/* Refracts `e` like GLSL's refract(). If reflection is total, reflects `e` instead. */
vec3 optics_refract(vec3 e, vec3 n_r, float eta)
{
    float k = optics_refract_k(e, n_r, eta);
    if (k < 0.0)
        return reflect(e, n_r);
    return eta * e - (eta * dot(n_r, e) + sqrt(k)) * n_r;
}

/* Reflects `e` at the front face, like GLSL's reflect() (Seipel and Nivfors, eq. 3). */
vec3 optics_reflect(vec3 e, vec3 n_f)
{
    return e - 2.0 * dot(n_f, e) * n_f;
}

/* Approximates Fresnel reflectance (Seipel and Nivfors, eq. 4). At normal incidence, returns 0. */
float optics_fresnel_paper(vec3 e, vec3 n)
{
    float f = 1.0 - abs(dot(e, n));
    return f * f * f;
}

/* Mixes reflected and refracted radiance by the reflectance `f` (Seipel and Nivfors, eq. 6). */
vec3 optics_compose(vec3 reflected, vec3 refracted, float f)
{
    return f * reflected + (1.0 - f) * refracted;
}

/* Returns the alpha of a pixel through which a background is visible: 1 - luminance (Rec. 709) of
 * the transmittance. */
float optics_alpha(vec3 transmittance)
{
    return 1.0 - dot(transmittance, vec3(0.2126, 0.7152, 0.0722));
}

/* Returns the unpolarised Fresnel reflectance, 1 on total reflection. `n` may face either side. */
float optics_fresnel(vec3 e, vec3 n, float eta)
{
    float ci = abs(dot(e, n));
    float sin2 = eta * eta * (1.0 - ci * ci);
    if (sin2 >= 1.0)
        return 1.0;
    float ct = sqrt(1.0 - sin2);
    float rs = (eta * ci - ct) / (eta * ci + ct);
    float rp = (ci - eta * ct) / (ci + eta * ct);
    return 0.5 * (rs * rs + rp * rp);
}

/* Returns the reflectance of a thin gap, 2R / (1 + R), with interreflections. R is the reflectance
 * of each of the two parallel sides. `eta` is the index outside over the index in the gap.
 * Interference is left out, because gaps are wider than a wavelength. */
float optics_gap(vec3 e, vec3 n, float eta)
{
    float r = optics_fresnel(e, n, eta);
    return 2.0 * r / (1.0 + r);
}

#endif
