/*
 * trace_stack.glsl: the nodes and leaves of a tree that a ray has still to go through.
 *
 * With TRACE_RAYS they are an array. Its index is not constant, so it is in memory, which lavapipe
 * writes for each lane apart. Else they move, so that each has a register; the older ones move
 * once for all nodes between two leaves. Then a ray that has no room leaves these nodes, so loops
 * take more rounds. llvmpipe ends a pixel's loops after 65 535 rounds: rays that meet surroundings
 * have many parts, and light of a few pixels would be lost.
 */
#ifndef TRACE_STACK_GLSL
#define TRACE_STACK_GLSL

const int trace_nothing = int(TREE_LEAF);

#ifdef TRACE_RAYS

int stack[TREE_DEPTH_MAX + 2], stack_top;

void stack_begin()
{
    stack_top = 0;
    stack[0] = trace_nothing;
}

/* Returns whether a ray may go on from node to node. */
bool stack_has_room()
{
    return true;
}

int stack_pop()
{
    int popped = stack[stack_top];
    stack_top--;
    return popped;
}

/* Returns where a ray goes from a node of which it meets both children, one or none. */
int stack_next(bool both, bool none, int near, int far)
{
    int popped = stack[stack_top];
    stack[stack_top + 1] = far;
    stack_top += none ? -1 : int(both);
    return none ? popped : near;
}

/* Makes room, and returns what follows if nothing does so far. */
int stack_settle(int node)
{
    return node;
}

#else

const int stack_newer_max = 5;
int stack_newer[stack_newer_max], stack_older[TREE_DEPTH_MAX]; /* the last one first */

void stack_begin()
{
    for (int i = 0; i < stack_newer_max; i++)
        stack_newer[i] = trace_nothing;
    for (int i = 0; i < TREE_DEPTH_MAX; i++)
        stack_older[i] = trace_nothing;
}

bool stack_has_room()
{
    return stack_newer[stack_newer_max - 1] == trace_nothing;
}

int stack_pop()
{
    int popped = stack_newer[0];
    for (int i = 0; i + 1 < stack_newer_max; i++)
        stack_newer[i] = stack_newer[i + 1];
    stack_newer[stack_newer_max - 1] = trace_nothing;
    return popped;
}

int stack_next(bool both, bool none, int near, int far)
{
    int next = none ? stack_newer[0] : near;
    int pushed = far;
    for (int i = 0; i < stack_newer_max; i++) {
        int entry = stack_newer[i];
        int popped = i + 1 < stack_newer_max ? stack_newer[i + 1] : trace_nothing;
        stack_newer[i] = both ? pushed : none ? popped : entry;
        pushed = entry;
    }
    return next;
}

int stack_settle(int node)
{
    if (!stack_has_room()) {
        for (int i = TREE_DEPTH_MAX - 1; i > 0; i--)
            stack_older[i] = stack_older[i - 1];
        stack_older[0] = stack_newer[stack_newer_max - 1];
        stack_newer[stack_newer_max - 1] = trace_nothing;
    }
    if (node != trace_nothing)
        return node;
    int next = stack_older[0];
    for (int i = 0; i + 1 < TREE_DEPTH_MAX; i++)
        stack_older[i] = stack_older[i + 1];
    stack_older[TREE_DEPTH_MAX - 1] = trace_nothing;
    return next;
}

#endif
#endif
