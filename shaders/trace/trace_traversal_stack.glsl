/*
 * trace_traversal_stack.glsl: traversal stack of BVH nodes and leaves.
 *
 * With TRACE_RAYS it is an array. Its variable index places it in memory, which lavapipe writes
 * lane by lane. Otherwise entries are shifted between variables, which stay in registers; only the
 * newest ones are shifted for each node, the older ones once per leaf. A ray whose newest part is
 * full has to leave the node loop early, which costs iterations. That is too risky with TRACE_RAYS:
 * llvmpipe terminates loops after 65 535 iterations, and such paths have many segments.
 */
#ifndef TRACE_TRAVERSAL_STACK_GLSL
#define TRACE_TRAVERSAL_STACK_GLSL

const int trace_nothing = int(BVH_LEAF);

#ifdef TRACE_RAYS

int stack[BVH_DEPTH_MAX + 2], stack_top;

void stack_begin()
{
    stack_top = 0;
    stack[0] = trace_nothing;
}

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

/* Returns the next node. Pushes `far` if both children were hit. Pops a node if none was hit. */
int stack_next(bool both, bool none, int near, int far)
{
    int popped = stack[stack_top];
    stack[stack_top + 1] = far;
    stack_top += none ? -1 : int(both);
    return none ? popped : near;
}

/* Makes room on the stack. Returns `node`, or the next stack entry if `node` is trace_nothing. */
int stack_settle(int node)
{
    return node;
}

#else

const int stack_newer_max = 5;
int stack_newer[stack_newer_max], stack_older[BVH_DEPTH_MAX]; /* both with the top entry first */

void stack_begin()
{
    for (int i = 0; i < stack_newer_max; i++)
        stack_newer[i] = trace_nothing;
    for (int i = 0; i < BVH_DEPTH_MAX; i++)
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
        for (int i = BVH_DEPTH_MAX - 1; i > 0; i--)
            stack_older[i] = stack_older[i - 1];
        stack_older[0] = stack_newer[stack_newer_max - 1];
        stack_newer[stack_newer_max - 1] = trace_nothing;
    }
    if (node != trace_nothing)
        return node;
    int next = stack_older[0];
    for (int i = 0; i + 1 < BVH_DEPTH_MAX; i++)
        stack_older[i] = stack_older[i + 1];
    stack_older[BVH_DEPTH_MAX - 1] = trace_nothing;
    return next;
}

#endif
#endif
