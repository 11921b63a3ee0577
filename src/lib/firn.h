/*
 * firn.h: C interface of libfirn, a renderer for ice, glass and water.
 *
 *     firn *device;
 *     firn_scene *scene;
 *     firn_renderer *renderer;
 *     const char *options[] = { "env", "studio", "material", "glass", NULL };
 *     const char *layers[] = { "beauty", "Z" };
 *     struct firn_renderer_options size = { sizeof(size), 640, 480, 1, layers, 2 };
 *     struct firn_camera camera = { sizeof(camera), FIRN_CAMERA_SCENE };
 *     struct firn_buffer z = { sizeof(z), "Z", data, FIRN_FLOAT32, 1 };
 *     firn_open(NULL, &device);
 *     firn_scene_load(device, "teapot", options, &scene);
 *     firn_renderer_create(scene, &size, &renderer);
 *     firn_render(renderer, &camera, &z, 1, NULL, NULL);
 *
 * Handles. A `firn` is an open Vulkan device with its messages. Scenes belong to a device, and
 * renderers to a scene. Handles may be closed in any order: a device or scene is freed when the
 * last handle that uses it is closed. Closing NULL does nothing.
 *
 * Structs. Every struct begins with its size, which the caller sets to sizeof. Later versions
 * append members; zero is the default of every member.
 *
 * Text. Names, paths and messages are UTF-8 and end at '\0'. Strings and arrays that the caller
 * passes are copied. The string that firn_error() returns stays valid until the next call with
 * a handle of the same device. Other returned strings stay valid as long as the handle, or forever
 * if the function takes no handle.
 *
 * Errors. Functions return a status, whose values are the exit codes of the program firn. If it is
 * not FIRN_OK, firn_error() returns a one-line message with a remedy, results are not written, and
 * pointers to new handles are NULL. After a device is lost, all calls return FIRN_TRY_AGAIN; close
 * the handles and open the device again.
 *
 * Messages. Warnings and notes go to the log callback of the device; nothing is written to the
 * standard streams.
 *
 * Threads. Only one thread at a time may use a device with its scenes and renderers. Threads may
 * use different devices at the same time. Any thread may call firn_cancel().
 *
 * Processes. After fork(), the child must not use handles of its parent, and cannot open devices if
 * the parent has opened one: such calls return FIRN_FAILED at once. Start worker processes
 * before the first firn_open(), or with exec(). Model files and images are read by sandboxed
 * processes (firn_options.reader). Signal handlers, the signal mask, environment variables and
 * other properties of the calling process are not changed.
 *
 * Space. World space is right-handed, +Y up, in metres. It is the space of the model file, unless
 * the options `scale`, `up` or `rotate` change it. Matrices of 12 numbers are 3x4 in row-major
 * order; they multiply column vectors, and the fourth column is the translation.
 *
 * Images. Row 0 is the top row. Colours are linear Rec.709 radiance unless a type is named sRGB.
 */
#ifndef FIRN_H
#define FIRN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Exported functions. */
#if defined(__GNUC__)
#define FIRN_API __attribute__((visibility("default")))
#else
#define FIRN_API
#endif

typedef struct firn firn;
typedef struct firn_scene firn_scene;
typedef struct firn_renderer firn_renderer;

/* Result of a call. Values equal the exit codes of the program firn. */
typedef enum firn_status {
    FIRN_OK = 0,
    FIRN_FAILED = 1,       /* other failure, such as a call after fork() */
    FIRN_USAGE = 2,        /* invalid argument */
    FIRN_DATA = 65,        /* damaged or unsupported input file or array */
    FIRN_NO_INPUT = 66,    /* missing or unreadable input file */
    FIRN_NO_DEVICE = 69,   /* no usable Vulkan device */
    FIRN_CANT_CREATE = 73, /* an output file cannot be created */
    FIRN_WRITE = 74,       /* output file incompletely written */
    FIRN_TRY_AGAIN = 75,   /* out of memory or device lost; a retry may succeed */
    FIRN_CANCELLED = 130,  /* cancelled by a progress callback or firn_cancel() */
} firn_status;

/* ---- library ---- */

/* Returns the version of the library, such as "0.3.0". */
FIRN_API const char *firn_version(void);

/* Returns the name of a status, such as "FIRN_DATA"; "?" if the value is unknown. */
FIRN_API const char *firn_status_name(firn_status status);

/* ---- device ---- */

enum firn_log_level {
    FIRN_LOG_ERROR = 0,   /* the message that firn_error() returns */
    FIRN_LOG_WARNING = 1, /* something is missing from the image */
    FIRN_LOG_NOTE = 2,    /* information, such as a default that was chosen */
};

/* Callback for a message: one line, without newline. It is called during calls with handles of the
 * device, by the calling thread or a thread of the library, but never by two at once. It must not
 * call functions that take a handle. `level` is a firn_log_level. */
typedef void firn_log_fn(void *user, int level, const char *text);

enum {
    FIRN_NO_CACHE = 1, /* store no pipelines and BVHs in the cache folder */
    FIRN_VALIDATE = 2, /* enable the Vulkan validation layer, if it is installed */
    /* open no Vulkan device: scenes can be loaded and queried, and drawn by the path tracer
     * (refraction=reference) */
    FIRN_WITHOUT_DEVICE = 4,
};

struct firn_options {
    size_t size;
    const char *device; /* Vulkan device: its number or part of its name; NULL for the best */
    firn_log_fn *log;   /* NULL to drop messages */
    void *log_user;
    /* sandboxed reader program; NULL for $FIRN_READER or the installed firn-reader */
    const char *reader;
    const char *cache; /* absolute path; NULL for $XDG_CACHE_HOME/firn or ~/.cache/firn */
    uint32_t flags;    /* FIRN_NO_CACHE, FIRN_VALIDATE, FIRN_WITHOUT_DEVICE */
    /* folder of the built-in scenes and environments; NULL for $FIRN_ASSETS or the installed one */
    const char *assets;
};

/* Opens a device. `options` may be NULL. Returns FIRN_NO_DEVICE if there is none, FIRN_USAGE for
 * invalid options, FIRN_TRY_AGAIN if out of memory, FIRN_FAILED after fork(). */
FIRN_API firn_status firn_open(const struct firn_options *options, firn **device);

/* Closes a device; `device` may be NULL. */
FIRN_API void firn_close(firn *device);

/* Returns the message of the last failed call with a handle of this device, or "". If `device` is
 * NULL, returns that of the calling thread's last failed firn_open() or function without a
 * handle. */
FIRN_API const char *firn_error(const firn *device);

/* Returns the name of the Vulkan device, such as "llvmpipe (LLVM 15.0.6, 256 bits)"; "" without a
 * device. */
FIRN_API const char *firn_device_name(const firn *device);

/* ---- scenes from files ---- */

/*
 * Loads a scene. `path` is a name of `firn list scenes`, or the path of a .gltf, .glb, .obj, .ply
 * or .stl file. `options` are pairs of name and value that end with NULL, or NULL. Names, values,
 * checks and messages are those of `firn render`, without the leading dashes:
 *
 *     "env", "studio"                 "material", "glass"      "material", "Cup=ruby,ior=1.6"
 *     "ground", "none"                "scale", "0.01"          "transform", "Cup=0,0.1,0"
 *     "animation", "1"                "set", "refract.ior=1.4" "refract.ior", "1.4"
 *     "refraction", "trace"           "quality", "normal"      "samples", "4"
 *     "camera", "Front"               "plain", ""              "exposure", "auto"
 *
 * `size`, `aov`, `show`, `tiles` and options of output files are refused. Options without a value,
 * such as `plain`, take "". As in `firn render`, the default quality is `high`, which means several
 * samples per pixel, unless samples are stated.
 *
 * Returns FIRN_NO_INPUT, FIRN_DATA, FIRN_USAGE or FIRN_TRY_AGAIN.
 */
FIRN_API firn_status firn_scene_load(firn *device, const char *path, const char *const *options,
                                     firn_scene **scene);

/* Closes a scene; `scene` may be NULL. */
FIRN_API void firn_scene_close(firn_scene *scene);

/*
 * Sets an option or a setting (firn_setting_get()), as firn_scene_load() does, from the next render
 * on. If it describes the scene ("env", "cracks.count"), that render loads the scene again and
 * reports errors of files. Invalid names and values return
 * FIRN_USAGE and change nothing.
 */
FIRN_API firn_status firn_scene_set(firn_scene *scene, const char *name, const char *value);

/* Writes the current value of a setting, such as "1.31", "on" or "neutral", truncated to `size`
 * bytes including '\0'. This is the effective value, after the choices of scene, quality level and
 * material. */
FIRN_API firn_status firn_scene_get(firn_scene *scene, const char *name, char *text, size_t size);

/* ---- list of settings ---- */

enum firn_setting_type {
    FIRN_SETTING_FLOAT = 0,
    FIRN_SETTING_COUNT = 1,  /* whole number */
    FIRN_SETTING_SWITCH = 2, /* "on" or "off"; numbers 1 and 0 */
    FIRN_SETTING_CHOICE = 3, /* a name of `choices`; its index as a number */
};

/* Description of a setting. Strings stay valid forever. */
struct firn_setting {
    size_t size;
    const char *name;           /* "refract.ior" */
    const char *label;          /* "Refractive index" */
    const char *help;           /* one line */
    const char *unit;           /* "degrees"; NULL if there is none */
    const char *const *choices; /* list that ends with NULL; NULL unless FIRN_SETTING_CHOICE */
    uint32_t type;              /* firn_setting_type */
    uint32_t has_auto;          /* 1 if "auto" is a value */
    double initial, min, max;   /* default and range; an `initial` below `min` is "auto" */
    uint32_t loads_scene;       /* 1 if a change reloads or regenerates scene data */
};

/* Describes the setting with an index, from 0. Sets only members within setting->size. Returns
 * FIRN_USAGE at the end of the list. */
FIRN_API firn_status firn_setting_get(uint32_t index, struct firn_setting *setting);

/* ---- objects and materials ---- */

/* Object of a scene: a refractive object, or an object of the opaque surroundings. */
struct firn_object {
    size_t size;
    const char *name;  /* name of its node; "" if it has none */
    uint32_t id;       /* number in the layers `object` and `object.last`, from 1 */
    uint32_t refracts; /* 1 if it is a refractive object */
    float box_min[3];  /* bounds, metres, world space */
    float box_max[3];
    uint32_t triangle_count;
    const char *material; /* name of its material, or of the first of several */
};

/* Counts the objects. This and the next three functions first apply changed options and added
 * arrays, as a render does. */
FIRN_API firn_status firn_scene_object_count(firn_scene *scene, uint32_t *count);

/* Describes object `index`, from 0. Strings stay valid until the scene changes. Returns FIRN_USAGE
 * at the end of the list. */
FIRN_API firn_status firn_scene_object(firn_scene *scene, uint32_t index,
                                       struct firn_object *object);

enum {
    FIRN_MATERIAL_UNLIT = 1,     /* base_color is emitted radiance */
    FIRN_MATERIAL_TWO_SIDED = 2, /* opaque surfaces are visible from both sides */
    FIRN_MATERIAL_BLENDED = 4,   /* base_color[3] is the fraction of light that is reflected */
    FIRN_MATERIAL_PRIORITY = 8,  /* `priority` is set */
};

/* Surface and the medium behind it, as in glTF 2.0. firn_material_init() sets the defaults. */
struct firn_material {
    size_t size;
    const char *name;
    float base_color[4]; /* linear RGB, 0 to 1, and alpha */
    float metallic;      /* 0 to 1 */
    float roughness;     /* 0 to 1 */
    float transmission;  /* 0 (opaque) to 1: fraction of non-reflected light that is transmitted */
    float ior;           /* refractive index, 1 to 4 */
    float dispersion;    /* 20 / Abbe number, 0 to 10 */
    float thickness;     /* above 0: the surface bounds a medium; 0: thin wall */
    float attenuation_color[3]; /* of white light after attenuation_distance, 0 to 1 */
    float attenuation_distance; /* metres; 0 for a clear medium */
    float scattering;           /* optical depth of scattering across the object; 0 if clear */
    float emission[3];          /* radiance, 0 to 65504 */
    int32_t priority;           /* of nested media: the highest fills the overlap */
    uint32_t flags;             /* FIRN_MATERIAL_UNLIT, ... */
    uint32_t class_id;          /* number in layer `class`, 0 to 65535; extras.class of a file */
};

/* Sets a material from text: "" for glTF's default (white, opaque), else in the syntax of
 * `--material NODE=TEXT`, such as "glass" or "ruby:rough,ior=1.76,priority=2". Keeps
 * material->size. Returns FIRN_USAGE for an unknown name or value. */
FIRN_API firn_status firn_material_init(struct firn_material *material, const char *text);

/* Reads the material of object `index`. */
FIRN_API firn_status firn_scene_material(firn_scene *scene, uint32_t index,
                                         struct firn_material *material);

/* Replaces the material of object `index` from the next render on, but keeps its textures and name.
 * The option `material` no longer affects the object. The first change of an object reloads the
 * scene. Later ones do not if the object is refractive and they change only ior, dispersion,
 * roughness, attenuation, emission or metallic. Returns FIRN_USAGE if transmission would become 0
 * or cease to be 0, and for objects of a built-in scene. */
FIRN_API firn_status firn_scene_set_material(firn_scene *scene, uint32_t index,
                                             const struct firn_material *material);

/* ---- scenes from arrays ---- */

/* Triangle mesh. Attributes are float32; strides are in bytes, and 0 means packed. */
struct firn_mesh {
    size_t size;
    uint32_t vertex_count, index_count; /* index_count is a multiple of 3 */
    const float *positions;             /* x, y, z per vertex, metres */
    const float *normals;               /* x, y, z per vertex, outward; NULL for smooth ones */
    const float *uvs;                   /* u, v per vertex; (0, 0) is top left; may be NULL */
    const uint32_t *indices;            /* counter-clockwise seen from outside */
    size_t position_stride, normal_stride, uv_stride;
};

/* Material number of an instance without a material, which is white and opaque. If no instance has
 * a material, all are ice or have the option `material`, as in a file without materials. */
#define FIRN_NO_MATERIAL UINT32_MAX

/* Instance of a mesh. */
struct firn_instance {
    size_t size;
    uint32_t mesh, material; /* numbers of the mesh and of the material */
    const char *name;        /* name of the object; NULL for "" */
    float world[12];         /* mesh-to-world matrix, 3x4; all zeros for identity */
};

enum firn_light_kind {
    FIRN_LIGHT_DIRECTIONAL = 0,
    FIRN_LIGHT_POINT = 1,
    FIRN_LIGHT_SPOT = 2,
};

/* Punctual light of KHR_lights_punctual; lights opaque surfaces only. */
struct firn_light {
    size_t size;
    uint32_t kind;                /* firn_light_kind */
    float position[3];            /* metres; unused by directional lights */
    float direction[3];           /* of emission; unused by point lights */
    float color[3];               /* linear */
    float intensity;              /* lux (directional) or candela */
    float range;                  /* metres; 0 for no limit */
    float inner_cone, outer_cone; /* half-angles of a spot, radians */
};

/* Equirectangular environment: `width` x `height` texels of linear RGB radiance, width = 2 height.
 * Row 0 is the zenith (+Y); the centre column faces -Z, with +X to its right. */
struct firn_environment {
    size_t size;
    uint32_t width, height;
    const float *texels; /* r, g, b per texel */
    size_t row_stride;   /* bytes; 0 means packed */
    float rotate_deg;    /* rotation about +Y */
    float exposure;      /* stops */
};

/* Creates an empty scene. `options` are those of firn_scene_load(), except those that name nodes of
 * a file. Add meshes, materials and instances before creating a renderer. The arrays are copied.
 * Numbers of meshes and materials start at 0. */
FIRN_API firn_status firn_scene_create(firn *device, const char *const *options,
                                       firn_scene **scene);
FIRN_API firn_status firn_scene_add_mesh(firn_scene *scene, const struct firn_mesh *mesh,
                                         uint32_t *number);
FIRN_API firn_status firn_scene_add_material(firn_scene *scene,
                                             const struct firn_material *material,
                                             uint32_t *number);
/* Adds an instance. To find its index for firn_scene_object(), compare names: refractive objects
 * are listed first, and open shells that together form a closed surface are one object. */
FIRN_API firn_status firn_scene_add_instance(firn_scene *scene,
                                             const struct firn_instance *instance);
FIRN_API firn_status firn_scene_add_light(firn_scene *scene, const struct firn_light *light);
/* Sets the environment of any scene, in place of the option `env`. */
FIRN_API firn_status firn_scene_set_environment(firn_scene *scene,
                                                const struct firn_environment *environment);

/* ---- cameras ---- */

enum firn_camera_kind {
    FIRN_CAMERA_SCENE = 0,   /* camera of the options or file, else one that frames the scene */
    FIRN_CAMERA_LOOK_AT = 1, /* eye, target, up, fov_deg */
    FIRN_CAMERA_OPENCV = 2,  /* fx, fy, cx, cy; camera axes +X right, +Y down, +Z forward */
    FIRN_CAMERA_OPENGL = 3,  /* fx, fy, cx, cy; camera axes +X right, +Y up, -Z forward */
};

/*
 * Camera of a view. A point (x, y, z) in OpenCV camera space is projected to the pixel coordinates
 * u = fx x / z + cx, v = fy y / z + cy, with u to the right and v down. The centre of the top left
 * pixel is (0, 0) for FIRN_CAMERA_OPENCV and (.5, .5) for FIRN_CAMERA_OPENGL. Pixels need not be
 * square, and (cx, cy) need not be the image centre. Lens distortion is not supported.
 */
struct firn_camera {
    size_t size;
    uint32_t kind;                /* firn_camera_kind */
    uint32_t has_time;            /* 1 if `time` is set; 0 for setting motion.time */
    double time;                  /* animation time, seconds */
    double eye[3], target[3];     /* metres */
    double up[3];                 /* all zeros for +Y */
    double fov_deg;               /* vertical field of view, degrees, 1 to 170 */
    double fx, fy, cx, cy;        /* pixels */
    double world_from_camera[12]; /* camera-to-world matrix, 3x4, without scale */
};

/* Converts `from` to the kind to->kind, for the image size of a renderer. Sets all members of `to`
 * except `size` and `kind`. FIRN_CAMERA_LOOK_AT implies a centred principal point and square
 * pixels. Returns FIRN_USAGE for an invalid camera. */
FIRN_API firn_status firn_camera_convert(firn_renderer *renderer, const struct firn_camera *from,
                                         struct firn_camera *to);

/* ---- layers ---- */

/* Layer of an image. Strings stay valid forever. */
struct firn_layer {
    size_t size;
    const char *name;
    const char *help;  /* one line, with unit and background value */
    uint32_t channels; /* 1 to 8 */
    uint32_t averages; /* 1 if the mean of all samples, 0 if of the first sample */
    uint32_t type;     /* natural firn_type: UINT8 for display, UINT32 for numbers */
};

/* Describes the layer with an index, from 0: "beauty" (R, G, B, A), "display" (the tone-mapped sRGB
 * image of a PNG file), then those of `firn list layers`. Returns FIRN_USAGE at the end. */
FIRN_API firn_status firn_layer_get(uint32_t index, struct firn_layer *layer);

/* ---- rendering ---- */

struct firn_renderer_options {
    size_t size;
    uint32_t width, height; /* pixels, 1 to 16384 */
    /* per pixel; 0 for the scene's option `samples` or the number of the quality level */
    uint32_t samples;
    const char *const *layers; /* names of the layers that buffers may receive */
    size_t layer_count;        /* at least 1 */
};

/* Creates a renderer. All its views share one compiled frame and one uploaded scene. Returns
 * FIRN_USAGE for an unknown layer, one that the refraction model lacks, or an invalid size. */
FIRN_API firn_status firn_renderer_create(firn_scene *scene,
                                          const struct firn_renderer_options *options,
                                          firn_renderer **renderer);
FIRN_API void firn_renderer_close(firn_renderer *renderer);

/* Sets *html to a page that shows the compiled plan of a frame: passes, images, barriers, memory.
 * It is that of `firn graph --html`, and stays valid until the next call with the renderer. Returns
 * FIRN_USAGE for refraction=reference, which has no plan. */
FIRN_API firn_status firn_renderer_plan(firn_renderer *renderer, const char **html);

enum firn_type {
    FIRN_FLOAT32 = 0,
    /* `display` is sRGB, 0 to 255 or 65535; other layers are rounded and clamped, NaN becomes 0 */
    FIRN_UINT8 = 1,
    FIRN_UINT16 = 2,
    FIRN_UINT32 = 3, /* not for `display` */
};

/* Memory of the caller that receives a layer. */
struct firn_buffer {
    size_t size;
    const char *layer;      /* a layer of the renderer */
    void *data;             /* first channel of the top left pixel */
    uint32_t type;          /* firn_type; `display` as FLOAT32 is sRGB from 0 to 1 */
    uint32_t channels;      /* number of channels to write; 0 for all */
    ptrdiff_t pixel_stride; /* bytes from a pixel to its right neighbour; 0 if packed */
    ptrdiff_t row_stride; /* bytes from a row to the next one down, may be negative; 0 if packed */
};

/* Callback after each sample, or each tile of the path tracer. A nonzero result cancels. */
typedef int firn_progress_fn(void *user, uint32_t done, uint32_t all);

/*
 * Renders a view into buffers and waits for it. `camera` may be NULL for FIRN_CAMERA_SCENE.
 * `buffers` has `count` elements; `progress` may be NULL. Results are deterministic and
 * bit-identical to those of `firn render`. Returns FIRN_CANCELLED, with the buffers unchanged, if
 * `progress` or firn_cancel() cancels; the renderer remains usable. Until it is
 * closed, it keeps memory for as many views as were in flight at a time, 4 bytes per value.
 */
FIRN_API firn_status firn_render(firn_renderer *renderer, const struct firn_camera *camera,
                                 const struct firn_buffer *buffers, size_t count,
                                 firn_progress_fn *progress, void *user);

/*
 * Starts drawing a view without waiting for it. Returns FIRN_USAGE if two views of the renderer are
 * in flight already. Fetch tickets in the order of submission. Closing the renderer drops views
 * that were not fetched. Calls that use the scene or another renderer of the device wait until the
 * views in flight are drawn.
 */
FIRN_API firn_status firn_submit(firn_renderer *renderer, const struct firn_camera *camera,
                                 uint64_t *ticket);

/* Waits for a view, writes it to the buffers, and returns the status of drawing it. The ticket is
 * consumed unless FIRN_USAGE is returned, for invalid buffers or an invalid ticket. */
FIRN_API firn_status firn_fetch(firn_renderer *renderer, uint64_t ticket,
                                const struct firn_buffer *buffers, size_t count);

/* Returns 1 if firn_fetch() of the oldest ticket would not wait, else 0. */
FIRN_API int firn_is_ready(firn_renderer *renderer);

/* Cancels all views that are being drawn or are submitted, after the current sample. Any thread may
 * call it while the renderer is open. */
FIRN_API void firn_cancel(firn_renderer *renderer);

/* ---- files ---- */

/*
 * Writes arrays as layers of an EXR file, atomically. Each buffer has the layer's name, data of
 * FIRN_FLOAT32, or of FIRN_UINT32 for UINT channels, the number of channels, and strides. Names of
 * firn_layer_get() become the channels that `firn render` writes; others become NAME, or NAME.R,
 * NAME.G ... Needs no device; firn_error(NULL) returns the message of a failure. Returns
 * FIRN_USAGE, FIRN_CANT_CREATE, FIRN_WRITE or FIRN_TRY_AGAIN on failure.
 */
FIRN_API firn_status firn_write_exr(const char *path, uint32_t width, uint32_t height,
                                    const struct firn_buffer *buffers, size_t count);

/* ---- comparison ---- */

/* Image to compare: FIRN_UINT8 for sRGB, FIRN_FLOAT32 for linear radiance. */
struct firn_image {
    size_t size;
    uint32_t width, height;
    const void *data;
    uint32_t type;                      /* FIRN_FLOAT32 or FIRN_UINT8 */
    uint32_t channels;                  /* 3 or 4; the fourth is ignored */
    ptrdiff_t pixel_stride, row_stride; /* as in struct firn_buffer */
};

struct firn_difference {
    size_t size;
    double mae;         /* mean absolute error, linear */
    double mae_clipped; /* MAE of values clamped to 0..1 */
    double rmse;        /* root mean square error, linear */
    double relmse;      /* mean of (test - reference)^2 / (reference^2 + .01) */
    double flip;        /* mean FLIP error: HDR-FLIP of linear images, LDR-FLIP of sRGB images */
    double largest;     /* largest absolute difference, linear */
};

/* Measures the error of `test` relative to `reference`, as `firn diff` does. Both must have the
 * same size. `errors` receives width * height FLIP errors, 0 to 1, in row-major order, and may be
 * NULL. Needs no device; firn_error(NULL) returns the message of a failure. */
FIRN_API firn_status firn_diff(const struct firn_image *reference, const struct firn_image *test,
                               struct firn_difference *difference, float *errors);

#ifdef __cplusplus
}
#endif

#endif
