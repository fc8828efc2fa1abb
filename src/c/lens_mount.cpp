#include "c/lens_mount.h"

#include "c/lent.h"

#include <string>

namespace petzval::c {

Result<LensMount> mount_of(const petzval_lens_mount* given, const Lens& lens) {
    const petzval_lens_mount m = taken(given);
    constexpr int kLargestSide = 1 << 20;
    LensMount mount;
    if (m.width != 0 || m.height != 0) mount.width_px = m.width, mount.height_px = m.height;
    for (const int side : {mount.width_px, mount.height_px})
        if (side < 1 || side > kLargestSide)
            return Error{ErrorCode::InvalidArgument,
                         "mount.width and height must be 1 to " + std::to_string(kLargestSide)};
    if (m.pixel_aspect != 0) mount.pixel_aspect = m.pixel_aspect;
    auto own = own_camera(lens);
    if (!own) return own.error();
    mount.camera = *own;
    if (!m.camera) return mount;
    const Camera asked = camera_of(taken(m.camera));
    mount.camera.image_scale = asked.image_scale;
    for (double Camera::*number :
         {&Camera::focal_length_mm, &Camera::sensor_width_mm, &Camera::f_number, &Camera::focus_distance_m})
        if (asked.*number != 0) mount.camera.*number = asked.*number;
    return mount;
}

}  // namespace petzval::c
