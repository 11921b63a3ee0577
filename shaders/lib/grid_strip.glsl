/* grid_strip.glsl: vertex indexing of a square grid drawn as one triangle strip. */
#ifndef GRID_STRIP_GLSL
#define GRID_STRIP_GLSL

/* Returns the grid corner of a vertex of a triangle strip. The grid has `cells` squares per side.
 * Degenerate triangles join the rows, hence the strip has cells * (2 * cells + 4) vertices. */
uvec2 grid_strip_corner(uint index, uint cells)
{
    uint row_length = 2u * cells + 4u;
    uint row = index / row_length;
    uint along = clamp(index % row_length, 1u, row_length - 2u) - 1u;
    return uvec2(along / 2u, row + along % 2u);
}

#endif
