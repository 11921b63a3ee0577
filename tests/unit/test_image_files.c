/* test_image_files.c: PNG out, Radiance HDR in, and files that are whole or not there. */
#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/image/file.h"
#include "src/image/hdr.h"
#include "src/image/png.h"
#include "tests/support/check.h"

/* Every test runs inside a folder of its own, empty at first. */
static int enter_folder(void **state)
{
    char name[] = "/tmp/firn-test-files-XXXXXX";
    if (!mkdtemp(name) || chmod(name, 0755) != 0 || chdir(name) != 0)
        return -1;
    *state = strdup(name);
    return *state ? 0 : -1;
}

static int leave_folder(void **state)
{
    DIR *folder = opendir(".");
    const struct dirent *entry;

    if (!folder)
        return -1;
    while ((entry = readdir(folder)))
        (void)remove(entry->d_name);
    closedir(folder);
    const int result = chdir("/") == 0 && rmdir(*state) == 0 ? 0 : -1;
    free(*state);
    return result;
}

static int count_files(void)
{
    DIR *folder = opendir(".");
    int count = -2; /* "." and ".." */
    assert_non_null(folder);
    while (readdir(folder))
        count++;
    closedir(folder);
    return count;
}

static void save(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void check_content(const char *path, const char *expected)
{
    char text[64] = "";
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(text, 1, sizeof(text) - 1, file);
    fclose(file);
    assert_int_equal(count, strlen(expected));
    assert_string_equal(text, expected);
}

/* -- PNG -- */

enum {
    PNG_WIDTH = 31,
    PNG_HEIGHT = 17,
    PNG_COUNT = PNG_WIDTH * PNG_HEIGHT
};

static void fill_rgba(uint8_t rgba[static 4 * PNG_COUNT])
{
    for (int i = 0; i < 4 * PNG_COUNT; i++)
        rgba[i] = (uint8_t)(i * 7 + i / 50);
}

static enum status encode_png(const uint8_t *rgba, uint32_t width, uint32_t height, void **data,
                              size_t *size)
{
    return png_encode(&(struct png_picture){ .rgba = rgba, .width = width, .height = height }, data,
                      size);
}

static void test_png_round_trip(void **state)
{
    uint8_t rgba[4 * PNG_COUNT], rgb[3 * PNG_COUNT];
    png_image png = { .version = PNG_IMAGE_VERSION };
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    assert_true(png_image_begin_read_from_memory(&png, data, size));
    assert_int_equal(png.width, PNG_WIDTH);
    assert_int_equal(png.height, PNG_HEIGHT);
    assert_int_equal(png.format, PNG_FORMAT_RGB);
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
    for (size_t i = 0; i < PNG_COUNT; i++)
        assert_memory_equal(&rgb[3 * i], &rgba[4 * i], 3);
    free(data);
}

/* Only these chunks, of which sRGB says "perceptual": no time of day. */
static void test_png_chunks(void **state)
{
    static const char names[] = "IHDR sRGB IDAT IEND ";
    uint8_t rgba[4 * PNG_COUNT];
    char found[64] = "";
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    const uint8_t *bytes = data;
    for (size_t at = 8; at + 12 <= size && strlen(found) < 50;) {
        const size_t length = (size_t)bytes[at + 2] << 8 | bytes[at + 3];
        strncat(found, (const char *)bytes + at + 4, 4);
        strncat(found, " ", 2);
        if (memcmp(bytes + at + 4, "sRGB", 4) == 0)
            assert_int_equal(bytes[at + 8], PNG_sRGB_INTENT_PERCEPTUAL);
        at += 12 + length;
    }
    assert_string_equal(found, names);
    free(data);
}

static void test_png_sizes(void **state)
{
    const uint8_t texel[4] = { 1, 2, 3, 4 };
    void *data;
    size_t size;

    (void)state;
    assert_int_equal(encode_png(texel, 1, 1, &data, &size), STATUS_OK);
    free(data);
    assert_int_equal(encode_png(texel, 0, 1, &data, &size), STATUS_FAILED);
    assert_null(data);
    assert_int_equal(encode_png(texel, 65536, 65536, &data, &size), STATUS_FAILED);
    assert_null(data);
}

/* -- Radiance HDR -- */

#define HDR_HEAD "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n\n"

struct hdr {
    unsigned char bytes[512];
    size_t size;
};

static void put(struct hdr *hdr, const void *bytes, size_t size)
{
    assert_true(hdr->size + size <= sizeof(hdr->bytes));
    memcpy(hdr->bytes + hdr->size, bytes, size);
    hdr->size += size;
}

static void put_text(struct hdr *hdr, const char *text)
{
    put(hdr, text, strlen(text));
}

static enum status read_hdr(const struct hdr *hdr, size_t size, struct image *image)
{
    save("a.hdr", hdr->bytes, size);
    return hdr_read("a.hdr", image);
}

static void check_refused(const struct hdr *hdr, size_t size)
{
    static const struct image empty;
    struct image image = { 0 };
    assert_int_equal(read_hdr(hdr, size, &image), STATUS_DATA);
    assert_memory_equal(&image, &empty, sizeof(empty));
}

static void check_texel(const struct image *image, size_t i, float r, float g, float b)
{
    assert_true(image_find(image, "R")[i] == r);
    assert_true(image_find(image, "G")[i] == g);
    assert_true(image_find(image, "B")[i] == b);
}

/* Mantissas count 2^(exponent - 136). */
static void make_flat(struct hdr *hdr)
{
    static const unsigned char texels[4][4] = {
        { 128, 64, 0, 129 }, { 255, 1, 2, 136 }, { 9, 9, 9, 0 }, { 128, 0, 200, 100 }
    };
    *hdr = (struct hdr){ .size = 0 };
    put_text(hdr, HDR_HEAD "-Y 2 +X 2\n");
    put(hdr, texels, sizeof(texels));
}

/* Row 0 in runs and dumps, row 1 in runs alone. */
static void make_runs(struct hdr *hdr)
{
    static const unsigned char rows[] = {
        2,       2,   0,  9,  128 + 9, 128,        /* R: nine of 1 */
        4,       8,   16, 32, 64,      128 + 5, 2, /* G: four, then five equal ones */
        9,       0,   1,  2,  3,       4,       5,       6,  7,       8, /* B */
        128 + 9, 129,                                                    /* exponents */
        2,       2,   0,  9,  128 + 9, 64,      128 + 9, 32, 128 + 9, 16, 128 + 9, 129,
    };
    *hdr = (struct hdr){ .size = 0 };
    put_text(hdr, HDR_HEAD "-Y 2 +X 9\n");
    put(hdr, rows, sizeof(rows));
}

static void test_hdr_flat(void **state)
{
    struct hdr hdr;
    struct image image = { 0 };

    (void)state;
    make_flat(&hdr);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    assert_int_equal(image.width, 2);
    assert_int_equal(image.height, 2);
    assert_int_equal(image.plane_count, 3);
    check_texel(&image, 0, 1.0f, 0.5f, 0.0f);
    check_texel(&image, 1, 255.0f, 1.0f, 2.0f);
    check_texel(&image, 2, 0.0f, 0.0f, 0.0f);
    check_texel(&image, 3, 0x1p-29f, 0.0f, 200 * 0x1p-36f);
    image_finish(&image);
}

static void test_hdr_runs(void **state)
{
    struct hdr hdr;
    struct image image = { 0 };

    (void)state;
    make_runs(&hdr);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    assert_int_equal(image.width, 9);
    assert_int_equal(image.height, 2);
    for (size_t x = 0; x < 9; x++) {
        const float g = x < 4 ? (float)(8 << x) : 2.0f;
        check_texel(&image, x, 1.0f, g / 128.0f, (float)x / 128.0f);
        check_texel(&image, 9 + x, 0.5f, 0.25f, 0.125f);
    }
    image_finish(&image);
}

/* Wide enough for runs, but flat; and longer than what stb_image reads at once. */
static void test_hdr_wide_flat(void **state)
{
    struct hdr hdr = { .size = 0 };
    struct image image = { 0 };

    (void)state;
    put_text(&hdr, HDR_HEAD "-Y 5 +X 16\n");
    for (int i = 0; i < 80; i++)
        put(&hdr, (unsigned char[]){ 128, (unsigned char)i, 0, 128 + 8 }, 4);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    for (size_t i = 0; i < 80; i++)
        check_texel(&image, i, 128.0f, (float)i, 0.0f);
    image_finish(&image);
    for (size_t size = hdr.size - 1; size > hdr.size - 300; size--)
        check_refused(&hdr, size);
}

static void test_hdr_cut_short(void **state)
{
    struct hdr hdr;

    (void)state;
    make_flat(&hdr);
    for (size_t size = 0; size < hdr.size; size++)
        check_refused(&hdr, size);
    make_runs(&hdr);
    for (size_t size = 0; size < hdr.size; size++)
        check_refused(&hdr, size);
}

/* Runs of no length: stb_image 2.27 waits for ever for a run at the end of such a file. */
static void test_hdr_endless_runs(void **state)
{
    static const unsigned char zeros[64];
    struct hdr hdr = { .size = 0 };

    (void)state;
    put_text(&hdr, HDR_HEAD "-Y 1 +X 9\n");
    put(&hdr, (unsigned char[]){ 2, 2, 0, 9 }, 4);
    put(&hdr, zeros, sizeof(zeros));
    check_refused(&hdr, hdr.size);
}

static void test_hdr_headers(void **state)
{
    static const char *const headers[] = {
        "",
        "P6 1 1 255\n...",
        "#?RADIANCE\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n....",
        HDR_HEAD "+X 1 -Y 1\n....",
        HDR_HEAD "-Y 0 +X 1\n....",
        HDR_HEAD "-Y -1 +X 1\n....",
        HDR_HEAD "-Y 65537 +X 1\n....",
        HDR_HEAD "-Y 1 +X 65537\n....",
        HDR_HEAD "-Y 65536 +X 4097\n....",
        HDR_HEAD "-Y 65536 +X 4096\n....", /* in range, but where is the rest? */
        HDR_HEAD "-Y 1 +X 1\n...",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(headers) / sizeof(headers[0]); i++) {
        struct hdr hdr = { .size = 0 };
        put_text(&hdr, headers[i]);
        check_refused(&hdr, hdr.size);
    }
}

static void test_hdr_no_input(void **state)
{
    struct image image = { 0 };
    (void)state;
    assert_int_equal(hdr_read("none.hdr", &image), STATUS_NO_INPUT);
    assert_int_equal(hdr_read(".", &image), STATUS_NO_INPUT);
    assert_int_equal(image.plane_count, 0);
}

static void test_hdr_refuses_png(void **state)
{
    uint8_t rgba[4 * PNG_COUNT];
    struct image image = { 0 };
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    save("a.png", data, size);
    free(data);
    assert_int_equal(hdr_read("a.png", &image), STATUS_DATA);
}

/* -- files -- */

static void test_file_new_and_again(void **state)
{
    (void)state;
    assert_int_equal(file_check("a"), STATUS_OK);
    assert_int_equal(count_files(), 0);
    assert_int_equal(file_write("a", "first", 5), STATUS_OK);
    check_content("a", "first");
    assert_int_equal(file_check("a"), STATUS_OK);
    assert_int_equal(file_write("a", "2nd", 3), STATUS_OK);
    check_content("a", "2nd");
    assert_int_equal(file_write("./a", "", 0), STATUS_OK);
    check_content("a", "");
    assert_int_equal(count_files(), 1);
}

static void test_file_mode(void **state)
{
    struct stat info;
    const mode_t mask = umask(027);

    (void)state;
    assert_int_equal(file_write("a", "x", 1), STATUS_OK);
    umask(mask);
    assert_int_equal(stat("a", &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    for (mode_t mode = 0400; mode <= 0666; mode += 0266) { /* whoever may write the folder */
        assert_int_equal(chmod("a", mode), 0);
        assert_int_equal(file_write("a", "y", 1), STATUS_OK);
        check_content("a", "y");
        assert_int_equal(stat("a", &info), 0);
        assert_int_equal(info.st_mode & 0777, mode);
    }
}

static void test_file_absolute_path(void **state)
{
    char path[PATH_MAX];
    snprintf(path, sizeof(path), "%s/a", (const char *)*state);
    assert_int_equal(file_write(path, "abc", 3), STATUS_OK);
    check_content("a", "abc");
    if (access("/", W_OK) == 0)
        assert_int_equal(file_check("/firn-test-no-such-file"), STATUS_OK);
}

/* The older file survives a write that fails half way, and nothing else is left. */
static void test_file_failed_write(void **state)
{
    static const char big[100000];
    struct rlimit old, low;

    (void)state;
    assert_int_equal(file_write("a", "old", 3), STATUS_OK);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    low = old;
    low.rlim_cur = 65536;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &low), 0);
    const enum status again = file_write("a", big, sizeof(big));
    const enum status fresh = file_write("b", big, sizeof(big));
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    signal(SIGXFSZ, handler);
    assert_int_equal(again, STATUS_WRITE);
    assert_int_equal(fresh, STATUS_WRITE);
    check_content("a", "old");
    assert_int_equal(count_files(), 1);
}

static void check_cannot_create(const char *path)
{
    assert_int_equal(file_check(path), STATUS_CANT_CREATE);
    assert_int_equal(file_write(path, "x", 1), STATUS_CANT_CREATE);
}

static void test_file_bad_targets(void **state)
{
    char name[NAME_MAX + 2] = "";

    (void)state;
    save("plain", "x", 1);
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(symlink("folder", "to-folder"), 0);
    assert_int_equal(symlink("nothing", "to-nothing"), 0);
    memset(name, 'n', NAME_MAX + 1);
    check_cannot_create("");
    check_cannot_create(".");
    check_cannot_create("/");
    check_cannot_create("folder");
    check_cannot_create("folder/");
    check_cannot_create("new/");
    check_cannot_create("to-folder");
    check_cannot_create("to-nothing");
    check_cannot_create("missing/a");
    check_cannot_create("plain/a");
    check_cannot_create(name);
    check_content("plain", "x");
    assert_int_equal(count_files(), 4);
}

static void test_file_folder_without_permission(void **state)
{
    const uid_t user = geteuid();

    (void)state;
    assert_int_equal(mkdir("locked", 0555), 0);
    if (user == 0) /* whom nothing stops */
        assert_int_equal(seteuid(65534), 0);
    const enum status check = file_check("locked/a");
    const enum status write = file_write("locked/a", "x", 1);
    assert_int_equal(seteuid(user), 0);
    assert_int_equal(check, STATUS_CANT_CREATE);
    assert_int_equal(write, STATUS_CANT_CREATE);
}

static void test_file_symbolic_link(void **state)
{
    struct stat info;

    (void)state;
    assert_int_equal(mkdir("folder", 0777), 0);
    save("folder/target", "old", 3);
    assert_int_equal(symlink("folder/target", "one"), 0);
    assert_int_equal(symlink("one", "two"), 0);
    assert_int_equal(file_check("two"), STATUS_OK);
    assert_int_equal(file_write("two", "new", 3), STATUS_OK);
    check_content("folder/target", "new");
    assert_int_equal(lstat("one", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(lstat("two", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(unlink("folder/target"), 0);
    assert_int_equal(count_files(), 3);
}

static void test_file_long_names(void **state)
{
    static const size_t lengths[] = { 200, 240, NAME_MAX - 1, NAME_MAX };
    (void)state;
    for (size_t i = 0; i < 4; i++) {
        char name[NAME_MAX + 1] = "";
        memset(name, 'n', lengths[i]);
        assert_int_equal(file_check(name), STATUS_OK);
        assert_int_equal(file_write(name, "abc", 3), STATUS_OK);
        check_content(name, "abc");
    }
    assert_int_equal(count_files(), 4);
}

/* A temporary without a lock was left by a killed process, and goes. */
static void test_file_left_temporary(void **state)
{
    static const char *const others[] = { ".b.k3Xz0q.tmp",  ".a.k3Xz0.tmp", ".a.k3Xz0qq.tmp",
                                          ".a.k3Xz-q.tmp",  ".a.k3Xz0q.tm", "a.k3Xz0q.tmp",
                                          ".a.k3Xz0q.tmp~", ".ak3Xz0q.tmp" };
    (void)state;
    save("victim", "safe", 4);
    assert_int_equal(symlink("victim", ".a.SYMLNK.tmp"), 0);
    assert_int_equal(mkfifo(".a.0FIFO0.tmp", 0666), 0);
    save(".a.living.tmp", "x", 1);
    const int living = open(".a.living.tmp", O_RDWR);
    assert_int_equal(flock(living, LOCK_EX), 0);
    for (int i = 0; i < 8; i++)
        save(others[i], "x", 1);
    save(".a.k3Xz0q.tmp", "left", 4);
    save(".a.999999.tmp", "", 0);
    assert_int_equal(file_write("a", "abc", 3), STATUS_OK);
    check_content("a", "abc");
    check_content("victim", "safe");
    assert_int_equal(access(".a.k3Xz0q.tmp", F_OK), -1);
    assert_int_equal(access(".a.999999.tmp", F_OK), -1);
    assert_int_equal(count_files(), 8 + 5);
    close(living);
    assert_int_equal(file_write("a", "def", 3), STATUS_OK);
    assert_int_equal(count_files(), 8 + 4);
}

static void test_file_pipe(void **state)
{
    char text[8] = "";
    struct stat info;

    (void)state;
    assert_int_equal(mkfifo("pipe", 0666), 0);
    const int reader = open("pipe", O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    assert_int_equal(file_check("pipe"), STATUS_OK);
    assert_int_equal(file_write("pipe", "abc", 3), STATUS_OK);
    assert_int_equal(read(reader, text, sizeof(text)), 3);
    assert_string_equal(text, "abc");
    close(reader);
    assert_int_equal(stat("pipe", &info), 0);
    assert_true(S_ISFIFO(info.st_mode));
    assert_int_equal(count_files(), 1);
}

/* Writes "-" while stdout is a pipe; text printed before goes out before. */
static void test_file_stdout(void **state)
{
    char text[16] = "";
    int ends[2];

    (void)state;
    fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    assert_int_equal(pipe(ends), 0);
    dup2(ends[1], STDOUT_FILENO);
    printf("first ");
    const enum status check = file_check("-");
    const enum status write = file_write("-", "then", 4);
    const ssize_t count = read(ends[0], text, sizeof(text) - 1);
    void (*handler)(int) = signal(SIGPIPE, SIG_IGN);
    close(ends[0]);
    const enum status broken = file_write("-", "then", 4);
    dup2(saved, STDOUT_FILENO);
    signal(SIGPIPE, handler);
    close(saved);
    close(ends[1]);
    assert_int_equal(check, STATUS_OK);
    assert_int_equal(write, STATUS_OK);
    assert_int_equal(count, 10);
    assert_string_equal(text, "first then");
    assert_int_equal(broken, STATUS_WRITE);
    assert_int_equal(count_files(), 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_folder, leave_folder)

int main(void)
{
    const struct CMUnitTest tests[] = { TEST(test_png_round_trip),
                                        TEST(test_png_chunks),
                                        TEST(test_png_sizes),
                                        TEST(test_hdr_flat),
                                        TEST(test_hdr_runs),
                                        TEST(test_hdr_wide_flat),
                                        TEST(test_hdr_cut_short),
                                        TEST(test_hdr_endless_runs),
                                        TEST(test_hdr_headers),
                                        TEST(test_hdr_no_input),
                                        TEST(test_hdr_refuses_png),
                                        TEST(test_file_new_and_again),
                                        TEST(test_file_mode),
                                        TEST(test_file_absolute_path),
                                        TEST(test_file_failed_write),
                                        TEST(test_file_bad_targets),
                                        TEST(test_file_folder_without_permission),
                                        TEST(test_file_symbolic_link),
                                        TEST(test_file_long_names),
                                        TEST(test_file_left_temporary),
                                        TEST(test_file_pipe),
                                        TEST(test_file_stdout) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
