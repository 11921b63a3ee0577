/*
 * fuzz_settings.c: passes the input to --set. What is taken lies in its row's range and, printed,
 * gives the same again; what is refused changes nothing.
 */
#include <stdlib.h>
#include <string.h>

#include "src/settings/settings.h"
#include "tests/fuzz/fuzz.h"

/* Prints it and sets what is printed. */
static void check_row(const struct settings *settings, const struct setting *row)
{
    struct settings again = *settings;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    FUZZ_CHECK(out != NULL);
    fprintf(out, "%s=", row->name);
    settings_print(settings, row, out);
    FUZZ_CHECK(fclose(out) == 0);
    FUZZ_CHECK(settings_assign(&again, text, SETTING_USER, NULL) == STATUS_OK);
    FUZZ_CHECK(settings_equal(&again, settings));
    free(text);
}

static void check_all(const struct settings *settings)
{
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(settings, row);
        const bool is_auto = setting_is_auto(row, value);
        /* a float's limits are those of its doubles, rounded */
        FUZZ_CHECK(row->type == SETTING_CHOICE || row->type == SETTING_SWITCH || is_auto ||
                   ((float)value >= (float)row->min && (float)value <= (float)row->max));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct settings settings = settings_default();
    char *text = fuzz_text(data, size);
    const struct settings before = settings;
    if (settings_assign(&settings, text, SETTING_USER, NULL) == STATUS_OK) {
        char *equals = strchr(text, '=');
        FUZZ_CHECK(equals != NULL);
        *equals = '\0';
        const struct setting *row = settings_find(text);
        FUZZ_CHECK(row != NULL);
        check_all(&settings);
        check_row(&settings, row);
    } else {
        FUZZ_CHECK(memcmp(&settings, &before, sizeof(before)) == 0);
    }
    free(text);
    return 0;
}
