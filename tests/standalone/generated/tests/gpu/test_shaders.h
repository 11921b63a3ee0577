/* test_shaders.h: includes the generated header by the name that the tests use. */
#include <test_shaders.h>
