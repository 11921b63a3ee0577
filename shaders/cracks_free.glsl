/* cracks_free.glsl: crack_is_inside() for cracks that need no clipping when they are drawn. */
bool crack_is_inside()
{
    return true;
}
