/* particles_reset.comp: resets the indirect draw command to one instance of zero vertices. */
#version 460

layout(local_size_x = 1) in;

layout(binding = 2) writeonly buffer Draw
{
    uint vertex_count, instance_count, first_vertex, first_instance;
}

draw;

void main()
{
    draw.vertex_count = 0;
    draw.instance_count = 1;
    draw.first_vertex = draw.first_instance = 0;
}
