/* png_write.c: encodes PNG files in memory, and checks whole PNG files, with libpng. */
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/png.h"

enum {
    MESSAGE_SIZE = 128,
};

/* Keeps libpng's error message, and returns to the setjmp() of the caller. */
static _Noreturn void fail(png_structp png, png_const_charp text)
{
    char *message = png_get_error_ptr(png);
    snprintf(message, MESSAGE_SIZE, "%s", text);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

/* ---- encoding ---- */

/* Encoded file in memory. */
struct output {
    uint8_t *bytes;
    size_t size, capacity;
    bool is_out_of_memory;
};

static void append(png_structp png, png_bytep bytes, size_t size)
{
    struct output *output = png_get_io_ptr(png);
    const size_t end = output->size + size;
    if (end > output->capacity) {
        uint8_t *grown = realloc(output->bytes, 2 * end);
        output->is_out_of_memory = !grown;
        if (!grown)
            png_error(png, "out of memory");
        output->bytes = grown;
        output->capacity = 2 * end;
    }
    memcpy(output->bytes + output->size, bytes, size);
    output->size = end;
}

static void flush(png_structp png)
{
    (void)png;
}

static bool is_ascii(const char *text)
{
    while (*text > 0 && *text < 0x7f)
        text++;
    return *text == '\0';
}

/* Adds ASCII text as a tEXt chunk, other text as an iTXt chunk (UTF-8). libpng copies both. */
static void set_text(png_structp png, png_infop info, const struct image_text *text)
{
    png_text chunk = {
        .compression =
            is_ascii(text->value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
    };
    memcpy(&chunk.key, &text->name, sizeof(chunk.key)); /* libpng does not change the texts */
    memcpy(&chunk.text, &text->value, sizeof(chunk.text));
    png_set_text(png, info, &chunk, 1);
}

/* Encodes an image. Returns false after a failure, which fail() or `output` describes. */
static bool write_image(png_structp png, png_infop info, const struct png_image_source *picture)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_IHDR(png, info, picture->width, picture->height, picture->rgba_16 ? 16 : 8,
                 picture->has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (picture->height > IMAGE_MAX_TEXELS / picture->width)
        png_error(png, "too many pixels");
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    for (uint32_t i = 0; i < picture->text_count; i++)
        set_text(png, info, &picture->texts[i]);
    png_write_info(png, info);
    if (picture->rgba_16)
        png_set_swap(png); /* PNG is big-endian */
    if (!picture->has_alpha)
        png_set_filler(png, 0, PNG_FILLER_AFTER); /* drops the fourth channel */
    for (size_t y = 0; y < picture->height; y++) {
        const size_t at = 4 * y * picture->width;
        png_write_row(png, picture->rgba_16 ? (png_const_bytep)&picture->rgba_16[at]
                                            : &picture->rgba[at]);
    }
    png_write_end(png, NULL);
    return true;
}

enum status png_encode(const struct png_image_source *picture, void **data, size_t *size)
{
    char message[MESSAGE_SIZE] = "out of memory";
    struct output output = { 0 };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, message, fail, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info)
        png_set_write_fn(png, &output, append, flush);
    const bool is_done = info && write_image(png, info, picture);
    const bool is_out_of_memory = !info || output.is_out_of_memory;
    png_destroy_write_struct(&png, &info);
    *data = is_done ? output.bytes : NULL;
    *size = is_done ? output.size : 0;
    if (is_done)
        return STATUS_OK;
    free(output.bytes);
    log_error("the PNG image of %u x %u pixels could not be encoded: %s", picture->width,
              picture->height, message);
    return is_out_of_memory ? STATUS_TRY_AGAIN : STATUS_FAILED;
}

/* ---- checking ---- */

/* Reads a whole file row by row, and checks all CRCs. Returns false if it is damaged, or larger
 * than firn writes. */
static bool read_image(png_structp png, png_infop info, FILE *file)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_init_io(png, file);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_user_limits(png, IMAGE_MAX_SIDE, IMAGE_MAX_SIDE);
    png_read_info(png, info);
    const uint64_t height = png_get_image_height(png, info);
    if (height * png_get_image_width(png, info) > IMAGE_MAX_TEXELS)
        png_error(png, "too many pixels");
    const uint64_t rows = height * (uint64_t)png_set_interlace_handling(png);
    png_read_update_info(png, info);
    for (uint64_t y = 0; y < rows; y++)
        png_read_row(png, NULL, NULL);
    png_read_end(png, info);
    return true;
}

/* Copies size, channels and texts to *head. Returns false when out of memory. */
static bool fill_head(struct image_header *head, png_structp png, png_infop info)
{
    static const char names[4][2] = { "R", "G", "B", "A" };
    const uint32_t plane_count = png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA ? 4 : 3;
    png_textp texts = NULL;
    const int text_count = png_get_text(png, info, &texts, NULL);
    bool done = true;
    image_init(&head->image, png_get_image_width(png, info), png_get_image_height(png, info));
    for (uint32_t p = 0; p < plane_count && done; p++)
        done = image_header_add_plane(head, names[p], false);
    for (int i = 0; i < text_count && done; i++)
        done = image_header_add_text(head, texts[i].key, texts[i].text, strlen(texts[i].text));
    return done;
}

enum status png_check(const char *path, struct image_header *head)
{
    char message[MESSAGE_SIZE] = "data follows its end";
    FILE *file;
    int64_t size;
    enum status status = file_io_open(path, &file, &size);
    *head = (struct image_header){ 0 };
    if (status != STATUS_OK)
        return status;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, message, fail, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const bool has_chunks = png_has_whole_chunks(file, size);
    if (!has_chunks)
        snprintf(message, sizeof(message), "a chunk ends after the file");
    const bool is_whole = info && has_chunks && read_image(png, info, file) && fgetc(file) == EOF;
    if (!info || (is_whole && !fill_head(head, png, info))) {
        status = log_out_of_memory(path);
        image_header_finish(head);
    } else if (!is_whole) {
        status = ferror(file) ? STATUS_NO_INPUT : STATUS_DATA;
        log_error("%s: not a PNG file, or damaged: %s", path, message);
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return status;
}

bool png_matches(const struct image_header *head, const struct png_image_source *picture)
{
    struct image_plane planes[] = {
        { .name = "R" },
        { .name = "G" },
        { .name = "B" },
        { .name = "A" },
    };
    const uint32_t plane_count = picture->has_alpha ? 4 : 3;
    const struct image image = { picture->width, picture->height, plane_count, planes };
    return image_header_matches(head, &image, picture->texts, picture->text_count);
}
