/* test_tonemap.c: tone curves, against values computed from the published formulas. */
#include "shaders/output/tonemap.h"
#include "tests/support/assertions.h"

static const struct {
    uint32_t curve;
    vec3s radiance;
    double encoded[3];
} cases[] = {
    { TONEMAP_CLIP, { { 0.18F, 1, 4 } }, { 0.4614, 1.0000, 1.0000 } },
    { TONEMAP_NEUTRAL, { { 0.5F, 0.5F, 0.5F } }, { 0.7084, 0.7084, 0.7084 } },
    { TONEMAP_AGX, { { 0, 0, 0 } }, { 0.0000, 0.0000, 0.0000 } },
    { TONEMAP_AGX, { { 0.18F, 0.18F, 0.18F } }, { 0.5005, 0.5005, 0.5005 } },
    { TONEMAP_AGX, { { 1, 1, 1 } }, { 0.7918, 0.7919, 0.7919 } },
    { TONEMAP_AGX, { { 4, 1, 0.2F } }, { 0.9646, 0.8081, 0.6264 } },
    { TONEMAP_AGX, { { 0.02F, 0.1F, 60 } }, { 0.9418, 0.9429, 1.0000 } },
    { TONEMAP_ACES, { { 0, 0, 0 } }, { 0.0000, 0.0000, 0.0000 } },
    { TONEMAP_ACES, { { 0.18F, 0.18F, 0.18F } }, { 0.3585, 0.3585, 0.3585 } },
    { TONEMAP_ACES, { { 1, 1, 1 } }, { 0.8090, 0.8090, 0.8090 } },
    { TONEMAP_ACES, { { 4, 1, 0.2F } }, { 0.9988, 0.8342, 0.5674 } },
    { TONEMAP_ACES, { { 0.02F, 0.1F, 60 } }, { 0.9949, 0.7991, 1.0000 } },
    { TONEMAP_HABLE, { { 0, 0, 0 } }, { 0.0000, 0.0000, 0.0000 } },
    { TONEMAP_HABLE, { { 0.18F, 0.18F, 0.18F } }, { 0.3935, 0.3935, 0.3935 } },
    { TONEMAP_HABLE, { { 1, 1, 1 } }, { 0.7307, 0.7307, 0.7307 } },
    { TONEMAP_HABLE, { { 4, 1, 0.2F } }, { 0.9631, 0.7307, 0.4116 } },
    { TONEMAP_HABLE, { { 0.02F, 0.1F, 60 } }, { 0.1299, 0.3020, 1.0000 } },
};

static void curves_are_those_of_the_papers(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const vec3s encoded =
            tonemap_encode(cases[i].radiance, (struct tonemap_params){ 1.0F, cases[i].curve });
        for (size_t c = 0; c < 3; c++)
            CHECK_NEAR(encoded.raw[c], cases[i].encoded[c], 2e-4);
    }
}

/* A brighter grey is never darker, and never beyond white. */
static void curves_rise(void **state)
{
    (void)state;
    for (uint32_t curve = 0; curve <= TONEMAP_LAST; curve++) {
        float before = 0.0F;
        for (int i = -200; i < 100; i++) {
            const float grey = exp2f((float)i / 15.0F); /* 1e-4 to 100 */
            const vec3s encoded = tonemap_encode((vec3s){ { grey, grey, grey } },
                                                 (struct tonemap_params){ 1.0F, curve });
            assert_true(encoded.y >= before - 1e-3F && encoded.y < 1.0001F);
            before = encoded.y;
        }
        assert_true(before > 0.95F);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_those_of_the_papers),
        cmocka_unit_test(curves_rise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
