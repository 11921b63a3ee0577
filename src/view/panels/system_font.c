/* system_font.c: finds a system font through fontconfig. */
#include "src/view/panels/system_font.h"
#ifdef FONT_CONFIG
#include <fontconfig/fontconfig.h>
#include <stdio.h>

/* Accepts a font only if it is scalable, because fontconfig may fall back to a bitmap font. */
static bool take(struct system_font *font, const FcPattern *found)
{
    FcChar8 *path;
    FcBool scalable = FcFalse;
    if (FcPatternGetString(found, FC_FILE, 0, &path) != FcResultMatch ||
        FcPatternGetBool(found, FC_SCALABLE, 0, &scalable) != FcResultMatch || !scalable)
        return false;
    if (FcPatternGetInteger(found, FC_INDEX, 0, &font->index) != FcResultMatch)
        font->index = 0;
    font->index &= 0xffff; /* upper bits select a variable-font instance */
    const int length = snprintf(font->path, sizeof(font->path), "%s", (const char *)path);
    return length > 0 && length < SYSTEM_FONT_PATH_SIZE;
}

bool system_font_find(struct system_font *font, const char *family)
{
    FcResult result;
    bool found = false;
    *font = (struct system_font){ .index = 0 };
    FcConfig *config = FcInitLoadConfigAndFonts();
    FcPattern *pattern = FcNameParse((const FcChar8 *)family);
    if (config && pattern) {
        FcPatternAddBool(pattern, FC_SCALABLE, FcTrue);
        FcPatternAddBool(pattern, FC_COLOR, FcFalse);
        FcConfigSubstitute(config, pattern, FcMatchPattern);
        FcDefaultSubstitute(pattern);
        FcPattern *match = FcFontMatch(config, pattern, &result);
        found = match && take(font, match);
        if (match)
            FcPatternDestroy(match);
    }
    if (pattern)
        FcPatternDestroy(pattern);
    if (config)
        FcConfigDestroy(config);
    if (!found)
        *font = (struct system_font){ .index = 0 };
    return found;
}
#else
bool system_font_find(struct system_font *font, const char *family)
{
    (void)family;
    *font = (struct system_font){ .index = 0 };
    return false;
}
#endif
