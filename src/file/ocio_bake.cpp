/* ocio_bake.cpp: converts colours with a view of an OpenColorIO config. */
#include "src/file/ocio_bake.h"
#include <OpenColorIO/OpenColorIO.h>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace ocio = OCIO_NAMESPACE;

bool ocio_bake_is_built()
{
    return true;
}

/* Returns the name of the config's colour space for linear Rec. 709. */
static std::string find_source(const ocio::ConstConfigRcPtr &config)
{
    static const char *const names[] = { "lin_rec709",
                                         "Linear Rec.709 (sRGB)",
                                         "lin_srgb",
                                         "Linear Rec.709",
                                         "Linear sRGB",
                                         "Utility - Linear - sRGB",
                                         "Utility - Linear - Rec.709" };
    for (const char *name : names) {
        if (config->getColorSpace(name))
            return name;
    }
    throw std::runtime_error("expected a colour space for linear Rec. 709, such as lin_rec709");
}

/* Checks that a display has a view. */
static void check_view(const ocio::ConstConfigRcPtr &config, const std::string &display,
                       const std::string &view)
{
    std::string known;
    for (int i = 0; i < config->getNumViews(display.c_str()); i++) {
        const std::string name = config->getView(display.c_str(), i);
        if (name == view)
            return;
        known += (i ? ", " : "") + name;
    }
    throw std::runtime_error("unknown view '" + view + "' of display '" + display +
                             "'; it has: " + known);
}

static void convert(const char *path, const std::string &name, float *colors, size_t count)
{
    const ocio::ConstConfigRcPtr config = ocio::Config::CreateFromFile(path);
    const size_t slash = name.find('/');
    const bool has_display = slash != std::string::npos;
    const std::string display = has_display ? name.substr(0, slash) : config->getDefaultDisplay();
    const std::string view = has_display ? name.substr(slash + 1) : name;
    check_view(config, display, view);
    const std::string source = find_source(config);
    const ocio::ConstProcessorRcPtr processor = config->getProcessor(
        source.c_str(), display.c_str(), view.c_str(), ocio::TRANSFORM_DIR_FORWARD);
    ocio::PackedImageDesc image(colors, static_cast<long>(count), 1, 3);
    processor->getDefaultCPUProcessor()->apply(image);
}

bool ocio_bake(const char *config, const char *view, float *colors, size_t count, char *fault,
               size_t fault_size)
{
    try {
        ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);
        convert(config, view, colors, count);
        return true;
    } catch (const std::exception &exception) {
        std::snprintf(fault, fault_size, "%s", exception.what());
        return false;
    }
}
