/* fuzz_hdr.c: reads the input as a Radiance HDR file, as an image and as a panorama. */
#include "src/file/hdr.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/fuzz_image.h"
#include "tests/fuzz/fuzz_scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    struct image image = { 0 };
    fuzz_file_write(path, "a.hdr", data, size);
    const enum status status = hdr_read(path, &image, NULL, NULL);
    fuzz_check_image(&image, status);
    image_finish(&image);
    FUZZ_CHECK(fuzz_load_environment(path) != STATUS_OK || status == STATUS_OK);
    return 0;
}
