/* cracks_free.glsl: cracks that were cut before, or are not to be. */
bool crack_is_inside()
{
    return true;
}
