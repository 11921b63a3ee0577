/*
 * fuzz_profile_json.c: reads the input as a profile. What is accepted can be printed and compared,
 * and what is written of it is read and written again byte by byte.
 */
#include <string.h>
#include "src/lab/profile/profile_reports.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_file.h"

static char *write_report(profile_report_fn *report, struct profile *profile)
{
    const struct profile_sweep sweep = { .points = profile, .point_count = 1 };
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    FUZZ_CHECK(out != NULL);
    FUZZ_CHECK(report(&sweep, out) == STATUS_OK);
    FUZZ_CHECK(fclose(out) == 0);
    FUZZ_CHECK(size == strlen(text));
    return text;
}

static void compare(const struct profile *profile)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool is_slower = true;
    FUZZ_CHECK(out != NULL);
    const enum status status = profile_compare(profile, profile, 0, out, &is_slower);
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_USAGE); /* too few runs */
    FUZZ_CHECK(!is_slower);                                    /* than itself */
    FUZZ_CHECK(fclose(out) == 0);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    struct profile profile;
    fuzz_file_write(path, "a.json", data, size);
    const enum status status = profile_read_json(path, &profile);
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA);
    FUZZ_CHECK(status == STATUS_OK || (!profile.rows && !profile.settings && !profile.command));
    if (status != STATUS_OK)
        return 0;
    char *first = write_report(profile_json, &profile);
    free(write_report(profile_table, &profile));
    compare(&profile);
    profile_finish(&profile);
    fuzz_file_write(path, "a.json", (const uint8_t *)first, strlen(first));
    FUZZ_CHECK(profile_read_json(path, &profile) == STATUS_OK);
    char *second = write_report(profile_json, &profile);
    FUZZ_CHECK(!strcmp(first, second));
    profile_finish(&profile);
    free(first);
    free(second);
    return 0;
}
