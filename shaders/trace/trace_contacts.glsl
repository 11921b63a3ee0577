/*
 * trace_contacts.glsl: hits on surfaces of several shells that coincide, exactly or within
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
    uvec4 changed = trace_stack_push(is_entering ? contact.entered : contact.left, own);
    contact.entered = is_entering ? changed : contact.entered;
    contact.left = is_entering ? contact.left : changed;
    bool is_crossed = trace_stack_has(contact.entered, own) && trace_stack_has(contact.left, own);
    if (is_crossed) {
        if (rank == own && !is_entering)
            decisive = hit; /* the continued path ignores this face */
        rank = rank == own ? 0u : rank;
    } else if (own > rank) {
        decisive = hit;
        rank = own;
    }
}

/* Restricts further queries to the surroundings of a path's closest hit, which is at a contact. */
void contact_begin(trace_path path, trace_hit hit, inout trace_start start)
{
    vec3 facet = uintBitsToFloat(trace_row(BVH_TRIANGLE_WORDS * hit.triangle + 2)).xyz;
    float towards = abs(dot(trace_posed(facet, hit.bvh), path.dir));
    float reach = (trace.contact + contact_rounding * hit.t) / max(towards, contact_cosine_min);
    float near = max(hit.t - reach, 0.0);
    contact_search =
        trace_contact_search(near, hit.t + reach, near, -1, hit.triangle, path.medium_stack);
    start.bvhs = 1u << BVH_OBJECTS;
}

/* Finds the next hit of a path and, at a contact, all others within trace.contact. Returns the
 * decisive hit. */
trace_hit contact_next_hit(trace_path path, bool is_active, out trace_contact contact)
{
    trace_start start = trace_start_of(path);
    trace_hit decisive, hit;
    uint rank = 0u;
    int count = 0;
    bool goes_on = false;
    contact = trace_contact(uvec4(0u), uvec4(0u));
    contact_search = trace_contact_search(0.0, 1e30, 0.0, -1, -1, path.medium_stack);
    do {
        hit = trace_nearest_hit(start, is_active);
        if (count == 0)
            decisive = hit;
        if (trace_has(TRACE_HAS_CONTACTS)) {
            goes_on = hit.triangle >= 0 && count < contact_hits_max &&
                      (count > 0 || contact_bits(hit) != 0u);
            if (goes_on)
                contact_add(hit, path.dir, contact, decisive, rank);
            if (goes_on && count == 0) {
                contact_begin(path, hit, start);
            } else {
                contact_search.last = hit.t;
                contact_search.last_triangle = hit.triangle;
            }
        }
        count++;
    } while (goes_on);
    contact_search = trace_contact_search(0.0, 1e30, 0.0, -1, -1, path.medium_stack);
    return decisive;
}

#endif
