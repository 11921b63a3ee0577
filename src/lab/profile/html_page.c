/* html_page.c: inserts profile and sweep as JSON into the HTML page. */
#include "src/lab/profile/html_page.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/json.h"
#include "src/lab/profile/page/embedded_page.h"

static size_t data_size(const char *json)
{
    size_t size = strlen(json);
    for (const char *c = json; (c = strchr(c, '<')); c++)
        size += sizeof("\\u003c") - 2;
    return size;
}

static char *put(char *at, const char *text, size_t size)
{
    memcpy(at, text, size);
    return at + size;
}

/* Copies JSON and escapes '<' in its strings, because "</script>" would end the HTML element. */
static char *write_data(char *at, const char *json)
{
    for (; *json; json++)
        at = *json == '<' ? put(at, "\\u003c", 6) : put(at, json, 1);
    return at;
}

/* Returns the page with its data inserted, or NULL when out of memory. */
static char *fill_page(const char *const data[static PAGE_PART_COUNT - 1], size_t *size)
{
    *size = page_parts[0].size;
    for (size_t i = 0; i + 1 < PAGE_PART_COUNT; i++)
        *size += data_size(data[i]) + page_parts[i + 1].size;
    char *text = malloc(*size + 1);
    if (!text)
        return NULL;
    char *at = put(text, page_parts[0].text, page_parts[0].size);
    for (size_t i = 0; i + 1 < PAGE_PART_COUNT; i++)
        at = put(write_data(at, data[i]), page_parts[i + 1].text, page_parts[i + 1].size);
    *at = 0;
    return text;
}

enum status profile_write_html(const struct profile *p, const struct profile_sweep *sweep,
                               char **text, size_t *size)
{
    char *profile_json = NULL, *sweep_json = NULL;
    *text = NULL;
    enum status status = profile_write_json(p, &profile_json, size);
    if (status == STATUS_OK && sweep)
        status = profile_write_sweep_json(sweep, &sweep_json, size);
    if (status != STATUS_OK)
        goto fail;
    *text = fill_page((const char *[]){ profile_json, sweep ? sweep_json : "null" }, size);
    if (!*text) {
        status = log_out_of_memory(NULL);
    }
fail:
    free(profile_json);
    free(sweep_json);
    return status;
}
