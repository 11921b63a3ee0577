/* model_avif.c: decodes AVIF textures of models, by libavif. */
#include "src/scene/import/model_avif.h"
#include <avif/avif.h>
#include <string.h>

bool model_avif_is_built(void)
{
    return true;
}

/* Returns a decoder that has read the header of an image, or NULL. Decodes in this thread, because
 * the sandbox of a reader allows no other. */
static avifDecoder *open_decoder(const uint8_t *bytes, size_t size)
{
    static const char brand[] = "ftypavif"; /* at byte 4 of still images */
    if (size < 4 + sizeof(brand) || memcmp(&bytes[4], brand, sizeof(brand) - 1) != 0)
        return NULL;
    avifDecoder *decoder = avifDecoderCreate();
    if (!decoder)
        return NULL;
    decoder->maxThreads = 1;
    decoder->ignoreExif = AVIF_TRUE;
    decoder->ignoreXMP = AVIF_TRUE;
    if (avifDecoderSetIOMemory(decoder, bytes, size) == AVIF_RESULT_OK &&
        avifDecoderParse(decoder) == AVIF_RESULT_OK)
        return decoder;
    avifDecoderDestroy(decoder);
    return NULL;
}

bool model_avif_read_size(const uint8_t *bytes, size_t size, int *width, int *height)
{
    avifDecoder *decoder = open_decoder(bytes, size);
    if (!decoder)
        return false;
    *width = (int)decoder->image->width;
    *height = (int)decoder->image->height;
    avifDecoderDestroy(decoder);
    return true;
}

enum status model_avif_decode(const uint8_t *bytes, size_t size, int width, int height,
                              uint8_t *texels)
{
    avifDecoder *decoder = open_decoder(bytes, size);
    avifRGBImage rgb;
    if (!decoder)
        return STATUS_DATA;
    avifResult result = avifDecoderNextImage(decoder);
    if (result == AVIF_RESULT_OK &&
        (decoder->image->width != (uint32_t)width || decoder->image->height != (uint32_t)height))
        result = AVIF_RESULT_INVALID_ARGUMENT;
    if (result == AVIF_RESULT_OK) {
        avifRGBImageSetDefaults(&rgb, decoder->image);
        rgb.format = AVIF_RGB_FORMAT_RGBA;
        rgb.depth = 8;
        rgb.pixels = texels;
        rgb.rowBytes = (uint32_t)width * 4;
        result = avifImageYUVToRGB(decoder->image, &rgb);
    }
    avifDecoderDestroy(decoder);
    if (result == AVIF_RESULT_OUT_OF_MEMORY)
        return STATUS_TRY_AGAIN;
    return result == AVIF_RESULT_OK ? STATUS_OK : STATUS_DATA;
}
