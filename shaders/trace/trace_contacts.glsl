/*
 * trace_contacts.glsl: hits on surfaces of several objects that coincide, exactly or within
 * trace.contact, as one interface.
 *
 * At a triangle with BVH_CONTACT, queries along the same ray enumerate the further hits by distance
 * and triangle index. The path changes all media at once. The object of highest priority whose
 * medium begins or ends decides the normal and the surface material. An object that is both
 * entered and left does not count, and neither does a thin wall at the boundary of a medium.
 */
#ifndef TRACE_CONTACTS_GLSL
#define TRACE_CONTACTS_GLSL

const int contact_hits_max = 8; /* maximum number of hits at a contact */

/* Objects that a path enters and leaves at a hit, in the form of a medium stack. */
struct trace_contact {
    uvec4 entered, left;
};

/* Returns the flags of a hit's triangle: BVH_CONTACT, BVH_CONTACT_THIN or 0. */
uint contact_bits(trace_hit hit)
{
    bool is_object = hit.triangle >= 0 && hit.bvh == BVH_OBJECTS;
    uint bits = trace_corner(BVH_CORNER_WORDS * max(hit.triangle, 0) + 2).w & BVH_CONTACT_MASK;
    return is_object ? bits : 0u;
}

/* Adds a hit to a contact. Replaces `decisive`, of priority `rank`, if the hit's is higher. */
void contact_add(trace_hit hit, vec3 dir, inout trace_contact contact, inout trace_hit decisive,
                 inout uint rank)
{
    vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    bool is_entering = dot(trace_posed(facet, hit.bvh), dir) < 0.0;
    uint bits = contact_bits(hit);
    uint own = trace_corner(BVH_CORNER_WORDS * hit.triangle).w % BVH_OBJECT_NUMBER;
    if (bits == 0u || (bits & BVH_CONTACT_THIN) != 0u)
        return;
    if (is_entering)
        contact.entered = trace_stack_push(contact.entered, own);
    else
        contact.left = trace_stack_push(contact.left, own);
    bool is_crossed = trace_stack_has(contact.entered, own) && trace_stack_has(contact.left, own);
    if (is_crossed) {
        rank = rank == own ? 0u : rank;
    } else if (own > rank) {
        decisive = hit;
        rank = own;
    }
}

/* Finds the next hit of a path and, at a contact, all others within trace.contact. Returns the
 * decisive hit. */
trace_hit contact_next_hit(trace_path path, bool is_active, out trace_contact contact)
{
    trace_start start = trace_start_of(path);
    contact = trace_contact(uvec4(0u), uvec4(0u));
    contact_search.medium_stack = path.medium_stack;
    trace_hit decisive = trace_nearest_hit(start, is_active);
    trace_hit hit = decisive;
    uint rank = 0u;
    int left = trace_has(TRACE_HAS_CONTACTS) && contact_bits(hit) != 0u ? contact_hits_max : 0;
    if (left > 0) {
        vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
        float towards = abs(dot(trace_posed(facet, hit.bvh), path.dir));
        float reach = (trace.contact + contact_rounding * hit.t) / max(towards, contact_cosine_min);
        start.bvhs = 1u << BVH_OBJECTS;
        float near = max(hit.t - reach, 0.0);
        contact_search =
            trace_contact_search(near, hit.t + reach, near, -1, hit.triangle, path.medium_stack);
    }
    while (left > 0) {
        contact_add(hit, path.dir, contact, decisive, rank);
        hit = trace_nearest_hit(start, true);
        contact_search.last = hit.t;
        contact_search.last_triangle = hit.triangle;
        left = hit.triangle >= 0 ? left - 1 : 0;
    }
    contact_search = trace_contact_search(0.0, 1e30, 0.0, -1, -1, path.medium_stack);
    uvec4 entered = contact.entered;
    contact.entered = trace_stack_difference(entered, contact.left);
    contact.left = trace_stack_difference(contact.left, entered);
    return decisive;
}

/* Returns the medium stack behind a contact, or in front of it. */
uvec4 contact_stack(uvec4 medium_stack, trace_contact contact, bool is_behind)
{
    return is_behind ? trace_stack_union(trace_stack_difference(medium_stack, contact.left),
                                         contact.entered)
                     : trace_stack_union(trace_stack_difference(medium_stack, contact.entered),
                                         contact.left);
}

#endif
