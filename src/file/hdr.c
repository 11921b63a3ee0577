/* hdr.c: reads Radiance .hdr files: RGBE and XYZE, flat and run-length encoded, of any orientation.
 */
#include "src/file/hdr.h"
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"

enum {
    LINE_SIZE = 512, /* of a header line; longer lines are cut, which affects comments */
    RUNS_MIN = 8,    /* shortest and longest line with one run-length code per channel */
    RUNS_MAX = 32767,
    EXPONENT_BIAS = 128 + 8, /* of a mantissa from 0 to 255 */
};

static const char truncated[] = "the file is truncated";

struct hdr_file {
    const char *path;
    FILE *file;
    bool is_xyz;
    bool has_warned;             /* about an invalid header line */
    double gain[3];              /* product of EXPOSURE and COLORCORR: texels are divided by it */
    float matrix[9];             /* to linear Rec.709, row-major */
    bool has_matrix;             /* `matrix` is not the identity */
    uint32_t width, height;      /* of the image */
    uint32_t line_count, length; /* of the scan lines, which may be columns of the image */
    /* Index of the first texel, and distances of lines and of texels along a line in the image */
    ptrdiff_t first, line_step, step;
};

/* Reads a line without its end (LF or CR LF). Returns false at the end of the file. */
static bool read_line(FILE *file, char line[static LINE_SIZE])
{
    size_t length = 0;
    int c;
    while ((c = getc(file)) != EOF && c != '\n') {
        if (length < LINE_SIZE - 1)
            line[length++] = (char)c;
    }
    while (length > 0 && line[length - 1] == '\r')
        length--;
    line[length] = '\0';
    return c != EOF;
}

/* Returns the value of a header line, or NULL if the line is no assignment to the variable. */
static const char *value_of(const char *line, const char *variable)
{
    const size_t length = strlen(variable);
    if (strncmp(line, variable, length) != 0 || line[length] != '=')
        return NULL;
    line += length + 1;
    return line + strspn(line, " \t");
}

/* Returns true if a value is a word, which spaces may follow. */
static bool is_word(const char *value, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(value, word, length) == 0 && value[length + strspn(value + length, " \t")] == 0;
}

/* Parses the first `count` numbers of a text. */
static bool parse_numbers(const char *text, double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i]))
            return false;
        text = end;
    }
    return true;
}

/* Warns about the first header line that has no valid value. */
static void warn(struct hdr_file *hdr, const char *line, const char *expected)
{
    if (!hdr->has_warned)
        log_warning("%s: '%.80s' is ignored: expected %s", hdr->path, line, expected);
    hdr->has_warned = true;
}

/* Multiplies the gain by one number for all channels, or by one for each. */
static void parse_gain(struct hdr_file *hdr, const char *line, const char *value, int count)
{
    double numbers[3], gain[3];
    bool is_valid = parse_numbers(value, numbers, count);
    for (int c = 0; c < 3 && is_valid; c++) {
        gain[c] = hdr->gain[c] * numbers[count == 3 ? c : 0];
        is_valid = gain[c] > 1e-30 && gain[c] < 1e30;
    }
    if (is_valid)
        memcpy(hdr->gain, gain, sizeof(gain));
    else
        warn(hdr, line, "numbers above 0 with a product from 1e-30 to 1e30");
}

static void parse_primaries(struct hdr_file *hdr, const char *line, const char *value)
{
    double n[8];
    struct primaries primaries;
    enum primaries_kind kind = PRIMARIES_INVALID;
    if (parse_numbers(value, n, 8)) {
        primaries = (struct primaries){ { (float)n[0], (float)n[1] },
                                        { (float)n[2], (float)n[3] },
                                        { (float)n[4], (float)n[5] },
                                        { (float)n[6], (float)n[7] } };
        kind = primaries_to_rec709(&primaries, hdr->matrix);
    }
    hdr->has_matrix = kind == PRIMARIES_OTHER;
    if (kind == PRIMARIES_INVALID)
        warn(hdr, line, "the chromaticities of red, green, blue and white");
}

/* Parses a sign, X or Y, and a number. Returns NULL if the text is anything else. */
static const char *parse_axis(const char *text, bool *is_plus, char *axis, uint32_t *size)
{
    char *end;
    if ((text[0] != '+' && text[0] != '-') || (text[1] != 'X' && text[1] != 'Y') || text[2] != ' ')
        return NULL;
    *is_plus = text[0] == '+';
    *axis = text[1];
    const long number = strtol(text + 3, &end, 10);
    if (end == text + 3)
        return NULL;
    *size = number > 0 && number <= IMAGE_MAX_SIDE ? (uint32_t)number : 0;
    return end + strspn(end, " ");
}

/* Parses the line after the header: size, and order of the texels. The first axis is that along
 * which lines follow each other. Y points up. */
static const char *parse_resolution(struct hdr_file *hdr, const char *text)
{
    bool is_plus[2] = { false };
    char axes[2];
    text = parse_axis(text, &is_plus[0], &axes[0], &hdr->line_count);
    if (text)
        text = parse_axis(text, &is_plus[1], &axes[1], &hdr->length);
    if (!text || *text || axes[0] == axes[1])
        return "the resolution is damaged: expected a line such as '-Y 1024 +X 2048'";
    const bool has_rows = axes[0] == 'Y';
    const uint32_t width = has_rows ? hdr->length : hdr->line_count;
    const uint32_t height = has_rows ? hdr->line_count : hdr->length;
    if (!width || !height || width > IMAGE_MAX_TEXELS / height)
        return "the size is out of range";
    const bool is_from_left = is_plus[has_rows], is_from_top = !is_plus[!has_rows];
    const ptrdiff_t across = is_from_left ? 1 : -1;
    const ptrdiff_t down = is_from_top ? (ptrdiff_t)width : -(ptrdiff_t)width;
    hdr->width = width;
    hdr->height = height;
    hdr->first = (is_from_left ? 0 : (ptrdiff_t)width - 1) +
                 (is_from_top ? 0 : (ptrdiff_t)width * ((ptrdiff_t)height - 1));
    hdr->line_step = has_rows ? down : across;
    hdr->step = has_rows ? across : down;
    return NULL;
}

/* Reads the header. Returns a message that describes its fault, or NULL if it is valid. */
static const char *read_header(struct hdr_file *hdr)
{
    char line[LINE_SIZE];
    const char *value;
    if (!read_line(hdr->file, line) || strncmp(line, "#?", 2) != 0)
        return "not a Radiance HDR file";
    while (read_line(hdr->file, line) && *line) {
        if ((value = value_of(line, "EXPOSURE")))
            parse_gain(hdr, line, value, 1);
        else if ((value = value_of(line, "COLORCORR")))
            parse_gain(hdr, line, value, 3);
        else if ((value = value_of(line, "PRIMARIES")))
            parse_primaries(hdr, line, value);
        else if ((value = value_of(line, "FORMAT"))) {
            hdr->is_xyz = is_word(value, "32-bit_rle_xyze");
            if (!hdr->is_xyz && !is_word(value, "32-bit_rle_rgbe"))
                return "FORMAT is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze";
        }
    }
    if (hdr->is_xyz) {
        primaries_rec709_from_xyz(hdr->matrix);
        hdr->has_matrix = true;
    }
    return feof(hdr->file) || !read_line(hdr->file, line) ? truncated : parse_resolution(hdr, line);
}

/* Reads texels from index `at` on, which are flat or in the old run-length encoding: a texel
 * 1, 1, 1, n repeats the previous one n times, a second such texel 256 n times, and so on. */
static const char *read_texels(const struct hdr_file *hdr, uint8_t (*line)[4], uint32_t at)
{
    uint32_t shift = 0;
    while (at < hdr->length) {
        uint8_t texel[4];
        if (fread(texel, 1, sizeof(texel), hdr->file) != sizeof(texel))
            return truncated;
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            memcpy(line[at++], texel, sizeof(texel));
            shift = 0;
            continue;
        }
        uint64_t count = (uint64_t)texel[3] << shift;
        if (at == 0 || count > hdr->length - at)
            return "a run of texels is damaged";
        for (; count > 0; count--, at++)
            memcpy(line[at], line[at - 1], sizeof(texel));
        shift = shift < 32 ? shift + 8 : shift;
    }
    return NULL;
}

/* Reads one channel of a line: runs (a code above 128, and a byte) and dumps (their length). */
static const char *read_channel(const struct hdr_file *hdr, uint8_t (*line)[4], int channel)
{
    for (uint32_t at = 0; at < hdr->length;) {
        const int code = getc(hdr->file);
        if (code == EOF)
            return truncated;
        const uint32_t count = code > 128 ? (uint32_t)code - 128 : (uint32_t)code;
        if (count == 0 || count > hdr->length - at)
            return "a run of texels is damaged";
        int value = code > 128 ? getc(hdr->file) : 0;
        for (uint32_t i = 0; i < count; i++) {
            value = code > 128 ? value : getc(hdr->file);
            line[at++][channel] = (uint8_t)value;
        }
        if (value == EOF)
            return truncated;
    }
    return NULL;
}

static const char *read_scan_line(const struct hdr_file *hdr, uint8_t (*line)[4])
{
    if (hdr->length < RUNS_MIN || hdr->length > RUNS_MAX)
        return read_texels(hdr, line, 0);
    if (fread(line[0], 1, sizeof(line[0]), hdr->file) != sizeof(line[0]))
        return truncated;
    const uint8_t *start = line[0];
    if (start[0] == 1 && start[1] == 1 && start[2] == 1)
        return "a run of texels is damaged";
    if (start[0] != 2 || start[1] != 2 || start[2] > 127)
        return read_texels(hdr, line, 1);
    if (((uint32_t)start[2] << 8 | start[3]) != hdr->length)
        return "a line has the wrong length";
    for (int channel = 0; channel < 4; channel++) {
        const char *fault = read_channel(hdr, line, channel);
        if (fault)
            return fault;
    }
    return NULL;
}

static void store_line(const struct hdr_file *hdr, uint8_t (*line)[4], uint32_t index,
                       const struct image *image)
{
    ptrdiff_t at = hdr->first + (ptrdiff_t)index * hdr->line_step;
    for (uint32_t i = 0; i < hdr->length; i++, at += hdr->step) {
        const float unit = line[i][3] ? ldexpf(1.0f, line[i][3] - EXPONENT_BIAS) : 0.0f;
        for (int c = 0; c < 3; c++)
            image->planes[c].texels[at] =
                (float)((double)((float)line[i][c] * unit) / hdr->gain[c]);
    }
}

static enum status reject(const struct hdr_file *hdr, const char *fault)
{
    if (ferror(hdr->file)) {
        log_error("%s: cannot be read: %s", hdr->path, strerror(EIO));
        return STATUS_NO_INPUT;
    }
    log_error("%s: %s", hdr->path, fault);
    return STATUS_DATA;
}

static enum status read_image(const struct hdr_file *hdr, struct image *image)
{
    static const char names[3][2] = { "R", "G", "B" };
    const char *fault = NULL;
    bool has_memory = true;
    uint8_t(*line)[4] = malloc(hdr->length * sizeof(*line));
    image_init(image, hdr->width, hdr->height);
    for (int c = 0; c < 3 && has_memory; c++)
        has_memory = image_add_plane(image, names[c], false) != NULL;
    has_memory = has_memory && line;
    for (uint32_t i = 0; i < hdr->line_count && has_memory && !fault; i++) {
        fault = read_scan_line(hdr, line);
        if (!fault)
            store_line(hdr, line, i, image);
    }
    free(line);
    if (has_memory && !fault) {
        if (hdr->has_matrix)
            primaries_convert(hdr->matrix, image->planes[0].texels, image->planes[1].texels,
                              image->planes[2].texels, (size_t)hdr->width * hdr->height);
        return STATUS_OK;
    }
    image_finish(image);
    return has_memory ? reject(hdr, fault) : log_out_of_memory(hdr->path);
}

enum status hdr_read(const char *path, struct image *image, image_size_fn *begin, void *user)
{
    struct hdr_file hdr = { .path = path, .gain = { 1, 1, 1 } };
    int64_t size;
    enum status status = file_io_open(path, &hdr.file, &size);
    if (status != STATUS_OK)
        return status;
    const char *fault = read_header(&hdr);
    /* A line has two texels at least, one of which may be a run. */
    if (!fault && size < (int64_t)hdr.line_count * (hdr.length > 1 ? 8 : 4))
        fault = truncated;
    if (fault)
        status = reject(&hdr, fault);
    else if (begin)
        status = begin(user, hdr.width, hdr.height, 3);
    if (status == STATUS_OK)
        status = read_image(&hdr, image);
    fclose(hdr.file);
    return status;
}
