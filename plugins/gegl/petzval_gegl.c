/* The GEGL operation petzval:defocus. Input: scene-linear colour; aux: depth. It runs in GIMP 3 (GEGL
 * Operation) and in the program gegl. What cannot be made is a warning of GLib, and the input passes
 * unchanged. */
#include <gegl-plugin.h>
#include <petzval/petzval_c.h>

typedef struct {
    GeglOperationComposer parent;
    double numbers[5]; /* by Property */
    char *lens, *look, *preset;
} Defocus;

typedef struct {
    GeglOperationComposerClass parent;
} DefocusClass;

enum Property { FOCAL_LENGTH, SENSOR_WIDTH, F_NUMBER, FOCUS_DISTANCE, DEPTH_UNIT, LENS, LOOK, PRESET };

static const struct {
    const char *name, *label, *what;
    double least, most, usual;
} NUMBERS[] = {
    {"focal-length", "Focal length", "of the camera, mm", 0.1, 10000, 50},
    {"sensor-width", "Sensor width", "that the picture spans, mm", 0.1, 10000, 36},
    {"f-number", "f-number", "of the aperture, such as 2.8", 0.01, 1e9, 2.8},
    {"focus-distance", "Focus distance", "along the optical axis, m", 0.001, 1e9, 3},
    {"depth-unit", "Depth unit", "metres per unit of depth", 1e-9, 1e9, 1},
};

static const struct {
    const char *name, *label, *what;
} TEXTS[] = {
    {"lens", "Lens", "name of a lens, or path of a lens file"},
    {"look", "Look", "look as JSON, link of the lens lab or path"},
    {"preset", "Preset", "name of a look that ships or is in your folder of presets"},
};

static gboolean text_given(const char* text) { return text && *text; }
static GTypeInstance* of(gpointer object) { return (GTypeInstance*)object; }
static Defocus* self_of(gpointer object) { return (Defocus*)(void*)of(object); }

static char** text_of(Defocus* self, guint property) {
    return property == LENS ? &self->lens : property == LOOK ? &self->look : &self->preset;
}

static void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
    Defocus* self = self_of(object);
    char** text = text_of(self, id - 1);
    (void)spec;
    if (id - 1 < LENS) {
        self->numbers[id - 1] = g_value_get_double(value);
    } else {
        g_free(*text);
        *text = g_value_dup_string(value);
    }
}

static void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
    Defocus* self = self_of(object);
    (void)spec;
    if (id - 1 < LENS)
        g_value_set_double(value, self->numbers[id - 1]);
    else
        g_value_set_string(value, *text_of(self, id - 1));
}

static void finalize(GObject* object) {
    g_free(self_of(object)->lens);
    g_free(self_of(object)->look);
    g_free(self_of(object)->preset);
    G_OBJECT_CLASS(g_type_class_peek_parent(of(object)->g_class))->finalize(object);
}

/* Premultiplied linear light and one channel of depth. */
static void prepare(GeglOperation* operation) {
    const Babl* light = babl_format("RaGaBaA float");
    gegl_operation_set_format(operation, "input", light);
    gegl_operation_set_format(operation, "aux", babl_format("Y float"));
    gegl_operation_set_format(operation, "output", light);
}

/* A lens needs the whole picture, and GEGL would ask for tiles. */
static GeglRectangle whole(GeglOperation* operation) {
    const GeglRectangle* input = gegl_operation_source_get_bounding_box(operation, "input");
    const GeglRectangle nothing = {0, 0, 0, 0};
    return input && !gegl_rectangle_is_infinite_plane(input) ? *input : nothing;
}

static GeglRectangle required(GeglOperation* operation, const char* pad, const GeglRectangle* wanted) {
    (void)pad, (void)wanted;
    return whole(operation);
}

static GeglRectangle cached(GeglOperation* operation, const GeglRectangle* wanted) {
    (void)wanted;
    return whole(operation);
}

static GeglRectangle invalidated(GeglOperation* operation, const char* pad, const GeglRectangle* changed) {
    (void)pad, (void)changed;
    return whole(operation);
}

/* One session for all operations: it keeps kernels. Null, and petzval_error_text(), if it cannot be opened.
 */
static petzval_session* session(void) {
    static GMutex mutex;
    static petzval_session* opened;
    g_mutex_lock(&mutex);
    if (!opened) petzval_session_open(NULL, &opened);
    g_mutex_unlock(&mutex);
    return opened;
}

/* True for the path of a file, false for JSON and links of the lens lab. */
static gboolean is_path(const char* look) {
    while (g_ascii_isspace(*look)) ++look;
    return *look != '{' && !g_str_has_prefix(look, "lens=") && !strstr(look, "#lens=");
}

/* The look of a text: JSON, a link of the lens lab, or the path of a file. */
static petzval_status look_of_text(const char* text, petzval_look** look) {
    char* read = NULL;
    if (is_path(text)) g_file_get_contents(text, &read, NULL, NULL);
    const petzval_status status = petzval_look_from_json(read ? read : text, look);
    g_free(read);
    return status;
}

/* Why a given look is refused, or NULL. The caller frees it. */
static char* fault_of_look(const char* text) {
    GError* why = NULL;
    char *read = NULL, *fault = NULL;
    petzval_look* look = NULL;
    if (!text_given(text)) return NULL;
    if (is_path(text) && !g_file_get_contents(text, &read, NULL, &why))
        fault = g_strdup_printf("look: %s", why->message);
    else if (petzval_look_from_json(read ? read : text, &look))
        fault = g_strdup_printf("look: %s", petzval_error_text());
    petzval_look_close(look);
    g_clear_error(&why);
    g_free(read);
    return fault;
}

static petzval_status look_of(const Defocus* self, petzval_look** look) {
    const char* text = text_given(self->look) ? self->look : "{\"petzval_look\": 1}";
    petzval_status status =
        text_given(self->preset) ? petzval_look_from_preset(self->preset, look) : look_of_text(text, look);
    if (!status && text_given(self->lens)) status = petzval_look_set(*look, "lens.name", self->lens);
    return status;
}

/* petzval_defocus() writes through the pointers: NOLINTNEXTLINE(readability-non-const-parameter) */
static petzval_status make(const Defocus* self, float* rgba, float* depth, int width, int height) {
    const double* n = self->numbers;
    petzval_camera camera = {sizeof camera, n[FOCAL_LENGTH],   n[SENSOR_WIDTH],
                             n[F_NUMBER],   n[FOCUS_DISTANCE], 0};
    petzval_pixels light = {sizeof light, width, height, PETZVAL_FLOAT, rgba, rgba + 1, rgba + 2,
                            rgba + 3,     16,    0};
    petzval_plane plane = {sizeof plane, width, height, PETZVAL_FLOAT, depth, 4, (ptrdiff_t)width * 4};
    const petzval_depth_meaning meaning = {.size = sizeof meaning, .unit_m = n[DEPTH_UNIT]};
    petzval_look* look = NULL;
    petzval_shot shot = {.size = sizeof shot};
    petzval_status status = look_of(self, &look);
    light.row_stride = (ptrdiff_t)width * 16;
    shot.colour = &light, shot.depth_m = &plane, shot.depth_meaning = &meaning, shot.camera = &camera;
    if (!status && !session()) status = PETZVAL_INTERNAL;
    if (!status) status = petzval_defocus(session(), &shot, look, NULL, &light, NULL);
    petzval_look_close(look);
    return status;
}

static gboolean process(GeglOperation* operation, GeglBuffer* input, GeglBuffer* aux, GeglBuffer* output,
                        const GeglRectangle* result, int level) {
    const GeglRectangle all = input ? *gegl_buffer_get_extent(input) : *result;
    const size_t count = (size_t)all.width * (size_t)all.height;
    const Babl* light = babl_format("RaGaBaA float");
    (void)level;
    if (!input || !count) return TRUE;
    float* rgba = g_try_malloc_n(count, 16);
    float* depth = g_try_malloc_n(count, 4);
    char* const fault = fault_of_look(self_of(operation)->look);
    if (!aux) {
        g_warning("petzval:defocus: connect depth to the pad aux");
    } else if (!gegl_rectangle_contains(gegl_buffer_get_extent(aux), &all)) {
        /* For a missing file, gegl:load draws a small picture of its error message. */
        const GeglRectangle* given = gegl_buffer_get_extent(aux);
        g_warning("petzval:defocus: aux has %d x %d pixels and does not cover the picture, %d x %d; check the file "
                  "of the depth, or scale the depth",
                  given->width, given->height, all.width, all.height);
    } else if (text_given(self_of(operation)->preset) && text_given(self_of(operation)->look)) {
        g_warning("petzval:defocus: preset and look are both given; empty one of them");
    } else if (fault) {
        g_warning("petzval:defocus: %s", fault);
    } else if (!rgba || !depth) {
        g_warning("petzval:defocus: no memory for %d x %d pixels", all.width, all.height);
    } else {
        gegl_buffer_get(input, &all, 1, light, rgba, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
        gegl_buffer_get(aux, &all, 1, babl_format("Y float"), depth, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
        if (make(self_of(operation), rgba, depth, all.width, all.height)) {
            g_warning("petzval:defocus: %s", petzval_error_text());
            gegl_buffer_get(input, &all, 1, light, rgba, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
        }
        gegl_buffer_set(output, &all, 0, light, rgba, GEGL_AUTO_ROWSTRIDE);
        g_free(rgba), g_free(depth), g_free(fault);
        return TRUE;
    }
    g_free(rgba), g_free(depth), g_free(fault);
    gegl_buffer_copy(input, result, GEGL_ABYSS_NONE, output, result);
    return TRUE;
}

static void class_init(gpointer class, gpointer data) {
    const GParamFlags flags = G_PARAM_READWRITE | G_PARAM_CONSTRUCT | G_PARAM_STATIC_STRINGS;
    GObjectClass* object = class;
    GeglOperationClass* operation = class;
    (void)data;
    object->set_property = set_property, object->get_property = get_property, object->finalize = finalize;
    for (guint i = 0; i < G_N_ELEMENTS(NUMBERS); ++i)
        g_object_class_install_property(
            object, i + 1,
            g_param_spec_double(NUMBERS[i].name, NUMBERS[i].label, NUMBERS[i].what, NUMBERS[i].least,
                                NUMBERS[i].most, NUMBERS[i].usual, flags));
    for (guint i = 0; i < G_N_ELEMENTS(TEXTS); ++i)
        g_object_class_install_property(
            object, LENS + 1 + i,
            g_param_spec_string(TEXTS[i].name, TEXTS[i].label, TEXTS[i].what, "", flags));
    operation->prepare = prepare, operation->threaded = FALSE;
    operation->get_bounding_box = whole, operation->get_required_for_output = required;
    operation->get_cached_region = cached, operation->get_invalidated_by_change = invalidated;
    ((GeglOperationComposerClass*)class)->process = process;
    gegl_operation_class_set_keys(operation, "name", "petzval:defocus", "title", "Depth of field of a lens",
                                  "categories", "blur", "description",
                                  "Depth of field of a real lens, from depth on the pad aux", NULL);
}

static const GeglModuleInfo INFO = {GEGL_MODULE_ABI_VERSION};

G_MODULE_EXPORT const GeglModuleInfo* gegl_module_query(GTypeModule* module);
G_MODULE_EXPORT gboolean gegl_module_register(GTypeModule* module);

const GeglModuleInfo* gegl_module_query(GTypeModule* module) {
    (void)module;
    return &INFO;
}

gboolean gegl_module_register(GTypeModule* module) {
    const GTypeInfo type = {
        .class_size = sizeof(DefocusClass), .class_init = class_init, .instance_size = sizeof(Defocus)};
    gegl_module_register_type(module, GEGL_TYPE_OPERATION_COMPOSER, "PetzvalDefocus", &type, 0);
    return TRUE;
}
