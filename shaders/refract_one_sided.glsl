/* refract_one_sided.glsl: eq. 2 at the front face alone. */
#include "refract.glsl"

refract_result shade()
{
    vec3 e = normalize(eye_to_point);
    vec3 n_f = refract_front_normal();
    return refract_lookup(e, n_f, optics_refract(e, n_f, frame.eta));
}
