/* ui_search_synonyms.c: table of search synonyms for settings and actions. */
#include "src/view/panels/ui_search_synonyms.h"
#include <stddef.h>
#include <string.h>

static const struct {
    const char *name, *words;
} rows[] = {
    /* settings */
    { "tonemap.exposure", "brightness brighter bright dark darker lightness ev stops" },
    { "tonemap.curve", "contrast tone mapping filmic look" },
    { "tonemap.dither", "banding bands" },
    { "lens.f_stop", "blur blurry bokeh depth field aperture sharp sharpness focus" },
    { "lens.focus", "blur blurry sharp sharpness distance" },
    { "frost.amount", "matt matte dull rough blur foggy opaque sharp" },
    { "frost.roughness", "matt matte dull rough blur foggy sharp" },
    { "highlight.strength", "shine shiny gloss glossy highlight specular sparkle" },
    { "highlight.shininess", "shine shiny gloss glossy highlight specular polish" },
    { "refract.ior", "transparent transparency glass index bend material" },
    { "refract.dispersion", "rainbow prism spectrum colours" },
    { "refract.fresnel", "mirror reflection reflective shine" },
    { "absorb.red", "colour color tint hue transparent transparency opaque clear" },
    { "absorb.green", "colour color tint hue transparent transparency opaque clear" },
    { "absorb.blue", "colour color tint hue transparent transparency opaque clear" },
    { "air.count", "white milky cloudy opaque transparent clear" },
    { "air.haze", "fog foggy milky cloudy opaque transparent clear" },
    { "air.media", "fog foggy milky opaque transparent clear" },
    { "bubbles.count", "air holes clear" },
    { "cracks.count", "broken fracture fissure split clear" },
    { "bump.strength", "rough roughness relief uneven wavy smooth dents" },
    { "light.count", "lamp lamps lighting" },
    { "light.strength", "lamp lamps intensity brightness shine lighting" },
    { "sky.sun_azimuth", "shadow direction daylight lighting" },
    { "sky.sun_elevation", "shadow height daylight noon evening sunset lighting" },
    { "sky.sun_strength", "brightness intensity daylight lighting" },
    { "env.sun_strength", "brightness intensity daylight lighting" },
    { "ice_caustics.light", "shadow shine sunlight focus" },
    { "ao.strength", "occlusion ao ambient shadow foot ground dark" },
    { "ssr.steps", "reflection wet polished glossy floor table ssr" },
    { "ice_caustics.shadow", "shade dark" },
    { "ice_caustics.surroundings_shadow", "shadow shade dark" },
    { "env_cube.size", "reflection resolution sharp sharpness pixelated" },
    { "inclusions.scale", "resolution supersampling antialiasing sharp sharpness pixelated" },
    { "motion.ice", "spin turn rotate rotation turntable speed animation" },
    { "motion.fps", "frame rate speed" },
    { "ice.melt", "drip wet thaw smaller" },
    { "trace.min_branch", "noise noisy grain grainy" },
    { "reference.photons", "noise noisy grain caustics" },
    { "water.amplitude", "waves ripples height" },
    { "texture.anisotropy", "blur blurry sharp sharpness" },
    /* actions */
    { "half a stop brighter, or darker", "brightness exposure light dark" },
    { "half a stop darker", "brightness exposure" },
    { "save the image", "export screenshot image png exr" },
    { "save the window with its panels", "export screenshot image" },
    { "save the session", "project scene store" },
    { "save the settings as a preset", "export store" },
    { "copy the firn render command", "terminal command line share shell" },
    { "copy the image", "clipboard image share" },
    { "next model in the folder", "open file browse" },
    { "orthographic or perspective", "isometric parallel projection lens" },
    { "reset the camera", "home centre center view start" },
    { "full screen on or off", "fullscreen maximise maximize window" },
    { "enlarge text and panels", "zoom font bigger scale dpi" },
    { "shrink text and panels", "zoom font smaller scale dpi" },
    { "dark or light theme", "colours colors night mode appearance" },
    { "hide or show the panels", "sidebar interface menu settings" },
    { "compare A and B side by side", "wipe split before after side" },
    { "compare with the reference", "truth ground accurate exact raytracing path tracing" },
    { "difference of A and B", "error flip delta" },
    { "time of each pass", "performance speed fps profile slow gpu" },
    { "render graph of the frame", "plan passes memory" },
    { "layers and pixel values", "pixel probe histogram magnifier inspect normals depth" },
    { "false colours", "heat map heatmap" },
    { "play or pause", "play animation stop start" },
    { "draft or full quality in motion", "slow lag preview resolution blurry fast" },
    { "keyboard shortcuts", "shortcuts help keyboard hotkeys" },
    { "undo the last change", "revert back" },
    { "close the window", "quit exit leave" },
};

const char *ui_search_synonyms(const char *name)
{
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        if (!strcmp(rows[i].name, name))
            return rows[i].words;
    }
    return "";
}

const char *ui_search_synonyms_name(uint32_t i)
{
    return i < sizeof(rows) / sizeof(rows[0]) ? rows[i].name : NULL;
}
