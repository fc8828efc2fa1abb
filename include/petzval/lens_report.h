// The report of a lens as one self-contained HTML page; sheets that compare many lenses;
// contact sheets of one picture through many lenses; and files of kernels. Part of
// petzval::files.
#pragma once

#include "petzval/develop.h"
#include "petzval/display_files.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/lens_kernel.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/session.h"
#include "petzval/shot.h"
#include "petzval/workers.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace petzval {

// A page with its figures inside (SVG, PNG as data: URIs, CSS; no scripts), XHTML so that any XML reader
// takes it; the same bytes every time. Errors: those of lens_facts() and of mounting the lens at its own
// aperture. Drawn by the workers `lent` by a host, or by our own `threads` (0: all).
PETZVAL_API Result<std::string> lens_report(const std::string& name_or_file, int threads = 0,
                                            Workers* lent = nullptr);

// Entry of a lens on sheets of many lenses.
struct LensCard {
    std::string name, title, year, kind;
    std::string focal_length, f_number, blur;  // with units, as shown
    std::string discs;                         // SVG: a disc in front of focus and one behind
    std::string curve;                         // SVG: longitudinal aberration
    std::string rays;                          // SVG: rays near the focus
    std::string texture;                       // SVG: the bokeh texture
};
PETZVAL_API Result<LensCard> lens_card(const std::string& name_or_file, int threads = 0,
                                       Workers* lent = nullptr);

// HTML pages that link to NAME.html for each card: the contact sheet; and one row per lens with its curve,
// rays, texture, discs and numbers.
PETZVAL_API std::string lens_index(const std::vector<LensCard>& cards);
PETZVAL_API std::string lens_comparison(const std::vector<LensCard>& cards);
// The contact sheet as a separate SVG file.
PETZVAL_API std::string lens_contact_sheet(const std::vector<LensCard>& cards);

// The file name of a lens's page, NAME.html, with characters that every system allows.
PETZVAL_API std::string lens_page_name(const std::string& name_or_file);
// The file names for several lenses, in their order. Errors: those of lens_facts(); InvalidArgument if two
// lenses would have the same page.
PETZVAL_API Result<std::vector<std::string>> lens_page_names(const std::vector<std::string>& lenses);
// Writes the page of each lens into a folder that exists, then comparison.html, contact-sheet.svg and
// index.html. Returns the paths in the order of writing. `progress` is called with the share done before each
// lens; false cancels. Errors: those of lens_page_names() and lens_report(); Cancelled, OutputFailed.
PETZVAL_API Result<std::vector<std::string>> write_lens_pages(
    const std::vector<std::string>& lenses, const std::string& folder,
    const std::function<bool(double)>& progress = {});

// Reports as files, as petzval lens report writes them.
struct LensReportFiles {
    std::vector<std::string> lenses = {};  // names or lens files; empty: every built-in lens
    // The report of one lens is a page (is_lens_page()), or a page in this folder; empty: in the current
    // folder. The report of several lenses is a folder; see write_lens_pages(). A missing folder is made.
    std::string output = {};
    std::size_t max_memory_bytes = 0;           // 0: no limit
    std::function<bool(double)> progress = {};  // as of write_lens_pages()
};
struct LensReportMade {
    std::vector<std::string> outputs;  // in the order of writing
    std::string record;                // that of `petzval lens report --json`
};
// True for the extensions .html, .htm and .xhtml.
PETZVAL_API bool is_lens_page(const std::string& path);
// Errors: InvalidArgument for several lenses without a folder.
PETZVAL_API Status check(const LensReportFiles& files);
// The paths in the order of writing. Errors: those of check() and lens_page_names().
PETZVAL_API Result<std::vector<std::string>> outputs_of(const LensReportFiles& files);
// `may_write` is asked when the folder exists, before the files are written; its error stops. Errors: those
// of outputs_of() and write_lens_pages(); OutOfMemory.
PETZVAL_API Result<LensReportMade> make_lens_report(const LensReportFiles& files,
                                                    const std::function<Status()>& may_write = {});

// A picture through one lens.
struct LensView {
    Picture light;     // the display window, scene-linear
    std::string lens;  // as requested
    double f_number = 0;
    std::vector<std::string> warnings = {};
};

// The look with another lens, its own aperture shape and added aberrations kept. f_number: empty for the
// lens's widest aperture, or the shot's f-number if the lens has no limit. A lens that does not open that
// far is used wide open, with a warning. shot.camera.f_number is changed. Errors: those of Lens::open() and
// Session::take(); InvalidArgument naming missing camera numbers.
PETZVAL_API Result<LensView> through_lens(Session& session, Shot& shot, Look look, const std::string& lens,
                                          std::optional<double> f_number = {}, const Control& control = {});

struct LensViewSheet {
    std::vector<std::string> lenses = {};  // names or lens files; at least one
    std::optional<double> f_number = {};   // of all; empty: each lens wide open
    int cell_width_px = 480;               // height by the shape of the picture
    int columns = 0;                       // 0: a sheet about as wide as high
    bool captions = true;                  // lens and f-number in each picture
    DevelopSettings develop = {};
};

// All lenses on one sheet, display-linear. `seen` is called after each lens; may be empty. Errors: those of
// through_lens(), with the lens before the message.
PETZVAL_API Result<Picture> lens_view_sheet(Session& session, Shot& shot, const Look& look,
                                            const LensViewSheet& sheet, const Control& control = {},
                                            const std::function<void(const LensView&)>& seen = {});

// One picture of a shot's files through several lenses, written as a display picture.
struct LensViewFile {
    ShotSource source;
    std::optional<PixelPosition> focus_pixel = {};
    std::optional<WorldPoint> focus_point = {};
    Look look = {};
    // `develop` comes from `display`; an aperture in source.camera sets the f-number of all
    // lenses.
    LensViewSheet sheet = {};
    DisplayChoice display = {};
    std::optional<Transfer> transfer = {};  // as the user gave it
    std::string output = {};                // .png
    bool overwrite = true;
    int threads = 0;  // 0: all
};
// `warn` gets the warnings of the shot, then those of each lens, which begin with its name. Errors: those of
// read_shot(), of focusing and of lens_view_sheet(); OutputFailed.
PETZVAL_API Status write_lens_view_sheet(const LensViewFile& file, const Control& control,
                                         const std::function<void(const std::string&)>& warn);

// The lens on a camera. Missing numbers are the lens's own, also its format. So a focal length alone
// scales the lens but not its sensor, and its aberrations in pixels grow too. If the sensor is scaled by
// the same factor, the kernel stays the same. height_px: empty for 9/16 of the width. Errors: those of
// own_camera().
PETZVAL_API Result<LensMount> mounted_on(const Lens& lens, const CameraChoice& choice, int width_px,
                                         std::optional<int> height_px = {});

// Refuses, before it is drawn and written, a kernel, texture or volume that takes more than limit_bytes (0:
// no limit). Errors: OutOfMemory; those of largest_disc_px() and most_texture_rows().
PETZVAL_API Status lens_disc_fits(const Lens& lens, const LensMount& mount, double coc_radius_px, int size_px,
                                  std::size_t limit_bytes);
PETZVAL_API Status bokeh_texture_fits(const Lens& lens, const LensMount& mount,
                                      const BokehTextureSettings& settings, std::size_t limit_bytes);
PETZVAL_API Status bokeh_volume_fits(const BokehVolumeSettings& settings, std::size_t limit_bytes);
// The same for an atlas with its files. Errors: OutOfMemory; those of lens_atlas_disc_px().
PETZVAL_API Status lens_atlas_fits(const Lens& lens, const LensMount& mount,
                                   const LensAtlasSettings& settings, std::size_t limit_bytes);
// The same for a report, whatever the lens. Errors: OutOfMemory.
PETZVAL_API Status lens_report_fits(std::size_t limit_bytes);

// EXR files of floats; their attributes (petzval:lens, petzval:coc, …) give all numbers that a program
// needs to use them (docs/reference/lens-files.md). Errors: those of write_exr_planes().
PETZVAL_API Status write_lens_disc(const std::string& path, const LensDisc& disc, double coc_radius_px,
                                   double field_x, double field_y, bool overwrite);
// Layers: energy without a name, "view", and the radius of each column as "coc.radius".
PETZVAL_API Status write_bokeh_texture(const std::string& path, const BokehTexture& texture,
                                       const BokehTextureSettings& settings, const LensMount& mount,
                                       bool overwrite);
// All slices in one picture, the first on top.
PETZVAL_API Picture stacked_slices(const BokehVolume& volume);
PETZVAL_API Status write_bokeh_volume(const std::string& path, const BokehVolume& volume,
                                      const LensMount& mount, bool overwrite);

// A kernel for displays: its brightest channel is 1, its alpha 1.
PETZVAL_API Picture exposed_to_white(Picture picture);
// The same as a PNG; without a tone curve unless one is chosen. Errors: OutputFailed.
PETZVAL_API Status write_lens_view(const std::string& path, Picture picture, const DisplayChoice& display,
                                   bool overwrite);

// One kernel of a lens. field_x, field_y and size_px are those of lens_point_spread().
struct LensDiscSettings {
    double coc_radius_px = 20;
    double field_x = 0, field_y = 0;
    int size_px = 0;
    bool raw = false;
};

// A kernel, a bokeh texture or a volume as a file, as petzval lens psf, table and volume write it.
struct LensPictureFile {
    Look look = {};                     // its lens, with the images of apertures and kernels that it names
    CameraChoice camera = {};           // numbers that are given replace the lens's own
    int width_px = 1920;                // of the picture that the camera takes
    std::optional<int> height_px = {};  // empty: 9/16 of the width
    std::string output = {};            // .exr: the numbers; .png: a picture for displays
    DisplayChoice display = {};         // of a PNG
    bool overwrite = true;              // false: an output that exists is an error
    std::size_t max_memory_bytes = 0;   // 0: no limit
    std::variant<LensDiscSettings, BokehTextureSettings, BokehVolumeSettings> picture = {};
};
// Errors: InvalidArgument for a choice of the lens that shows only away from the middle, where the kernel or
// the volume is of the middle.
PETZVAL_API Status check(const LensPictureFile& file);
struct LensPictureMade {
    std::string lens;     // the lens that was used, in words
    Camera camera;        // the lens was mounted on it
    std::string warning;  // empty: none
    std::string record;   // that of `petzval lens psf --json`, `lens table` or `lens volume`
};
// Calls `drawn` before the file is written; the record is empty then. Errors: those of check(),
// read_lens_images(), Lens::open(), mounted_on() and of the kernels; OutOfMemory; OutputFailed.
PETZVAL_API Result<LensPictureMade> make_lens_picture(
    LensPictureFile file, const std::function<void(const LensPictureMade&)>& drawn = {});

// An atlas of discs as files, as petzval lens atlas writes it: atlas.json and atlas.bin in a folder.
struct LensAtlasFiles {
    Look look = {};                     // its lens, with the images of apertures that it names
    CameraChoice camera = {};           // numbers that are given replace the lens's own
    int width_px = 1920;                // of the picture that the camera takes
    std::optional<int> height_px = {};  // empty: 9/16 of the width
    LensAtlasSettings atlas = {};
    std::string folder = {};           // made if it does not exist
    std::size_t max_memory_bytes = 0;  // 0: no limit
};
struct LensAtlasMade {
    std::string lens;    // the lens that was used, in words
    Camera camera;       // the lens was mounted on it
    std::string record;  // that of `petzval lens atlas --json`
};
// The paths of both files, the header first.
PETZVAL_API std::vector<std::string> outputs_of(const LensAtlasFiles& files);
// Errors: InvalidArgument for a number of zones out of range; for a pupil that is not round with several
// zones, which shaders turn about the middle; for a choice that shows only away from the middle with one
// zone.
PETZVAL_API Status check(const LensAtlasFiles& files);
// Writes the header last: if it exists, its texels do. Existing files are replaced. `may_write` is asked when
// the folder exists, before the files are written; its error stops. Errors: those of check(),
// read_lens_images(), Lens::open(), mounted_on() and lens_atlas(); OutOfMemory; OutputFailed.
PETZVAL_API Result<LensAtlasMade> make_lens_atlas(LensAtlasFiles files,
                                                  const std::function<Status()>& may_write = {});

// The lens buffer of the shader kit as a file, as petzval lens buffer writes it.
struct LensBufferFile {
    Look look = {};                     // its lens, with the images of apertures that it names; its quality
    CameraChoice camera = {};           // numbers that are given replace the lens's own
    int width_px = 1920;                // of the frame that the programs draw
    std::optional<int> height_px = {};  // empty: 9/16 of the width
    std::string output = {};
    bool overwrite = true;
    std::size_t max_memory_bytes = 0;  // 0: no limit
};
struct LensBufferMade {
    std::string lens;    // the lens that was used, in words
    Camera camera;       // the lens was mounted on it
    std::string record;  // that of `petzval lens buffer --json`
};
// Errors: those of read_lens_images(), Lens::open(), mounted_on() and realtime_lens_buffer(); OutOfMemory;
// OutputFailed.
PETZVAL_API Result<LensBufferMade> make_lens_buffer(LensBufferFile file);

}  // namespace petzval
