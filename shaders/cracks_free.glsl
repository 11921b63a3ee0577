/* cracks_free.glsl: cracks that need no clipping, or were clipped in advance. */
bool crack_is_inside()
{
    return true;
}
