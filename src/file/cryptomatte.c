/* cryptomatte.c: hashes of names, and the metadata that maps them to names. */
#include "src/file/cryptomatte.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/json_text.h"

enum {
    NAME_SIZE = 64 /* of a name with its terminator, as MATERIAL_NAME_SIZE */
};

static uint32_t rotate(uint32_t x, uint32_t bits)
{
    return x << bits | x >> (32 - bits);
}

static uint32_t scramble(uint32_t k)
{
    return rotate(k * 0xcc9e2d51u, 15) * 0x1b873593u;
}

uint32_t cryptomatte_hash(const char *text)
{
    const size_t length = strlen(text);
    const unsigned char *bytes = (const unsigned char *)text;
    uint32_t h = 0;
    for (size_t i = 0; i + 4 <= length; i += 4) {
        const uint32_t k = bytes[i] | (uint32_t)bytes[i + 1] << 8 | (uint32_t)bytes[i + 2] << 16 |
                           (uint32_t)bytes[i + 3] << 24;
        h = rotate(h ^ scramble(k), 13) * 5 + 0xe6546b64u;
    }
    uint32_t k = 0;
    for (size_t i = length; i > length / 4 * 4; i--)
        k = k << 8 | bytes[i - 1];
    h ^= scramble(k);
    h ^= (uint32_t)length;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

float cryptomatte_id(const char *name)
{
    uint32_t bits = cryptomatte_hash(name);
    const uint32_t exponent = bits >> 23 & 255;
    float id;
    if (exponent == 0 || exponent == 255)
        bits ^= 1u << 23;
    memcpy(&id, &bits, sizeof(id));
    return id;
}

/* Adds a line "NUMBER NAME" to a manifest. Returns false when out of memory. */
static bool add_name(json_t *manifest, const char *line, size_t length)
{
    const char *space = memchr(line, ' ', length);
    const char *start = space ? space + 1 : line;
    const size_t size = length - (size_t)(start - line);
    char hex[9], name[NAME_SIZE] = "";
    memcpy(name, start, size < NAME_SIZE ? size : NAME_SIZE - 1);
    json_t *valid = json_string(name); /* NULL: not UTF-8, which JSON cannot store */
    const float id = cryptomatte_id(name);
    uint32_t bits;
    memcpy(&bits, &id, sizeof(bits));
    snprintf(hex, sizeof(hex), "%08x", bits);
    const bool done = !valid || json_object_set_new(manifest, name, json_string(hex)) == 0;
    json_decref(valid);
    return done;
}

/* Returns the manifest, a JSON object of IDs by name, or NULL when out of memory. */
static char *make_manifest(const char *names)
{
    json_t *manifest = json_object();
    bool done = manifest != NULL;
    for (const char *line = names; *line && done;) {
        const size_t length = strcspn(line, "\n");
        done = add_name(manifest, line, length);
        line += length + (line[length] == '\n');
    }
    char *text = done ? json_dumps(manifest, JSON_COMPACT | JSON_SORT_KEYS) : NULL;
    json_decref(manifest);
    return text;
}

bool cryptomatte_describe(struct cryptomatte_texts *texts, const char *name, const char *names)
{
    static const char *const keys[CRYPTOMATTE_TEXTS] = { "name", "hash", "conversion", "manifest" };
    texts->manifest = make_manifest(names);
    const char *const values[CRYPTOMATTE_TEXTS] = { name, "MurmurHash3_32", "uint32_to_float32",
                                                    texts->manifest };
    for (size_t i = 0; i < CRYPTOMATTE_TEXTS; i++) {
        snprintf(texts->keys[i], sizeof(texts->keys[i]), "cryptomatte/%.7x/%s",
                 cryptomatte_hash(name) >> 4, keys[i]);
        texts->all[i] = (struct image_text){ texts->keys[i], values[i] };
    }
    return texts->manifest != NULL;
}

void cryptomatte_finish(struct cryptomatte_texts *texts)
{
    free(texts->manifest);
    *texts = (struct cryptomatte_texts){ 0 };
}
