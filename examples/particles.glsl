/* particles.glsl: particle struct shared by the fountain's shaders. */
struct Particle {
    vec2 position; /* clip space */
    vec2 velocity; /* per second */
    vec3 color;
    float end; /* seconds; 0 if not yet spawned */
};
