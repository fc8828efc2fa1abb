// Lenses for the tests of this room, typed in once.
#pragma once

#include "optics/prescription.h"

#include <cmath>

namespace petzval::optics {

// radius_mm 0: plane; nd 1: air.
inline Surface surface(double radius_mm, double thickness_mm, double nd, double vd, double clear_radius_mm) {
    Surface s;
    s.curvature_per_mm = radius_mm == 0 ? 0 : 1 / radius_mm;
    s.thickness_mm = thickness_mm;
    s.after = nd == 1 ? Glass{} : abbe_glass("model", nd, vd);
    s.clear_radius_mm = clear_radius_mm;
    return s;
}

// 50 mm f/2, US 2,673,491 (Tronnier), indices to three decimals as in the pbrt scenes' dgauss.50mm.dat.
inline Prescription double_gauss() {
    Prescription lens;
    lens.name = "double Gauss";
    lens.surfaces = {surface(29.475, 3.76, 1.67, 47.1, 12.6),  surface(84.83, 0.12, 1, 0, 12.6),
                     surface(19.275, 4.025, 1.67, 47.1, 11.5), surface(40.77, 3.275, 1.699, 30.1, 11.5),
                     surface(12.75, 5.705, 1, 0, 9.0),         surface(0, 4.5, 1, 0, 8.55),
                     surface(-14.495, 1.18, 1.603, 38.0, 8.5), surface(40.77, 6.065, 1.658, 57.3, 10.0),
                     surface(-20.385, 0.19, 1, 0, 10.0),       surface(437.065, 3.22, 1.717, 48.0, 10.0),
                     surface(-39.73, 36.1059, 1, 0, 10.0)};
    lens.stop = 5;
    lens.aperture_kind = ApertureKind::StopRadius;
    lens.aperture = 8.55;
    lens.field = 22;
    return lens;
}

// An upright cylinder.
inline Surface cylinder(double radius_mm, double thickness_mm, double nd, double vd, double clear_radius_mm) {
    Surface s = surface(0, thickness_mm, nd, vd, clear_radius_mm);
    s.cylinder_per_mm = 1 / radius_mm;
    return s;
}

// 60.5 mm f/1.96, squeeze 1.92: US 6,310,731.
inline Prescription anamorphic() {
    Prescription lens;
    lens.name = "anamorphic";
    lens.surfaces = {cylinder(-101.3, 4, 1.591, 61, 30),    cylinder(50, 7.7, 1.762, 27.2, 30),
                     cylinder(87.3, 71.3, 1, 0, 30),        surface(0, 4.4, 1.711, 30.3, 28),
                     cylinder(122.4, 9.5, 1.716, 53.8, 28), cylinder(-122.4, 2, 1, 0, 28),
                     surface(38.4, 6, 1.681, 54.9, 18),     surface(-783.3, 0.1, 1, 0, 18),
                     surface(35.9, 3.8, 1.758, 52.3, 16),   surface(55.5, 2.2, 1, 0, 16),
                     surface(-575.3, 9.2, 1.624, 36.4, 14), surface(18.8, 3.05, 1, 0, 10.5),
                     surface(0, 3.05, 1, 0, 10.5),          surface(-18.5, 1.5, 1.704, 30.1, 10.5),
                     surface(70.7, 1.7, 1, 0, 11),          surface(99.6, 4.4, 1.792, 47.5, 12),
                     surface(-26, 0.3, 1, 0, 12),           surface(115.2, 3.9, 1.732, 54.7, 14),
                     surface(-53.2, 43.33, 1, 0, 14)};
    lens.stop = 12;
    lens.aperture_kind = ApertureKind::StopRadius;
    lens.aperture = 9.8;
    lens.field = 20.8;
    return lens;
}

// f = 1, 160 degrees, US 4,256,373.
inline Prescription fisheye() {
    Prescription lens;
    lens.name = "fisheye";
    lens.surfaces = {surface(4.7033, 0.1305, 1.713, 53.93, 1.45),
                     surface(0.8146, 0.5754, 1, 0, 0.82),
                     surface(2.3433, 0.0979, 1.62041, 60.29, 0.8),
                     surface(0.7204, 0.3269, 1, 0, 0.6),
                     surface(1.4258, 0.251, 1.71736, 29.42, 0.6),
                     surface(-8.7833, 0.0063, 1, 0, 0.6),
                     surface(2.8016, 0.1632, 1.59551, 39.44, 0.55),
                     surface(-3.3885, 0.0653, 1.744, 44.9, 0.55),
                     surface(2.8217, 0.1305, 1, 0, 0.55),
                     surface(0, 0.0916, 1.5186, 60.1, 0.45),
                     surface(0, 0.0979, 1, 0, 0.45),
                     surface(0, 0.0979, 1, 0, 0.45),
                     surface(-4.4012, 0.3269, 1.497, 81.6, 0.55),
                     surface(-0.9403, 0.0063, 1, 0, 0.55),
                     surface(3.7044, 0.2943, 1.48749, 70.15, 0.55),
                     surface(-0.7556, 0.0916, 1.84666, 23.88, 0.55),
                     surface(-1.4548, 2.32458, 1, 0, 0.6)};
    lens.stop = 11;
    lens.aperture_kind = ApertureKind::FNumber;
    lens.aperture = 2.8;
    lens.field = 80;
    return lens;
}

// Plano-convex, f about 100, f/4; index 1.5168.
inline Prescription singlet() {
    Prescription lens;
    lens.name = "singlet";
    lens.surfaces = {surface(51.68, 5, 1.5168, 64.17, 15), surface(0, 96.7, 1, 0, 15)};
    lens.aperture_kind = ApertureKind::EntrancePupilDiameter;
    lens.aperture = 25;
    lens.field = 5;
    return lens;
}

}  // namespace petzval::optics
