/* particles.glsl: what the shaders of the fountain share. */
struct Particle {
    vec2 position; /* clip space */
    vec2 velocity; /* per second */
    vec3 color;
    float end; /* seconds; 0: it has never lived */
};
